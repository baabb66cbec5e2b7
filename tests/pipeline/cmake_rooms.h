/// \file
/// The rooms as the build has them: the flow in the top CMakeLists.txt, and the lists that must agree with it.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace fusee::house {

/// From left to right, as the comment of the top CMakeLists.txt draws them: "base <- mechanism <- …".
std::vector<std::string> rooms_in_flow();
/// Room → its place in the flow.
std::map<std::string, int> flow();

/// The names that a call of CMake holds, "add_subdirectory(base)" … for each call: {"base", …}.
std::vector<std::string> arguments_of(std::string_view text, const std::string& command);
/// What `set(NAME a b c)` lists, or `foreach(NAME a b c)`.
std::vector<std::string> list_in(std::string_view text, const std::string& command, const std::string& name);

/// Room → the rooms that its CMakeLists.txt links it with.
std::map<std::string, std::set<std::string>> links();
/// `room`, what it is linked with, what that is linked with …
std::set<std::string> reached_from(const std::string& room, const std::map<std::string, std::set<std::string>>& links);

}  // namespace fusee::house
