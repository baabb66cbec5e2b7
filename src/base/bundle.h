/// \file
/// A bundle: one run of the program in one zip file, to reproduce a bug. It holds bundle.json, the run's stdout and its
/// input files. The same run gives the same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"

namespace fusee {

/// An input file of the run: its bytes, or the reason why it could not be read.
struct BundledFile {
  std::string path;  ///< path in the run's folder, as the bundle names it: "arm.toml", "outside/run.csv"
  std::string bytes;
  std::optional<Diagnostic> failure;  ///< set when the file could not be read; `bytes` is then empty
};

struct BundledOutput {
  std::string path;  ///< path in the output folder of the command line: "pulley.stl"
  std::uint64_t bytes = 0;
  std::string sha256;

  bool operator==(const BundledOutput&) const = default;
};

/// Exit code, messages and outputs of the run.
struct BundledOutcome {
  int exit = 0;
  std::vector<Diagnostic> messages;
  std::string result;                  ///< stdout
  std::vector<BundledOutput> outputs;  ///< in the order in which the run wrote them
};

struct Bundle {
  std::string version;             ///< version of fusee: "0.1.0"
  std::string built_with;          ///< "gcc 12.2.0"
  std::string runs_on;             ///< "x86_64, glibc 2.36"
  std::vector<std::string> words;  ///< the command line, with the file names of the bundle
  std::vector<BundledFile> files;
  /// Names of entries (folders as "name/") that existed where outputs should go and were refused with exit code 6.
  std::vector<std::string> in_the_way;
  BundledOutcome outcome;
};

/// Upper bound on the size of a bundle, packed and unpacked.
inline constexpr std::uint64_t k_largest_bundle = std::uint64_t{512} << 20;
/// Upper bound on the number of files, and on the number of folders. Entries in the way count as well.
inline constexpr std::size_t k_most_bundled_files = 2000;

std::string bundle_bytes(const Bundle& bundle);
/// Parses untrusted bytes. Throws InputError for `name` and the offending entry: names that lead out of the bundle or
/// are hidden, links, duplicate or unlisted entries, wrong hashes, exceeded limits.
Bundle read_bundle(std::string_view bytes, const std::string& name);
/// True when `bytes` begin like a bundle. Such a file may be overwritten.
bool is_bundle(std::string_view bytes);

/// True for a relative UTF-8 path like "a/b.csv" whose parts do not begin with a dot. Colons, backslashes and
/// characters that cleaned_line() replaces are rejected: the path stays inside its folder on every system and can be
/// printed. It has at most 1000 bytes, and each part at most 255.
bool is_inner_path(std::string_view path);

}  // namespace fusee
