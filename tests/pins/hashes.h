/// \file
/// Hashes of outputs as sha256sum writes them: "<64 digits>  build/forearm/pulley.stl", in one file for each command.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"

namespace fusee::pins {

/// Path of an output, "build/forearm/pulley.stl" → SHA-256, 64 hexadecimal digits.
using Hashes = std::map<std::string, std::string>;

/// Name of the hash file: "build/forearm" → "build.sha256".
std::string hash_file_of(const std::string& run_name);
Hashes hashes_of(const std::string& run_name, const std::vector<OutputFile>& outputs);

std::string text_of(const Hashes& hashes);
Hashes parse_hashes(std::string_view text);

/// Differences in words, one a line: changed, removed, new. Empty if there are none.
std::vector<std::string> differences(const Hashes& pinned, const Hashes& found);

}  // namespace fusee::pins
