/// \file
/// Internal: a pulley whose tendons are wound several times, where one turn does not suffice.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/export/product.h"
#include "fusee/kit/kit.h"
#include "fusee/pipeline.h"
#include "fusee/profile/advice.h"

namespace fusee {

/// Of pulleys that turn less than once: warnings of what the file says of helical grooves.
std::vector<Diagnostic> unused_turn_keys(const MechanismFile& file);

/// What a joint of level tendons leaves out of one whose tendons are wound several times; null where they are not.
std::optional<Diagnostic> note_on_turns(const MechanismFile& file);
/// Where its pulleys bend a tendon tighter than tendon.bend_ratio wants, and where a tendon leaves its groove at too
/// large an angle; nothing where they turn less than once.
std::vector<Diagnostic> warnings_of_turns(const MechanismFile& file);
/// with_plausibility_warnings(), and that note.
MechanismFile with_plausibility_warnings_and_turns(MechanismFile file);

/// Spirals and body of product.joint in place of what one turn could not be; as design() otherwise.
bool design_several_turns(Product& product, double tolerance,
                          const std::function<void(std::string_view step)>& before_step,
                          TieOffSearch search = TieOffSearch::thorough);

/// One turn where it suffices, else several: false when neither can be made. Where several are not for this file, what
/// keeps it to one is said.
bool design_any(Product& product, double tolerance, const AsBuiltLimits& limits,
                const std::function<void(std::string_view step)>& before_step,
                TieOffSearch search = TieOffSearch::thorough);

/// Where its tendons lie above the pulley's lower face, on guides and drum.
TendonHeights tendon_heights(const Product& product);

/// Tendons wound in space on the grooves of a mesh of it.
HelicalRewind rewind_several_turns(const Product& product, const TriangleMesh& mesh);
/// On floors that were found elsewhere. InputError: other than two.
HelicalRewind rewind_several_turns(const Product& product, const std::vector<FloorLine>& floors);
/// Of a mesh that was read back.
std::vector<Check> check_several_turns(const Product& product, const TriangleMesh& mesh);

/// What keeps a joint whose pulleys turn further than once from helical grooves, looked at as briefly as trials are;
/// null where nothing is seen to. A search would make r1 ever smaller: to it a bend that build warns of is an obstacle.
std::optional<std::string> obstacle_to_several_turns(const Mechanism& mechanism);

/// How advice on several turns is tried.
struct TurnsTrial {
  double tolerance = 0;                        ///< that pulleys are made to, mm
  std::function<bool(const Mechanism&)> made;  ///< the whole making
  std::function<void()> between;               ///< called between looks; may be empty
};
/// What would make a refused one possible.
Advice advice_for_several_turns(const Product& product, const TurnsTrial& trial);

}  // namespace fusee
