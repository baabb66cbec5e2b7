/// \file
/// A simulated joint on a bench with known faults, by which calibration is judged.
///
/// It shares no equation with the fit. Strings are wound on the polygon of the pulley that was made, or on the spiral
/// (string_geometry.h). Tendons are elastic between C, pin and pulley (bench.h). Friction at a pin follows a bristle
/// (Dahl 1968). θ is the root of the torque balance, found by bracketing. Only the declared numbers and the outlines
/// come from fusee. rad, mm, N, s unless the name says otherwise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fusee/helix.h"
#include "fusee/mechanism.h"
#include "fusee/profile.h"
#include "rig/action.h"
#include "rig/way.h"

namespace fusee::rig {

/// Differences of a joint from its declaration. All zero: none.
struct HiddenFaults {
  // Motor sensor: the shaft stands at α + offset + amplitude (sin(n α + phase) − sin phase).
  double motor_offset = 0;
  double motor_eccentricity = 0;  ///< n = 1
  double motor_eccentricity_phase = 0;
  double motor_harmonic = 0;
  double motor_harmonic_phase = 0;
  int motor_harmonic_order = 2;
  double backlash = 0;  ///< full width, of α

  // Pulleys.
  double radius_offset = 0;  ///< both outlines further out, mm
  double pulley_scale = 0;   ///< both outlines larger by this fraction
  double runout_x = 0;       ///< outlines off the axis, at home, mm
  double runout_y = 0;
  double profile_error = 0;  ///< amplitude of a wave on both outlines, mm
  int profile_harmonic = 2;  ///< waves a turn
  double profile_phase = 0;

  // Tendons.
  double modulus = 0;            ///< the true one, MPa; 0: as declared
  double groove_friction = 0.2;  ///< between tendon and groove, whatever the file says
  double slack = 0;              ///< material too much, of both together; they hang loose at home, mm
  /// The strain grows by this share of T/EA with every decade of time under T, from one run to the next: a spring and a
  /// dashpot for each decade (Kelvin), at rest under home's tension.
  double creep = 0;
  double slip = 0;               ///< material released at one knot, mm
  std::size_t slip_side = 1;     ///< 0: tendon 1, 1: tendon 2
  std::size_t slip_run = 0;      ///< the run in which it happens
  double slip_at = 0.5;          ///< share of that run
  double expansion = 0;          ///< strain per K
  double expansion_other = 0.3;  ///< share of the temperature that tendon 1, in a draught, follows

  // Sheaths, both alike.
  double sheath_friction = 0;    ///< added to the coefficient times the bends
  double sheath_compliance = 0;  ///< added to a sheath's, mm/N

  // Pins.
  double friction = 0;                  ///< added to μ
  double guide_radius = 0;              ///< added to the pins' radius, mm
  double guide_outward = 0;             ///< both pins, mm
  double guide_down = 0;                ///< both pins, mm
  std::array<double, 2> pin_outward{};  ///< each pin beyond that, mm; [0] is tendon 1's
  std::array<double, 2> pin_down{};
  double bearing_friction = 0;  ///< added to the coefficient of idlers' bearings
  double frame_compliance = 0;  ///< of the pins, along the tendon's force on them, mm/N

  // Joint.
  double joint_length = 0;       ///< added to OC, mm
  double drum_radius = 0;        ///< added to the drum's, mm
  double drum_runout = 0;        ///< of the drum's centre off the joint's axis, mm
  double drum_runout_phase = 0;  ///< where that centre stands at home, from across (0) towards along (π/2)
  std::array<Vec2, 2> end_moved{Vec2::Zero(), Vec2::Zero()};  ///< of each tendon's own attachment: across, along, mm
  double gravity = 0;                                         ///< weight times lever, N·mm
  double gravity_direction = 0;  ///< of the pull; 0: from C to O at home, π/2: towards −θ
  double bearing = 0;            ///< dry friction of the joint's bearing once it moves, N·mm

  // Joint sensor: shows waves as the motor's does.
  double zero = 0;
  double gain = 0;
  double joint_eccentricity = 0;
  double joint_eccentricity_phase = 0;
  double joint_harmonic = 0;
  double joint_harmonic_phase = 0;
  int joint_harmonic_order = 2;
  double lag = 0;         ///< what is shown is this old, s
  double lag_filter = 0;  ///< what is shown follows with this time constant, s

