/// \file
/// Internal: choice and placement of a body's tie-offs: the two that carry load first, then a spare one at the other
/// end of each arc if there is space. mm, not yet scaled.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "fusee/solid.h"
#include "solid/anchors.h"
#include "solid/body.h"
#include "solid/channel_entries.h"

namespace fusee::solid {

/// The two kinds of tie-off.
using TieOff = std::variant<AnchorPath, FaceHole>;

/// A tie-off at an end of a pulley's closing arc.
struct PlannedAnchor {
  transmission::Side side = transmission::Side::left;
  bool wound_end = true;  ///< the end that carries load; false: a spare tie-off at the other end
  TieOff tie_off;
  std::optional<TailSlot> tail;

  // Properties that both kinds of tie-off have.
  Vec2 start() const;
  Vec2 pocket() const;
  double pocket_radius(const BodyLayout& layout) const;
  bool cuts_into_hub(const BodyLayout& layout) const;
  double wrap() const;
  /// Plan views of all that is cut out, except the tail's slot.
  std::vector<Bar> bars(const BodyLayout& layout) const;
};

/// A tie-off, or its tail's slot alone, that did not print. It is not planned there again.
struct Rejection {
  transmission::Side side = transmission::Side::left;
  bool wound_end = true;
  double wrap = 0;    ///< past the end of the active arc, rad
  bool tail = false;  ///< only the tail's slot did not print

  bool operator==(const Rejection&) const = default;
};

/// The tie-offs that carry load.
struct WoundTieOffs {
  std::optional<TieOff> p1, p2;
  bool both() const { return p1 && p2; }
};

/// Both tie-offs of P1, or of P2.
struct TieOffPair {
  TieOff wound;
  std::optional<TieOff> spare;
};

/// The result of the search for a tie-off at a wound end.
struct AnchorRoom {
  transmission::Side side = transmission::Side::left;
  double room = 0;   ///< radius of the largest pocket found; 0: not even the channel fits
  double least = 0;  ///< least useful radius
};

/// True if a set screw whose axis points in direction `angle` (rad) keeps a wall to this tie-off: the least wall of the
/// body, at most 1 mm.
bool clears_set_screw(const BodyLayout& layout, double angle, const TieOff& tie_off);

/// Sets width and fillet of the channels.
void choose_channel(BodyLayout& layout, const Mechanism& mechanism);

/// Default place of a load-carrying tie-off on the closing arc.
enum class WrapChoice { furthest, nearest };

/// Options for planning tie-offs. A plan exists exactly if one with `nearest` exists, which takes a tenth of the time
/// to find.
struct TieOffWishes {
  WrapChoice wrap = WrapChoice::furthest;
  std::vector<Rejection> rejected = {};  ///< places that must not be planned again
  double entry_lean = k_steep_lean;
  /// True to decide only whether a plan exists. Omits whatever is no condition of a plan: work after a failed
  /// condition, marks, and slots for tails without a clamp screw.
  bool conditions_alone = false;
};

/// Keeps references to its arguments.
class TieOffPlanner {
 public:
  TieOffPlanner(const Mechanism& mechanism, const profile::SynthesisResult& synthesis, const FlangeRims& rims,
                const TieOffWishes& wishes)
      : mechanism_(mechanism),
        ground1_(synthesis.p1, mechanism.tendon.diameter),
        ground2_(synthesis.p2, mechanism.tendon.diameter),
        rims_(rims),
        wishes_(wishes) {}

  /// From now on, uses a slot to the face where a channel and its pocket do not fit.
  void allow_face_holes() { face_holes_ = true; }

  /// The tie-offs that carry load. Requires a layout with bore, hub, wall and channel.
  WoundTieOffs wound(const BodyLayout& layout) const;
  /// True if both exist and their pockets are large enough.
  bool has_room(const BodyLayout& layout, const WoundTieOffs& wound) const;
  /// Chooses one pocket size for all channels: the smaller of those that fit at the wound ends.
  void settle_pockets(BodyLayout& layout, const WoundTieOffs& wound) const;
  /// All tie-offs including the spare ones. The layout notes an omitted one.
  std::vector<PlannedAnchor> all(BodyLayout& layout, const WoundTieOffs& wound) const;
  /// The results for P1 and P2 where a channel or nothing was found. A slot to the face has no pocket to report.
  std::vector<AnchorRoom> rooms(const BodyLayout& layout, const WoundTieOffs& wound) const;

 private:
  double wanted_pocket(const BodyLayout& layout) const;
  double least_pocket(const BodyLayout& layout) const;
  AnchorSite site(const BodyLayout& layout, const AnchorGround& ground) const;
  std::optional<AnchorPath> channel(AnchorSite site, const BodyLayout& layout, bool wound_end, double wanted,
                                    const LapRange& laps) const;
  std::optional<TieOff> tie_off(const AnchorSite& site, const BodyLayout& layout, bool wound_end, double wanted,
                                const LapRange& laps) const;
  void add(std::vector<PlannedAnchor>& anchors, BodyLayout& layout, const AnchorGround& ground,
           const TieOffPair& pair) const;
  bool is_rejected(transmission::Side side, bool wound_end, double wrap) const;
  /// `first`: the load-carrying tie-off found nearest to the active arc.
  TieOffPair wrapped_furthest(const BodyLayout& layout, const AnchorGround& ground, const TieOff& first) const;
  /// `first`: the load-carrying tie-off of the same pulley.
  std::optional<TieOff> spare_beside(const BodyLayout& layout, const AnchorGround& ground, const TieOff& first) const;

  const Mechanism& mechanism_;
  AnchorGround ground1_, ground2_;
  const FlangeRims& rims_;
  const TieOffWishes& wishes_;
  bool face_holes_ = false;
};

}  // namespace fusee::solid
