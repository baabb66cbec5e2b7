#include "kit/parts.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "kit/hardware.h"
#include "kit/motor_mount.h"
#include "mechanism/catalogue.h"

namespace fusee::kit {
namespace {

// Depth of engraved lines, mm.
constexpr double k_engraved = 0.6;

SlabLoop edge(DiscHull hull) { return {std::move(hull), false, 0, 0}; }
SlabLoop hole(DiscHull hull) { return {std::move(hull), true, 0, 0}; }
SlabLoop round_hole(const Vec2& place, double diameter) { return hole(disc(place, 0.5 * diameter)); }

DiscHull hull_of(std::vector<Disc> discs, int corners = 96) { return {std::move(discs), corners}; }

SlabBody tube(double radius, double bore, double height) {
  return {{{0, height, {edge(disc({0, 0}, radius)), round_hole({0, 0}, bore)}}}};
}

/// The direction of the link at a joint angle, and the direction to its right.
struct LinkFrame {
  Vec2 along, across;
};
LinkFrame link_frame(double theta) {
  const Vec2 along(elementary::sin(theta), elementary::cos(theta));
  return {along, {along.y(), -along.x()}};
}

/// Half the width of the link at the tensioner. Beside the slide are 0.25 mm of clearance, a rail of 2.2 mm and a
/// margin of 0.5 mm.
double half_width(const KitSizes& sizes) { return 0.5 * sizes.slide_width + 2.95; }

/// A part that does not move with the link, in its print orientation.
KitPlace fixed_at(const Vec2& shift, double z) { return {shift, z, false, false}; }
/// A part on the link.
KitPlace on_link_at(const Vec2& shift, double z) { return {shift, z, false, true}; }
/// A part on the link that is printed upside down.
KitPlace turned_over_on_link_at(const Vec2& shift, double z) { return {shift, z, true, true}; }

DiscHull link_hull(const KitSizes& sizes, double R) {
  const double end = half_width(sizes) - 1;
  std::vector<Disc> discs{{{0, 0}, sizes.hub}, {{0, -sizes.pointer + 0.8}, 0.8}};
  for (const double x : {-1.0, 1.0}) {
    discs.push_back({{x * sizes.cap_screws, 0}, 0.5 * sizes.cap_screw->clearance + k_wall});
    discs.push_back({{x * sizes.post_screws, R}, 0.5 * sizes.small->clearance + k_wall});
    discs.push_back({{x * end, sizes.link_end - 1}, 1});
  }
  return hull_of(discs, 144);
}

/// Outline of the scale, with its feet. The lines are on the far side of the axis from C, under the link's pointer.
DiscHull scale_hull(const KitPlan& plan, const Joint& joint) {
  const KitSizes& sizes = plan.sizes;
  std::vector<Disc> discs{{{0, 0}, sizes.axle_tube + 3}};
  for (const Vec2& foot : plan.feet) discs.push_back({foot, 0.5 * sizes.foot->clearance + 3});
  // Angle beyond the range, rad, with space for half of a number: 7 mm at the radius of the numbers.
  const double more = std::max(radians(8), 7 / (sizes.pointer + 7));
  const double from = joint.theta_min - more, to = joint.theta_max + more;
  const int steps = static_cast<int>(std::ceil(degrees(to - from) / 5));
  for (int i = 0; i <= steps; ++i)
    discs.push_back({-(sizes.pointer + k_scale_reach - 1) * link_frame(from + (to - from) * i / steps).along, 1});
  return hull_of(discs, 180);
}

// ---- parts ----------------------------------------------------------------------------------------------------------

class PartMaker {
 public:
  PartMaker(KitPlan& plan, const Mechanism& mechanism, const solid::BodyLayout& layout)
      : plan_(plan),
        sizes_(plan.sizes),
        mechanism_(mechanism),
        layout_(layout),
        pulley_(0, -mechanism.guides.OE - mechanism.pulley.EF) {}

