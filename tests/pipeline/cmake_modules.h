/// \file
/// The modules as the build has them: their order in the top CMakeLists.txt, and the lists that must agree with it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fusee::house {

/// From left to right, as the comment of the top CMakeLists.txt draws them: "base <- mechanism <- …".
std::vector<std::string> modules_in_flow();
/// Module → its place in that order.
std::map<std::string, int> flow();

/// The arguments of each call of a CMake command: for "add_subdirectory(base)" … {"base", …}.
std::vector<std::string> arguments_of(std::string_view text, const std::string& command);
/// The values of `set(NAME a b c)` or `foreach(NAME a b c)`.
std::vector<std::string> list_in(std::string_view text, const std::string& command, const std::string& name);

/// Module → the modules that its CMakeLists.txt links.
std::map<std::string, std::set<std::string>> links();

}  // namespace fusee::house
