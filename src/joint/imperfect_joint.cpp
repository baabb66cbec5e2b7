#include "joint/imperfect_joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "joint/outline_error.h"
#include "transmission/load.h"

namespace fusee::joint {
namespace {

/// Convergence limit for θ, far below sensor noise and the steps of a fit. rad
constexpr double k_last_step = 1e-9;

// Bounds that keep the joint physical while a fit varies its numbers.
constexpr double k_least_drum = 1e-3;                 // mm
constexpr double k_least_relative_compliance = 1e-3;  // of the declared tendon

/// Moves an end inside the drum onto its surface.
void tie_on_drum(std::optional<Attachment>& end, const Joint& joint) {
  if (!end) return;
  const double across = end->across - joint.drum_centre.across, along = end->along - joint.drum_centre.along;
  const double away = elementary::hypot(across, along);
  if (away >= joint.drum_radius || away == 0) return;
  const double scale = joint.drum_radius / away;
  end = Attachment{joint.drum_centre.across + scale * across, joint.drum_centre.along + scale * along};
}

/// Applies errors of the drum and of the attachments.
void mount_drum(Joint& joint, const JointError& errors) {
  if (joint.drum_radius > 0) {
    joint.drum_radius = std::max(k_least_drum, joint.drum_radius + errors.drum.radius);
    joint.drum_centre.across += errors.drum.across;
    joint.drum_centre.along += errors.drum.along;
  }
  const auto move = [](std::optional<Attachment>& end, const AttachmentError& error) {
    if (end) end = Attachment{end->across + error.across, end->along + error.along};
  };
  move(joint.attachment1, errors.end1);
  move(joint.attachment2, errors.end2);
  if (errors.drum == DrumError{} && errors.end1 == AttachmentError{} && errors.end2 == AttachmentError{}) return;
  tie_on_drum(joint.attachment1, joint);
  tie_on_drum(joint.attachment2, joint);
}

/// Applies sheath errors. The friction of a sheath without bends, and the compliance of a rigid one, are the identified
/// values alone.
void mount_sheath(Sheath& sheath, const SheathError& errors) {
  if (!sheath.is_there() || errors == SheathError{}) return;
  const double friction = std::max(0.0, sheath.mu * sheath.bend + errors.friction);
  if (!(sheath.bend > 0)) sheath.bend = 1.0;
  sheath.mu = friction / sheath.bend;
  const double compliance = (sheath.stiffness > 0 ? 1.0 / sheath.stiffness : 0.0) + errors.compliance;
  sheath.stiffness = compliance > 0 ? 1.0 / compliance : 0.0;
}

}  // namespace

MountedMechanism mounted(const Mechanism& declared, const Imperfections& errors) {
  Mechanism mechanism = declared;
  transmission::keep_law(mechanism);
  mechanism.joint.R += errors.joint.length;
  mount_drum(mechanism.joint, errors.joint);
  mechanism.guides.EB += errors.pins.left.outward;
  mechanism.guides.ED += errors.pins.right.outward;
  mechanism.guides.OE += errors.pins.left.down;
  mechanism.pulley.EF -= errors.pins.left.down;  // the pulley's axis does not move
  mechanism.guides.D_below_B += errors.pins.right.down - errors.pins.left.down;
  mechanism.guides.radius = std::max(0.0, mechanism.guides.radius + errors.pins.radius);
  Guides& guides = mechanism.guides;
  if (guides.kind == GuideKind::idler) {
    guides.bearing_friction =
        std::max(0.0, guides.bearing_friction + errors.pins.friction + errors.pins.bearing_friction);
  } else {
    guides.mu = std::max(0.0, guides.mu + errors.pins.friction);
  }
  mount_sheath(mechanism.sheath, errors.sheath);
  mechanism.pulley.mu = std::max(0.0, mechanism.pulley.mu + errors.tendon.groove_friction);
  mechanism.tendon.modulus /= std::max(k_least_relative_compliance, 1.0 + errors.tendon.stretch);
  mechanism.tendon.pretension =
      errors.tendon.pretension_share() * std::max(0.0, mechanism.tendon.pretension + errors.tendon.pretension);
  return {std::move(mechanism), {errors.joint.path1, errors.joint.path2}};
}

GeometryError geometry_of(const Imperfections& errors) {
  return {errors.pulley,     errors.pins.left,  errors.pins.right, errors.pins.radius, errors.joint.length,
          errors.joint.drum, errors.joint.end1, errors.joint.end2, errors.joint.path1, errors.joint.path2};
}

JointModel imperfect_geometry(const MadePulleys& made, const Mechanism& declared, const Imperfections& errors) {
  const OutlineError& outline = errors.pulley.outline;
  const MadePulleys larger = made.offset_by(outline.offset / (1.0 + errors.pulley.scale));
  JointModel model = joint_model(larger, mounted(declared, errors));
  // For a tendon, an eccentric pulley equals a pin moved the opposite way, and a pulley scaled by a factor equals pins
  // closer by that factor.
  const bool is_centred_and_to_scale = errors.pulley.scale == 0 && outline.runout_x == 0 && outline.runout_y == 0;
  if (!is_centred_and_to_scale) {
    model.lower = [larger, pins = model.pins, scale = 1.0 + errors.pulley.scale, x = outline.runout_x,
                   y = outline.runout_y](double alpha) {
      const double c = elementary::cos(alpha);
      const double s = elementary::sin(alpha);
      const Vec2 centre(c * x + s * y, c * y - s * x);  // turned clockwise
      std::array<transmission::LowerGuide, 2> equivalent;
      for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? -1.0 : 1.0;
        const transmission::LowerGuide guide = pins[i].lower();
        equivalent[i] = {(guide.across - sign * centre.x()) / scale, (guide.above - centre.y()) / scale,
                         guide.rho / scale};
      }
      std::array<LowerPath, 2> paths = larger.paths(equivalent, alpha);
      for (std::size_t i = 0; i < 2; ++i) {
        const double sign = i == 0 ? -1.0 : 1.0;
        paths[i].p = paths[i].p * scale + sign * centre.x() * elementary::cos(paths[i].normal) +
                     centre.y() * elementary::sin(paths[i].normal);
        paths[i].reach *= scale;
        paths[i].wound *= scale;
      }
      return paths;
    };
  }
  // A wave shifts the tangent line. Its rotation of the line is negligible, and so is the shift of the contact along
  // the line. The left tendon is computed on its mirror image, where the arc has the opposite sign.
  if (outline.wave_sin != 0 || outline.wave_cos != 0) {
    model.lower = [without_wave = model.lower, outline](double alpha) {
      std::array<LowerPath, 2> paths = without_wave(alpha);
      const SupportWave left = support_wave(k_pi - paths[0].normal + alpha, paths[0].p, outline);
      const SupportWave right = support_wave(paths[1].normal + alpha, paths[1].p, outline);
      paths[0].p += left.outward;
      paths[0].wound -= left.arc;
      paths[1].p += right.outward;
      paths[1].wound += right.arc;
      return paths;
    };
  }
  return model;
}

