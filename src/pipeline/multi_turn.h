/// \file
/// Internal: multi-turn pulleys, used if one turn does not suffice.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fusee/export.h"
#include "fusee/kit.h"
#include "fusee/pipeline.h"
#include "fusee/profile.h"

namespace fusee::pipeline {

/// Warnings about keys for helical grooves, if the pulleys turn less than once.
std::vector<Diagnostic> unused_turn_keys(const MechanismFile& file);

/// Note on the approximations that the planar joint model makes for multi-turn pulleys; empty for one turn.
std::optional<Diagnostic> note_on_turns(const MechanismFile& file);
/// Warnings about bends tighter than tendon.bend_ratio and about large fleet angles; empty for one turn.
std::vector<Diagnostic> warnings_of_turns(const MechanismFile& file);
/// Adds the plausibility warnings and note_on_turns() to the file's warnings.
MechanismFile with_plausibility_warnings_and_turns(MechanismFile file);

/// As design(), with spirals of several turns: for a joint for which one turn does not suffice.
bool design_multi_turn(formats::Product& product, double chord_error_mm, const RunContext& context,
                       solid::TieOffSearch search = solid::TieOffSearch::thorough);

/// Designs one turn if it suffices, else several; false if neither is feasible. If a key of the
/// file forbids several turns, the failed conditions of product.synthesis name it.
bool design_any(formats::Product& product, double chord_error_mm, const AsBuiltLimits& limits,
                const RunContext& context, solid::TieOffSearch search = solid::TieOffSearch::thorough);

/// Heights of the tendons above the pulley's lower face, on guides and drum, mm.
kit::TendonHeights tendon_heights(const formats::Product& product);

/// Winds tendons in space on the grooves of a mesh.
helical_solid::HelicalRewind rewind_multi_turn(const formats::Product& product, const solid::TriangleMesh& mesh);
/// Winds tendons on the given groove floors. Throws InputError unless there are two.
helical_solid::HelicalRewind rewind_multi_turn(const formats::Product& product,
                                               const std::vector<helical_solid::FloorLine>& floors);
/// Checks of a mesh that was read back.
std::vector<Check> check_multi_turn(const formats::Product& product, const solid::TriangleMesh& mesh);

/// An obstacle to helical grooves for pulleys of more than one turn, by a brief check; empty if none is found. A bend
/// that build() warns of counts as an obstacle here: a search would otherwise make r1 ever smaller.
std::optional<std::string> obstacle_to_multi_turn(const Mechanism& mechanism);

/// Functions with which advice on several turns is tested.
struct MultiTurnTrial {
  double chord_error_mm = 0;                   ///< chord error of the pulleys, mm
  std::function<bool(const Mechanism&)> made;  ///< true if a full build passes every check
  const RunContext& context;                   ///< a request to stop ends the search
};
/// Changes that make a refused multi-turn pulley possible.
profile::Advice multi_turn_advice(const formats::Product& product, const MultiTurnTrial& trial);

}  // namespace fusee::pipeline
