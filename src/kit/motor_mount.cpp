#include "kit/motor_mount.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.h"
#include "kit/hardware.h"
#include "kit/parts.h"
#include "mechanism/catalogue.h"

namespace fusee::kit {
namespace {

/// The screw of a motor, M1.6 for holes narrower than all threads of the kit.
std::string motor_screw(const fusee::MotorType& motor, double length) {
  if (motor.hole < k_threads.front().diameter) return "M1.6 × " + rounded(stock_length(length));
  return screw_words(thread_within(motor.hole), length);
}

/// True if the motor has the shaft or horn that the file names.
bool has_named_fitting(const fusee::MotorType& motor, const Body& body) {
  const std::string& name = body.bore == Bore::horn ? body.horn : body.shaft;
  return std::find(motor.fits.begin(), motor.fits.end(), name) != motor.fits.end();
}

}  // namespace

const fusee::MotorType* motor_for(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  const Body& body = mechanism.body;
  const bool horn = body.bore == Bore::horn;
  for (const fusee::MotorType& motor : motor_types()) {
    if (has_named_fitting(motor, body)) return &motor;
  }
  if (horn || body.bore == Bore::hex || body.bore == Bore::square) return nullptr;
  // No motor names this shaft: one whose shaft has the same diameter fits too.
  const double shaft = shaft_of(mechanism, layout);
  for (const fusee::MotorType& motor : motor_types()) {
    if (motor.shaft > 0 && std::abs(motor.shaft - shaft) < 0.05) return &motor;
  }
  return nullptr;
}

std::string motor_name(const Mechanism& mechanism, const fusee::MotorType* mount) {
  if (const std::string model = motor_limits(mechanism.motor).name; find_motor_model(mechanism.motor.model))
    return model;
  return mount != nullptr && has_named_fitting(*mount, mechanism.body) ? mount->name : "";
}

std::string mount_words(const std::string& name, const fusee::MotorType& mount) {
  if (name == mount.name) return name;
  return (name.empty() ? "" : name + "; ") + "its mount is assumed to be that of " + mount.name;
}

Vec2 motor_front(const Vec2& pulley) { return {0, pulley.y() > 0 ? -1.0 : 1.0}; }

std::vector<SlabLoop> motor_holes(const fusee::MotorType& motor, const Vec2& pulley, const Vec2& front) {
  std::vector<SlabLoop> holes;
  const auto through = [&holes](DiscHull hull) { holes.push_back({std::move(hull), true, 0, 0}); };
  constexpr double k_around_pilot = 0.5;  // clearance in diameter, mm
  constexpr double k_around_motor = 0.3;  // clearance on each side, mm
  if (motor.pilot > 0) {
    through(disc(pulley, 0.5 * (motor.pilot + k_around_pilot)));
  } else {
    const Vec2 a = pulley + (motor.front + k_around_motor) * front, b = pulley - (motor.back + k_around_motor) * front;
    const double side = motor.side + k_around_motor;
    through(box({-side, std::min(a.y(), b.y())}, {side, std::max(a.y(), b.y())}));
  }
  for (const double x : {-motor.hole_x, motor.hole_x}) {
    through(disc(pulley + Vec2(x, 0) + motor.hole_front * front, 0.5 * motor.hole));
    if (!motor.two_holes) through(disc(pulley + Vec2(x, 0) - motor.hole_back * front, 0.5 * motor.hole));
  }
  return holes;
}

// A screw's head is taken to be as wide as two of its holes.
double distance_to_motor(const fusee::MotorType& motor, const Vec2& from_axis, const Vec2& front) {
  const double along = from_axis.dot(front);
  return std::max({std::abs(from_axis.x()) - std::max(motor.side, motor.hole_x + motor.hole),
                   along - std::max(motor.front, motor.hole_front + motor.hole),
                   -along - std::max(motor.back, motor.hole_back + motor.hole)});
}

std::vector<Disc> motor_corners(const fusee::MotorType& motor, const Vec2& pulley, const Vec2& front) {
  constexpr double k_beyond_hole = 4;  // from a screw's axis to the plate's end, mm
  const double to_front = std::max(motor.front, motor.hole_front + k_beyond_hole);
  const double to_back = std::max(motor.back, motor.hole_back + k_beyond_hole);
  std::vector<Disc> corners;
  for (const double x : {-1.0, 1.0}) {
    for (const double along : {to_front, -to_back})
      corners.push_back({pulley + Vec2(x * motor.side, 0) + along * front, 0});
  }
  return corners;
}

// Screws reach 4 mm into the motor. Those of a motor with a horn reach through its flange and a nut, 8 mm for both.
void buy_motor(KitPlan& plan, const std::string& name, const fusee::MotorType& motor, double plate) {
  if (name == motor.name)
    plan.items.push_back({1, motor.name + ": " + motor.description, "drives the pulley; assumed: " + motor.source});
  else
    plan.items.push_back({1, name.empty() ? "motor: the file names none" : "motor: " + name,
                          "drives the pulley; its mount is assumed, body.shaft or body.horn changes it: " + motor.name +
                              ", " + motor.description + "; " + motor.source});
  if (motor.shaft > 0)
    plan.items.push_back(
        {motor.two_holes ? 2 : 4, motor_screw(motor, plate + 4) + " with low head", "motor, from above"});
  else
    plan.items.push_back({4, motor_screw(motor, plate + 8) + " with low head and nuts", "motor, from above"});
}

}  // namespace fusee::kit