// moment · sin(tilt − θ) = (moment sin tilt) cos θ − (moment cos tilt) sin θ. The error adds to both coefficients.
Weight with_error(const Weight& declared, const WeightError& error) {
  if (error == WeightError{}) return declared;
  const double cos_part = declared.moment * elementary::sin(declared.tilt) + error.cos;
  const double sin_part = error.sin - declared.moment * elementary::cos(declared.tilt);
  return {elementary::hypot(cos_part, sin_part), elementary::atan2(cos_part, -sin_part)};
}

void set_imperfect_statics(JointModel& model, const Mechanism& declared, const Imperfections& errors) {
  set_statics(model, mounted(declared, errors));
  model.last_step = k_last_step;
  model.slack = 0.5 * errors.tendon.slack;
  model.bearing_friction = std::max(0.0, errors.joint.friction);
  model.rubbing = {std::max(0.0, errors.joint.rubbing.by_area), std::max(0.0, errors.joint.rubbing.by_lesser)};
  model.waves = errors.tendon.waves;
  model.pin_compliance = std::max(0.0, errors.pins.compliance);
  const Weight weight = with_error({model.weight, model.tilt}, errors.joint.weight);
  model.weight = weight.moment;
  model.tilt = weight.tilt;
}

}  // namespace fusee::joint
