/// \file
/// A joint for other programs: θ(α) as simulators and firmware can have it, each with what it misses. rad, mm.
///
/// Simulators take polynomials of degree 4, descriptions of robots a straight line, firmware tables of 32-bit floats.
/// What is fitted is a JointCurve: the law that the file declares, what an identified joint does each way, or a
/// compensation.csv.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/mechanism/mechanism.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

// ---- what the joint does --------------------------------------------------------------------------------------------

/// θ(α) and back, both growing. Beyond its ends it stands still.
struct AngleMap {
  double alpha_min = 0, alpha_max = 0;  ///< rad
  double theta_min = 0, theta_max = 0;  ///< rad
  std::function<double(double alpha)> theta;
  std::function<double(double theta)> alpha;
  std::function<double(double alpha)> slope;  ///< dθ/dα
};

/// The law must exist, and grow.
AngleMap angle_map(const Transmission& law);
/// By straight lines between rows, of which both columns grow.
AngleMap angle_map(std::vector<LawRow> rows);

/// Where the motor must stand for the joint to be at `theta`: moving up, and moving down. rad
struct TwoWayRow {
  double theta = 0;
  double up = 0;
  double down = 0;
};

enum class CurveSource {
  law,           ///< the declared θ(α): each way the same
  identified,    ///< the joint with its [identified] numbers, simulated there and back under its declared load
  compensation,  ///< a compensation.csv
};

struct JointCurve {
  CurveSource source = CurveSource::law;
  AngleMap middle;                              ///< between both ways; the law itself
  std::optional<std::array<AngleMap, 2>> ways;  ///< from below (α grows), from above
  double loop = 0;                              ///< half of what lies between both ways at most, at the joint, rad
};

/// Of rows whose three columns grow.
JointCurve two_way_curve(const std::vector<TwoWayRow>& rows, CurveSource source);

/// A joint as simulators and as firmware see it.
struct JointCurves {
  JointCurve stands;  ///< θ: where the joint stands, for simulators
  JointCurve shown;   ///< θ: what its sensor shows, for firmware. α is what the motor's sensor shows, in both
};

/// With the pulley that `fusee build` makes of the file. The law must exist, and grow (grows()).
/// Null where the identified joint has no equilibrium to move through.
std::optional<JointCurves> joint_curves(const DeclaredMechanism& declared);

/// Whether θ grows with α over the whole range. The law must exist.
bool grows(const Transmission& law);

/// compensation.csv → its rows. InputError with all that is wrong.
std::vector<TwoWayRow> read_compensation(const std::string& text, const std::string& name);
/// More rows: between two of them, what the motor goes beyond the law grows evenly, so that the law keeps its bends.
/// The rows as they are where they reach far beyond the law.
std::vector<TwoWayRow> refined(const std::vector<TwoWayRow>& rows, const Transmission& law);

// ---- polynomials ----------------------------------------------------------------------------------------------------

/// c[0] + c[1] x + …
struct Polynomial {
  std::vector<double> c;

  double operator()(double x) const;
  double slope(double x) const;
};

/// A point to come near to; an error counts `weight` times.
struct FitPoint {
  double x = 0;
  double y = 0;
  double weight = 1;
};

struct PolynomialFit {
  Polynomial p;
  double error = 0;  ///< the largest of weight · |p(x) − y|
};

/// The polynomial whose largest error at the points is the least that there is (exchange algorithm of Remez and
/// Stiefel), but for rounding. `points` by growing x, more than degree + 2.
PolynomialFit least_largest_error(const std::vector<FitPoint>& points, int degree);

/// A joint equality as MuJoCo has it.
struct EqualityFit {
  bool of_alpha = true;    ///< θ = p(α); false: α = p(θ), where that misses less
  Polynomial p;            ///< rad
  double error = 0;        ///< of θ at any α of the range, rad
  double slope_error = 0;  ///< of dθ/dα, as a part of it: what torques miss
};

constexpr int k_equality_degree = 4;  ///< polycoef of MuJoCo's joint and tendon equalities

EqualityFit fit_equality(const AngleMap& map);
/// θ = p(α), a straight line.
EqualityFit fit_line(const AngleMap& map);
/// What an equality misses of a map, by solving it: error and slope_error.
EqualityFit measured(EqualityFit fit, const AngleMap& map);

