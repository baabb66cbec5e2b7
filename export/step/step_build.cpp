#include "export/step/step_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/step/grain.h"
#include "export/step/groove_section.h"
#include "export/step/normal_spline.h"
#include "export/step/skin.h"
#include "export/step/step_shapes.h"
#include "fusee/base.h"
#include "solid/body.h"

namespace fusee::formats {
namespace {

// A groove's floor is guaranteed within 1e-4 mm. Rims carry no function.
constexpr double k_groove_tolerance = 6e-5;
constexpr double k_rim_tolerance = 1e-3;
// Tolerance for recognising rows among the body's rings, which were computed in the same way.
constexpr double k_same = 1e-7;  // mm
// Least distance of sector cuts, rad.
constexpr double k_narrowest_sector = radians(75);
// The kernel's time for a cut grows with the ratio of part size to smallest feature: a radius of 0.4 m takes a minute.
constexpr double k_largest_radius = 400;  // mm

/// A curve whose parallels are rings of the body.
struct BaseCurve {
  std::vector<Vec2> points;             ///< at the outlines' normals
  std::vector<double> radii = {};       ///< of curvature, if known
  std::vector<std::size_t> kinks = {};  ///< points with tangent continuity only
  double tolerance = k_groove_tolerance;
  std::vector<NormalSpline> fits = {};  ///< one for each sector
};

/// A ring of the body as a parallel of a base curve; base null: a circle about the axis, of the radius `distance`.
struct ParallelRing {
  BaseCurve* base = nullptr;
  double distance = 0;
  double z = 0;
};

BaseCurve base_of(const profile::Outline& outline) {
  BaseCurve base;
  for (const profile::OutlinePoint& point : outline.points) {
    base.points.push_back(point.position);
    base.radii.push_back(point.curvature_radius);
  }
  base.kinks = {outline.active_first, outline.active_last};
  return base;
}

[[noreturn]] void refuse_as_too_large(const std::string& why) {
  throw InputError("", "too large for STEP: " + why, "build it without --step: the meshes have it");
}

void refuse_beyond(double reach) {
  if (reach > k_largest_radius)
    refuse_as_too_large(fmt::format("it reaches {} mm from its axis, and at most {} mm do", rounded(reach, 4),
                                    rounded(k_largest_radius)));
}

void set_name_and_zones(StepPart& part, const Product& product) {
  const solid::BodyLayout& layout = product.pulley.layout;
  part.name = product.joint.mechanism.name;
  part.z_mate = layout.scale * layout.z_mate;
  part.z_top = layout.scale * layout.z_top;
}

class StepBuilder {
 public:
  explicit StepBuilder(const Product& product)
      : product_(product),
        mechanism_(product.joint.mechanism),
        layout_(product.pulley.layout),
        p1_(base_of(product.synthesis.p1)),
        p2_(base_of(product.synthesis.p2)) {
    for (const profile::OutlinePoint& point : product.synthesis.p1.points) psi_.push_back(point.psi);
    const solid::FlangeRims rims =
        solid::flange_rims(product.synthesis.p1, product.synthesis.p2, mechanism_.tendon.diameter, layout_.groove_depth,
                           mechanism_.body.flange);
    middle_.points = rims.middle;
    middle_.tolerance = k_rim_tolerance;
    set_name_and_zones(part_, product);
  }

  StepPart build() {
    for (const Vec2& point : middle_.points) reach_ = std::max(reach_, point.norm());
    refuse_beyond(reach_);
    choose_sectors();
    const solid::RingStack stack = solid::body_stack(product_.synthesis.p1, product_.synthesis.p2,
                                                     mechanism_.tendon.diameter, mechanism_.body.flange, layout_);
    for (std::size_t k = 0; k < stack.rings.size(); ++k) {
      const std::size_t rings = add_groove_at(stack, k);
      if (rings > 0)
        k += rings - 1;
      else
        add(parallel_of(stack.rings[k]));
    }
    if (layout_.hub_radius > 0) part_.hub = StepHub{layout_.scale * layout_.hub_radius, layout_.scale * layout_.z_hub};
    return std::move(part_);
  }

