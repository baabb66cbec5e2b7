/// \file
/// Comparison of a calibration with the truth of its case, and rates over many cases.
///
/// A group is *false* if it holds neither a fault of the joint nor a kin of an unmodelled one.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/calibration.h"
#include "rig/truths.h"

namespace fusee::rig {

/// True value − centre of a 95 % interval, per half width. The interval contains the true value if it is −1 … 1.
struct Deviation {
  double in_half_widths = 0;
  bool is_within() const { return std::abs(in_half_widths) <= 1.0; }
};

/// Both reported intervals of a parameter of a true fault.
struct IntervalCheck {
  std::string name;   ///< "backlash width_deg"
  Deviation overall;  ///< from `ci95`
  Deviation if_only;  ///< from `ci95_if_only`
};

/// Counts for one joint. Faults that are hardly visible are not counted.
struct Judgement {
  std::string truth;
  calibration::CalibrationVerdict verdict = calibration::CalibrationVerdict::not_testable;
  std::size_t named = 0;             ///< named faults
  std::size_t held = 0;              ///< of `named`: in a reported group
  std::size_t held_by_names = 0;     ///< of `named`: in a group without `unmodelled`
  std::size_t beyond = 0;            ///< of `named`: not held, although larger than `detectable`
  std::size_t alone = 0;             ///< of `named`: alone in a group
  std::size_t false_groups = 0;      ///< false groups
  std::size_t false_names = 0;       ///< false groups without `unmodelled`
  std::size_t wrong_alone = 0;       ///< false groups of one member
  std::vector<std::string> outside;  ///< unmodelled faults of the joint
  bool nothing = false;              ///< a joint as declared, except perhaps for the friction of its groove
  std::vector<IntervalCheck> numbers;
  /// One line: !false {groups}evidence~lead over the unmodelled alternative[its words], <deviation of each number; that of `ci95_if_only`>, (missed
  /// faults, size per detectable size).
  std::string words;
};

/// `without`: effects that were left out of the catalogue. A fault of that name counts as unmodelled.
Judgement judge(const Case& made, const calibration::Calibration& found, const std::vector<std::string>& without = {});

/// Writes the files of a case. Returns the paths of the runs.
std::vector<std::filesystem::path> write_case(const Case& made, const std::filesystem::path& folder);
struct Answer {
  calibration::Calibration found;
  Judgement judgement;
};
/// Writes the files of a case, reads them and calibrates.
Answer calibrate_case(const Case& made, const std::filesystem::path& folder,
                      const std::vector<std::string>& without = {});

/// A counted share.
struct Rate {
  std::size_t part = 0;
  std::size_t all = 0;

  double share() const { return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all); }
};
struct Bounds {
  double low = 0;
  double high = 1;
};
/// 95 % score interval of a binomial proportion (Wilson 1927).
Bounds wilson(const Rate& rate);

/// *Modelled* joints have named faults only, or none. `_outside`: the rate over joints with an unmodelled fault.
struct Rates {
  Rate miss;               ///< named faults in no group, modelled joints
  Rate kept;               ///< named faults in a group, joints with an unmodelled fault
  std::size_t beyond = 0;  ///< of `miss`: larger than `detectable`
  Rate held_by_names;      ///< named faults in a group without `unmodelled`, all joints
  Rate alone;              ///< named faults alone in a group, all joints
  Rate false_groups;       ///< modelled joints with a false group
  Rate false_groups_outside;
  Rate false_groups_nothing;  ///< joints as declared with a false group
  Rate false_names;           ///< modelled joints with a false group without `unmodelled`
  Rate false_names_outside;
  Rate wrong_alone;          ///< joints with a false group of one member
  Rate unexplained_outside;  ///< joints with an unmodelled fault called unexplained or not_repeatable
  Rate quiet;                ///< joints as declared called no_effect
  Rate untestable;           ///< joints called not_testable; their faults count as missed
  Rate covered;              ///< parameters of true faults within their 95 % intervals
  Rate covered_if_only;      ///< parameters of true faults within `ci95_if_only`
};
Rates rates(const std::vector<Judgement>& judgements);

/// Counts of each truth, the rates with their bounds, and the coverage of each parameter. Markdown.
std::string matrix(const std::vector<Judgement>& judgements);

}  // namespace fusee::rig
