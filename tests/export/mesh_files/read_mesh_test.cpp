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