  void make() {
    add_base();
    add_pins();
    add_axle();
    add_link();
    add_sensor();
    add_printed("fit_coupon", "the fit coupon: print it first", coupon_body(mechanism_), {});
    set_tendon_lengths();
  }

 private:
  void add_printed(std::string name, std::string words, SlabBody body, std::vector<KitPlace> places, int count = 1) {
    plan_.parts.push_back({std::move(name), std::move(words), std::move(body), std::move(places), count, false});
  }
  // A part that may also be cut from sheets.
  void add_plate(std::string name, std::string words, SlabBody body, std::vector<KitPlace> places) {
    plan_.parts.push_back({std::move(name), std::move(words), std::move(body), std::move(places), 1, true});
  }
  void buy(int count, std::string what, std::string use) {
    plan_.items.push_back({count, std::move(what), std::move(use)});
  }

  // Adds base plate, legs and motor.
  void add_base() {
    Slab plate{0, sizes_.base, {}};
    std::vector<Disc> corners;
    for (const Vec2& leg : plan_.legs) {
      corners.push_back({leg, k_leg_radius + 1});
      plate.loops.push_back(round_hole(leg, leg_screw().clearance));
    }
    plate.loops.insert(plate.loops.begin(), edge(hull_of(corners)));
    plate.loops.push_back(round_hole({0, 0}, sizes_.axle->clearance));
    for (const Vec2& foot : plan_.feet) plate.loops.push_back(round_hole(foot, sizes_.foot->clearance));
    for (const KitPin& pin : plan_.pins)
      plate.loops.push_back(round_hole(pin.place, pin.screw ? pin.screw->clearance : 2 * pin.radius));
    for (SlabLoop& loop : holes_of_motor()) plate.loops.push_back(std::move(loop));
    add_plate("base_plate", "base plate: joint axis, pins, motor", {{plate}}, {fixed_at({0, 0}, -sizes_.base)});
    std::vector<KitPlace> legs;
    for (const Vec2& leg : plan_.legs) legs.push_back(fixed_at(leg, -sizes_.base - sizes_.leg));
    add_printed("leg", "leg under the base plate", tube(k_leg_radius, leg_screw().tapping, sizes_.leg), legs, 4);
    buy(4, screw_words(leg_screw(), sizes_.base + 10) + " with low head", "legs, from above");
    if (sizes_.motor) buy_motor(plan_, sizes_.motor_name, *sizes_.motor, sizes_.base);
  }

  const Thread& leg_screw() const { return thread_within(3.2, mechanism_.units); }

  std::vector<SlabLoop> holes_of_motor() const {
    if (sizes_.motor) return motor_holes(*sizes_.motor, pulley_, sizes_.motor_front);
    const bool horn = mechanism_.body.bore == Bore::horn;
    const double opening = horn ? horn_of(mechanism_).bolt_circle + 10 : shaft_of(mechanism_, layout_) + 1;
    return {round_hole(pulley_, opening)};
  }

  // Adds the pins with their spacers, sleeves and collars.
  void add_pins() {
    for (const KitPin& pin : plan_.pins) {
      const std::string letter = pin.side == transmission::Side::left ? "b" : "d",
                        name = pin.side == transmission::Side::left ? "B" : "D";
      const double bore = pin.screw ? pin.screw->clearance : 2 * pin.radius + 0.2;
      const auto collar = [&](const std::string& which, double radius, double low, double high,
                              const std::string& words) {
        add_printed("pin_" + letter + "_" + which, words, tube(radius, bore, high - low), {fixed_at(pin.place, low)});
      };
      collar("spacer", pin.collar, 0, pin.gap_low, "spacer below the tendon on pin " + name);
      if (pin.screw) {
        collar("sleeve", pin.radius, pin.gap_low, pin.gap_high, "sleeve on which the tendon runs, pin " + name);
        buy(1, screw_words(*pin.screw, sizes_.base + pin.top + 1) + " with nut", "pin " + name + ", from below");
      } else {
        buy(1,
            "steel rod ⌀ " + rounded(2 * pin.radius, 4) + " mm × " + rounded(std::ceil(sizes_.base + pin.top), 4) +
                " mm",
            "pin " + name + ", pressed into the base plate; its spacer glued to the plate");
      }
      collar("collar", pin.collar, pin.gap_high, pin.gap_high + k_collar_height,
             "collar above the tendon on pin " + name);
    }
  }

