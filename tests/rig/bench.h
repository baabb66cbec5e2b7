/// \file
/// The joint on its bench, in equilibrium at one pulley angle after another.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rig/cord.h"
#include "rig/groove_chain.h"
#include "rig/rig.h"
#include "rig/string_geometry.h"

namespace fusee::rig {

/// What acts on the joint at a step; Bench fills in what it knows itself (pulley, θ, tensions, pull).
struct Conditions : Moment {
  std::array<double, 2> let_go{};  ///< material let go at each knot so far, mm
};

/// A piece of tendon in a sheath, and the bend through which it goes on towards the pulley.
struct SheathPiece {
  double length = 0;   ///< at home, mm
  double give = 0;     ///< by how much that gets shorter, mm/N
  double holds = 0;    ///< ln of the tensions' ratio that the bend's friction can hold
  double bristle = 0;  ///< as BenchTendon::bristle
  double material = 0;
};

/// A tendon in its right-hand image: index 0 is tendon 1, seen in the mirror.
struct BenchTendon {
  Hull hull;           ///< its pulley, in the pulley's frame at home
  double held_at = 0;  ///< height of its end, or of the collar, where the pulley's groove climbs
  Circle pin;
  Vec2 axis = Vec2::Zero();         ///< of the pulley
  double sign = 1;                  ///< of the image's angles
  Vec2 end = Vec2::Zero();          ///< where it is tied, in the link at home
  Hull drum;                        ///< with that end, in the link at home, upside down; empty: no drum
  std::ptrdiff_t tied = 0;          ///< the corner of `drum` that the end is
  std::ptrdiff_t over = 0;          ///< and the one at which the string to the pin leaves it
  std::vector<SheathPiece> sheath;  ///< from the mouth to the pin; empty: none
  Circle guide;                     ///< from which it comes to its pulley: the pin, or the sheath's mouth
  double mark = 0;                  ///< direction of the point of the pin's rim between the upper and the lower part
  double upper = 0;                 ///< unstretched length above the mark, mm
  double lower = 0;                 ///< below it, up to the pulley
  double wound = 0;                 ///< arc on the pulley
  GrooveChain laid;                 ///< what lies on it, up to the knot
  std::ptrdiff_t corner = 0;        ///< at which it begins
  double bristle = 0;               ///< −1…1: share of the friction in use; > 0 where tendon went down over the pin
  double let_go = 0;
  double upper_tension = 0;  ///< N
  double lower_tension = 0;
  std::array<double, 5> crept{};  ///< strain of each decade's spring beyond that of home
  double home_tension = 0;
  Vec2 home_push = Vec2::Zero();  ///< force on the pin at home, N
  Vec2 push = Vec2::Zero();
};

class Bench {
 public:
  /// At home, unloaded, θ = 0.
  Bench(const MadeJoint& joint, const Hidden& hidden);

  /// θ with the pulley turned to `pulley`; a lump is met at `alpha`. NaN when nothing holds the joint.
  double to(double pulley, double alpha, const Conditions& conditions);
  /// As it stands, for what acts outside the bench.
  const Moment& now() const { return now_; }

  /// tendon(0): tendon 1.
  const BenchTendon& tendon(std::size_t side) const { return tendons_[side]; }
  double theta() const { return theta_; }

 private:
  /// A tendon at a pulley angle, before θ is known.
  struct Below {
    Circle pin;
    double length = 0;    ///< but for what all of its way rises by
    double rise = 0;      ///< of that, from the joint to where it meets the pulley; 0 with collars
    double material = 0;  ///< before the groove takes or gives
    double wound = 0;
    double normal = 0;
    std::ptrdiff_t corner = 0;
    std::ptrdiff_t over = 0;
    Cord cord;
    GrooveChain laid;
    double guess = 0;  ///< of the tension above the groove, N
  };
  /// A tendon at a trial θ.
  struct Trial {
    double torque = 0;   ///< on the joint, towards its own side
    double slipped = 0;  ///< over the pin, down
    double to_span = 0;  ///< into the span to the pulley
    std::vector<SheathPiece> sheath;
    double bristle = 0;
    double upper_tension = 0, lower_tension = 0;  ///< on both sides of the pin
    double pulley_tension = 0;
    Vec2 pull = Vec2::Zero();  ///< unit, from the link's end to the pin, in the image
    Vec2 push = Vec2::Zero();
  };

  void build_link(BenchTendon& tendon, std::size_t side, const DeclaredMechanism& declared) const;
  void thread(BenchTendon& tendon, const DeclaredMechanism& declared) const;
  Circle seen_guide(const BenchTendon& tendon, const Circle& pin) const;
  static double slant(double level, double rise);
  static double sloping_more(const BenchTendon& tendon, const LowerString& string);
  static double rise_of(const BenchTendon& tendon, const LowerString& string);
  double level_arm_at_home(BenchTendon& tendon) const;
  static double knot_of(const BenchTendon& tendon, const Circle& seen, const LowerString& at_home, double unwound);
  double ratio(double wrap, double bristle) const;
  /// Of the tension at the mouth what is left at the pin. `slipped` past each bend, from the mouth to the pin.
  static double through(std::vector<SheathPiece>& sheath, const Cord& cord, double home, double tension,
                        double& slipped);
  Vec2 hang(BenchTendon& tendon, double tension, double slack, double unwound);
  Cord cord(std::size_t side, const Conditions& conditions) const;
  void creep(BenchTendon& tendon, double seconds) const;
  Below below(std::size_t side, const Conditions& conditions, double longer, const Vec2& moved) const;
  Trial tried(std::size_t side, Below& below, double theta) const;
  double excess(std::array<Below, 2>& below, double theta, const Conditions& conditions) const;
  double dry_friction(const Conditions& conditions);
  double balanced(std::array<Below, 2>& below, const Conditions& conditions, double dry) const;
  double lump(double alpha) const;
  /// Of each tendon by how much it is longer, and how far its pin is moved, in its image. mm
  using Ways = Eigen::Matrix<double, 6, 1>;
  template <typename Answer>
  bool come_to_rest(Answer answer, Ways there);

  Hidden hidden_;
  bool collar_ = false;
  double R_ = 0;
  double EA_ = 0;
  double friction_ = 0;
  double turning_ = 0;   ///< of idlers: friction of the bearing, at its radius per the idler's; 0: pins
  double furthest_ = 0;  ///< θ at which nothing is thought to hold the joint
  double torque_declared_ = 0;
  double weight_ = 0;  ///< times its lever, N·mm
  double tilt_ = 0;
  Spring spring_;
  double step_ = 0;                                                                     ///< of θ, the last one
  Eigen::Matrix<double, 6, 6> towards_rest_ = Eigen::Matrix<double, 6, 6>::Identity();  ///< as found so far
  double theta_ = 0;
  std::array<BenchTendon, 2> tendons_;
  std::array<Actors, 2> longer_;
  Actors torque_;
  Actors dry_;
  Moment now_;
};

}  // namespace fusee::rig
