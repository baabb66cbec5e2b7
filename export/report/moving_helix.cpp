#include "export/report/moving_helix.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/report/svg.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

// Least turn between drawn rows, because a drawing requires fewer rows than a part.
constexpr double k_drawn_turn = radians(4.0);

std::string number_text(double value, int decimals) {
  return std::isfinite(value) ? trimmed_fixed(value, decimals) : "null";
}

template <typename Number>
std::string numbers_text(std::size_t count, int decimals, Number number) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + number_text(number(i), decimals);
  return text + "]";
}

/// x, y, height and turn of rows with a minimum spacing.
std::string drawn_rows(const helix::Spiral& spiral, const helical_solid::SpiralPlace& place) {
  std::string text = "[";
  double drawn_turn = -1e9;
  for (std::size_t i = 0; i < spiral.rows.size(); ++i) {
    const helix::SpiralRow& row = spiral.rows[i];
    if (row.turn - drawn_turn < k_drawn_turn && i + 1 < spiral.rows.size()) continue;
    drawn_turn = row.turn;
    text += (text.size() > 1 ? ",[" : "[") + number_text(row.x, 3) + "," + number_text(row.y, 3) + "," +
            number_text(place.height(row.z), 3) + "," + number_text(row.turn, 4) + "]";
  }
  return text + "]";
}

std::string side_json(const Product& product, std::size_t i) {
  const HelixProduct& helix = *product.helix;
  const helix::HelixSide& side = helix.synthesis.sides.at(i);
  const helical_solid::SpiralPlace& place = i == 0 ? helix.pulley.p1 : helix.pulley.p2;
  const std::vector<transmission::TransmissionPoint>& stroke = product.synthesis.stroke;
  // Rise per mm of y, towards the joint. The slope rises towards the pulley, hence the minus. It is per mm of the path
  // in plan, and a millimetre of that path has |cos(normal)| mm along y.
  const auto rise = [&](std::size_t k) {
    const transmission::TendonPoint& tendon = i == 0 ? stroke[k].t1 : stroke[k].t2;
    return -place.direction * elementary::tan(side.stroke[k].slope) / std::abs(elementary::cos(tendon.lower_normal));
  };
  return "{\"rows\":" + drawn_rows(side.spiral, place) +
         ",\"z\":" + numbers_text(stroke.size(), 4, [&](std::size_t k) { return place.height(side.stroke[k].z); }) +
         ",\"slope\":" + numbers_text(stroke.size(), 6, rise) +
         ",\"fleet\":" + numbers_text(stroke.size(), 4, [&](std::size_t k) { return degrees(side.stroke[k].fleet); }) +
         "}";
}

std::string data_json(const Product& product) {
  const std::vector<transmission::TransmissionPoint>& stroke = product.synthesis.stroke;
  return "{\"alpha\":" + numbers_text(stroke.size(), 5, [&](std::size_t k) { return degrees(stroke[k].alpha); }) +
         ",\"theta\":" + numbers_text(stroke.size(), 5, [&](std::size_t k) { return degrees(stroke[k].theta); }) +
         ",\"pin\":" + number_text(product.joint.mechanism.pulley.EF, 4) +
         ",\"top\":" + number_text(product.pulley.layout.z_top, 3) + ",\"sides\":[" + side_json(product, 0) + "," +
         side_json(product, 1) + "]}";
}

std::string shown_number(const std::string& words, const std::string& name) {
  return "<div><dt>" + words + "</dt><dd data-show=\"" + name + "\">–</dd></div>";
}

}  // namespace

std::string moving_helix(const Product& product) {
  const std::vector<transmission::TransmissionPoint>& stroke = product.synthesis.stroke;
  if (stroke.empty()) return "";
  Figure figure;
  figure.width = 900;
  figure.height = 320;
  figure.title = "The pulley from the side, and both tendons";
  figure.body = "<g class=\"helix-scene\"></g>";
  return "<div class=\"moving helix\"><div class=\"controls\" hidden=\"hidden\"><button type=\"button\" "
         "class=\"play\" aria-pressed=\"false\">Play</button><label for=\"alpha\">Pulley angle α</label><input "
         "id=\"alpha\" type=\"range\" min=\"" +
         trimmed_fixed(degrees(stroke.front().alpha), 3) + "\" max=\"" +
         trimmed_fixed(degrees(stroke.back().alpha), 3) +
         "\" step=\"any\" value=\"0\"/><output for=\"alpha\" data-show=\"alpha\">–</output></div>" +
         inline_svg(figure) + "<dl class=\"numbers\" hidden=\"hidden\">" +
         shown_number("Joint angle θ, declared", "theta") + shown_number("Heights of the take-offs", "heights") +
         shown_number("Turns on P1, on P2, spare ones included", "turns") + shown_number("Fleet angles", "fleets") +
         "</dl><script type=\"application/json\" id=\"helix\">" + data_json(product) + "</script></div>";
}

}  // namespace fusee::formats