  // Adds the joint's axle with its bearings, the scale and the feet.
  void add_axle() {
    add_printed("axle_spacer", "spacer round the joint's axle, up to the scale",
                tube(sizes_.axle_tube, sizes_.axle->clearance, sizes_.scale_low), {fixed_at({0, 0}, 0)});
    std::vector<KitPlace> feet;
    for (const Vec2& foot : plan_.feet) feet.push_back(fixed_at(foot, 0));
    add_printed("foot_spacer", "spacer from base plate to scale",
                tube(foot_radius(), sizes_.foot->clearance, sizes_.scale_low), feet, 2);
    add_plate("scale_plate", "scale of the joint's angle, on axle and feet", scale_body(),
              {fixed_at({0, 0}, sizes_.scale_low)});
    const double ring = sizes_.link_low - sizes_.scale_low - sizes_.scale_plate + sizes_.ledge;
    add_printed("bearing_ring", "ring under the inner ring of the lower bearing",
                tube(0.5 * sizes_.bearing->spacer, sizes_.axle->clearance, ring),
                {fixed_at({0, 0}, sizes_.scale_low + sizes_.scale_plate)});
    buy(2, "ball bearing " + sizes_.bearing->name + " (" + sizes_.bearing->description + ")", "joint, in the link");
    const double stack = sizes_.base + sizes_.link_low + sizes_.link + sizes_.axle->nut_height + 1;
    buy(1, screw_words(*sizes_.axle, stack) + " with nut", "the joint's axle, from below");
    const double rod = sizes_.base + sizes_.bracket_low + sizes_.bracket + 2 * sizes_.foot->nut_height + 4;
    buy(2,
        "threaded rod " + std::string(sizes_.foot->name) + " × " + rounded(std::ceil(rod), 4) + " mm with 2 nuts each",
        "feet of scale and bracket");
  }

  double foot_radius() const { return 0.5 * sizes_.foot->clearance + k_wall; }

  SlabBody scale_body() const {
    const SlabLoop rim = edge(scale_hull(plan_, mechanism_.joint));
    std::vector<SlabLoop> through{round_hole({0, 0}, sizes_.axle->clearance)};
    for (const Vec2& foot : plan_.feet) through.push_back(round_hole(foot, sizes_.foot->clearance));
    Slab lower{0, sizes_.scale_plate - k_engraved, {rim}}, upper{lower.high, sizes_.scale_plate, {rim}};
    lower.loops.insert(lower.loops.end(), through.begin(), through.end());
    upper.loops.insert(upper.loops.end(), through.begin(), through.end());
    for (DiscHull& line : graduation()) upper.loops.push_back(hole(std::move(line)));
    return {{lower, upper}};
  }

  /// A line every `graduation`, a longer one every 10°, and numbers as dense as space allows.
  std::vector<DiscHull> graduation() const {
    std::vector<DiscHull> lines;
    const double step = sizes_.graduation, tip = sizes_.pointer;
    int numbered = 10;
    while (radians(numbered) * (tip + 7) < 11) numbered += 10;  // at least 11 mm between numbers
    const int first = static_cast<int>(std::ceil(mechanism_.joint.theta_min / step - 1e-6)) - 1;
    const int last = static_cast<int>(std::floor(mechanism_.joint.theta_max / step + 1e-6)) + 1;
    for (int i = first; i <= last; ++i) {
      const int angle = static_cast<int>(std::lround(degrees(i * step)));
      const Vec2 out = -link_frame(i * step).along;
      const bool is_long = angle % 10 == 0;
      lines.push_back(slot((tip + 1) * out, (tip + (is_long ? 4.2 : 2.8)) * out, 0.3));
      if (angle % numbered != 0) continue;
      for (DiscHull& stroke : number_strokes(angle, (tip + 7) * out, -out)) lines.push_back(std::move(stroke));
    }
    return lines;
  }

