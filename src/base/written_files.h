/// \file
/// Internal: which files in a folder fusee wrote. The manifest.json that every set of outputs holds lists them.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace fusee {

inline constexpr const char* k_manifest = "manifest.json";
/// No output of ours is larger: such a file was written by somebody else.
inline constexpr std::size_t k_largest_output = std::size_t{4} << 30;

/// Name and SHA-256 of outputs.
using WrittenFiles = std::set<std::pair<std::string, std::string>>;

/// Adds what the manifest of `folder` lists. False, and nothing added, when there is none that fusee wrote.
bool add_written_files(const std::filesystem::path& folder, WrittenFiles& written);

/// True for a regular file that is listed, by its name, with the bytes that it has now.
bool is_unchanged(const WrittenFiles& written, const std::filesystem::path& file);

}  // namespace fusee
