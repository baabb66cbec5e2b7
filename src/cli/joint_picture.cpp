#include "cli/joint_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/text.h"
#include "export/report/tendon_trace.h"
#include "fusee/transmission.h"

namespace fusee::cli {
namespace {

using transmission::Side;

constexpr int k_columns = 44;
constexpr int k_lines = 26;
constexpr int k_side_margin = 3;  // columns for letters beside the joint

/// A sheet of characters, which are twice as high as wide. Points and lengths are in mm in the joint's frame.
class Sheet {
 public:
  /// Extends the part of the plane that is drawn. Call it for everything before fit().
  void include(const Vec2& centre, double radius = 0) {
    low_ = low_.cwiseMin(centre - Vec2(radius, radius));
    high_ = high_.cwiseMax(centre + Vec2(radius, radius));
  }
  /// Chooses the scale: all included points lie between the side margins, and on k_lines - 1 lines at most. A line is
  /// as high as two columns are wide.
  void fit() {
    const Vec2 size = high_ - low_;
    column_ = std::max({size.x() / (k_columns - 2 * k_side_margin), 0.5 * size.y() / (k_lines - 2), 1e-9});
    lines_.assign(static_cast<std::size_t>(std::lround(size.y() / (2 * column_))) + 1, std::string(k_columns, ' '));
    middle_ = 0.5 * (low_.x() + high_.x());
  }
  /// Puts a character at a point, unless the point is outside of the sheet.
  void put(const Vec2& at, char sign) {
    char* cell = find(at);
    if (cell != nullptr) *cell = sign;
  }
  void circle(const Vec2& centre, double radius, char sign) {
    const int steps = std::max(12, static_cast<int>(8 * radius / column_));
    for (int i = 0; i < steps; ++i) put(centre + radius * unit(k_two_pi * i / steps), sign);
  }
  /// A line of `sign`, or of strokes '|', '-', '/' or '\\' by its slope if `sign` is 0.
  void line(const Vec2& from, const Vec2& to, char sign = 0) {
    const Vec2 direction = to - from;
    const double rise = std::abs(direction.y()) / 2, run = std::abs(direction.x());  // a line is 2 columns high
    constexpr double k_flattest_diagonal = 0.4;
    char stroke = (direction.x() > 0) == (direction.y() > 0) ? '/' : '\\';
    if (rise < k_flattest_diagonal * run) stroke = '-';
    if (run < k_flattest_diagonal * rise) stroke = '|';
    const int steps = 1 + static_cast<int>(2 * (run + rise) / column_);
    for (int i = 0; i <= steps; ++i) put(from + direction * i / steps, sign == 0 ? stroke : sign);
  }
  /// Text whose first character is `offset` columns to the right of a point.
  void words(const Vec2& at, std::string_view text, int offset = 0) {
    for (std::size_t i = 0; i < text.size(); ++i) put(at + Vec2((offset + static_cast<int>(i)) * column_, 0), text[i]);
  }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  char* find(const Vec2& at) {
    const auto line = std::lround((high_.y() - at.y()) / (2 * column_));
    const auto column = k_columns / 2 + std::lround((at.x() - middle_) / column_);
    if (line < 0 || line >= static_cast<long>(lines_.size()) || column < 0 || column >= k_columns) return nullptr;
    return &lines_[static_cast<std::size_t>(line)][static_cast<std::size_t>(column)];
  }