  // Adds the link, with the post at C and the tensioner's slide.
  void add_link() {
    const double R = mechanism_.joint.R, top = sizes_.link;
    const Thread& small = *sizes_.small;
    const SlabLoop rim = edge(link_hull(sizes_, R));
    std::vector<SlabLoop> through{round_hole({0, R}, 2 * sizes_.post + 0.2)};
    for (const double x : {-1.0, 1.0}) {
      through.push_back(round_hole({x * sizes_.cap_screws, 0}, sizes_.cap_screw->tapping));
      through.push_back(round_hole({x * sizes_.post_screws, R}, small.tapping));
    }
    Slab ledge{0, sizes_.ledge, {rim, round_hole({0, 0}, ledge_hole())}};
    Slab seat{sizes_.ledge, top, {rim, round_hole({0, 0}, sizes_.bearing->outer)}};
    for (Slab* slab : {&ledge, &seat}) slab->loops.insert(slab->loops.end(), through.begin(), through.end());
    const double inner = 0.5 * sizes_.slide_width + 0.25, outer = half_width(sizes_) - 0.5, end = sizes_.link_end;
    const double wall_inner = 0.5 * small.clearance;
    Slab rails{top, top + 4, {}}, walls{top + 4, top + tensioner_height(small), {}};
    for (const double x : {-1.0, 1.0}) {
      const auto upright = [x](double from, double to, double low, double high) {
        return edge(box({x > 0 ? from : -to, low}, {x > 0 ? to : -from, high}, 0.4));
      };
      rails.loops.push_back(upright(inner, outer, slide_start(), end - 6));
      rails.loops.push_back(upright(wall_inner, outer, end - 5, end - 1));
      walls.loops.push_back(upright(wall_inner, outer, end - 5, end - 1));
    }
    add_plate("link", "link of length R, on both bearings, with the tensioner's guide", {{ledge, seat, rails, walls}},
              {on_link_at({0, 0}, sizes_.link_low)});
    add_post();
    add_slide();
  }

  double ledge_hole() const {
    return sizes_.bearing->outer - std::min(2.0, 0.5 * (sizes_.bearing->outer - sizes_.bearing->spacer));
  }
  /// y of the slide's end towards C, at home.
  double slide_start() const { return mechanism_.joint.R + sizes_.post + k_post_to_slide; }

  /// The post hangs down from its flange and is printed standing on it.
  void add_post() {
    const Thread& small = *sizes_.small;
    const double top = sizes_.link_low + sizes_.link + sizes_.flange;
    const double cone = sizes_.post - sizes_.waist, chamfer_height = 0.4;
    // Heights in print orientation, upside down, from the top of the flange.
    const double waist_begin = top - sizes_.z_tendon2 - 0.5 * sizes_.tendon_gap,
                 waist_end = waist_begin + sizes_.tendon_gap;
    const double end = top - sizes_.post_low;
    const double cone_end = waist_end + cone * steepness();
    const SlabLoop bore = round_hole({0, 0}, 2 * sizes_.bore), stem = edge(disc({0, 0}, sizes_.post));
    std::vector<Disc> plate{{{0, 0}, sizes_.post + 1}};
    Slab flange{0, sizes_.flange, {bore}};
    for (const double x : {-1.0, 1.0}) {
      plate.push_back({{x * sizes_.post_screws, 0}, small.head_radius + 0.6});
      flange.loops.push_back(round_hole({x * sizes_.post_screws, 0}, small.clearance));
    }
    flange.loops.push_back(edge(hull_of(plate, 72)));
    SlabLoop narrow = stem, widening = stem, widened = bore;
    narrow.grow_low = narrow.grow_high = widening.grow_low = -cone;
    widened.grow_high = chamfer_height;
    const double chamfer = end - chamfer_height;
    add_printed("post", "post at C: tendon 2 is tied round it, tendon 1 goes up through it",
                {{flange,
                  {sizes_.flange, waist_begin, {stem, bore}},
                  {waist_begin, waist_end, {narrow, bore}},
                  {waist_end, cone_end, {widening, bore}},
                  {cone_end, chamfer, {stem, bore}},
                  {chamfer, end, {stem, widened}}}},
                {turned_over_on_link_at({0, mechanism_.joint.R}, top)});
    buy(2, screw_words(small, sizes_.flange + std::min(sizes_.link, 10.0)), "post, into the link");
  }

