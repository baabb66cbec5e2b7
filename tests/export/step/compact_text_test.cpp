#include "export/step/compact_text.h"

#include <gmock/gmock.h>

namespace fusee::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string k_text =
    "ISO-10303-21;\nHEADER;\nFILE_NAME('it''s; #7','',(''),(''),'a',\n  'b','');\nENDSEC;\nDATA;\n"
    "#1 = DIRECTION('',(0.,0.,1.));\n#4 = DIRECTION('',(0.,0.,\n    1.));\n"
    "#5 = VECTOR('',#1,1.);\n#9 = VECTOR('',#4,1.);\n#12 = VERTEX_POINT('#4',#9);\n#13 = VERTEX_POINT('#4',#5);\n"
    "ENDSEC;\nEND-ISO-10303-21;\n";

TEST(CompactStep, MergesEqualValues) {
  EXPECT_EQ(compact_step(k_text),
            "ISO-10303-21;\nHEADER;\nFILE_NAME('it''s; #7','',(''),(''),'a','b','');\nENDSEC;\nDATA;\n"
            "#1=DIRECTION('',(0.,0.,1.));\n#2=VECTOR('',#1,1.);\n#3=VERTEX_POINT('#4',#2);\n#4=VERTEX_POINT('#4',#2);\n"
            "ENDSEC;\nEND-ISO-10303-21;\n");
}

TEST(CompactStep, IsIdempotent) {
  const std::string once = compact_step(k_text);
  EXPECT_EQ(compact_step(once), once);
}

TEST(CompactStep, KeepsTenDigitsAndPoint) {
  const auto number = [](const std::string& text) {
    return compact_step("DATA;\n#1=LENGTH_MEASURE(" + text + ");\nENDSEC;\n");
  };
  EXPECT_THAT(number("12.345678901234"), HasSubstr("(12.3456789)"));
  EXPECT_THAT(number("-0.00000001234567"), HasSubstr("(-1.234567E-08)"));
  EXPECT_THAT(number("3.0000000000000E+00"), HasSubstr("(3.)"));
  EXPECT_THAT(number("-1.00000000000E-07"), HasSubstr("(-1.E-07)"));
  EXPECT_THAT(number("214"), HasSubstr("(214)"));
  EXPECT_THAT(number("'12.345678901234'"), HasSubstr("('12.345678901234')"));
}

}  // namespace
}  // namespace fusee::formats
