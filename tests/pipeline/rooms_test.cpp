// The order of modules is drawn once, in the top CMakeLists.txt. All other lists of modules must agree with it.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "pipeline/cmake_rooms.h"
#include "pipeline/source_text.h"

namespace fusee::house {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

const fs::path k_root = FUSEE_SOURCE_DIR;

std::vector<std::string> flow_without(const std::vector<std::string>& left_out) {
  std::vector<std::string> rooms = rooms_in_flow();
  for (const std::string& room : left_out) {
    EXPECT_THAT(rooms, Contains(room));
    std::erase(rooms, room);
  }
  return rooms;
}

std::vector<std::string> folders_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(k_root / folder)) {
    if (entry.is_directory()) names.push_back(entry.path().filename().string());
  }
  return names;
}

TEST(Modules, AreUniqueInOrder) {
  EXPECT_EQ(flow().size(), rooms_in_flow().size());
  EXPECT_EQ(rooms_in_flow().front(), "base");
  EXPECT_EQ(rooms_in_flow().back(), "cli");
}

TEST(Modules, IncludeEveryFolder) {
  for (const std::string& folder : folders_in("src")) EXPECT_THAT(rooms_in_flow(), Contains(folder));
}

TEST(Modules, AreBuiltInOrder) {
  EXPECT_EQ(arguments_of(text_of("src/CMakeLists.txt"), "add_subdirectory"), flow_without({"export"}));
}

/// All but the ends of the order, which are not libraries: the program and the Python module.
TEST(Modules, AreInstalled) {
  EXPECT_EQ(list_in(text_of("src/install.cmake"), "set", "FUSEE_ROOMS"), flow_without({"python", "cli"}));
}

TEST(Modules, LinkFromRightToLeft) {
  const std::map<std::string, int> place = flow();
  for (const auto& [room, linked] : links()) {
    for (const std::string& other : linked) EXPECT_LT(place.at(other), place.at(room)) << room << " ← " << other;
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
  const std::string text = "add_subdirectory(a)  # add_subdirectory(b)\nset(ROOMS a b\n  c)\nset(OTHER d)\n";
  EXPECT_THAT(arguments_of(text, "add_subdirectory"), ElementsAre("a"));
  EXPECT_THAT(list_in(text, "set", "ROOMS"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(list_in(text, "set", "NONE"), IsEmpty());
}

}  // namespace
}  // namespace fusee::house
