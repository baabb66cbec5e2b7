#include <gtest/gtest.h>

#include <filesystem>

#include "fusee/base.h"
#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using testing::error_of;
using testing::facets;
using ::testing::HasSubstr;

TEST(ReadMesh, IdentifiesFormatByContent) {
  const solid::TriangleMesh mesh = testing::tetrahedron();
  for (const std::string& bytes :
       {stl_bytes(mesh, "x"), obj_text(mesh, "x"), threemf_bytes(mesh, "x"), draco_bytes(mesh, 0.01)}) {
    EXPECT_EQ(read_mesh(bytes, "no.ending").triangles.size(), 4U);
    EXPECT_EQ(read_mesh(bytes, "liar.ply").triangles.size(), 4U);
  }
}

/// A prism on this outline, counterclockwise, as polygons of an OFF file; the floors begin at corner `first`.
std::string prism(const std::vector<std::pair<double, double>>& outline, std::size_t first) {
  const std::size_t n = outline.size();
  std::string text = "OFF " + std::to_string(2 * n) + " " + std::to_string(n + 2) + " 0\n";
  for (const int z : {0, 10}) {
    for (const auto& [x, y] : outline)
      text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  }
  std::string floor = std::to_string(n), ceiling = floor;
  for (std::size_t i = 0; i < n; ++i) {
    floor += " " + std::to_string((first + n - i) % n);
    ceiling += " " + std::to_string(n + (first + i) % n);
  }
  text += floor + "\n" + ceiling + "\n";
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = (i + 1) % n;
    text += "4 " + std::to_string(i) + " " + std::to_string(k) + " " + std::to_string(n + k) + " " +
            std::to_string(n + i) + "\n";
  }
  return text;
}

// CAD and Blender write flat faces as one polygon, concave or with corners on a line. A fan would fold back.
TEST(ReadMesh, DividesConcavePolygons) {
  const std::vector<std::pair<double, double>> corner = {{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}};
  const std::vector<std::pair<double, double>> channel = {{0, 0},  {20, 0}, {20, 20}, {15, 20},
                                                          {15, 5}, {5, 5},  {5, 20},  {0, 20}};
  const std::vector<std::pair<double, double>> on_lines = {{0, 0},   {10, 0},  {20, 0}, {20, 10},
                                                           {20, 20}, {10, 20}, {0, 20}, {0, 10}};
  // The bridge from the outline to a square hole is passed twice.
  const std::vector<std::pair<double, double>> with_hole = {{0, 0}, {20, 0}, {20, 20}, {0, 20}, {0, 0},
                                                            {5, 5}, {5, 15}, {15, 15}, {15, 5}, {5, 5}};
  struct Case {
    const char* name;
    std::vector<std::pair<double, double>> outline;
    double area;
  };
  for (const Case& shape : {Case{"corner", corner, 300}, Case{"channel", channel, 250}, Case{"on lines", on_lines, 400},
                            Case{"with hole", with_hole, 300}}) {
    for (std::size_t first = 0; first < shape.outline.size(); ++first) {
      const solid::TriangleMesh mesh = solid::weld(read_mesh(prism(shape.outline, first), "x.off"));
      EXPECT_NEAR(solid::enclosed_volume(mesh), 10 * shape.area, 1e-9) << shape.name << first;
      if (shape.outline.size() == 10) continue;  // the walls of the bridge coincide
      for (const Check& check : solid::check_mesh(mesh))
        EXPECT_TRUE(check.ok) << shape.name << first << " " << check.name << " " << check.where;
    }
  }
  // The facets of a convex polygon remain those of the fan.
  EXPECT_EQ(read_mesh("OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 1 2 3 0\n", "x.off").triangles,
            (std::vector<std::array<std::uint32_t, 3>>{{1, 2, 3}, {1, 3, 0}}));
}

// A vertex far away, or one that is not a number, is not part of the mesh if no facet uses it.
TEST(ReadMesh, OmitsUnusedVertices) {
  const solid::TriangleMesh mesh = read_mesh("v nan 0 0\nv 0 0 0\nv 500 500 500\nv 1 0 0\nv 0 1 0\nf 2 4 5\n", "x.obj");
  ASSERT_EQ(mesh.vertices.size(), 3U);
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.vertices[mesh.triangles[0][1]], Vec3(1, 0, 0));
  EXPECT_EQ(solid::bounds(mesh).high, Vec3(1, 1, 0));
}

TEST(ReadMesh, ErrorListsFormats) {
  EXPECT_EQ(error_of("", "x.stl"), "x.stl: error: the file is empty, expected a mesh");
  EXPECT_EQ(error_of("hello", "letter.txt"),
            "letter.txt: error: expected a mesh, but neither its first bytes nor its name identify the format\n"
            "  hint: fusee reads .stl, .obj, .3mf, .off, .ply, .drc and .dxf");
}

/// The fuzzer's start corpus and its former failures: each is a mesh or an InputError.
TEST(ReadMesh, ReadsOrRejectsFuzzCorpus) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FUSEE_SOURCE_DIR "/tests/fuzz/corpus/mesh")) {
    const std::string bytes = read_file(entry.path(), 1 << 20);
    const std::string name = entry.path().filename().string();
    const std::string error = error_of(bytes, name);
    // A file named good_… is a mesh.
    if (name.starts_with("good_")) {
      EXPECT_EQ(error, "");
    }
    if (name.starts_with("bad_")) {
      EXPECT_NE(error, "") << name;
    }
    ++files;
  }
  EXPECT_GT(files, 10);
}

}  // namespace
}  // namespace fusee::formats
