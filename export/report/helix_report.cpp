#include "export/report/helix_report.h"

#include <algorithm>
#include <cmath>

#include "export/report/calibration_words.h"
#include "export/report/tables.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

const PlotAxis k_motor_axis{"pulley angle α", "°", {}, {}, 1e-6};

template <typename Value>
std::vector<Vec2> over_alpha(const Product& product, std::size_t side, Value value) {
  std::vector<Vec2> points;
  const std::vector<helix::HelixPoint>& stroke = product.helix->synthesis.sides.at(side).stroke;
  for (std::size_t i = 0; i < stroke.size(); ++i)
    points.emplace_back(degrees(product.synthesis.stroke[i].alpha), value(stroke[i]));
  return points;
}

std::vector<Vec2> plan_points(const std::vector<helix::SpiralRow>& rows, std::size_t first, std::size_t last) {
  std::vector<Vec2> points;
  for (std::size_t i = first; i <= last; ++i) points.emplace_back(rows[i].x, rows[i].y);
  return points;
}

}  // namespace

std::string helix_heights(const Product& product) {
  const helical_solid::TendonsLaid ends = product.helix->laid(product.joint.mechanism.guides.collar);
  return (ends.collar ? "The collars hold tendon 1 at " : "Tendon 1 ends on the joint at ") + readable(ends.z1, 1) +
         " mm and tendon 2 at " + readable(ends.z2, 1) + " mm above the pulley’s lower face" +
         (ends.collar ? "." : ", and the guide pins are smooth cylinders over all heights between.");
}

std::vector<Plot> helix_plots(const Product& product) {
  const HelixProduct& helix = *product.helix;
  Plot heights{"Height of the take-offs", k_motor_axis, {"above the lower face", "mm", {}, {}, 0.1}, {}, {}, {}};
  heights.series = {{"tendon 1", Ink::p1,
                     over_alpha(product, 0, [&](const helix::HelixPoint& p) { return helix.pulley.p1.height(p.z); })},
                    {"tendon 2", Ink::p2,
                     over_alpha(product, 1, [&](const helix::HelixPoint& p) { return helix.pulley.p2.height(p.z); })}};
  Plot fleets{"Fleet angles", k_motor_axis, {"path against groove", "°", {}, {}, 0.1}, {}, {}, {}};
  fleets.series = {
      {"tendon 1", Ink::p1, over_alpha(product, 0, [](const helix::HelixPoint& p) { return degrees(p.fleet); })},
      {"tendon 2", Ink::p2, over_alpha(product, 1, [](const helix::HelixPoint& p) { return degrees(p.fleet); })}};
  return {heights, fleets};
}

Figure spiral_figure(const Product& product, transmission::Side side) {
  constexpr double k_size = 420, k_margin = 12, k_heading = 28;
  const helix::HelixSide& helix = product.helix->synthesis.sides.at(side == transmission::Side::left ? 0 : 1);
  const std::vector<helix::SpiralRow>& rows = helix.spiral.rows;
  double reach = 0;
  for (const helix::SpiralRow& row : rows) reach = std::max(reach, elementary::hypot(row.x, row.y));
  const double scale = (0.5 * k_size - k_margin) / reach;
  const auto drawn = [&](std::size_t first, std::size_t last) {
    std::vector<Vec2> points;
    for (const Vec2& point : plan_points(rows, first, last))
      points.emplace_back(0.5 * k_size + scale * point.x(), k_heading + 0.5 * k_size - scale * point.y());
    return thinned(points, 0.1);
  };
  const std::string pulley(transmission::pulley_name(side));
  Figure figure;
  figure.width = k_size;
  figure.height = k_heading + k_size;
  figure.title = pulley + " in plan, " + readable(helix.turns, 2) + " turns over the range";
  const std::string ink = side == transmission::Side::left ? "p1" : "p2 whole";
  figure.body = svg_path("thin " + ink, drawn(0, helix.spiral.first_used)) +
                svg_path("thin " + ink, drawn(helix.spiral.last_used, rows.size() - 1)) +
                svg_path("curve " + ink, drawn(helix.spiral.first_used, helix.spiral.last_used)) +
                svg_words("heading", {k_margin, 0.6 * k_heading}, figure.title);
  return figure;
}

}  // namespace fusee::formats
