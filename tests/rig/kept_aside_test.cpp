// Of every split that is kept aside: each fault is seen, does nothing at size nought, and stands in no other list.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "rig/fault_checks.h"

namespace fusee::rig {
namespace {

struct Split {
  std::string name;
  std::size_t kinds = 0;  ///< at least
  std::size_t without_kin = 0;
  std::vector<RunPlan> plans;
};

void PrintTo(const Split& split, std::ostream* out) { *out << split.name; }

/// Both loads, fast and slow, rest and motion: whatever a fault needs to show itself.
std::vector<RunPlan> every_condition() {
  return {{0.0, radians(12.0), 1, 3.0}, {25.0, radians(90.0), 2, 0.0}, {-25.0, radians(25.0), 1, 0.0}};
}

class KeptAside : public ::testing::TestWithParam<Split> {
 protected:
  static const std::vector<Fault>& faults() {
    const std::vector<FaultList>& lists = fault_lists();
    return std::find_if(lists.begin(), lists.end(), [](const FaultList& list) { return list.split == GetParam().name; })
        ->faults;
  }
};

TEST_P(KeptAside, kinds_that_no_other_list_holds) {
  const std::vector<std::string> names = names_in(GetParam().name);
  EXPECT_GE(std::set<std::string>(names.begin(), names.end()).size(), GetParam().kinds);
  EXPECT_GE(kinds_without_kin(GetParam().name), GetParam().without_kin);
}

TEST_P(KeptAside, none_does_anything_at_size_nought) { expect_nothing_at_size_nought(faults(), GetParam().plans); }

TEST_P(KeptAside, each_moves_the_reading_more_by_its_size) { expect_more_by_size(faults(), GetParam().plans); }

TEST_P(KeptAside, a_truth_drawn_from_the_split_is_of_the_split_and_stays_out_of_the_matrix) {
  expect_drawn_from(GetParam().name);
}

/// Minutes: FUSEE_LONG_TESTS=1.
TEST_P(KeptAside, joints_on_which_each_is_well_seen_are_found) {
  if (std::getenv("FUSEE_LONG_TESTS") == nullptr) GTEST_SKIP() << "FUSEE_LONG_TESTS is not set";
  expect_joints_on_which_each_is_well_seen(GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(
    Of, KeptAside,
    ::testing::Values(Split{"unseen", 12, 8, every_condition()}, Split{"sealed", 20, 12, loads_and_rests()},
                      Split{"withheld", 16, 12, loads_and_rests()}, Split{"reserved", 20, 10, loads_and_rests()},
                      Split{"unopened", 20, 10, loads_and_rests()}, Split{"unread", 20, 10, loads_and_rests()},
                      Split{"untold", 20, 10, loads_and_rests()}, Split{"unmet", 20, 10, loads_and_rests()},
                      Split{"unheard", 20, 10, loads_and_rests()}, Split{"unforeseen", 24, 15, loads_and_rests()},
                      Split{"unimagined", 24, 15, loads_and_rests()}, Split{"undreamt", 31, 17, loads_and_rests()},
                      Split{"unsuspected", 32, 18, loads_and_rests()}),
    [](const auto& split) { return split.param.name; });

}  // namespace
}  // namespace fusee::rig
