// Number formatting and text sanitizing.
#include "base/text.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string_view>

namespace fusee {
namespace {

TEST(Text, TrimmedFixedRemovesOnlyZeros) {
  EXPECT_EQ(trimmed_fixed(2.5, 3), "2.5");
  EXPECT_EQ(trimmed_fixed(3, 3), "3");
  EXPECT_EQ(trimmed_fixed(100, 0), "100");
  EXPECT_EQ(trimmed_fixed(0.0625, 9), "0.0625");
  EXPECT_EQ(trimmed_fixed(-1e-9, 3), "0");
}

TEST(Text, FixedRoundsAsPrintfDoes) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 100000; ++i) {
    const double size = std::pow(10.0, static_cast<double>(random() % 20) - 9.0);
    // Every fourth value lies exactly between two decimals, where a double can represent it.
    const double value = i % 4 == 0 ? static_cast<double>(random() % 4096) / 64.0
                                    : size * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
    const int decimals = static_cast<int>(random() % 13);
    char expected[128];
    std::snprintf(expected, sizeof expected, "%.*f", decimals, value);
    const bool is_zero = std::string_view(expected).find_first_of("123456789") == std::string_view::npos;
    ASSERT_EQ(fixed(value, decimals), expected + (is_zero && expected[0] == '-' ? 1 : 0));
  }
  EXPECT_EQ(fixed(1e300, 2).size(), 304u);
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "inf");
}

TEST(Text, RoundedKeepsSignificantDigits) {
  EXPECT_EQ(rounded(18.9), "18.9");
  EXPECT_EQ(rounded(0.012345), "0.01235");
  EXPECT_EQ(rounded(1200), "1200");
  EXPECT_EQ(rounded(-2.0), "-2");
}

TEST(Text, ReadsPrintedNumbersExactly) {
  for (const double value : {0.0, -0.1, 1.0 / 3, 1e-300, 1.7976931348623157e308})
    EXPECT_EQ(number_of(shortest(value)), value);
  EXPECT_EQ(number_of(rounded(-2.0 / 3)), -0.6667);
  EXPECT_EQ(number_of(fixed(1200, 3)), 1200);
}

TEST(Text, ConvertsUtf16OfBothByteOrders) {
  using namespace std::string_literals;
  EXPECT_EQ(utf8_of_utf16("\xFF\xFEs\0\xB0\0\xAC\x20"s), "s°€");
  EXPECT_EQ(utf8_of_utf16("\xFE\xFF\0s\0\xB0\x20\xAC"s), "s°€");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\x3D\xD8\x00\xDE"s), "\xF0\x9F\x98\x80");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFE\x3D\xD8s\0"s), "\uFFFDs");
  EXPECT_EQ(utf8_of_utf16("\xFF\xFEs\0x"s), "s");
  EXPECT_EQ(utf8_of_utf16("solid"), std::nullopt);
}

TEST(Text, WrapsByCharacters) {
  EXPECT_EQ(wrapped("one two", "  - ", "    "), "  - one two\n");
  EXPECT_EQ(wrapped("", "  ", "  "), "  \n");
  const std::string word(40, 'x'), umlauts = "äöüäöüäöüäöüäöüäöüäöüäöüäöüäöüäöüäöü";  // 36 characters, 72 bytes
  EXPECT_EQ(wrapped(word + " " + word, "- ", "  "), "- " + word + "\n  " + word + "\n");
  EXPECT_EQ(wrapped(umlauts + " " + umlauts, "  ", "  "), "  " + umlauts + " " + umlauts + "\n");
  EXPECT_EQ(wrapped(word + word + word + " y", "", ""), word + word + word + "\ny\n");
  EXPECT_EQ(characters("3 × 4 …"), 7u);
}

TEST(Text, CleanedRemovesControlCharacters) {
  EXPECT_EQ(cleaned("θ = 3°, größe 日本 😀 \uFFFD\n\tx"), "θ = 3°, größe 日本 😀 \uFFFD\n\tx");
  for (const char* one : {"\x1b", "\r", "\x07", "\x7f", "\u0080", "\u009b", "\u200e", "\u200f", "\u061c", "\u202a",
                          "\u202e", "\u2066", "\u2069", "\u2028", "\ufffe", "\uffff", "\ufdd0", "\xf0\x9f\xbf\xbe"})
    EXPECT_EQ(cleaned(std::string("a") + one + "b"), "a\uFFFDb") << testing::PrintToString(one);
  EXPECT_EQ(cleaned(std::string("\0", 1)), "\uFFFD");
  EXPECT_EQ(cleaned_line("a\n\tb\x1b"), "a  b\uFFFD");
}

TEST(Text, CleanedIsValidUtf8) {
  for (const std::string bytes : {"\xff", "\x9b", "\xc2", "\xe2\x82", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80",
                                  "\xf4\x90\x80\x80", "\xf8\x88\x80\x80\x80"}) {
    EXPECT_FALSE(is_utf8(bytes));
    const std::string clean = cleaned(bytes + "a");
    EXPECT_TRUE(is_utf8(clean));
    EXPECT_TRUE(clean.ends_with("\uFFFDa"));
    EXPECT_EQ(cleaned(clean), clean);
  }
  EXPECT_EQ(cleaned("\xe2\x82\x82\xe2"), "₂\uFFFD");
  EXPECT_EQ(cleaned("\xe2\x82.\xf0\x9f\x98"), "\uFFFD.\uFFFD");  // each malformed sequence once, as in JSON
}

TEST(Text, UnicodeEscapesAreJson) {
  EXPECT_EQ(unicode_escaped("a\u009b\u202e\x7f\x1b\xff é"), "a\\u009b\\u202e\\u007f\\u001b\uFFFD é");
}

}  // namespace
}  // namespace fusee