  double steepness() const { return post_steepness(mechanism_); }

  void add_slide() {
    const Thread& small = *sizes_.small;
    const SlideLengths lengths = slide_lengths(small);
    const double half = 0.5 * sizes_.slide_width, inner = 0.5 * small.clearance, floor = 2;
    const double top = tensioner_axis(small) + 0.5 * small.nut;
    Slab lower{
        0,
        floor,
        {edge(box({-half, 0}, {half, lengths.whole()}, 0.8)), round_hole({0, 0.5 * lengths.clamp}, small.tapping)}};
    Slab upper{floor, top, {}};
    const double back = lengths.clamp, nut = back + lengths.back, front = nut + lengths.nut;
    for (const double x : {-1.0, 1.0}) {
      for (const auto& [low, high] : {std::pair{back, nut}, {front, lengths.whole() - 0.15}})
        upper.loops.push_back(
            edge(box({x > 0 ? inner : -half + 0.15, low}, {x > 0 ? half - 0.15 : -inner, high}, 0.3)));
    }
    add_printed("tensioner_slide", "tensioner: the slide that tendon 1 is clamped to", {{lower, upper}},
                {on_link_at({0, slide_start()}, sizes_.link_low + sizes_.link)});
    buy(1, screw_words(small, sizes_.travel + lengths.front + lengths.nut + lengths.back + 6) + " with nut",
        "tensioner: through the wall at the link's end, the nut in the slide");
    buy(1, screw_words(small, 6) + " with washer", "clamps tendon 1 on the slide");
  }

  // Adds the magnet's cap and the board with its bracket.
  void add_sensor() {
    const fusee::BoardType& board = *sizes_.board;
    const Thread& screw = *sizes_.cap_screw;
    std::vector<Disc> shape{{{0, 0}, sizes_.cap}};
    std::vector<SlabLoop> screws;
    for (const double x : {-1.0, 1.0}) {
      shape.push_back({{x * sizes_.cap_screws, 0}, 0.5 * screw.clearance + k_wall});
      screws.push_back(round_hole({x * sizes_.cap_screws, 0}, screw.clearance));
    }
    const SlabLoop rim = edge(hull_of(shape, 72));
    Slab web{0, sizes_.web, {rim, round_hole({0, 0}, board.magnet + 0.1)}};
    Slab room{sizes_.web, sizes_.cap_height, {rim, round_hole({0, 0}, 2 * sizes_.recess)}};
    for (Slab* slab : {&web, &room}) slab->loops.insert(slab->loops.end(), screws.begin(), screws.end());
    const double link_top = sizes_.link_low + sizes_.link;
    add_printed("magnet_cap", "cap on the link: holds the bearings, and the magnet over the axis", {{web, room}},
                {turned_over_on_link_at({0, 0}, link_top + sizes_.cap_height)});
    buy(2, screw_words(screw, sizes_.cap_height + 6), "magnet cap, into the link");
    buy(1, "magnet ⌀ " + rounded(board.magnet) + " × " + rounded(board.magnet_height) + ", magnetised across",
        "in the magnet cap, flush");
    std::vector<KitPlace> feet;
    for (const Vec2& foot : plan_.feet) feet.push_back(fixed_at(foot, sizes_.scale_low + sizes_.scale_plate));
    add_printed("foot_tube", "spacer from scale to bracket",
                tube(foot_radius(), sizes_.foot->clearance, sizes_.bracket_low - sizes_.scale_low - sizes_.scale_plate),
                feet, 2);
    add_bracket();
  }

