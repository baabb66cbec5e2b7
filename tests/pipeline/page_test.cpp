// Checks src/README.md against the code, and the equations and tests that other pages name.
#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "pipeline/cmake_modules.h"
#include "pipeline/source_text.h"

namespace fusee::house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path k_root = FUSEE_SOURCE_DIR;

const std::vector<Source>& product_sources() {
  static const std::vector<Source> sources = sources_under({"include", "src", "export"});
  return sources;
}

/// Table rows and paragraphs: names of one passage belong together.
std::vector<std::string> passages_of(const std::string& page) {
  std::vector<std::string> passages = {""};
  std::istringstream lines(page);
  bool fenced = false;
  for (std::string line; std::getline(lines, line);) {
    const bool fence = line.rfind("```", 0) == 0;
    fenced = fenced != fence;
    if (fence || fenced) continue;
    if (line.empty() || line.front() == '|') passages.emplace_back();
    passages.back() += line + "\n";
  }
  return passages;
}

/// The names in `backticks`.
std::vector<std::string> named_in(const std::string& passage) {
  static const std::regex pattern("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator i(passage.begin(), passage.end(), pattern), end; i != end; ++i) names.push_back((*i)[1]);
  return names;
}

bool is_command(const std::string& name) { return name.rfind("fusee ", 0) == 0; }
bool is_function(const std::string& name) { return name.size() > 2 && name.substr(name.size() - 2) == "()"; }
bool is_path(const std::string& name) { return name.find('/') != std::string::npos; }

/// Definitions and declarations begin in the first column; calls do not.
bool has_function(const std::string& path, const std::string& name) {
  const std::string words = name.substr(0, name.size() - 2);
  const std::regex pattern("(^|\n)[A-Za-z][^\n;={]*\\b" + words + "\\(");
  return std::regex_search(code_of(text_of(path)), pattern);
}

/// True for a type, a key or a name in outputs: it occurs in the code, or a file name ends in it.
bool is_name_of_the_project(const std::string& name) {
  const std::string word = std::regex_replace(name, std::regex("^\\[|\\]$"), "");
  return fs::exists(k_root / name) ||
         std::any_of(product_sources().begin(), product_sources().end(), [&](const Source& source) {
           const bool path_ends_so = source.path.size() >= word.size() &&
                                     source.path.compare(source.path.size() - word.size(), word.size(), word) == 0;
           return path_ends_so || source.text.find(word) != std::string::npos;
         });
}

/// "" if the name is known. `beside`: the names of its passage, among which is the file of a function.
std::string why_unknown(const std::string& name, const std::vector<std::string>& beside) {
  if (is_command(name)) return "";
  if (is_path(name)) return fs::exists(k_root / name) ? "" : "there is no " + name;
  if (!is_function(name)) return is_name_of_the_project(name) ? "" : "nothing is called " + name;
  const bool found = std::any_of(beside.begin(), beside.end(), [&](const std::string& path) {
    return is_path(path) && fs::is_regular_file(k_root / path) && has_function(path, name);
  });
  return found ? "" : "no file in the passage of " + name + " defines it";
}

std::vector<std::string> unknown_names_in(const std::string& page) {
  std::vector<std::string> words;
  for (const std::string& passage : passages_of(page)) {
    const std::vector<std::string> names = named_in(passage);
    for (const std::string& name : names) {
      const std::string why = why_unknown(name, names);
      if (!why.empty()) words.push_back(why);
    }
  }
  return words;
}

TEST(Page, NamesExist) { EXPECT_THAT(unknown_names_in(text_of("src/README.md")), IsEmpty()); }

bool is_test(const std::string& name) {
  static const std::regex pattern("[A-Z][A-Za-z]+\\.[A-Za-z_]+");
  return std::regex_match(name, pattern);
}

bool has_test(const std::string& name) {
  static const std::vector<Source> tests = sources_under({"tests"});
  const std::string suite = name.substr(0, name.find('.')), test = name.substr(name.find('.') + 1);
  return std::any_of(tests.begin(), tests.end(), [&](const Source& source) {
    return source.text.find("(" + suite + ", " + test + ")") != std::string::npos;
  });
}

/// Checks the names in backticks of a page for users as far as they are the project's: files, functions, tests.
std::vector<std::string> unknown_names_for_users_in(const std::string& page) {
  std::vector<std::string> words;
  for (const std::string& passage : passages_of(page)) {
    const std::vector<std::string> names = named_in(passage);
    for (const std::string& name : names) {
      if (is_test(name) && !has_test(name)) words.push_back("there is no test " + name);
      const bool ours = is_function(name) || (is_path(name) && name.find(' ') == std::string::npos);
      const std::string why = ours ? why_unknown(name, names) : "";
      if (!why.empty()) words.push_back(why);
    }
  }
  return words;
}

TEST(Page, NamesOnUserPagesExist) {
  for (const char* page : {"background/physics.md", "background/calibration.md", "background/guarantees.md",
                           "background/certified-optimum.md", "development/architecture.md", "development/extending.md",
                           "development/testing.md", "development/releasing.md"}) {
    EXPECT_THAT(unknown_names_for_users_in(text_of(std::string("docs/") + page)), IsEmpty()) << page;
  }
}

TEST(Page, ListsModulesInOrder) {
  static const std::regex row("^\\| `([a-z_]+)` \\|");
  std::vector<std::string> modules;
  for (const std::string& passage : passages_of(text_of("src/README.md"))) {
    std::smatch match;
    if (std::regex_search(passage, match, row)) modules.push_back(match[1]);
  }
  EXPECT_EQ(modules, modules_in_flow());
}

TEST(Page, DetectsUnknownNames) {
  EXPECT_THAT(unknown_names_in("`read_file()` in `src/base/files.cpp`; `fusee build`\n"), IsEmpty());
  EXPECT_THAT(unknown_names_in("| `read_file()` | `src/base/text.cpp` |\n| `src/base/files.cpp` |\n"),
              ElementsAre("no file in the passage of read_file() defines it"));
  EXPECT_THAT(unknown_names_in("`src/base/nowhere.cpp`\n\n`Mechanism`, `Mechanizm`\n```\n`fenced`\n```\n"),
              ElementsAre("there is no src/base/nowhere.cpp", "nothing is called Mechanizm"));
  EXPECT_THAT(unknown_names_for_users_in("`Page.DetectsUnknownNames` `Page.IsNot` `law = 1/2` `src/base/nowhere.cpp`"),
              ElementsAre("there is no test Page.IsNot", "there is no src/base/nowhere.cpp"));
  // build.cpp calls the function but does not define it.
  EXPECT_THAT(unknown_names_in("`synthesise()` in `src/pipeline/build.cpp`"),
              ElementsAre("no file in the passage of synthesise() defines it"));
}

}  // namespace
}  // namespace fusee::house
