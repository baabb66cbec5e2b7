// Rules of #include that the compiler does not enforce. A module sees the headers of itself and of the modules that it
// links, and no others: fusee_headers() in the top CMakeLists.txt.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "pipeline/cmake_modules.h"
#include "pipeline/source_text.h"

namespace {

namespace house = fusee::house;
namespace fs = std::filesystem;

/// Module → its place in the order. Built on first use, after the constants of other files.
const std::map<std::string, int>& flow() {
  static const std::map<std::string, int> read = house::flow();
  return read;
}

/// For each inner module of export, the inner modules that it may use. The mesh formats know no pulley. All may use
/// tool.h, the program's name.
const std::map<std::string, std::set<std::string>> k_export_uses = {{"mesh_files", {}},
                                                                    {"drawings", {}},
                                                                    {"report", {"mesh_files", "drawings"}},
                                                                    {"kit", {"mesh_files", "drawings", "report"}},
                                                                    {"model", {"report"}},
                                                                    {"step", {}}};

struct Include {
  fs::path file;  ///< relative to the source tree
  int line = 0;
  std::string target;
  bool quoted = false;  ///< "…" instead of <…>

  std::string description() const { return file.string() + ":" + std::to_string(line) + " includes " + target; }
};

/// "fusee/solid.h" → "solid"; "fusee/mechanism_file.h" and "mechanism/catalogue.h" → "mechanism"; else "".
std::string module_of(const std::string& target) {
  static const std::regex pattern("^(?:fusee/)?([a-z_]+?)(?:/|(?:_file|_elementary)?\\.h$)");
  std::smatch match;
  return std::regex_search(target, match, pattern) && flow().count(match[1]) ? match[1].str() : "";
}

/// include/fusee/solid.h and src/solid/mesh.cpp → "solid"; export/tool.h → "export".
std::string home_of(const fs::path& file) {
  const std::string path = file.generic_string();
  for (const std::string prefix : {"include/", "src/", ""}) {
    if (path.rfind(prefix, 0) == 0) return module_of(path.substr(prefix.size()));
  }
  return "";
}

/// "export/report/svg.h" → "report"; "" for others.
std::string inner_module_of(const std::string& path) {
  static const std::regex pattern("^export/([a-z_]+)/");
  std::smatch match;
  return std::regex_search(path, match, pattern) && k_export_uses.count(match[1]) ? match[1].str() : "";
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

/// Inner modules of export count separately.
std::string module_or_inner_module(const fs::path& file) {
  const std::string inner = file.parent_path().generic_string();
  return inner.rfind("export/", 0) == 0 ? inner : home_of(file);
}

TEST(Modules, HaveAFifthOfLinesAtMost) {
  std::map<std::string, long> lines;
  long all = 0;
  for (const house::Source& source : house::sources_under({"include", "src", "export"})) {
    const long count = house::line_at(source.text, source.text.size()) - 1;
    lines[module_or_inner_module(source.path)] += count;
    all += count;
  }
  for (const auto& [module, count] : lines)
    EXPECT_LE(5 * count, all) << module << " has " << count << " of " << all << " lines";
}

TEST(Includes, KeepOrderOfInnerModules) {
  for (const Include& include : all_includes()) {
    if (home_of(include.file) != "export") continue;
    const std::string home = inner_module_of(include.file.generic_string()), module = inner_module_of(include.target);
    if (module.empty() || module == home) continue;
    ASSERT_FALSE(home.empty()) << include.file << " is in no inner module";
    EXPECT_TRUE(k_export_uses.at(home).count(module)) << include.description();
  }
}

TEST(Includes, OwnHeadersAreQuoted) {
  for (const Include& include : all_includes()) {
    if (include.quoted) {
      const bool beside = fs::exists(fs::path(FUSEE_SOURCE_DIR) / include.file.parent_path() / include.target);
      EXPECT_TRUE(beside || !module_of(include.target).empty()) << include.description();
    } else {
      EXPECT_NE(include.target.rfind("fusee/", 0), 0u) << include.description();
    }
  }
}

/// Base and mechanism are the vocabulary of all modules; `export` is a keyword. The build makes fusee::embedded.
std::string namespace_of(const std::string& module) {
  if (module == "base" || module == "mechanism") return "fusee";
  return "fusee::" + (module == "export" ? "formats" : module);
}

TEST(Modules, HaveTheirOwnNamespace) {
  static const std::regex pattern("\\nnamespace (fusee[a-z_:]*) \\{");
  for (const house::Source& source : house::sources_under({"include", "src", "export"})) {
    const std::string expected = namespace_of(home_of(source.path));
    for (std::sregex_iterator match(source.text.begin(), source.text.end(), pattern), last; match != last; ++match) {
      const std::string found = (*match)[1];
      EXPECT_TRUE(found == expected || found.starts_with(expected + "::") || found == "fusee" ||
                  found == "fusee::embedded")
          << source.path << " opens " << found << " in place of " << expected;
    }
  }
}

TEST(PublicHeaders, AreAtMostTwenty) {
  const fs::directory_iterator headers(fs::path(FUSEE_SOURCE_DIR) / "include/fusee");
  EXPECT_LE(std::distance(begin(headers), end(headers)), 20);
}

TEST(PublicHeaders, NeedOnlyEigen) {
  static const std::regex standard("^[a-z_0-9]+$");
  for (const Include& include : all_includes()) {
    if (include.file.generic_string().rfind("include/", 0) != 0) continue;
    if (include.quoted) {
      EXPECT_EQ(include.target.rfind("fusee/", 0), 0u) << include.description();
    } else {
      EXPECT_TRUE(std::regex_match(include.target, standard) || include.target.rfind("Eigen/", 0) == 0)
          << include.description();
    }
  }
}

/// Each of these libraries is included in one place only.
TEST(Includes, LibrariesStayInTheirPlaces) {
  const std::vector<std::pair<std::regex, std::regex>> places = {
      {std::regex("^CGAL/"), std::regex("_cgal\\.(cpp|h)$")},
      {std::regex("^OpenMesh/"), std::regex("^src/solid/")},
      {std::regex("^CLI/"), std::regex("^src/cli/")},
      {std::regex("^toml\\+\\+"), std::regex("^src/mechanism/")},
      {std::regex("^draco/"), std::regex("^export/mesh_files/draco\\.cpp$")},
      {std::regex("^zip\\.h"), std::regex("^src/base/zip\\.cpp$")},
      {std::regex("^pagmo/"), std::regex("_pagmo\\.cpp$")},
      {std::regex("^boost/"), std::regex("^src/transmission/interval\\.h$")},
      {std::regex("^pugixml"), std::regex("^export/(mesh_files/|model/check_model\\.cpp)")},
      {std::regex("^openssl/"), std::regex("^src/base/")},
      {std::regex("^sqlite3\\.h"), std::regex("^src/measurement/sqlite_bag\\.cpp$")},
      {std::regex("^(zstd|lz4frame)\\.h"), std::regex("^src/measurement/unpacking\\.cpp$")},
      {std::regex("^(STEP|BRep|TopoDS|Geom_|XCAFDoc|Standard_)"), std::regex("^export/step/step_occt\\.cpp$")},
      {std::regex("^pybind11/"), std::regex("^src/python/")}};
  for (const Include& include : all_includes()) {
    for (const auto& [library, place] : places) {
      if (!std::regex_search(include.target, library)) continue;
      EXPECT_TRUE(std::regex_search(include.file.generic_string(), place)) << include.description();
    }
  }
}

TEST(Modules, AreReadFromPaths) {
  EXPECT_EQ(module_of("fusee/mechanism_file.h"), "mechanism");
  EXPECT_EQ(module_of("fusee/pipeline.h"), "pipeline");
  EXPECT_EQ(module_of("cli/console.h"), "cli");
  EXPECT_EQ(module_of("zip.h"), "");
  EXPECT_EQ(home_of("export/mesh_files/stl.cpp"), "export");
  EXPECT_EQ(home_of("include/fusee/pipeline.h"), "pipeline");
  EXPECT_EQ(home_of("src/profile/outline_cgal.cpp"), "profile");
  EXPECT_EQ(inner_module_of("export/mesh_files/stl.cpp"), "mesh_files");
  EXPECT_EQ(inner_module_of("include/fusee/export.h"), "");
  EXPECT_EQ(inner_module_of("export/tool.h"), "");
}

}  // namespace