// ---- tendons --------------------------------------------------------------------------------------------------------

/// A tendon from its end on the link over its pin to a point that stands still, as a simulator that wraps round
/// cylinders has it. In the frame of the mechanism, with the joint at home, mm.
struct WrappedTendon {
  Side side = Side::left;
  Vec2 end{0, 0};  ///< on the link
  Vec2 pin{0, 0};
  double rho = 0;          ///< the cylinder, to the tendon's centre line; 0: a point that it goes through
  Vec2 anchor{0, 0};       ///< the point that stands still, below the pin, or where the tendon goes into its sheath
  Vec2 outer{0, 0};        ///< on the side of the pin that the tendon passes
  double home_length = 0;  ///< from its end to the anchor, or to the far mouth of its sheath
  double most_wrap = 0;    ///< round the pin, at any angle of the range, rad
  /// The link's drum about O, to the tendon's centre line, where the tendon lies on it at every angle of the range; 0:
  /// it does nowhere.
  double drum = 0;
  std::vector<Vec2> on_drum;  ///< places on the link that it always covers, from its end on, by short chords
  Vec2 drum_outer{0, 0};      ///< on the side of the drum that it passes after them
  Vec2 off_drum{0, 0};        ///< a point that stands still, on its straight way from drum to pin
  std::optional<Vec2> mouth = std::nullopt;  ///< where its sheath ends, beside the pulley
};

/// The law by tendons: above the pin they are wrapped, what the pulley takes in of one of them is a polynomial of α.
struct TendonModel {
  std::array<WrappedTendon, 2> tendons;
  std::array<std::string, 2> left_out;  ///< why a simulator cannot have this one; "": it has it
  Side held = Side::left;               ///< whose length is held to that polynomial
  Polynomial length;                    ///< of that tendon, less home_length; mm over rad
  double error = 0;                     ///< of θ at any α of the range, rad
};

/// Null, with why, where neither tendon can be had. One that leaves the drum within the range cannot, nor one that lies
/// nearly half round its pin, or further round the drum than simulators wrap.
std::optional<TendonModel> tendon_model(const Mechanism& mounted, const AngleMap& map, std::string& why_not);

/// What θ misses, rad, where a tendon's length is held to `length` of α; found by moving the joint until it is.
double tendon_error(const WrappedTendon& tendon, const Polynomial& length, const AngleMap& map);

// ---- tables ---------------------------------------------------------------------------------------------------------

/// How a table counts the motor's angle.
struct MotorUnit {
  double per_turn = 360;  ///< degrees, or counts of an encoder; negative where they fall as α grows
  bool ticks = false;
  double zero = 0;  ///< shown at α = 0

  double of(double alpha) const;
  double alpha(double shown) const;
};

/// One way, each table over even steps from its first to its last place.
struct OneWayTable {
  float first = 0, last = 0;  ///< motor's angle, in its unit less its zero: the first is the smaller one
  std::vector<float> theta;   ///< deg, of the motor's angle
  std::vector<float> motor;   ///< motor's angle less its zero, of θ
};

struct TableErrors {
  double theta = 0;     ///< of θ read from α, rad
  double returned = 0;  ///< of θ where the motor stands as read from θ, rad
  double motor = 0;     ///< of that motor angle, rad
};

struct JointTable {
  MotorUnit unit;
  int pieces = 0;                         ///< straight pieces of each table
  float theta_first = 0, theta_last = 0;  ///< deg
  std::vector<OneWayTable> ways;          ///< one, or from below and from above
  std::vector<float> slope;               ///< dθ/dα of the middle, over the first way's angles
  std::vector<float> holding;  ///< motor torque that holds the declared load without friction, N·mm; or none
  TableErrors errors;          ///< by 32-bit arithmetic, the worst way
};

constexpr int k_most_pieces = 4096;

/// The shortest table (a power of two) whose θ misses no more than `most`, rad, both ways round. Null where
/// k_most_pieces are too few.
std::optional<JointTable> joint_table(const JointCurve& curve, const Mechanism& mechanism, const MotorUnit& unit,
                                      double most);
/// What a table misses of its curve, in 32-bit arithmetic.
TableErrors measured(const JointTable& table, const JointCurve& curve);

/// As the header that is written does it: `at` in pieces from the first entry.
float looked_up(const std::vector<float>& table, float at);

}  // namespace fusee
