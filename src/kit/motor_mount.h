/// \file
/// Internal: how a motor is held under a base plate: its holes, the room that it takes, what it is screwed on with. mm
#pragma once

#include <vector>

#include "fusee/kit/kit.h"

namespace fusee {

/// The first of the catalogue with such a shaft or horn; null: none.
const MotorType* motor_for(const Mechanism& mechanism, const BodyLayout& layout);
/// Towards the joint.
Vec2 motor_front(const Vec2& pulley);
/// Through the plate.
std::vector<SlabLoop> motor_holes(const MotorType& motor, const Vec2& pulley, const Vec2& front);
/// From its body and its screws to a place seen from the pulley's axis, in the plane: below 0 within.
double beside_motor(const MotorType& motor, const Vec2& off, const Vec2& front);
/// What of the base plate is there for it.
std::vector<Disc> motor_corners(const MotorType& motor, const Vec2& pulley, const Vec2& front);
void buy_motor(KitPlan& plan, const MotorType& motor, double plate);

}  // namespace fusee
