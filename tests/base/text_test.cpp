// Numbers to text: what a reader gets back, and nothing that he would stumble over.
#include "fusee/base/text.h"

#include <gmock/gmock.h>

namespace fusee {
namespace {

TEST(Text, TrimmedFixedLosesZerosAndNothingElse) {
  EXPECT_EQ(trimmed_fixed(2.5, 3), "2.5");
  EXPECT_EQ(trimmed_fixed(3, 3), "3");
  EXPECT_EQ(trimmed_fixed(100, 0), "100");
  EXPECT_EQ(trimmed_fixed(0.0625, 9), "0.0625");
  EXPECT_EQ(trimmed_fixed(-1e-9, 3), "0");
}

TEST(Text, RoundedKeepsItsDigitsAndNoZerosBehindThem) {
  EXPECT_EQ(rounded(18.9), "18.9");
  EXPECT_EQ(rounded(0.012345), "0.01235");
  EXPECT_EQ(rounded(1200), "1200");
  EXPECT_EQ(rounded(-2.0), "-2");
}

TEST(Text, WrapsByCharactersAndKeepsLongWordsWhole) {
  EXPECT_EQ(wrapped("one two", "  - ", "    "), "  - one two\n");
  EXPECT_EQ(wrapped("", "  ", "  "), "  \n");
  const std::string word(40, 'x'), umlauts = "äöüäöüäöüäöüäöüäöüäöüäöüäöüäöüäöüäöü";  // 36 characters, 72 bytes
  EXPECT_EQ(wrapped(word + " " + word, "- ", "  "), "- " + word + "\n  " + word + "\n");
  EXPECT_EQ(wrapped(umlauts + " " + umlauts, "  ", "  "), "  " + umlauts + " " + umlauts + "\n");
  EXPECT_EQ(wrapped(word + word + word + " y", "", ""), word + word + word + "\ny\n");
  EXPECT_EQ(characters("3 × 4 …"), 7u);
}

}  // namespace
}  // namespace fusee
