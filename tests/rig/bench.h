/// \file
/// Quasi-static equilibrium of the joint for a sequence of pulley angles.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rig/groove_chain.h"
#include "rig/rig.h"
#include "rig/string_geometry.h"

namespace fusee::rig {

/// Inputs of a step. Bench sets pulley, θ, tensions and pull.
struct Conditions : Moment {
  std::array<double, 2> let_go{};  ///< tendon released at each knot so far, mm
};

/// A segment of tendon in a sheath, followed by a bend towards the pulley.
struct SheathPiece {
  double length = 0;      ///< at home, mm
  double compliance = 0;  ///< mm/N
  double log_ratio = 0;   ///< ln of the largest ratio of tensions across the bend: μφ
  double bristle = 0;     ///< as BenchTendon::bristle
  double material = 0;
};

/// A tendon in the right-hand image. Tendon 1 (index 0) is mirrored.
struct BenchTendon {
  Hull hull;           ///< pulley, in its own frame at home
  double held_at = 0;  ///< height of its end or of its collar, helical grooves only
  Circle pin;
  Vec2 axis = Vec2::Zero();         ///< of the pulley
  double sign = 1;                  ///< of angles in the image
  Vec2 end = Vec2::Zero();          ///< attachment, in the link at home
  Hull drum;                        ///< including the attachment, in the link at home, upside down; empty: no drum
  std::ptrdiff_t tied = 0;          ///< corner of `drum` at the attachment
  std::ptrdiff_t over = 0;          ///< corner of `drum` at which the string to the pin leaves
  std::vector<SheathPiece> sheath;  ///< from the sheath's exit to the pin; empty: no sheath
  Circle guide;                     ///< last contact before the pulley: the pin, or the sheath's exit
  double mark = 0;                  ///< direction of the point of the pin that separates the upper and the lower part
  double upper = 0;                 ///< unstretched length above the mark, mm
  double lower = 0;                 ///< below the mark, up to the pulley
  double wound = 0;                 ///< take-off as an arc on the pulley
  GrooveChain laid;                 ///< tendon in the groove, from the knot to the take-off
  std::ptrdiff_t corner = 0;        ///< of the take-off
  double bristle = 0;               ///< −1 … 1: used share of the friction; > 0 after motion towards the pulley
  double let_go = 0;
  double upper_tension = 0;  ///< N
  double lower_tension = 0;
  std::array<double, 5> crept{};  ///< creep strain of each decade's Kelvin element, relative to home
  double home_tension = 0;
  Vec2 home_push = Vec2::Zero();  ///< force on the pin at home, N
  Vec2 push = Vec2::Zero();
};

class Bench {
 public:
  /// At home, unloaded, θ = 0.
  Bench(const MadeJoint& joint, const HiddenFaults& hidden);

  /// θ with the pulley at `pulley` and the motor's sensor at `alpha`. NaN without equilibrium.
  double to(double pulley, double alpha, const Conditions& conditions);
  /// State after the last step.
  const Moment& now() const { return now_; }

  /// tendon(0): tendon 1.
  const BenchTendon& tendon(std::size_t side) const { return tendons_[side]; }
  double theta() const { return theta_; }

 private:
  /// A tendon at a pulley angle, before θ is known.
  struct LowerSpan {
    Circle pin;
    double length = 0;    ///< without the rise
    double rise = 0;      ///< from the joint to the take-off; 0 with collars
    double material = 0;  ///< before exchange with the groove
    double wound = 0;
    double normal = 0;
    std::ptrdiff_t corner = 0;
    std::ptrdiff_t over = 0;
    Cord cord;
    GrooveChain laid;
    double guess = 0;  ///< initial value of the tension above the groove, N
  };
  /// A tendon at a trial θ.
  struct Trial {
    double torque = 0;   ///< on the joint, positive towards its own side
    double slipped = 0;  ///< over the pin, down
    double to_span = 0;  ///< into the span to the pulley
    std::vector<SheathPiece> sheath;
    double bristle = 0;
    double upper_tension = 0, lower_tension = 0;  ///< at the pin
    double pulley_tension = 0;
    Vec2 pull = Vec2::Zero();  ///< unit, from the link's end to the pin, in the image
    Vec2 push = Vec2::Zero();
  };

  void build_link(BenchTendon& tendon, std::size_t side, const DeclaredMechanism& declared) const;
  void add_sheath(BenchTendon& tendon, const DeclaredMechanism& declared) const;
  Circle seen_guide(const BenchTendon& tendon, const Circle& pin) const;
  static double length_ratio(double level, double rise);
  static double sloping_more(const BenchTendon& tendon, const LowerString& string);
  static double rise_of(const BenchTendon& tendon, const LowerString& string);
  double level_arm_at_home(BenchTendon& tendon) const;
  static double knot_of(const BenchTendon& tendon, const Circle& seen, const LowerString& at_home, double unwound);
  double ratio(double wrap, double bristle) const;
  /// Tension at the pin for a tension at the sheath's exit. `slipped`: passed each bend, from the exit to the pin.
  static double pull_through(std::vector<SheathPiece>& sheath, const Cord& cord, double home, double tension,
                             double& slipped);
  Vec2 cut_to_length(BenchTendon& tendon, double tension, double slack, double unwound);
  Cord cord(std::size_t side, const Conditions& conditions) const;
  void creep(BenchTendon& tendon, double seconds) const;
  LowerSpan place_lower_span(std::size_t side, const Conditions& conditions, double longer, const Vec2& moved) const;
  Trial evaluate(std::size_t side, LowerSpan& below, double theta) const;
  double excess_torque(std::array<LowerSpan, 2>& below, double theta, const Conditions& conditions) const;
  double dry_friction(const Conditions& conditions);
  double solve_balance(std::array<LowerSpan, 2>& below, const Conditions& conditions, double dry) const;
  double lump(double alpha) const;
  /// For each tendon: elongation of its path and displacement of its pin in its image, mm.
  using Displacements = Eigen::Matrix<double, 6, 1>;
  template <typename Answer>
  bool solve_displacements(Answer answer, Displacements there);

  HiddenFaults hidden_;
  bool collar_ = false;
  double R_ = 0;
  double EA_ = 0;
  double friction_ = 0;
  double turning_ = 0;   ///< idlers: friction of the bearing × its radius / idler radius; 0: pins
  double furthest_ = 0;  ///< |θ| beyond which there is no equilibrium
  double torque_declared_ = 0;
  double weight_ = 0;  ///< weight × lever, N·mm
  double tilt_ = 0;
  Spring spring_;
  double step_ = 0;                                                                     ///< last change of θ
  Eigen::Matrix<double, 6, 6> towards_rest_ = Eigen::Matrix<double, 6, 6>::Identity();  ///< Broyden's inverse Jacobian
  double theta_ = 0;
  std::array<BenchTendon, 2> tendons_;
  std::array<Actors, 2> longer_;
  Actors torque_;
  Actors dry_;
  Moment now_;
};

}  // namespace fusee::rig