  void add_bracket() {
    const fusee::BoardType& board = *sizes_.board;
    std::vector<Disc> shape;
    std::vector<KitPlace> spacers;
    Slab plate{0, sizes_.bracket, {}};
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const Vec2 place(x * board.pitch.x(), y * board.pitch.y());
        shape.push_back({place, 0.5 * board.hole + 2});
        plate.loops.push_back(round_hole(place, board.hole));
        spacers.push_back(fixed_at(place, sizes_.bracket_low - k_board_spacer));
      }
    }
    for (const Vec2& foot : plan_.feet) {
      shape.push_back({foot, foot_radius() + 1});
      plate.loops.push_back(round_hole(foot, sizes_.foot->clearance));
    }
    plate.loops.push_back(edge(hull_of(shape)));
    add_printed("board_spacer", "spacer between bracket and board",
                tube(0.5 * board.hole + k_wall, board.hole, k_board_spacer), spacers, 4);
    add_plate("bracket", "bracket: the board hangs under it, chip down", {{plate}},
              {fixed_at({0, 0}, sizes_.bracket_low)});
    buy(1, board.name + ": " + board.description, "reads the joint's angle; assumed: " + board.source);
    buy(4,
        screw_words(thread_within(board.hole, mechanism_.units),
                    sizes_.bracket + k_board_spacer + board.thickness + 4) +
            " with nuts",
        "board, under the bracket");
  }

  void set_tendon_lengths() {
    const Thread& small = *sizes_.small;
    const double top = sizes_.link_low + sizes_.link + sizes_.flange;
    // Tendon 1 is wound three times round the clamping screw, tendon 2 once round the post's waist.
    plan_.tendons[0] = {transmission::Side::left,
                        top - sizes_.post_low + slide_start() - mechanism_.joint.R + 0.5 * slide_lengths(small).clamp,
                        3 * k_pi * small.diameter};
    plan_.tendons[1] = {transmission::Side::right, 0, k_two_pi * sizes_.waist};
  }

  KitPlan& plan_;
  const KitSizes& sizes_;
  const Mechanism& mechanism_;
  const solid::BodyLayout& layout_;
  Vec2 pulley_;
};

}  // namespace

SlideLengths slide_lengths(const Thread& thread) {
  return {2 * thread.head_radius + 1.5, 2.5, thread.nut_height + 0.5, 3.0};
}

// 8° steeper than the printer's limit. At the limit, slicers that round add supports, as PrusaSlicer does at 45°.
double post_steepness(const Mechanism& mechanism) {
  return elementary::tan(std::clamp(mechanism.print.overhang + radians(8), radians(53), radians(80)));
}

double tensioner_axis(const Thread& thread) { return 2.3 + nut_corner_radius(thread); }
double tensioner_height(const Thread& thread) { return tensioner_axis(thread) + thread.head_radius; }

