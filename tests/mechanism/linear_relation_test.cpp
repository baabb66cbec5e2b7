#include "mechanism/linear_relation.h"

#include <gmock/gmock.h>

#include "fusee/mechanism_file.h"
#include "mechanism/mechanism_text.h"

namespace fusee {
namespace {

using testing::HasSubstr;

/// left − right of a relation in the valid file: R 100, EB 50, ED 50, OE −40, EF 80, r1 16.
double difference(const std::string& text) {
  const ParsedRelation parsed = parse_relation(text);
  EXPECT_FALSE(parsed.fault) << text << ": " << parsed.fault->message;
  const DeclaredMechanism mechanism = parse_mechanism(k_good_file, "f.toml");
  return parsed.relation.left.value(mechanism) - parsed.relation.right.value(mechanism);
}

TEST(LinearRelation, EvaluatesExpressions) {
  EXPECT_EQ(difference("guides.EB_mm <= 0.5 * joint.length_mm"), 0.0);
  EXPECT_EQ(difference("guides.EB_mm - 2*(joint.length_mm - 10) = -guides.OE_mm / 4 + 1e1"), 50 - 180 - (10 + 10));
  EXPECT_EQ(difference("joint.length_mm*2/4 >= 3"), 3 - 50);  // sides exchanged
  EXPECT_NEAR(difference("-(-(guides.EB_mm)) = joint.range_deg[1]"), 50 - 30, 1e-12);
  EXPECT_EQ(difference("joint.length_mm + guides.OE_mm - joint.length_mm <= 0"), -40.0);
}

TEST(LinearRelation, AddsTermsOfOneKey) {
  const LinearRelation relation =
      parse_relation("2*guides.EB_mm + guides.EB_mm - 3*guides.EB_mm + guides.ED_mm = 0").relation;
  ASSERT_EQ(relation.left.terms.size(), 1u);
  EXPECT_EQ(relation.left.terms[0].key, "guides.ED_mm");
}

struct FaultyText {
  const char* text;
  std::size_t at;
  const char* message;
};

TEST(LinearRelation, ReportsPlaceOfFaults) {
  for (const FaultyText& faulty :
       {FaultyText{"", 0, "ends where a number or a key"}, FaultyText{"guides.EB_mm", 12, "ends before its ="},
        FaultyText{"guides.EB_mm < 3", 13, "expected =, <= or >="}, FaultyText{"guides.EB_mm == 3", 13, "expected ="},
        FaultyText{"guides.EB_mm <= 0.5 * joint.lenght_mm", 22, "is not a key"},
        FaultyText{"guides.EB_mm * guides.ED_mm <= 3", 13, "multiplies keys"},
        FaultyText{"1 / guides.EB_mm <= 3", 2, "divides"}, FaultyText{"guides.EB_mm / 0 <= 3", 13, "divides"},
        FaultyText{"(guides.EB_mm <= 3", 0, "not closed"}, FaultyText{"guides.EB_mm <= 3)", 17, "unexpected"},
        FaultyText{"3 <= 4", 0, "names no key"}, FaultyText{"guides.EB_mm <= ", 16, "ends where"},
        FaultyText{"pulley.law = 3", 0, "holds no single number"},
        FaultyText{"guides.EB_mm <= 1e999", 16, "not a number"},
        FaultyText{"guides.EB_mm <= #", 16, "expected a number or a key"}}) {
    const ParsedRelation parsed = parse_relation(faulty.text);
    ASSERT_TRUE(parsed.fault) << faulty.text;
    EXPECT_EQ(parsed.fault->at, faulty.at) << faulty.text;
    EXPECT_THAT(parsed.fault->message, HasSubstr(faulty.message)) << faulty.text;
    EXPECT_FALSE(parsed.fault->hint.empty());
  }
}

TEST(LinearRelation, RejectsDeepNesting) {
  EXPECT_TRUE(parse_relation(std::string(100000, '(')).fault);
  EXPECT_TRUE(parse_relation(std::string(100000, '-') + "guides.EB_mm = 0").fault);
}

}  // namespace
}  // namespace fusee
