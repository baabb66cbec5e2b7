#include "export/step/step.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/module.h"
#include "export/step/compact_text.h"
#include "export/step/step_build.h"
#include "export/step/step_part.h"
#include "export/step/step_shapes.h"
#include "fusee/base.h"
#include "solid/nearest_segment.h"

namespace fusee::formats {
namespace {

namespace fs = std::filesystem;

/// Largest error of the floor, mm.
constexpr double k_floor_limit = 1e-4;

struct MakerLoad {
  const StepMaker* maker = nullptr;
  std::string why_not;
};

MakerLoad load() {
  if (!FUSEE_HAS_STEP) return {nullptr, "its module fusee-step, which needs OpenCASCADE, was left out"};
  const LoadedModule module = load_module("fusee-step", k_step_maker);
  return {static_cast<const StepMaker*>(module.found), module.why_not};
}

const MakerLoad& loaded() {
  static const MakerLoad once = load();
  return once;
}

const StepMaker& maker() {
  demand(loaded().maker != nullptr, "STEP was requested without its module: " + loaded().why_not);
  return *loaded().maker;
}

/// Error of the section of a file along the active arc, which no tie-off cuts.
double floor_error(const profile::Outline& outline, double tendon_diameter, double scale, const Polygon& floor) {
  if (floor.empty()) return std::numeric_limits<double>::infinity();
  const solid::NearestSegment nearest({floor});
  const Polygon exact = profile::parallel(outline, -0.5 * tendon_diameter);
  double worst = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (outline.is_active(i)) worst = std::max(worst, nearest.distance(scale * exact[i]));
  }
  return worst;
}

/// Points on the floors of helical grooves under the tendons: half a tendon inside every row of the spirals.
std::vector<Vec3> floor_points(const HelixProduct& helix, double tendon_diameter, double scale) {
  std::vector<Vec3> points;
  const helical_solid::SpiralPlace* const spirals[] = {&helix.pulley.p1, &helix.pulley.p2};
  for (std::size_t k = 0; k < 2; ++k) {
    const helix::Spiral& spiral = helix.synthesis.sides[k].spiral;
    for (std::size_t i = spiral.first_used; i <= spiral.last_used; ++i) {
      const helix::SpiralRow& row = spiral.rows[i];
      const Vec2 floor = Vec2(row.x, row.y) - 0.5 * tendon_diameter * unit(row.turn);
      points.push_back(scale * Vec3(floor.x(), floor.y(), spirals[k]->height(row.z)));
    }
  }
  return points;
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

StepInspection inspect_step(const fs::path& path, const Product& product, double tolerance) {
  const solid::BodyLayout& layout = product.pulley.layout;
  const double tendon_diameter = product.joint.mechanism.tendon.diameter, scale = layout.scale;
  StepQuestion question;
  StepInspection inspection;
  if (product.helix) {
    question.points = floor_points(*product.helix, tendon_diameter, scale);
    question.floors = [&inspection, scale](const solid::TriangleMesh& mesh) {
      inspection.helical = helical_solid::helical_floors(mesh, scale);
      std::vector<Vec3> points;
      for (const helical_solid::FloorLine& line : inspection.helical) {
        for (const Vec3& point : line) points.push_back(scale * point);
      }
      return points;
    };
  } else {
    question.planes = {scale * layout.z_p1, scale * layout.z_p2};
  }
  const StepReading found = maker().read(path.string(), question);
  const double expected =
      product.pulley.expected_volume + elementary::pow(scale, 3) * round_hole_excess(product.pulley);
  inspection.checks.push_back(exactly("solids", found.solids, 1, "1"));
  inspection.checks.push_back(exactly("unpaired_edges", found.unpaired_edges, 0, "1"));
  inspection.checks.push_back(exactly("invalid_shapes", found.is_valid ? 0 : 1, 0, "1"));
  inspection.checks.push_back(exactly("open_faces", found.open_faces, 0, "1"));
  inspection.checks.push_back(
      at_most("volume_difference", std::abs(found.volume - expected), tolerance * found.area, "mm3"));
  double error = std::numeric_limits<double>::infinity();
  if (product.helix && found.distances.size() == question.points.size()) {
    error = *std::max_element(found.distances.begin(), found.distances.end());
  } else if (found.sections.size() == 2) {
    error = std::max(floor_error(product.synthesis.p1, tendon_diameter, scale, found.sections[0]),
                     floor_error(product.synthesis.p2, tendon_diameter, scale, found.sections[1]));
    inspection.floor1 = found.sections[0];
    inspection.floor2 = found.sections[1];
  }
  inspection.checks.push_back(at_most("floor_error", error, k_floor_limit, "mm"));
  // The points on the exact surface replace those of the mesh.
  auto floor = found.floors.begin();
  for (helical_solid::FloorLine& line : inspection.helical) {
    for (Vec3& point : line) {
      if (floor != found.floors.end()) point = *floor++ / scale;
    }
  }
  return inspection;
}

}  // namespace fusee::formats
