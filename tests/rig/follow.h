/// \file
/// What a calibration asks for next, made on the rig.
#pragma once

#include "fusee/plan/bench_run.h"
#include "rig/truths.h"

namespace fusee::rig {

/// A number as a person would read it on the rig's joint, without error, in the unit of the fit.
double read_by_hand(const EffectParameter& number, const Case& made);

/// Adds a run to the case, or writes readings with their usual error into [prior] of its file. False for what the rig
/// cannot do: the case stays as it was.
bool perform(const NextMeasurement& next, Case& made);

}  // namespace fusee::rig
