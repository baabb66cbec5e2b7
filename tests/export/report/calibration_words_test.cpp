// Texts of identified parameters.
#include <gtest/gtest.h>

#include "fusee/export.h"

namespace fusee::formats {
namespace {

TEST(ParameterWords, DescribeSign) {
  EXPECT_EQ(parameter_words({"scale_percent", -1.2, -1.3, -1.1, -1.3, -1.1, "both pulleys are too small"}, ""),
            "scale = −1.2 % (95 %: −1.3 … −1.1), both pulleys are too small");
  EXPECT_EQ(parameter_words({"EA_N", 4500, 4400, 4600, 4400, 4600}, ""), "EA = 4500 N (95 %: 4400 … 4600)");
}

TEST(ParameterWords, GiveTheNarrowerIntervalFirst) {
  EXPECT_EQ(parameter_words({"scale_percent", -1.2, -3.2, 0.8, -1.3, -1.1}, ""),
            "scale = −1.2 % (95 %: −1.3 … −1.1 if it is the only cause, otherwise −3.2 … 0.8)");
}

}  // namespace
}  // namespace fusee::formats
