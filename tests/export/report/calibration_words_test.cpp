// Numbers that were found, in words.
#include <gtest/gtest.h>

#include "fusee/export/calibration.h"

namespace fusee {
namespace {

TEST(ParameterWords, SayWhatTheSignMeans) {
  EXPECT_EQ(parameter_words({"scale_percent", -1.2, -1.3, -1.1, "both pulleys too small"}, ""),
            "scale = −1.2 % (95 %: −1.3 … −1.1), both pulleys too small");
  EXPECT_EQ(parameter_words({"EA_N", 4500, 4400, 4600, ""}, ""), "EA = 4500 N (95 %: 4400 … 4600)");
}

}  // namespace
}  // namespace fusee