  Vec2 low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
  double column_ = 1;  ///< width of a column, mm
  double middle_ = 0;  ///< x of the middle column, mm
  std::vector<std::string> lines_;
};

/// The pitch curve of one side; a circle for a multi-turn pulley, which has no outline.
profile::Outline outline_of(const formats::Product& product, Side side) {
  if (!product.helix) return side == Side::left ? product.synthesis.p1 : product.synthesis.p2;
  const transmission::TransmissionPoint& home = *product.synthesis.home();
  const double radius = side == Side::left ? home.t1.p : home.t2.p;
  profile::Outline circle;
  circle.side = side;
  constexpr int k_points = 180;
  for (int i = 0; i < k_points; ++i) {
    const Vec2 normal = unit(k_two_pi * i / k_points);
    circle.points.push_back({k_two_pi * i / k_points, radius * normal, normal, radius});
  }
  circle.active_last = k_points - 1;
  return circle;
}

std::string mm(double value) { return rounded(value, 3) + " mm"; }
/// A length of the mechanism file, with the digits that it has there.
std::string mm_as_typed(double value) { return rounded(value, 6) + " mm"; }

/// "12 mm below O", "24 mm above O", "level with O". `below`: distance below O, mm.
std::string height_words(double below) {
  if (below == 0) return "level with O";
  return mm(std::abs(below)) + (below > 0 ? " below O" : " above O");
}

/// Lines beside the picture. `drawn_length`: length of the link in the picture, mm.
std::vector<std::string> legend(const Mechanism& mechanism, double drawn_length) {
  const Guides& guides = mechanism.guides;
  std::vector<std::string> lines;
  const bool plain = mechanism.joint.is_plain();
  if (plain)
    lines.push_back(fmt::format("C: both tendons end here, {} above O", mm_as_typed(mechanism.joint.R)));
  else if (mechanism.joint.R > drawn_length)
    lines.push_back(fmt::format("C is {} above O: the load acts there", mm_as_typed(mechanism.joint.R)));
  else
    lines.push_back(fmt::format("C: the load acts here, {} above O", mm_as_typed(mechanism.joint.R)));
  lines.emplace_back("O: the joint's axis; + turns C to the right");
  if (!plain) {
    lines.push_back(fmt::format("drum about O, {} in radius", mm(mechanism.joint.drum_radius)));
    lines.emplace_back("A1, A2: ends of tendons 1 and 2 on the drum");
  }
  lines.push_back(fmt::format("B, D: {} of {}, {},", guides.kind == GuideKind::idler ? "idlers" : "pins",
                              mm(2 * guides.radius), height_words(guides.OE)));
  lines.push_back(fmt::format("  {} to the left, {} to the right", mm(guides.EB), mm(guides.ED)));
  lines.push_back(fmt::format("G: axis of motor and pulley, {}", height_words(guides.OE + mechanism.pulley.EF)));
  return lines;
}

}  // namespace

std::string joint_picture(const formats::Product& product) {
  const Mechanism& mechanism = product.joint.mechanism;
  const Vec2 axis = formats::pulley_axis(mechanism), origin(0, 0), c(0, mechanism.joint.R);
  Sheet sheet;
  double reach = 0;
  for (const Side side : {Side::left, Side::right}) {
    reach = std::max(reach, circumradius(profile::parallel(outline_of(product, side), 0)));
    sheet.include(formats::pin_centre(mechanism, side), mechanism.guide_pitch_radius());
    sheet.include(formats::attachment(mechanism, side, 0));
  }
  sheet.include(axis, reach);
  sheet.include(origin, mechanism.drum_pitch_radius());
  // A joint with a drum may be far smaller than its link, which is then cut off.
  const double drawn_length =
      mechanism.joint.is_plain() ? c.y() : std::min(c.y(), 2.0 * mechanism.joint.drum_radius + 0.5 * reach);
  sheet.include({0, drawn_length});
  sheet.fit();
  sheet.line(origin, {0, drawn_length}, ':');
  if (mechanism.joint.drum_radius > 0) sheet.circle(origin, mechanism.joint.drum_radius, '.');
  sheet.circle(axis, reach, 'o');
  for (const Side side : {Side::left, Side::right}) {
    if (const auto trace = formats::trace_tendon(mechanism, outline_of(product, side), 0, 0)) {
      for (std::size_t i = 1; i < trace->free_path.size(); ++i)
        sheet.line(trace->free_path[i - 1], trace->free_path[i]);
    }
  }
  for (const Side side : {Side::left, Side::right})
    sheet.words(formats::pin_centre(mechanism, side), side == Side::left ? "B" : "D");
  if (mechanism.joint.is_plain()) {
    sheet.words(c, "C");
  } else {
    const Vec2 end1 = formats::attachment(mechanism, Side::left, 0),
               end2 = formats::attachment(mechanism, Side::right, 0);
    sheet.words(end1, "A1", end1.x() < 0 ? -1 : 0);
    // Letters of ends that are close together would overlap.
    if ((end1 - end2).norm() > 0.2 * mechanism.joint.drum_radius) sheet.words(end2, "A2", end2.x() < 0 ? -1 : 0);
    if (drawn_length == c.y()) sheet.words(c, "C");
  }
  sheet.words(origin, "O");
  sheet.words(axis, "G");
  std::string picture;
  const std::vector<std::string> legend_lines = legend(mechanism, drawn_length);
  for (std::size_t i = 0; i < std::max(sheet.lines().size(), legend_lines.size()); ++i) {
    std::string line = i < sheet.lines().size() ? sheet.lines()[i] : std::string(k_columns, ' ');
    if (i < legend_lines.size()) line += "  " + legend_lines[i];
    line.erase(line.find_last_not_of(' ') + 1);
    picture += line + "\n";
  }
  return picture;
}

}  // namespace fusee::cli