 private:
  // Sector cuts are as far from tie-offs as possible, so that they cross no cut feature.
  void choose_sectors() {
    constexpr int k_samples = 360;
    const auto clearance_at = [&](double psi) {
      double clearance = k_pi;
      for (const solid::Anchor& anchor : product_.pulley.anchors) {
        for (const Vec2& place : {anchor.exit, anchor.pocket})
          clearance =
              std::min(clearance, std::abs(std::remainder(psi - elementary::atan2(place.y(), place.x()), k_two_pi)));
      }
      return clearance;
    };
    double first = 0, second = 0, best = -1;
    for (int i = 0; i < k_samples; ++i) {
      const double psi = k_two_pi * (i + 0.37) / k_samples;
      if (clearance_at(psi) > best + 1e-9) {
        best = clearance_at(psi);
        first = psi;
      }
    }
    best = -1;
    for (int i = 0; i < k_samples; ++i) {
      const double psi = first + k_narrowest_sector + (k_two_pi - 2 * k_narrowest_sector) * (i + 0.37) / k_samples;
      if (clearance_at(psi) > best + 1e-9) {
        best = clearance_at(psi);
        second = psi;
      }
    }
    part_.sectors = {first, second, first + k_two_pi};
  }

  std::size_t sectors() const { return part_.sectors.size() - 1; }

  const std::vector<NormalSpline>& fits_of(BaseCurve& base) {
    if (!base.fits.empty()) return base.fits;
    std::vector<Vec2> points;
    std::vector<double> radii, kinks;
    for (const Vec2& point : base.points) points.push_back(layout_.scale * point);
    for (const double radius : base.radii) radii.push_back(layout_.scale * radius);
    for (const std::size_t kink : base.kinks) kinks.push_back(psi_[kink]);
    const SupportCurve curve(psi_, std::move(points), std::move(radii));
    for (std::size_t s = 0; s < sectors(); ++s) {
      auto fitted = fit(curve, part_.sectors[s], part_.sectors[s + 1], kinks, base.tolerance, layout_.scale * reach_);
      if (!fitted) refuse_as_too_large("its curves take more pieces than a part for CAD may have");
      base.fits.push_back(std::move(*fitted));
    }
    return base.fits;
  }

  ParallelRing parallel_of(const solid::Ring& ring) {
    const auto& reference = product_.synthesis.p1.points;
    const auto is_parallel = [&](const std::vector<Vec2>* base, double distance) {
      for (std::size_t i = 0; i < ring.points.size(); ++i) {
        const Vec2 from = base ? (*base)[i] : Vec2(Vec2::Zero());
        if ((ring.points[i] - from - distance * reference[i].normal).norm() > k_same) return false;
      }
      return true;
    };
    const double from_axis = ring.points.front().dot(reference.front().normal);
    if (is_parallel(nullptr, from_axis)) return {nullptr, from_axis, ring.z};
    for (BaseCurve* base : {&p1_, &p2_, &middle_}) {
      const double distance = (ring.points.front() - base->points.front()).dot(reference.front().normal);
      if (is_parallel(&base->points, distance)) return {base, distance, ring.z};
    }
    demand(false, fmt::format("a ring at z = {} that is no parallel of any curve", ring.z));
    return {};
  }

  /// Adds a groove's rings with a round seat instead of its corners. Returns the number of rings used; 0 if no such
  /// groove begins here.
  std::size_t add_groove_at(const solid::RingStack& stack, std::size_t k) {
    for (const bool left : {true, false}) {
      const solid::GrooveWalls& walls = left ? layout_.p1 : layout_.p2;
      const double plane = left ? layout_.z_p1 : layout_.z_p2;
      const std::size_t rings = walls.below.size() + walls.above.size() - 2;
      const auto seat = seat_of(walls, mechanism_);
      if (!seat || stack.rings[k].z != plane - walls.below_width()) continue;
      // The flange's own ring may have the height of the groove edge.
      if (k + rings > stack.rings.size() || stack.rings[k + rings - 1].z != plane + walls.above_width()) continue;
      const ParallelRing low = parallel_of(stack.rings[k]), high = parallel_of(stack.rings[k + rings - 1]);
      if (low.base != high.base || std::abs(low.distance - high.distance) > k_same) continue;
      add(low);
      add_seat(low, plane, *seat);
      add(high);
      return rings;
    }
    return 0;
  }

  void add_seat(const ParallelRing& groove_edge, double plane, const Seat& seat) {
    const double floor = groove_edge.distance - layout_.groove_depth;
    const auto on_arc = [&](double angle, double radius) {
      return ParallelRing{groove_edge.base, floor + seat.radius - radius * elementary::cos(angle),
                          plane + radius * elementary::sin(angle)};
    };
    const auto add_arc = [&](double from, double to) {
      if (from == -seat.below) add(on_arc(from, seat.radius));
      const double half = 0.5 * (to - from);
      add(on_arc(to, seat.radius));
      StepBand& band = part_.bands.back();
      const ParallelRing corner = on_arc(0.5 * (from + to), seat.radius / elementary::cos(half));
      band.seat_radius = layout_.scale * seat.radius;
      band.seat_middle = layout_.scale * (floor + seat.radius);
      band.seat_z = layout_.scale * plane;
      band.corner_z = layout_.scale * corner.z;
      band.weight = elementary::cos(half);
      if (groove_edge.base) band.corner = pieces_of(corner);
    };
    const std::vector<double> angles = seat.angles();
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) add_arc(angles[i], angles[i + 1]);
  }

