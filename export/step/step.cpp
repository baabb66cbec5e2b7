#include "fusee/export/step.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>

#include "export/step/compact_text.h"
#include "export/step/step_build.h"
#include "export/step/step_part.h"
#include "export/step/step_shapes.h"
#include "fusee/base/diagnostics.h"
#include "solid/nearest_segment.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

/// Where the module lies under the folder that a program was installed in, or built in.
constexpr const char* k_module = FUSEE_STEP_MODULE;
/// Of the exact floor, mm.
constexpr double k_floor_limit = 1e-4;

/// Code is loaded from beside its own program alone, and not where somebody else could have put it.
bool is_trusted(const fs::path& module, const fs::path& program) {
  struct stat of_module {
  }, of_program{};
  if (::stat(module.c_str(), &of_module) != 0 || ::stat(program.c_str(), &of_program) != 0) return false;
  return of_module.st_uid == 0 || of_module.st_uid == of_program.st_uid;
}

/// The file that this function was linked into: the program, or a shared library.
fs::path own_file() {
  std::error_code ignored;
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&step_missing), &info) != 0 && info.dli_fname != nullptr) {
    const fs::path path = fs::weakly_canonical(info.dli_fname, ignored);
    if (path.extension() == ".so") return path;
  }
  return fs::read_symlink("/proc/self/exe", ignored);
}

/// bin/fusee and lib/…/fusee/modules/ are beside each other; in a build tree the programs of tests lie deeper, and so
/// does Python's module in lib/python3/dist-packages/fusee.
std::optional<fs::path> module_file() {
  constexpr int k_levels = 5;
  const fs::path program = own_file();
  fs::path folder = program.parent_path();
  for (int level = 0; level < k_levels && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    const fs::path module = folder / k_module;
    if (is_trusted(module, program)) return module;
  }
  return std::nullopt;
}

struct Loaded {
  const StepMaker* maker = nullptr;
  std::string why_not;
};

Loaded load() {
  const auto file = module_file();
  if (!file) {
    return {nullptr, FUSEE_HAS_STEP ? "its module fusee-step is not installed beside it"
                                    : "its module fusee-step, which needs OpenCASCADE, was left out"};
  }
  void* module = ::dlopen(file->c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return {nullptr, std::string("its module fusee-step cannot be loaded: ") + ::dlerror()};
  const auto* maker = static_cast<const StepMaker*>(::dlsym(module, k_step_maker));
  if (maker == nullptr) return {nullptr, "its module fusee-step is of another version"};
  return {maker, {}};
}

/// Loaded once, and never let go: OpenCASCADE keeps what it has registered.
const Loaded& loaded() {
  static const Loaded once = load();
  return once;
}

const StepMaker& maker() {
  demand(loaded().maker != nullptr, "STEP asked for without its module: " + loaded().why_not);
  return *loaded().maker;
}

/// Of the tendons' own arc, which no tie-off is cut into, from what a file has there.
double floor_error(const Outline& outline, double tendon_diameter, double scale, const Polygon& floor) {
  if (floor.empty()) return std::numeric_limits<double>::infinity();
  const NearestSegment nearest({floor});
  const Polygon exact = parallel(outline, -0.5 * tendon_diameter);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (outline.is_active(i)) worst = std::max(worst, nearest.distance(scale * exact[i]));
  }
  return worst;
}

}  // namespace

std::optional<std::string> step_missing() {
  if (loaded().maker != nullptr) return std::nullopt;
  return loaded().why_not;
}

StepFile step_file(const Product& product) {
  StepFile file;
  file.bytes = maker().write(step_part(product), file.complaint);
  if (!file.bytes.empty()) file.bytes = compact_step(file.bytes);
  return file;
}

StepLook look_at_step(const fs::path& path, const Product& product, double tolerance) {
  const BodyLayout& layout = product.pulley.layout;
  const StepReading found = maker().read(path.string(), layout.scale * layout.z_p1, layout.scale * layout.z_p2);
  const double d = product.joint.mechanism.tendon.diameter, scale = layout.scale;
  const double expected = product.pulley.expected_volume + std::pow(scale, 3) * round_holes_leave(product.pulley);
  StepLook look;
  look.checks.push_back(exactly("solids", found.solids, 1, "1"));
  look.checks.push_back(exactly("unpaired_edges", found.unpaired_edges, 0, "1"));
  look.checks.push_back(exactly("invalid_shapes", found.is_valid ? 0 : 1, 0, "1"));
  look.checks.push_back(exactly("open_faces", found.open_faces, 0, "1"));
  look.checks.push_back(at_most("volume_difference", std::abs(found.volume - expected), tolerance * found.area, "mm3"));
  const double error = std::max(floor_error(product.synthesis.p1, d, scale, found.floor1),
                                floor_error(product.synthesis.p2, d, scale, found.floor2));
  look.checks.push_back(at_most("floor_error", error, k_floor_limit, "mm"));
  look.floor1 = found.floor1;
  look.floor2 = found.floor2;
  return look;
}

}  // namespace fusee
