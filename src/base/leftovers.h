/// \file
/// Internal: which files in a folder fusee wrote, the staging folders of killed runs, and the way back from them.
///
/// A killed run leaves its staging folder (staging.h). The next run that publishes into the same place puts back what
/// lies aside there and removes the rest. It trusts nothing in it: the folder must belong to this user, with mode 0700,
/// and nobody may hold its lock; no link is followed; entries are moved by their plain names, into the place alone, and
/// never over what stands there. Nothing outside the staging folder is deleted.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fusee/base/diagnostics.h"

namespace fusee {

/// Every set of outputs holds one, which lists the others.
inline constexpr const char* k_manifest = "manifest.json";
/// No output of ours is larger: such a file was written by somebody else.
inline constexpr std::size_t k_largest_output = std::size_t{4} << 30;

/// Name and SHA-256 of outputs, their manifest among them.
using WrittenFiles = std::set<std::pair<std::string, std::string>>;

/// Adds the manifest of `folder` and what it lists. Nothing when there is none that fusee wrote.
void add_written_files(const std::filesystem::path& folder, WrittenFiles& written);
/// Adds what the manifests in the leftovers of `place` list. Changes nothing on the disk.
void add_files_aside(const std::filesystem::path& place, WrittenFiles& written);
/// True for a regular file that is listed as `name`, with the bytes that it has now in `folder`.
bool is_unchanged(const WrittenFiles& written, const std::filesystem::path& folder, const std::string& name);

/// Folders within an output folder: those of the names "next/run_1.csv".
using Subfolders = std::set<std::string>;
/// Adds the subfolder of `name`, if it has one.
void add_subfolder(const std::string& name, Subfolders& subfolders);
Subfolders subfolders_of(const WrittenFiles& written);
/// Names in `folder`; of each subfolder that it holds, the names in that: "next/run_1.csv".
std::vector<std::string> entries_in(const std::filesystem::path& folder, const Subfolders& subfolders);
/// Makes the subfolder of `name` in `folder` where it is missing; false with errno.
bool make_subfolder(const std::filesystem::path& folder, const std::string& name);

/// Moves the entries of `from` into `to`, but those that `is_obsolete`, if given, and those whose name is taken there.
/// Returns how many were moved, and -1 when one could not be.
int move_entries(const std::filesystem::path& from, const std::filesystem::path& to, const Subfolders& subfolders,
                 const std::function<bool(const std::string& name)>& is_obsolete = {});

/// Ends what killed runs began at the folder `place`. Never throws for what lies there; the notes report what
/// was put back, and what was ignored.
std::vector<Diagnostic> recover_leftovers(const std::filesystem::path& place);
/// Removes the leftovers of `file` in which nothing but new files is.
void remove_staged_leftovers(const std::filesystem::path& file);

}  // namespace fusee
