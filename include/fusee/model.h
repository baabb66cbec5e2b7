/// \file
/// A joint for other programs: θ(α) in the forms of simulators and firmware, each with its error. Units: rad, mm.
///
/// Simulators use polynomials of degree 4, robot descriptions a straight line, firmware tables of 32-bit floats. The
/// source is a JointCurve: the law that the file declares, the motion of an identified joint in each direction, or a
/// compensation.csv.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism.h"
#include "fusee/transmission.h"

namespace fusee::model {

// ---- curves of the joint --------------------------------------------------------------------------------------------

/// θ(α) and its inverse, both increasing. Constant beyond the ends.
struct AngleMap {
  double alpha_min = 0, alpha_max = 0;  ///< rad
  double theta_min = 0, theta_max = 0;  ///< rad
  std::function<double(double alpha)> theta;
  std::function<double(double theta)> alpha;
  std::function<double(double alpha)> slope;  ///< dθ/dα
};

/// Requires a law that exists and increases.
AngleMap angle_map(const transmission::Transmission& law);
/// Linear interpolation between rows. Both columns must increase.
AngleMap angle_map(std::vector<LawRow> rows);

/// Motor angles at which the joint is at `theta`, rad.
struct TwoWayRow {
  double theta = 0;
  double up = 0;    ///< while α increases
  double down = 0;  ///< while α decreases
};

/// Origin of a curve.
enum class CurveSource {
  law,           ///< the declared θ(α), equal in both directions
  identified,    ///< the joint with its [identified] numbers, simulated in both directions under its declared load
  compensation,  ///< a compensation.csv
};

/// θ(α) of the joint, of both directions where they differ.
struct JointCurve {
  CurveSource source = CurveSource::law;
  AngleMap middle;                              ///< the law, or the mean motor angle of both directions
  std::optional<std::array<AngleMap, 2>> ways;  ///< both directions: from below (α increases), from above
  double half_hysteresis = 0;                   ///< half of the largest hysteresis at the joint, rad
};

/// Requires that all three columns of the rows increase.
JointCurve two_way_curve(const std::vector<TwoWayRow>& rows, CurveSource source);

/// The joint for simulators and for firmware.
struct JointCurves {
  JointCurve physical;  ///< with the true θ, for simulators
  /// With θ as the joint sensor shows it, for firmware; α is the motor sensor's reading in both curves
  JointCurve sensed;
};

/// The curves with the pulley that `fusee build` makes of the file. The law must exist and increase (grows()). Empty if
/// the identified joint has no equilibrium somewhere in its range.
std::optional<JointCurves> joint_curves(const DeclaredMechanism& declared);

/// True if θ increases with α over the whole range. The law must exist.
bool grows(const transmission::Transmission& law);

/// Parses compensation.csv. Throws InputError with all errors.
std::vector<TwoWayRow> read_compensation(const std::string& text, const std::string& name);
/// Adds rows in which the motor's offset from the law is interpolated linearly, so that the law keeps its shape.
/// Returns the rows unchanged if they reach far beyond the law.
std::vector<TwoWayRow> refined(const std::vector<TwoWayRow>& rows, const transmission::Transmission& law);

// ---- polynomials ----------------------------------------------------------------------------------------------------

/// The polynomial c[0] + c[1] x + …
struct Polynomial {
  std::vector<double> c;

