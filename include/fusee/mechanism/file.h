/// \file
/// Reading and writing of mechanism files (TOML), and the texts of `fusee explain`, `fusee new` and the editor schema.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/base/file_access.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// "table.key=value" from the command line. The value is TOML ("100", "[-20, 20]", "\"linear\""); a bare word is a
/// string.
struct Setting {
  std::string key;
  std::string value;
};

/// Place of each written key, by dotted name. Keys from --set have the setting as their file.
using KeyPlaces = std::map<std::string, Place, std::less<>>;

/// A mechanism read from a file, with the data that a manifest needs.
struct MechanismFile {
  DeclaredMechanism mechanism;
  std::string path;
  std::string sha256;  ///< of the file's bytes, without settings
  std::vector<Diagnostic> warnings;
  KeyPlaces places;

  /// The place of a key; the whole file if the key was not written.
  Place place_of(std::string_view key) const;
};

/// Reads a file, fills in defaults, applies `settings`, and loads the table of the law. Checks each key against the
/// field table and the keys against each other. Throws InputError with *all* errors of the file.
MechanismFile read_mechanism(const std::filesystem::path& path, const std::vector<Setting>& settings = {},
                             FileAccess& files = disk());

/// As read_mechanism(), from text. `name` is used in messages; tables are searched in `folder`.
DeclaredMechanism parse_mechanism(std::string_view text, const std::string& name,
                                  const std::filesystem::path& folder = ".", const std::vector<Setting>& settings = {},
                                  std::vector<Diagnostic>* warnings = nullptr, KeyPlaces* places = nullptr,
                                  FileAccess& files = disk());

/// A complete file, where each key has its meaning, unit, range and default as a comment. parse(write(m)) == m.
std::string write_mechanism(const DeclaredMechanism& mechanism);

/// Text of `fusee explain`: for a key ("r1_mm", "pulley.r1_mm"), a table ("pulley") or "" for the list. Throws
/// InputError with the nearest key.
std::string explain(std::string_view key);
/// The explanation as JSON text.
std::string explain_json(std::string_view key);

/// JSON schema of the mechanism file, for editors.
std::string mechanism_schema();

/// Templates of `fusee new`: the files of profiles/, compiled in.
struct Template {
  std::string_view name;
  std::string_view text;
};
std::vector<Template> templates();
/// The description in the template's first line.
std::string first_comment(const Template& known);
/// The text of a template. Throws InputError with the nearest name.
std::string_view find_template(std::string_view name);

}  // namespace fusee
