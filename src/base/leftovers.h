/// \file
/// Internal: the files that fusee wrote in a folder, and recovery from killed runs.
///
/// A killed run leaves its staging folder (staging.h). The next run that publishes into the same folder restores the
/// files set aside there and removes all others. The staging folder is not trusted: it must belong to this user, have
/// mode 0700 and be unlocked. No link is followed. Entries are moved by their plain names, only into the output folder,
/// and never over existing entries. Nothing outside the staging folder is deleted.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base.h"

namespace fusee {

/// The file that lists the others. Every set of outputs has one.
inline constexpr const char* k_manifest = "manifest.json";
/// Upper bound on the size of an output; a larger file was not written by fusee.
inline constexpr std::size_t k_largest_output = std::size_t{4} << 30;

/// Name and SHA-256 of outputs, manifests included.
using WrittenFiles = std::set<std::pair<std::string, std::string>>;

/// Adds the manifest of `folder` and the files that it lists. Adds nothing when fusee wrote no manifest there.
void add_written_files(const std::filesystem::path& folder, WrittenFiles& written);
/// Adds the files listed by the manifests in the leftovers of `place`. Changes nothing on the disk.
void add_files_aside(const std::filesystem::path& place, WrittenFiles& written);
/// True when `folder` holds a regular file `name` with the listed bytes.
bool is_unchanged(const WrittenFiles& written, const std::filesystem::path& folder, const std::string& name);

/// Folders within an output folder, taken from names like "next/run_1.csv".
using Subfolders = std::set<std::string>;
/// Adds the subfolder of `name`, if `name` has one.
void add_subfolder(const std::string& name, Subfolders& subfolders);
Subfolders subfolders_of(const WrittenFiles& written);
/// Names of the entries in `folder` and in its listed subfolders ("next/run_1.csv").
std::vector<std::string> entries_in(const std::filesystem::path& folder, const Subfolders& subfolders);
/// Makes the subfolder of `name` in `folder` unless it exists. Returns false and sets errno on failure.
bool make_subfolder(const std::filesystem::path& folder, const std::string& name);

/// Moves the entries of `from` into `to`, except those for which `is_skipped` holds and those whose name exists there.
/// Returns the number of moved entries, or -1 when a move failed.
int move_entries(const std::filesystem::path& from, const std::filesystem::path& to, const Subfolders& subfolders,
                 const std::function<bool(const std::string& name)>& is_skipped = {});

/// Completes or undoes what killed runs began in the folder `place`. Never throws for what it finds there. The notes
/// report restored and ignored files.
std::vector<Diagnostic> recover_leftovers(const std::filesystem::path& place);
/// For an output that is a single file: removes its leftover staging folders, except those that hold an earlier file.
void remove_staged_leftovers(const std::filesystem::path& file);

}  // namespace fusee
