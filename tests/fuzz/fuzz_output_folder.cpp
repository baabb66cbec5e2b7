// Arbitrary names, links and leftovers in and next to an output folder: nothing outside changes.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "output_folder_laws.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string pattern = (std::filesystem::temp_directory_path() / "fusee_fuzz_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return 0;
  const std::string broken =
      fusee::testing::broken_publishing_law(pattern, {reinterpret_cast<const char*>(data), size});
  std::filesystem::remove_all(pattern);
  if (!broken.empty()) {
    std::fprintf(stderr, "%s\n", broken.c_str());
    std::abort();
  }
  return 0;
}
