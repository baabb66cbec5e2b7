/// \file
/// The statics of a joint that is not as declared: pulleys made for the declaration and imperfect themselves, in the
/// mechanism as mounted.
#pragma once

#include "fusee/joint/as_it_is.h"
#include "fusee/joint/joint_model.h"

namespace fusee {

/// What the tendons' paths depend on: joints that have it in common have their geometry in common.
struct GeometryError {
  PulleyError pulley;
  PinPlaceError left_pin;
  PinPlaceError right_pin;
  double pin_radius = 0;
  double joint_length = 0;
  DrumError drum;
  AttachmentError end1;
  AttachmentError end2;
  PathError path1;
  PathError path2;

  bool operator==(const GeometryError&) const = default;
};
GeometryError geometry_of(const Imperfections& imperfections);

/// Both tendons' paths. Of the imperfections only geometry_of() acts.
JointModel imperfect_geometry(const MadePulleys& made, const Mechanism& declared, const Imperfections& imperfections);
/// A weight that turns the joint against +θ with moment · sin(tilt − θ).
struct Weight {
  double moment = 0;  ///< N·mm
  double tilt = 0;    ///< rad
};
/// What the joint weighs when it was declared so and found to weigh `error` more.
Weight with_error(const Weight& declared, const WeightError& error);

/// Stiffness, friction, pretension, slack and weight, in a model of that geometry.
void set_imperfect_statics(JointModel& model, const Mechanism& declared, const Imperfections& imperfections);

}  // namespace fusee