std::vector<DiscHull> number_strokes(int number, const Vec2& middle, const Vec2& up) {
  // Seven strokes a digit, from the highest bit on: top, upper left, upper right, middle, lower left, lower right,
  // bottom.
  constexpr std::array<unsigned, 10> k_digits{0b1110111, 0b0010010, 0b1011101, 0b1011011, 0b0111010,
                                              0b1101011, 0b1101111, 0b1010010, 0b1111111, 0b1111011};
  // mm. Strokes end at k_short from the corners of the digit and from the middle stroke, so that they do not touch.
  constexpr double k_half_width = 0.9, k_half_height = 1.8, k_short = 0.65, k_digit_pitch = 3.0, k_radius = 0.3;
  const double w = k_half_width - k_short, x = k_half_width, y = k_half_height;
  const std::array<std::pair<Vec2, Vec2>, 7> strokes{{{{-w, y}, {w, y}},
                                                      {{-x, k_short}, {-x, y - k_short}},
                                                      {{x, k_short}, {x, y - k_short}},
                                                      {{-w, 0}, {w, 0}},
                                                      {{-x, k_short - y}, {-x, -k_short}},
                                                      {{x, k_short - y}, {x, -k_short}},
                                                      {{-w, -y}, {w, -y}}}};
  const std::string text = std::to_string(number);
  const Vec2 right(up.y(), -up.x());
  std::vector<DiscHull> hulls;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned lit = text[i] == '-' ? 0b0001000U : k_digits[static_cast<std::size_t>(text[i] - '0')];
    const double shift = k_digit_pitch * (static_cast<double>(i) - 0.5 * static_cast<double>(text.size() - 1));
    for (std::size_t k = 0; k < strokes.size(); ++k) {
      if ((lit >> (6 - k) & 1U) == 0) continue;
      const auto at = [&](const Vec2& p) { return Vec2(middle + (p.x() + shift) * right + p.y() * up); };
      hulls.push_back(slot(at(strokes[k].first), at(strokes[k].second), k_radius));
    }
  }
  return hulls;
}

void make_parts(KitPlan& plan, const Mechanism& mechanism, const solid::BodyLayout& layout) {
  PartMaker(plan, mechanism, layout).make();
}

Polygon link_outline(const KitPlan& plan, const Mechanism& mechanism, double theta) {
  const LinkFrame frame = link_frame(theta);
  Polygon outline = outline_of(link_hull(plan.sizes, mechanism.joint.R));
  for (Vec2& point : outline) point = point.x() * frame.across + point.y() * frame.along;
  return outline;
}

Polygon scale_outline(const KitPlan& plan, const Mechanism& mechanism) {
  return outline_of(scale_hull(plan, mechanism.joint));
}

namespace {

PrintTrim trim_of(const Mechanism& mechanism, const solid::BodyLayout& layout) {
  const double overhang = mechanism.print.supports ? 0.0 : mechanism.print.overhang;
  return {layout.scale, mechanism.material.hole_compensation, layout.elephant_foot,
          overhang > radians(45) ? elementary::tan(overhang) : 1.0};
}

}  // namespace

solid::TriangleMesh printed_mesh(const KitPart& part, const Mechanism& mechanism, const solid::BodyLayout& layout) {
  // The coupon is not compensated, because it measures the printer's errors.
  if (part.places.empty()) return mesh_of(part.body);
  return mesh_of(trimmed(part.body, trim_of(mechanism, layout)), layout.scale);
}

double printed_volume(const KitPart& part, const Mechanism& mechanism, const solid::BodyLayout& layout) {
  if (part.places.empty()) return volume_of(part.body);
  return volume_of(trimmed(part.body, trim_of(mechanism, layout)), layout.scale);
}

solid::TriangleMesh placed_mesh(const KitPart& part, const KitPlace& place, double theta) {
  solid::TriangleMesh mesh = mesh_of(part.body);
  const LinkFrame frame = link_frame(place.on_link ? theta : 0);
  for (Vec3& v : mesh.vertices) {
    if (place.turned_over) v = {-v.x(), v.y(), -v.z()};
    const Vec2 p(v.x() + place.shift.x(), v.y() + place.shift.y());
    const Vec2 turned_to = p.x() * frame.across + p.y() * frame.along;
    v = {turned_to.x(), turned_to.y(), v.z() + place.z};
  }
  return mesh;
}

}  // namespace fusee::kit
