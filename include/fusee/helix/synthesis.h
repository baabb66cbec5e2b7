/// \file
/// Mechanism → both pitch curves wound several times, each a spiral with the height linear in its length, or why not.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "fusee/helix/spiral.h"
#include "fusee/profile/synthesis.h"
#include "fusee/transmission/transmission.h"

namespace fusee {

/// One tendon at one place of the stroke, in the third dimension.
struct HelixPoint {
  double z = 0;      ///< height of the take-off, in the spiral's frame, mm
  double slope = 0;  ///< of the free path's sloping part, rising from the joint's side to the pulley, rad
  double fleet = 0;  ///< between that and the groove where it leaves it, rad
  double wound = 0;  ///< along the groove, from where it leaves at home: more is wound where it is positive, mm
  double free = 0;   ///< length of what is not wound, from its end on the joint, mm
};

struct HelixSide {
  Spiral spiral;
  /// At which the tendon ends on the joint (with collars: stands on its guide), in the spiral's frame: where the fleet
  /// angle is smallest over the range. mm
  double attachment_z = 0;
  double turns = 0;                ///< of the working arc
  double circumference = 0;        ///< of the shortest turn, mm
  double lead = 0;                 ///< over the shortest turn, mm
  double fleet = 0;                ///< largest |fleet angle|, rad
  double fleet_at = 0;             ///< α of it, rad
  std::vector<HelixPoint> stroke;  ///< beside SynthesisResult::stroke
};

struct HelixSynthesis {
  SynthesisStatus status = SynthesisStatus::infeasible;
  std::array<HelixSide, 2> sides;         ///< P1, P2
  std::vector<TransmissionPoint> stroke;  ///< evenly spaced in α over the range, home included
  std::vector<Condition> conditions;
  std::vector<std::string> warnings;
  /// By how much the tendons' lengths in space vary over the range by the formulas that the curves are drawn from. mm
  double closure = 0;

  bool made() const { return status == SynthesisStatus::made; }
};

/// What a turn and the next need along the axis at least, the later one's radius being larger by `step` (of either
/// sign). mm
using LeastLead = std::function<double(double step)>;

/// What a mechanism's helical grooves are like across: the solid's to say.
struct HelixGroove {
  double lip = 0;          ///< over the floor, mm
  double room_at_lip = 0;  ///< how far aside a tendon lies as it touches the nearer wall on the lip's height, mm
  LeastLead least_lead;
};
using GrooveOf = std::function<HelixGroove(const Mechanism&)>;

/// No more turns are made than this, without the spare ones.
constexpr double k_most_turns = 12;
/// Fleet angles that are noted, and warned of. rad
constexpr double k_noted_fleet = radians(1.5);
constexpr double k_warned_fleet = radians(2.0);

/// How closely curves are looked at: as they will be made, or, some ten times faster, so far that the conditions are
/// those of what will be made to within a thousandth; whether lengths settle is then not asked.
enum class HelixLook { whole, brief };

/// Looks for no advice.
HelixSynthesis synthesise_helix(const Mechanism& mechanism, const HelixGroove& groove,
                                const SynthesisOptions& options = {}, HelixLook closely = HelixLook::whole);

}  // namespace fusee
