#include "pipeline/cmake_modules.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "pipeline/source_text.h"

namespace fusee::house {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The first group of each match of a pattern.
std::vector<std::string> first_groups(std::string_view text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> words;
  const std::string copy(text);
  for (std::sregex_iterator i(copy.begin(), copy.end(), regex), end; i != end; ++i) words.push_back((*i)[1]);
  return words;
}

std::string without_comments(std::string_view text) {
  return std::regex_replace(std::string(text), std::regex("#.*"), "");
}

std::string folder_of(const std::string& module) { return module == "export" ? "export" : "src/" + module; }

/// The words after MODULES up to the next keyword.
std::set<std::string> modules_named(const std::string& call) {
  std::set<std::string> modules;
  bool listed = false;
  for (const std::string& word : words_of(call)) {
    const bool keyword = std::regex_match(word, std::regex("SOURCES|MODULES|LIBS"));
    if (keyword) listed = word == "MODULES";
    if (!keyword && listed) modules.insert(word);
  }
  return modules;
}

/// The program is not a library: it links its modules as targets, such as "fusee_pipeline".
std::set<std::string> modules_linked(const std::string& call, const std::vector<std::string>& modules) {
  std::set<std::string> linked;
  const std::vector<std::string> words = words_of(call);
  for (const std::string& module : modules) {
    if (std::find(words.begin() + 1, words.end(), "fusee_" + module) != words.end()) linked.insert(module);
  }
  return linked;
}

}  // namespace

std::vector<std::string> modules_in_flow() {
  std::vector<std::string> modules;
  for (const std::string& line : first_groups(text_of("CMakeLists.txt"), "#([^\n]*<-[^\n]*)")) {
    for (const std::string& module : first_groups(line, "([a-z_]+)")) modules.push_back(module);
  }
  return modules;
}

std::map<std::string, int> flow() {
  std::map<std::string, int> places;
  for (const std::string& module : modules_in_flow()) places.emplace(module, static_cast<int>(places.size()));
  return places;
}

std::vector<std::string> arguments_of(std::string_view text, const std::string& command) {
  return first_groups(without_comments(text), "\\b" + command + "\\(([^)]*)\\)");
}

std::vector<std::string> list_in(std::string_view text, const std::string& command, const std::string& name) {
  for (const std::string& arguments : arguments_of(text, command)) {
    std::vector<std::string> words = words_of(arguments);
    if (words.empty() || words.front() != name) continue;
    words.erase(words.begin());
    return words;
  }
  return {};
}

std::map<std::string, std::set<std::string>> links() {
  const std::vector<std::string> modules = modules_in_flow();
  std::map<std::string, std::set<std::string>> links;
  for (const std::string& module : modules) {
    const std::string text = text_of(folder_of(module) + "/CMakeLists.txt");
    std::set<std::string>& linked = links[module];
    for (const std::string& call : arguments_of(text, "fusee_module")) linked.merge(modules_named(call));
    for (const std::string& call : arguments_of(text, "target_link_libraries"))
      linked.merge(modules_linked(call, modules));
  }
  return links;
}

}  // namespace fusee::house
