// The flow is the layout: a room uses only rooms to its left. These tests read every #include and say which one does
// not.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> k_flow = {
    {"base", 0},     {"mechanism", 1}, {"transmission", 2}, {"profile", 3},    {"measurement", 4},
    {"joint", 5},    {"analysis", 6},  {"optimize", 7},     {"paper", 8},      {"calibration", 9},
    {"correction", 10}, {"solid", 11}, {"export", 12},      {"pipeline", 13},  {"cli", 14}};

struct Include {
  fs::path file;  ///< relative to the source tree
  int line = 0;
  std::string target;
  bool quoted = false;  ///< "…" and not <…>

  std::string says() const { return file.string() + ":" + std::to_string(line) + " includes " + target; }
};

/// "fusee/solid/mesh.h" → "solid"; "fusee/pipeline.h" → "pipeline"; "mechanism/reader.h" → "mechanism"; else "".
std::string room_of(const std::string& target) {
  static const std::regex pattern("^(?:fusee/)?([a-z]+)(?:/|\\.h$)");
  std::smatch match;
  return std::regex_search(target, match, pattern) && k_flow.count(match[1]) ? match[1].str() : "";
}

/// include/fusee/solid/mesh.h, src/solid/mesh.cpp → "solid"; export/stl.cpp → "export".
std::string home_of(const fs::path& file) {
  const std::string path = file.generic_string();
  for (const std::string prefix : {"include/", "src/", ""}) {
    if (path.rfind(prefix, 0) == 0) return room_of(path.substr(prefix.size()));
  }
  return "";
}

std::vector<Include> includes_under(const std::vector<std::string>& folders) {
  static const std::regex pattern("^\\s*#\\s*include\\s*([<\"])([^>\"]+)");
  const fs::path root = FUSEE_SOURCE_DIR;
  std::vector<Include> includes;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".h" && ending != ".cpp") continue;
      std::ifstream stream(entry.path());
      std::string line;
      for (int number = 1; std::getline(stream, line); ++number) {
        std::smatch match;
        if (!std::regex_search(line, match, pattern)) continue;
        includes.push_back({fs::relative(entry.path(), root), number, match[2], match[1] == "\""});
      }
    }
  }
  return includes;
}

const std::vector<Include>& all_includes() {
  static const std::vector<Include> includes = includes_under({"include", "src", "export"});
  return includes;
}

TEST(Includes, AreFoundInEveryRoom) {
  std::set<std::string> homes;
  for (const Include& include : all_includes()) homes.insert(home_of(include.file));
  for (const auto& [room, place] : k_flow) EXPECT_TRUE(homes.count(room)) << room;
}

TEST(Includes, GoOnlyToTheLeft) {
  for (const Include& include : all_includes()) {
    const std::string home = home_of(include.file), room = room_of(include.target);
    if (!include.quoted || room.empty()) continue;
    ASSERT_FALSE(home.empty()) << include.file << " stands in no room";
    EXPECT_LE(k_flow.at(room), k_flow.at(home)) << include.says();
  }
}

TEST(Includes, OfOurOwnAreQuotedAndKnown) {
  for (const Include& include : all_includes()) {
    if (include.quoted) {
      const bool beside = fs::exists(fs::path(FUSEE_SOURCE_DIR) / include.file.parent_path() / include.target);
      EXPECT_TRUE(beside || !room_of(include.target).empty()) << include.says();
    } else {
      EXPECT_NE(include.target.rfind("fusee/", 0), 0u) << include.says();
    }
  }
}

TEST(Includes, OfPublicHeadersNameOnlyEigen) {
  static const std::regex standard("^[a-z_0-9]+$");
  for (const Include& include : all_includes()) {
    if (include.file.generic_string().rfind("include/", 0) != 0) continue;
    if (include.quoted) {
      EXPECT_EQ(include.target.rfind("fusee/", 0), 0u) << include.says();
    } else {
      EXPECT_TRUE(std::regex_match(include.target, standard) || include.target.rfind("Eigen/", 0) == 0)
          << include.says();
    }
  }
}

/// Heavy or telling libraries live in one place each.
TEST(Includes, OfLibrariesStayInTheirPlaces) {
  const std::vector<std::pair<std::regex, std::regex>> places = {
      {std::regex("^CGAL/"), std::regex("_cgal\\.(cpp|h)$")},
      {std::regex("^OpenMesh/"), std::regex("^src/solid/")},
      {std::regex("^CLI/"), std::regex("^src/cli/")},
      {std::regex("^toml\\+\\+"), std::regex("^src/mechanism/")},
      {std::regex("^draco/"), std::regex("^export/draco\\.cpp$")},
      {std::regex("^zip\\.h"), std::regex("^export/")},
      {std::regex("^ceres/"), std::regex("^src/calibration/")},
      {std::regex("^pagmo/"), std::regex("_pagmo\\.cpp$")},
      {std::regex("^boost/"), std::regex("^src/transmission/interval\\.h$")},
      {std::regex("^pugixml"), std::regex("^export/")},
      {std::regex("^openssl/"), std::regex("^src/base/")}};
  for (const Include& include : all_includes()) {
    for (const auto& [library, place] : places) {
      if (!std::regex_search(include.target, library)) continue;
      EXPECT_TRUE(std::regex_search(include.file.generic_string(), place)) << include.says();
    }
  }
}

TEST(Rooms, AreReadFromPaths) {
  EXPECT_EQ(room_of("fusee/solid/mesh.h"), "solid");
  EXPECT_EQ(room_of("fusee/pipeline.h"), "pipeline");
  EXPECT_EQ(room_of("cli/console.h"), "cli");
  EXPECT_EQ(room_of("zip.h"), "");
  EXPECT_EQ(home_of("export/stl.cpp"), "export");
  EXPECT_EQ(home_of("include/fusee/pipeline.h"), "pipeline");
  EXPECT_EQ(home_of("src/profile/outline_cgal.cpp"), "profile");
}

}  // namespace
