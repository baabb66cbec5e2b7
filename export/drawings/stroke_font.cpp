#include "export/drawings/stroke_font.h"

#include <algorithm>
#include <array>
#include <utility>

namespace fusee::formats {
namespace {

// A glyph on a grid 4 wide and 6 high: each pair of digits is a point (x, y), a space lifts the pen.
constexpr double k_glyph_height = 6;
constexpr double k_glyph_width = 4;
constexpr double k_advance = 6;

constexpr auto k_glyphs = std::to_array<std::pair<char, std::string_view>>({
    {'A', "0004264440 0242"},
    {'B', "00063645443303 3342413000"},
    {'C', "4536160501103041"},
    {'D', "00062644422000"},
    {'E', "46060040 0333"},
    {'F', "460600 0333"},
    {'G', "45361605011030414323"},
    {'H', "0006 4046 0343"},
    {'I', "1030 2026 1636"},
    {'J', "4641301001"},
    {'K', "0006 460340"},
    {'L', "060040"},
    {'M', "0006234640"},
    {'N', "00064046"},
    {'O', "103041453616050110"},
    {'P', "00063645443303"},
    {'Q', "103041453616050110 2240"},
    {'R', "00063645443303 2340"},
    {'S', "453616050413334241301001"},
    {'T', "0646 2026"},
    {'U', "060110304146"},
    {'V', "062046"},
    {'W', "0610233046"},
    {'X', "0046 0640"},
    {'Y', "062346 2320"},
    {'Z', "06460040"},
    {'0', "103041453616050110 0145"},
    {'1', "152620 1030"},
    {'2', "05163645440040"},
    {'3', "05163645443313 334241301001"},
    {'4', "30360242"},
    {'5', "460603334241301001"},
    {'6', "453616050110304142331302"},
    {'7', "064610"},
    {'8', "130405163645443313 1302011030414233"},
    {'9', "011030414536160504133344"},
    {'-', "1333"},
    {'+', "1333 2125"},
    {'.', "2021"},
    {',', "2110"},
    {':', "2122 2425"},
    {'/', "0046"},
    {'=', "0242 0444"},
    {'(', "36252130"},
    {')', "16252110"},
    {'<', "450341"},
    {'>', "054301"},
    {'_', "0040"},
    {';', "2110 2425"},
    {'\'', "2624"},
});

std::string_view glyph(char c) {
  const char capital = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  const auto* found =
      std::find_if(k_glyphs.begin(), k_glyphs.end(), [capital](const auto& g) { return g.first == capital; });
  return found == k_glyphs.end() ? std::string_view{} : found->second;
}

}  // namespace

std::vector<Polygon> stroke_text(std::string_view text, const Vec2& origin, double height) {
  const double unit_size = height / k_glyph_height;
  std::vector<Polygon> strokes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Vec2 corner = origin + Vec2(unit_size * k_advance * static_cast<double>(i), 0);
    const std::string_view pen = glyph(text[i]);
    bool down = false;
    for (std::size_t k = 0; k + 1 < pen.size();) {
      if (pen[k] == ' ') {
        down = false;
        ++k;
        continue;
      }
      if (!down) strokes.emplace_back();
      down = true;
      strokes.back().push_back(corner + unit_size * Vec2(pen[k] - '0', pen[k + 1] - '0'));
      k += 2;
    }
  }
  return strokes;
}

double stroke_text_width(std::string_view text, double height) {
  if (text.empty()) return 0;
  return height / k_glyph_height * (k_advance * static_cast<double>(text.size() - 1) + k_glyph_width);
}

}  // namespace fusee::formats