  /// Value at `x`, by Horner's rule.
  double operator()(double x) const;
  /// Derivative at `x`.
  double slope(double x) const;
};

/// A point to be fitted. Its error is multiplied by `weight`.
struct FitPoint {
  double x = 0;
  double y = 0;
  double weight = 1;
};

/// A polynomial and its largest error.
struct PolynomialFit {
  Polynomial p;
  double error = 0;  ///< largest weight · |p(x) − y|
};

/// The minimax polynomial of the points (exchange algorithm of Remez and Stiefel), up to rounding. `points`: increasing
/// in x, more than degree + 2.
PolynomialFit least_largest_error(const std::vector<FitPoint>& points, int degree);

/// A joint equality in MuJoCo's form.
struct EqualityFit {
  bool of_alpha = true;    ///< θ = p(α); false: α = p(θ), if its error is smaller
  Polynomial p;            ///< rad
  double error = 0;        ///< largest error of θ over the range, rad
  double slope_error = 0;  ///< largest relative error of dθ/dα, which is the error of torques
};

constexpr int k_equality_degree = 4;  ///< degree of polycoef in MuJoCo's joint and tendon equalities

/// The polynomial of degree k_equality_degree, of α or of θ, with the smaller largest error.
EqualityFit fit_equality(const AngleMap& map);
/// The straight line θ = p(α) with the least largest error.
EqualityFit fit_line(const AngleMap& map);
/// Computes error and slope_error by solving the equality.
EqualityFit measured(EqualityFit fit, const AngleMap& map);

// ---- tendons --------------------------------------------------------------------------------------------------------

/// A tendon from its end on the link over its pin to a fixed point, for a simulator that wraps tendons around
/// cylinders. In the mechanism's frame with the joint at home, mm.
struct WrappedTendon {
  transmission::Side side = transmission::Side::left;
  Vec2 end{0, 0};  ///< on the link
  Vec2 pin{0, 0};
  double rho = 0;          ///< radius of the cylinder to the tendon's centre line; 0: a point
  Vec2 anchor{0, 0};       ///< the fixed point below the pin, or the entrance of the sheath
  Vec2 outer{0, 0};        ///< a point beyond the pin, on the side on which the tendon passes it
  double home_length = 0;  ///< length from its end to the anchor, or to the far exit of its sheath
  double most_wrap = 0;    ///< largest wrap angle at the pin over the range, rad
  /// Radius of the link's drum about O, to the tendon's centre line, if the tendon lies on it at every angle of the
  /// range; 0 otherwise.
  double drum = 0;
  /// Points of the link that the tendon covers at every angle, from its end on, close together.
  std::vector<Vec2> on_drum;
  Vec2 drum_outer{0, 0};  ///< a point beyond the drum, on the side on which the tendon passes it after these points
  Vec2 off_drum{0, 0};    ///< a fixed point on the tendon's straight part from drum to pin
  std::optional<Vec2> sheath_exit = std::nullopt;  ///< exit of the tendon's sheath, beside the pulley
};

/// The law as two tendons that are wrapped above the pins. A polynomial of α gives the length of one of
/// them, from its end to the anchor.
struct TendonModel {
  std::array<WrappedTendon, 2> tendons;
  std::array<std::string, 2> omission;  ///< reason why a simulator cannot represent a tendon; "": it can
  /// The tendon whose length is constrained to the polynomial.
  transmission::Side constrained = transmission::Side::left;
  Polynomial length;  ///< length of that tendon as a function of α, minus home_length; mm over rad
  double error = 0;   ///< largest error of θ over the range, rad
};

/// Empty, with the reason in `why_not`, if neither tendon can be represented. Tendons are excluded if they leave the
/// drum within the range, or if they wrap nearly half round the pin or further round the drum than simulators allow.
std::optional<TendonModel> tendon_model(const Mechanism& mounted, const AngleMap& map, std::string& why_not);

/// Largest error of θ, rad, if a tendon's length is constrained to `length`(α). Found by moving the joint until the
/// lengths agree.
double tendon_error(const WrappedTendon& tendon, const Polynomial& length, const AngleMap& map);

// ---- tables ---------------------------------------------------------------------------------------------------------

/// The unit of the motor's angle in a table.
struct MotorUnit {
  double per_turn = 360;  ///< degrees, or counts of an encoder; negative if they decrease as α increases
  bool ticks = false;     ///< counts
  double zero = 0;        ///< reading at α = 0

  /// Reading in this unit at a motor angle, rad.
  double of(double alpha) const;
  /// Motor angle of a reading, rad.
  double alpha(double reading) const;
};

/// The tables of one direction, with evenly spaced entries.
struct OneWayTable {
  float first = 0, last = 0;  ///< motor angle of the first and last entry, in its MotorUnit minus its zero; ascending
  std::vector<float> theta_deg;  ///< θ, as a function of the motor angle
  std::vector<float> motor;      ///< motor angle in its MotorUnit minus its zero, as a function of θ
};

/// Largest errors of a table with respect to its curve.
struct TableErrors {
  double theta = 0;     ///< error of θ read from α, rad
  double returned = 0;  ///< error of θ at the motor angle read from θ, rad
  double motor = 0;     ///< error of that motor angle, rad
};

/// Tables of both directions of conversion, for firmware.
struct JointTable {
  MotorUnit unit;
  int pieces = 0;                                 ///< number of linear pieces of each table
  float theta_first_deg = 0, theta_last_deg = 0;  ///< θ of the first and last entry of the motor angles
  std::vector<OneWayTable> ways;                  ///< one, or two: from below and from above
  std::vector<float> slope;                       ///< dθ/dα of the mean curve, over the first way's angles
  std::vector<float> holding;  ///< motor torque that holds the declared load without friction, N·mm; may be empty
  TableErrors errors;          ///< in 32-bit arithmetic, for the worse direction
};

/// Limit of the size of a table.
constexpr int k_most_pieces = 4096;

/// The shortest table whose error of θ is at most `most`, rad, in both directions of conversion. Its number of pieces
/// is a power of two, 16 or more. Empty if k_most_pieces are too few.
std::optional<JointTable> joint_table(const JointCurve& curve, const Mechanism& mechanism, const MotorUnit& unit,
                                      double most);
/// Errors of a table with respect to its curve, in 32-bit arithmetic, at eight points of each piece.
TableErrors measured(const JointTable& table, const JointCurve& curve);

/// Interpolates as the generated header does. `position`: in pieces from the first entry.
float interpolated(const std::vector<float>& table, float position);

}  // namespace fusee::model