  std::vector<StepSpline> pieces_of(const ParallelRing& row) {
    std::vector<StepSpline> pieces;
    for (const NormalSpline& fitted : fits_of(*row.base)) {
      pieces.push_back(fitted.parallel(layout_.scale * row.distance));
      for (Vec2& pole : pieces.back().poles) pole = rounded_to_grain(pole);
    }
    return pieces;
  }

  /// A circle over another row's knots.
  std::vector<StepSpline> circle_like(BaseCurve& base, double radius) {
    std::vector<StepSpline> pieces;
    for (const NormalSpline& fitted : fits_of(base)) {
      pieces.push_back({fitted.knots, fitted.normal});
      for (Vec2& pole : pieces.back().poles) pole *= radius;
    }
    return pieces;
  }

  void add(const ParallelRing& row) {
    StepRow next{layout_.scale * row.z, 0};
    if (row.base)
      next.pieces = pieces_of(row);
    else
      next.radius = layout_.scale * row.distance;
    if (!part_.rows.empty()) {
      const StepRow& below = part_.rows.back();
      StepBand band;
      if (row.base || last_.base) {
        band.lower = last_.base ? below.pieces : circle_like(*row.base, below.radius);
        band.upper = row.base ? next.pieces : circle_like(*last_.base, next.radius);
      }
      part_.bands.push_back(std::move(band));
    }
    part_.rows.push_back(std::move(next));
    last_ = row;
  }

  const Product& product_;
  const Mechanism& mechanism_;
  const solid::BodyLayout& layout_;
  BaseCurve p1_, p2_, middle_;
  std::vector<double> psi_;
  double reach_ = 0;
  ParallelRing last_;  ///< of the last row
  StepPart part_;
};

StepPart helical_part(const Product& product) {
  double reach = 0;
  for (const helix::HelixSide& side : product.helix->synthesis.sides) {
    for (const helix::SpiralRow& row : side.spiral.rows) reach = std::max(reach, elementary::hypot(row.x, row.y));
  }
  refuse_beyond(reach);
  StepPart part;
  set_name_and_zones(part, product);
  part.skin = helical_skin(product);
  return part;
}

// ---- scaling to the printed size ------------------------------------------------------------------------------------

void scale(StepContour& contour, double factor) {
  contour.start *= factor;
  for (StepContour::Piece& piece : contour.pieces) {
    piece.to *= factor;
    if (piece.via) *piece.via *= factor;
  }
}

void scale(StepPrism& prism, double factor) {
  prism.origin *= factor;
  prism.low *= factor;
  prism.high *= factor;
  scale(prism.outer, factor);
  for (StepContour& loop : prism.inner) scale(loop, factor);
  if (prism.ceiling) prism.ceiling->point *= factor;
}

void scale(StepFrustum& frustum, double factor) {
  frustum.low_centre *= factor;
  frustum.high_centre *= factor;
  for (double* value : {&frustum.low, &frustum.high, &frustum.low_radius, &frustum.high_radius}) *value *= factor;
}

void scale(StepTurned& turned_section, double factor) {
  turned_section.centre *= factor;
  for (Vec2& corner : turned_section.section) corner *= factor;
}

void scale(StepChannel& channel, double factor) {
  for (StepRing& ring : channel.rings) {
    ring.middle *= factor;
    ring.radius *= factor;
    ring.ridge *= factor;
  }
}

void scale(solid::TriangleMesh& mesh, double factor) {
  for (Vec3& vertex : mesh.vertices) vertex *= factor;
}

std::vector<StepTool> scaled(std::vector<StepTool> tools, double factor) {
  for (StepTool& tool : tools) {
    for (StepSolid& solid : tool.common) std::visit([factor](auto& shape) { scale(shape, factor); }, solid);
  }
  return tools;
}

}  // namespace

StepPart step_part(const Product& product) {
  StepPart part = product.helix ? helical_part(product) : StepBuilder(product).build();
  const Mechanism& mechanism = product.joint.mechanism;
  const double factor = product.pulley.layout.scale;
  part.cuts = scaled(step_cuts(mechanism, product.pulley), factor);
  part.raised = scaled(step_raised(mechanism, product.pulley), factor);
  if (!product.helix) return part;
  for (StepTool& tool : scaled(run_out_cuts(product), factor)) part.cuts.push_back(std::move(tool));
  return part;
}

}  // namespace fusee::formats
