/// \file
/// What calibration made of a case, held against the truth.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "fusee/calibration/calibration.h"
#include "rig/truths.h"

namespace fusee::rig {

/// A number that was reported with an interval, of a fault that is there.
struct Covered {
  std::string name;  ///< "backlash width_deg"
  bool within = false;
  double away = 0;  ///< of the truth from the interval's middle, in its half width
};

/// One joint's answer.
struct Judgement {
  std::string truth;
  CalibrationVerdict verdict = CalibrationVerdict::not_testable;
  std::size_t named = 0;          ///< faults that have a name and are well seen
  std::size_t held = 0;           ///< of these, in a reported group
  std::size_t held_by_names = 0;  ///< of these, in a group that does not say that it may be nothing with a name
  std::size_t beyond = 0;         ///< of `named`, not held though more than `detectable` says would have shown
  std::size_t alone = 0;          ///< of these, named alone
  std::size_t false_groups = 0;   ///< reported groups whose names are neither a fault nor the kin of one without a name
  std::size_t false_names = 0;    ///< of these, that do not say that it may be nothing with a name
  std::size_t wrong_alone = 0;    ///< of these, with a single member
  std::vector<std::string> outside;  ///< faults without a name that are there
  bool nothing = false;              ///< a joint as declared, but perhaps for its groove's friction
  std::vector<Covered> numbers;
  /// One line for a person: !false {groups}evidence~nats ahead of [what has no name], <numbers, by half their
  /// intervals>.
  std::string words;
};

/// `without`: effects that were left out of the catalogue; a fault of that name is one without a name then.
Judgement judge(const Case& made, const Calibration& found, const std::vector<std::string>& without = {});

/// Its files; returns the runs.
std::vector<std::filesystem::path> write_case(const Case& made, const std::filesystem::path& folder);
/// The calibration of a case.
struct Answer {
  Calibration found;
  Judgement judgement;
};
/// Writes its files, and calibrates what is read back.
Answer calibrate_case(const Case& made, const std::filesystem::path& folder,
                      const std::vector<std::string>& without = {});

/// A share that was counted.
struct Rate {
  std::size_t part = 0;
  std::size_t all = 0;

  double share() const { return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all); }
};
/// 95 % of the shares that such a count may come from (Wilson 1927).
struct Bounds {
  double low = 0;
  double high = 1;
};
Bounds wilson(const Rate& rate);

struct Rates {
  Rate miss;                 ///< faults with a name that stand in no reported group, where all faults have names
  Rate kept;                 ///< faults with a name that stand in a reported group, beside one without
  std::size_t beyond = 0;    ///< of `miss`, more than `detectable` says would have shown
  Rate held_by_names;        ///< faults with a name that stand in a group of names alone, on all joints
  Rate alone;                ///< … and of these alone
  Rate false_blame;          ///< joints with a false group, all faults named or nothing there
  Rate false_blame_outside;  ///< the same of joints with a fault without a name
  Rate false_blame_nothing;  ///< the same of joints as declared
  Rate false_names;          ///< as false_blame, of groups that do not say that it may be nothing with a name …
  Rate false_names_outside;  ///< … and as false_blame_outside
  Rate wrong_alone;          ///< joints in which something was named alone that is not there
  Rate unexplained_outside;  ///< joints with a fault without a name that were called unexplained or not_repeatable
  Rate quiet;                ///< joints as declared that were called no_effect
  Rate untestable;           ///< joints that were called not_testable: nothing of theirs can be held
  Rate covered;              ///< numbers of named faults within their 95 % intervals
};
Rates rates(const std::vector<Judgement>& judgements);

/// Rows = truths, columns = counts; the rates with their bounds and definitions, and each number's coverage, below.
std::string matrix(const std::vector<Judgement>& judgements);
/// The rates alone.
std::string rate_table(const std::vector<Judgement>& judgements);

}  // namespace fusee::rig
