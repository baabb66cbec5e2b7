// The order of modules is drawn once, in the top CMakeLists.txt. All other lists of modules must agree with it.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "pipeline/cmake_modules.h"
#include "pipeline/source_text.h"

namespace fusee::house {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path k_root = FUSEE_SOURCE_DIR;

std::vector<std::string> flow_without(const std::vector<std::string>& left_out) {
  std::vector<std::string> modules = modules_in_flow();
  for (const std::string& module : left_out) {
    EXPECT_THAT(modules, Contains(module));
    std::erase(modules, module);
  }
  return modules;
}

std::vector<std::string> folders_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(k_root / folder)) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(Modules, AreUniqueInOrder) {
  EXPECT_EQ(flow().size(), modules_in_flow().size());
  EXPECT_EQ(modules_in_flow().front(), "base");
  EXPECT_EQ(modules_in_flow().back(), "cli");
}

TEST(Modules, IncludeEveryFolder) {
  for (const std::string& folder : folders_in("src")) EXPECT_THAT(modules_in_flow(), Contains(folder));
}

TEST(Modules, AreBuiltInOrder) {
  EXPECT_EQ(arguments_of(text_of("src/CMakeLists.txt"), "add_subdirectory"), flow_without({"export"}));
}

/// The inner modules of export that are libraries of their own.
std::vector<std::string> libraries_in_export() {
  std::vector<std::string> libraries;
  for (const std::string& folder : arguments_of(text_of("export/CMakeLists.txt"), "add_subdirectory")) {
    const std::string text = text_of("export/" + folder + "/CMakeLists.txt");
    if (!arguments_of(text, "fusee_inner_library").empty()) libraries.push_back(folder);
  }
  return libraries;
}

/// All but the ends of the order, which are not libraries: the program and the Python module. Libraries within export
/// stand before it.
TEST(Modules, AreInstalled) {
  std::vector<std::string> libraries = flow_without({"python", "cli"});
  const std::vector<std::string> inner = libraries_in_export();
  libraries.insert(std::find(libraries.begin(), libraries.end(), "export"), inner.begin(), inner.end());
  EXPECT_EQ(list_in(text_of("src/install.cmake"), "set", "FUSEE_LIBRARIES"), libraries);
}

TEST(Modules, LinkFromRightToLeft) {
  const std::map<std::string, int> place = flow();
  for (const auto& [module, linked] : links()) {
    for (const std::string& other : linked) EXPECT_LT(place.at(other), place.at(module)) << module << " ← " << other;
  }
}

/// A folder of tests that is missing from the list would never run.
TEST(Modules, HaveTests) {
  const std::vector<std::string> listed = list_in(text_of("tests/CMakeLists.txt"), "foreach", "folder");
  for (const std::string& folder : folders_in("tests")) {
    if (!fs::exists(k_root / "tests" / folder / "CMakeLists.txt")) continue;
    EXPECT_THAT(listed, Contains(folder));
  }
}

TEST(Modules, AreReadFromCMake) {
  const std::string text = "add_subdirectory(a)  # add_subdirectory(b)\nset(MODULES a b\n  c)\nset(OTHER d)\n";
  EXPECT_THAT(arguments_of(text, "add_subdirectory"), ElementsAre("a"));
  EXPECT_THAT(list_in(text, "set", "MODULES"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(list_in(text, "set", "NONE"), IsEmpty());
}

}  // namespace
}  // namespace fusee::house
