// Any bytes under names of three formats give an InputError, or a mesh with indices in range. Corpus:
// tests/fuzz/corpus/mesh.

#include <cstdint>
#include <cstdlib>

#include "export/mesh_files/mesh_files.h"
#include "fusee/base.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  // The name selects the format if the content does not.
  for (const char* name : {"fuzz.stl", "fuzz.obj", "fuzz.off"}) {
    try {
      const fusee::solid::TriangleMesh mesh = fusee::formats::read_mesh(bytes, name);
      for (const auto& triangle : mesh.triangles) {
        for (const std::uint32_t index : triangle) {
          if (index >= mesh.vertices.size()) std::abort();
        }
      }
    } catch (const fusee::InputError&) {
    }
  }
  return 0;
}
