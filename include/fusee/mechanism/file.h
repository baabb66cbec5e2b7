/// \file
/// The mechanism file: TOML in, TOML out, and what `fusee explain`, `fusee new` and an editor's schema say about it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/mechanism.h"

namespace fusee {

/// "table.key=value" from the command line; the value is TOML ("100", "[-20, 20]", "\"linear\""; a bare word is a
/// string).
struct Setting {
  std::string key;
  std::string value;
};

/// Where each key that was written stands, by dotted name; what --set gave has the setting for a file.
using KeyPlaces = std::map<std::string, Place, std::less<>>;

/// A mechanism read from a file, with what the manifest needs to name it.
struct MechanismFile {
  DeclaredMechanism mechanism;
  std::string path;
  std::string sha256;  ///< of the file's bytes (settings are not in it)
  std::vector<Diagnostic> warnings;
  KeyPlaces places;

  /// Of a key; the whole file where it was not written.
  Place place_of(std::string_view key) const;
};

/// Reads, fills in the defaults, applies `settings`, checks every key against the field table and the keys against
/// each other, and loads the table of law = "table". Throws InputError with *all* errors of the file at once.
MechanismFile read_mechanism(const std::filesystem::path& path, const std::vector<Setting>& settings = {});

/// The same from text; `name` stands in the messages, tables are looked for in `folder`.
DeclaredMechanism parse_mechanism(std::string_view text, const std::string& name,
                                  const std::filesystem::path& folder = ".", const std::vector<Setting>& settings = {},
                                  std::vector<Diagnostic>* warnings = nullptr, KeyPlaces* places = nullptr);

/// A complete file with every key, its meaning, unit, range and default as a comment. parse(write(m)) == m.
std::string write_mechanism(const DeclaredMechanism& mechanism);

/// `fusee explain`: a key ("r1_mm", "pulley.r1_mm"), a table ("pulley") or "" for the list. InputError with the nearest
/// key.
std::string explain(std::string_view key);
/// The same for machines (JSON text).
std::string explain_json(std::string_view key);

/// JSON schema of the mechanism file, for editors.
std::string mechanism_schema();

/// Templates of `fusee new`: the files of profiles/ that were compiled in.
struct Template {
  std::string_view name;
  std::string_view text;
};
std::vector<Template> templates();
/// What it says of itself.
std::string first_comment(const Template& known);
/// The text of one. InputError with the nearest name.
std::string_view find_template(std::string_view name);

}  // namespace fusee