  // Unmodelled.
  double lump = 0;        ///< both pulleys wrong at one place: tendon 2 wound, tendon 1 let out by this much more, mm
  double lump_at = 0;     ///< α
  double lump_width = 0;  ///< standard deviation, of α
  double hardening = 0;   ///< strain h of T = E' ε (1 + ε/h), as stiff as declared at the pretension; 0: none
  double bearing_stick = 0;     ///< dry friction beyond `bearing` from rest, N·mm
  double bearing_speed = 0.05;  ///< joint speed over which this more fades (Stribeck), rad/s
  double cogging = 0;           ///< amplitude, of α
  int cogging_per_turn = 30;
  double interpolation = 0;  ///< amplitude, of θ
  int interpolation_per_turn = 8;
  double zero_walk = 0;  ///< step of the joint sensor's zero at every reversal, standard deviation
  double bedding = 0;    ///< pulley still off its seat at the start of every run, of α

  // Actions, by their place in the chain.
  std::vector<Action> shaft = {};                  ///< added to the pulley's angle, after the play, rad
  std::array<std::vector<Action>, 2> longer = {};  ///< the tendon's way below its pin is longer by this, mm
  std::vector<Action> torque = {};                 ///< on the joint, towards +θ, N·mm
  std::vector<Action> dry = {};                    ///< added to the joint's dry friction, N·mm
  std::vector<Action> reading = {};                ///< added to what the joint's sensor shows, rad
  std::vector<Action> load = {};                   ///< pulls beyond the load that is logged, N

  bool operator==(const HiddenFaults&) const = default;
};

/// Sensors turned as in `plan`, with new zeros.
HiddenFaults with_turned_sensors(HiddenFaults hidden, const RunPlan& plan);

struct SensorPlan {
  double noise = radians(0.02);  ///< standard deviation
  double colour = 0;             ///< lag-1 autocorrelation of the noise
  double quantum = 0;            ///< smallest step; 0: none
  bool temperature = false;      ///< a column of it
  std::uint64_t seed = 1;
};

SensorPlan noiseless();

struct Row {
  double time = 0;
  double alpha = 0;  ///< as the motor's sensor shows it
  double theta = 0;  ///< as the joint's sensor shows it
  double load = 0;
  double temperature = 0;  ///< °C
};
using Log = std::vector<Row>;

/// A helical groove as made.
struct MadeSpiral {
  std::vector<helix::SpiralRow> rows;  ///< none: the pulley has an outline
  double held_at = 0;    ///< height of the tendon's end on the joint, or of the collar that holds it at its pin
  std::size_t home = 0;  ///< the row near which the tendon leaves it at home
};

/// Both pitch curves that were made for a declared mechanism.
struct MadeJoint {
  DeclaredMechanism declared;
  profile::Outline p1, p2;
  double alpha_min = 0;  ///< of the declared range
  double alpha_max = 0;
  std::array<MadeSpiral, 2> spirals = {};  ///< in place of p1, p2 where one turn is too little

  bool is_helical() const { return !spirals[0].rows.empty(); }
};
/// InputError if no pulley exists.
MadeJoint make_joint(const DeclaredMechanism& declared);

/// The runs one after another on one clock and one joint. Before each the motor goes home, unloaded, and to the start
/// of the sweep, where it is loaded.
std::vector<Log> log_runs(const MadeJoint& joint, const HiddenFaults& hidden, const std::vector<RunPlan>& runs,
                          const SensorPlan& sensors = {}, const MotionPlan& motion = {});

/// Rms of the differences of θ over all rows, rad. 0 where a joint has no equilibrium.
double rms_difference(const std::vector<Log>& one, const std::vector<Log>& other);

/// A log file: time_s, alpha_deg, theta_deg, load_N, temperature_C if requested, and the rotations of the sensors if
/// there are any.
std::string csv_text(const Log& log, bool temperature = false, const RunPlan& plan = {});

/// Reading of the joint's sensor at `theta`, but for its delay, noise and actions.
double joint_sensor_reading(const HiddenFaults& hidden, double theta);

}  // namespace fusee::rig
