/// \file
/// A bundle: one run of the program in one file, so that a report of a bug can be run again. A zip of bundle.json, what
/// the run said on stdout, and the files that it read; nothing else, and the same run gives the same bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/diagnostics.h"

namespace fusee {

/// What a run got when it asked for a file.
struct BundledFile {
  std::string path;  ///< in the folder of the run, as the bundle names it: "arm.toml", "outside/run.csv"
  std::string bytes;
  std::optional<Diagnostic> failure;  ///< instead of bytes: it could not be read
};

struct BundledOutput {
  std::string path;  ///< in the folder that the command line names: "pulley.stl"
  std::uint64_t bytes = 0;
  std::string sha256;

  bool operator==(const BundledOutput&) const = default;
};

/// How it ended and what it said.
struct BundledOutcome {
  int exit = 0;
  std::vector<Diagnostic> messages;
  std::string result;                  ///< stdout
  std::vector<BundledOutput> outputs;  ///< in the order in which they were written
};

struct Bundle {
  std::string version;             ///< of fusee: "0.1.0"
  std::string built_with;          ///< "gcc 12.2.0"
  std::string runs_on;             ///< "x86_64, glibc 2.36"
  std::vector<std::string> words;  ///< the command line, files named as in the bundle
  std::vector<BundledFile> files;
  /// Names alone, of files (and folders, "name/") that stood where outputs should go: refused with exit code 6.
  std::vector<std::string> in_the_way;
  BundledOutcome outcome;
};

/// Packed and unpacked a bundle holds no more.
inline constexpr std::uint64_t k_largest_bundle = std::uint64_t{512} << 20;
/// Of files, of names in the way, and of the folders that they stand in: each.
inline constexpr std::size_t k_most_bundled_files = 2000;

std::string bundle_bytes(const Bundle& bundle);
/// Any bytes. InputError of `name`, with the entry that is wrong: names that lead out of the bundle or are hidden, links,
/// entries that stand twice, that are not listed or not as listed, or too much of anything.
Bundle read_bundle(std::string_view bytes, const std::string& name);
/// Whether these bytes begin as a bundle does: ours to replace.
bool is_bundle(std::string_view bytes);

/// "a/b.csv": UTF-8, not absolute, no part of it begins with a dot, and without colons, backslashes and what cleaned()
/// takes out: it leads elsewhere on no system, hides nothing, and may be shown.
bool is_inner_path(std::string_view path);

}  // namespace fusee
