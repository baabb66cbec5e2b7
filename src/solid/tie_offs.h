/// \file
/// Which tie-offs a body gets, and where: the two that carry load first, a spare one at the other end of each arc where
/// there is room. mm, not yet scaled.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "fusee/solid/layout.h"
#include "fusee/solid/pulley.h"
#include "solid/anchors.h"
#include "solid/body.h"
#include "solid/mouths.h"

namespace fusee {

/// How a tendon leaves its groove.
using TieOff = std::variant<AnchorPath, FaceHole>;

struct PlannedAnchor {
  Side side = Side::left;
  bool wound_end = true;
  TieOff way;
  std::optional<TailSlot> tail;

  /// What both ways have.
  Vec2 start() const;
  Vec2 pocket() const;
  double pocket_radius(const BodyLayout& layout) const;
  double wrap() const;
  /// All that is cut out, but for the tail's slot, seen along the axis.
  std::vector<Bar> bars(const BodyLayout& layout) const;
};

/// A tie-off, or the slot for its tail alone, that did not print where it was: it is not planned there again.
struct Rejection {
  Side side = Side::left;
  bool wound_end = true;
  double wrap = 0;
  bool tail = false;

  bool operator==(const Rejection&) const = default;
};

/// The tie-offs that carry load.
struct WoundTieOffs {
  std::optional<TieOff> p1, p2;
  bool both() const { return p1 && p2; }
};

/// Both tie-offs of a pulley.
struct TieOffPair {
  TieOff wound;
  std::optional<TieOff> spare;
};

/// What was found about the tie-off at a wound end.
struct AnchorRoom {
  Side side = Side::left;
  double room = 0;   ///< radius of the largest pocket found, 0: not even the channel fits
  double least = 0;  ///< radius below which there is no use in it
};

/// A set screw whose axis points in direction `angle` keeps a wall to this tie-off.
bool clears_set_screw(const BodyLayout& layout, double angle, const TieOff& way);

/// Width and fillet of the channels.
void choose_channel(BodyLayout& layout, const Mechanism& mechanism);

/// Where on the closing arc a tie-off that carries load is put when the file does not say.
enum class WrapChoice { furthest, nearest };

/// How tie-offs are to be planned. The nearest alone say as well whether there is any plan, in a tenth of the time.
struct TieOffWishes {
  WrapChoice wrap = WrapChoice::furthest;
  std::vector<Rejection> rejected = {};  ///< what is not to be planned again
  double mouth_lean = k_steep_lean;
  /// Whether there is any plan is all that is asked: what a failed condition makes needless, and slots for tails that
  /// no condition speaks of, are not looked for.
  bool conditions_alone = false;
};

/// Refers to what it is made from.
class TieOffPlanner {
 public:
  TieOffPlanner(const Mechanism& mechanism, const SynthesisResult& synthesis, const FlangeRims& rims,
                const TieOffWishes& wishes)
      : mechanism_(mechanism),
        ground1_(synthesis.p1, mechanism.tendon.diameter),
        ground2_(synthesis.p2, mechanism.tendon.diameter),
        rims_(rims),
        wishes_(wishes) {}

  /// From now on a slot to the face is taken where a channel and its pocket have no room.
  void allow_face_holes() { face_holes_ = true; }

  /// In a layout that has bore, hub, wall and channel.
  WoundTieOffs wound(const BodyLayout& layout) const;
  bool has_room(const BodyLayout& layout, const WoundTieOffs& wound) const;
  /// One size of pocket for all channels: the smaller of what the wound ends have room for.
  void settle_pockets(BodyLayout& layout, const WoundTieOffs& wound) const;
  /// With the spare ones; one that is left out leaves a note in the layout.
  std::vector<PlannedAnchor> all(BodyLayout& layout, const WoundTieOffs& wound) const;
  /// Of channels, and of pulleys without any tie-off.
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
  bool is_rejected(Side side, bool wound_end, double wrap) const;
  TieOffPair wrapped_furthest(const BodyLayout& layout, const AnchorGround& ground, const TieOff& first) const;
  std::optional<TieOff> spare_beside(const BodyLayout& layout, const AnchorGround& ground, const TieOff& first) const;

  const Mechanism& mechanism_;
  AnchorGround ground1_, ground2_;
  const FlangeRims& rims_;
  const TieOffWishes& wishes_;
  bool face_holes_ = false;
};

}  // namespace fusee
