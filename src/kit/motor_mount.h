/// \file
/// Internal: the motor mount under a base plate: holes, space and fasteners. mm
#pragma once

#include <string>
#include <vector>

#include "fusee/kit.h"

namespace fusee::kit {

/// The first motor of the catalogue with the mechanism's shaft or horn; null if there is none.
const fusee::MotorType* motor_for(const Mechanism& mechanism, const solid::BodyLayout& layout);
/// The motor that the file gives: its model, else the mount's name if the file names its shaft or horn, else "".
std::string motor_name(const Mechanism& mechanism, const fusee::MotorType* mount);
/// "NEMA 17", "its mount is assumed to be that of NEMA 17", "NEMA17-48mm 5:1; its mount is assumed …".
std::string mount_words(const std::string& name, const fusee::MotorType& mount);
/// Direction of the motor's front, along y towards the joint. `pulley`: position of the pulley's axis.
Vec2 motor_front(const Vec2& pulley);
/// Holes through the plate. `pulley`: position of the pulley's axis.
std::vector<SlabLoop> motor_holes(const fusee::MotorType& motor, const Vec2& pulley, const Vec2& front);
/// Distance in the plane from the motor's body and screws to a place, negative inside. `from_axis`: the place relative
/// to the pulley's axis.
double distance_to_motor(const fusee::MotorType& motor, const Vec2& from_axis, const Vec2& front);
/// Corners of the part of the base plate that supports the motor.
std::vector<Disc> motor_corners(const fusee::MotorType& motor, const Vec2& pulley, const Vec2& front);
/// Adds the motor and its screws to the items. `plate`: thickness of the base plate.
void buy_motor(KitPlan& plan, const std::string& name, const fusee::MotorType& motor, double plate);

}  // namespace fusee::kit
