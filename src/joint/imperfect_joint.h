/// \file
/// Statics of an imperfect joint: imperfect pulleys made for the declaration, in the mechanism as mounted.
#pragma once

#include "fusee/joint.h"

namespace fusee::joint {

/// The deviations on which the tendon paths depend. Equal values allow a geometry to be reused.
struct GeometryError {
  PulleyError pulley;
  PinPlaceError left_pin;
  PinPlaceError right_pin;
  double pin_radius = 0;    ///< PinError::radius, mm
  double joint_length = 0;  ///< JointError::length, mm
  DrumError drum;
  AttachmentError end1;
  AttachmentError end2;
  PathError path1;
  PathError path2;

  bool operator==(const GeometryError&) const = default;
};
GeometryError geometry_of(const Imperfections& imperfections);

/// Both tendon paths. Only the part geometry_of() of the imperfections matters.
JointModel imperfect_geometry(const MadePulleys& made, const Mechanism& declared, const Imperfections& imperfections);
/// Weight of the link: moment · sin(tilt − θ) against +θ.
struct Weight {
  double moment = 0;  ///< N·mm
  double tilt = 0;    ///< rad
};
/// The declared weight with the identified additional torque `error`.
Weight with_error(const Weight& declared, const WeightError& error);

/// Sets stiffness, friction, pretension, slack and weight in a model with the geometry of `imperfections`.
void set_imperfect_statics(JointModel& model, const Mechanism& declared, const Imperfections& imperfections);

}  // namespace fusee::joint
