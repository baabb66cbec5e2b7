// An assembled rig as meshes, cut at many heights and at many places of the stroke. The tests use the positions of
// parts and the tendons' paths on the sampled outlines, and none of the sizes that the plan checked.
#include "fusee/kit.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "export/report/tendon_trace.h"
#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"
#include "kit/hardware.h"
#include "mechanism/catalogue.h"

namespace {

using namespace fusee;
using ::testing::HasSubstr;

struct Model {
  Mechanism mechanism;
  profile::SynthesisResult synthesis;
  solid::Pulley pulley;
  kit::KitPlan plan;
};

Model model_of(const std::string& profile, const std::vector<Setting>& settings = {}) {
  const MechanismFile file =
      read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (profile + ".toml"), settings);
  const joint::IdentifiedJoint joint = joint::identified_joint(file.mechanism);
  Model model{joint.mechanism, profile::synthesise(joint.mechanism, {.advice = false}), {}, {}};
  joint::draw_for_making(model.synthesis, joint.outline);
  model.pulley = solid::make_pulley(joint.mechanism, model.synthesis);
  model.plan = kit::plan_kit(joint.mechanism, model.synthesis, model.pulley.layout);
  return model;
}

bool is_inside(const std::vector<Polygon>& loops, const Vec2& point) {
  bool inside = false;
  for (const Polygon& loop : loops) {
    for (std::size_t i = 0, k = loop.size() - 1; i < loop.size(); k = i++) {
      if ((loop[i].y() > point.y()) == (loop[k].y() > point.y())) continue;
      const double t = (point.y() - loop[i].y()) / (loop[k].y() - loop[i].y());
      if (point.x() < loop[i].x() + t * (loop[k].x() - loop[i].x())) inside = !inside;
    }
  }
  return inside;
}

/// Least distance of points from a section; 0 if one lies inside.
double distance(const std::vector<Polygon>& loops, const std::vector<Vec2>& points) {
  double least = 1e9;
  for (const Vec2& point : points) {
    if (is_inside(loops, point)) return 0;
    for (const Polygon& loop : loops) least = std::min(least, distance_to_edges(loop, point));
  }
  return least;
}

/// Points at most half a millimetre apart.
std::vector<Vec2> dotted(const std::vector<Vec2>& path, bool closed) {
  std::vector<Vec2> dots;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < path.size(); ++i) {
    const Vec2 &a = path[i], &b = path[(i + 1) % path.size()];
    const int steps = std::max(1, static_cast<int>((b - a).norm() / 0.5));
    for (int k = 0; k <= steps; ++k) dots.push_back(a + (b - a) * k / steps);
  }
  return dots;
}

solid::TriangleMesh pulley_standing(const Model& model, double alpha) {
  solid::TriangleMesh mesh = model.pulley.mesh;
  const Vec2 axis = formats::pulley_axis(model.mechanism);
  for (Vec3& v : mesh.vertices) {
    v /= model.pulley.layout.scale;
    const Vec2 at = axis + turned(Vec2(v.x(), v.y()), -alpha);
    v = {at.x(), at.y(), v.z() + model.plan.sizes.pulley_low};
  }
  return mesh;
}

struct PlacedPart {
  std::string name;
  solid::TriangleMesh mesh;
  bool moves = false;
};

std::vector<PlacedPart> put_together(const Model& model, double theta, double alpha) {
  std::vector<PlacedPart> all;
  for (const kit::KitPart& part : model.plan.parts) {
    for (const kit::KitPlace& place : part.places)
      all.push_back({part.name, kit::placed_mesh(part, place, theta), place.on_link});
  }
  all.push_back({"pulley", pulley_standing(model, alpha), true});
  return all;
}

class Kit : public ::testing::TestWithParam<const char*> {};

/// True for parts that are screwed together.
bool may_touch(const std::string& a, const std::string& b) {
  static const std::set<std::set<std::string>> pairs{
      {"link", "post"}, {"link", "magnet_cap"}, {"link", "tensioner_slide"}};
  return pairs.count({a, b}) != 0;
}

TEST_P(Kit, MovingPartsDoNotCollide) {
  const Model model = model_of(GetParam());
  ASSERT_TRUE(model.plan.made());
  const auto& stroke = model.synthesis.stroke;
  for (const std::size_t place : {std::size_t{0}, stroke.size() / 3, stroke.size() / 2, stroke.size() - 1}) {
    const std::vector<PlacedPart> all = put_together(model, stroke[place].theta, stroke[place].alpha);
    // From the base plate to above the bracket, which is 4 mm thick. The odd steps avoid heights of faces.
    const double low = -model.plan.sizes.base, high = model.plan.sizes.bracket_low + 6;
    for (double z = low + 0.23; z < high; z += 1.37) {
      std::vector<std::vector<Polygon>> cuts;
      for (const PlacedPart& part : all) {
        const solid::Bounds box = solid::bounds(part.mesh);
        cuts.push_back(box.low.z() < z && z < box.high.z() ? solid::section(part.mesh, z) : std::vector<Polygon>());
      }
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].moves || cuts[i].empty()) continue;
        for (std::size_t k = 0; k < all.size(); ++k) {
          if (i == k || cuts[k].empty() || may_touch(all[i].name, all[k].name)) continue;
          // The ring lies in the link's bore.
          if (all[k].name == "bearing_ring") continue;
          // The plan requires 0.5 mm. Polygons and the distance of the dots take less than 0.1 mm of it.
          for (const Polygon& loop : cuts[i])
            EXPECT_GT(distance(cuts[k], dotted(loop, true)), 0.4)
                << all[i].name << " meets " << all[k].name << " at z = " << z
                << ", theta = " << degrees(stroke[place].theta);
        }
      }
    }
  }
}

/// All names of parts, by which a kit removes the parts of an earlier one.
void expect_known_names(const kit::KitPlan& plan) {
  for (const kit::KitPart& part : plan.parts) EXPECT_THAT(kit::k_kit_part_names, ::testing::Contains(part.name));
}

TEST_P(Kit, PartsHaveKnownNames) { expect_known_names(model_of(GetParam()).plan); }

TEST_P(Kit, TendonsRunFree) {
  const Model model = model_of(GetParam());
  ASSERT_TRUE(model.plan.made());
  const auto& stroke = model.synthesis.stroke;
  for (const std::size_t place : {std::size_t{0}, stroke.size() / 3, stroke.size() / 2, stroke.size() - 1}) {
    const std::vector<PlacedPart> all = put_together(model, stroke[place].theta, stroke[place].alpha);
    for (const transmission::Side side : {transmission::Side::left, transmission::Side::right}) {
      const bool left = side == transmission::Side::left;
      const auto trace = formats::trace_tendon(model.mechanism, left ? model.synthesis.p1 : model.synthesis.p2,
                                               stroke[place].alpha, stroke[place].theta);
      ASSERT_TRUE(trace);
      std::vector<Vec2> line = trace->free_path;
      // Towards the take-off the tendon enters its groove: the last fifth of the span is omitted.
      line.pop_back();
      const Vec2 last = line.back(), groove = trace->take_off;
      line.push_back(last + 0.8 * (groove - last));
      // Without the end that is tied to the post.
      const Vec2 first = line.front(), pin = line[1];
      line.front() = first + (pin - first).normalized() * (model.plan.sizes.post + 1);
      const double z = left ? model.plan.sizes.z_tendon1 : model.plan.sizes.z_tendon2;
      for (const double height :
           {z - 0.5 * model.mechanism.tendon.diameter, z, z + 0.5 * model.mechanism.tendon.diameter}) {
        for (const PlacedPart& part : all) {
          if (part.name == "pulley" || part.name == (left ? "pin_b_sleeve" : "pin_d_sleeve")) continue;
          EXPECT_GT(distance(solid::section(part.mesh, height), dotted(line, false)),
                    0.5 * model.mechanism.tendon.diameter + 0.2)
              << part.name << " touches tendon " << (left ? 1 : 2) << " at theta = " << degrees(stroke[place].theta);
        }
      }
    }
  }
}

TEST_P(Kit, PinsMatchTheMechanism) {
  const Model model = model_of(GetParam());
  for (const kit::KitPin& pin : model.plan.pins) {
    EXPECT_NEAR((pin.place - formats::pin_centre(model.mechanism, pin.side)).norm(), 0, 1e-9);
    // The tendon's plane lies half-way between the collars, in the plane of the pulley's groove.
    const double groove = pin.side == transmission::Side::left ? model.pulley.layout.z_p1 : model.pulley.layout.z_p2;
    EXPECT_NEAR(0.5 * (pin.gap_low + pin.gap_high), model.plan.sizes.pulley_low + groove, 1e-9);
  }
  // The plate has their holes.
  const kit::KitPart& base = model.plan.parts.front();
  const auto loops = solid::section(kit::mesh_of(base.body), 1.0);
  for (const kit::KitPin& pin : model.plan.pins) EXPECT_FALSE(is_inside(loops, pin.place));
  EXPECT_FALSE(is_inside(loops, Vec2(0, 0)));
  EXPECT_FALSE(is_inside(loops, formats::pulley_axis(model.mechanism)));
}

TEST_P(Kit, PostStandsAtC) {
  const Model model = model_of(GetParam());
  for (const kit::KitPart& part : model.plan.parts) {
    if (part.name != "post") continue;
    for (const transmission::TransmissionPoint& at : {model.synthesis.stroke.front(), model.synthesis.stroke.back()}) {
      const solid::TriangleMesh mesh = kit::placed_mesh(part, part.places.front(), at.theta);
      EXPECT_NEAR(solid::bounds(mesh).low.z(), model.plan.sizes.post_low, 1e-4);
      const auto loops = solid::section(mesh, model.plan.sizes.z_tendon2);
      ASSERT_EQ(loops.size(), 2u);  // waist and bore
      Vec2 middle(0, 0);
      for (const Vec2& point : loops[0]) middle += point / static_cast<double>(loops[0].size());
      EXPECT_NEAR((middle - formats::attachment(model.mechanism, transmission::Side::left, at.theta)).norm(), 0, 0.02);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Profiles, Kit, ::testing::Values("forearm", "finger", "wrist_exo"));

// ---- advice of rejected kits ----------------------------------------------------------------------------------------

std::string reasons(const kit::KitPlan& plan) {
  std::string text;
  for (const profile::Condition& condition : profile::failed_of(plan.conditions))
    text += condition.name + ": " + condition.message + "\n";
  return text;
}

TEST(KitOfOne, RejectsPinOfZeroRadius) {
  const Model model = model_of("forearm", {{"guides.radius_mm", "0"}});
  EXPECT_FALSE(model.plan.made());
  EXPECT_TRUE(model.plan.parts.empty());
  EXPECT_THAT(reasons(model.plan), HasSubstr("guides.radius_mm 0.5 or more"));
}

TEST(KitOfOne, RejectsAxleInPulleyWithAdvice) {
  const Model model = model_of("forearm", {{"pulley.EF_mm", "60"}});
  ASSERT_TRUE(model.pulley.made());
  EXPECT_FALSE(model.plan.made());
  EXPECT_THAT(reasons(model.plan), HasSubstr("pulley.EF_mm larger by"));
  EXPECT_TRUE(model_of("forearm", {{"pulley.EF_mm", "80"}}).plan.made());
}

TEST(KitOfOne, SmallFingerGetsSmallBearings) {
  const Model model = model_of("finger");
  ASSERT_TRUE(model.plan.made());
  EXPECT_LT(model.plan.sizes.bearing->outer, model.mechanism.joint.R / 3);
}

// ---- the coupon -----------------------------------------------------------------------------------------------------

TEST(KitOfOne, CouponHasFiveHolesAndPegs) {
  const Model model = model_of("forearm");
  const solid::TriangleMesh mesh = kit::mesh_of(kit::coupon_body(model.mechanism));
  for (const Check& check : solid::check_mesh(mesh)) EXPECT_TRUE(check.ok) << check.name << " " << check.where;
  std::vector<double> bores;
  std::size_t pegs = 0;
  for (const Polygon& loop : solid::section(mesh, 1.0)) {
    Vec2 middle(0, 0);
    for (const Vec2& point : loop) middle += point / static_cast<double>(loop.size());
    if (middle.y() > 40) bores.push_back(2 * distance_to_edges(loop, middle));
    pegs += signed_area(loop) > 0 && middle.y() < 15 ? 1 : 0;
  }
  std::sort(bores.begin(), bores.end());
  ASSERT_EQ(bores.size(), 5u);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(bores[static_cast<std::size_t>(i)], 5 + 0.1 * i, 0.03);
  EXPECT_EQ(pegs, 5u);
  for (const kit::CouponReading& reading : kit::coupon_readings(model.mechanism)) {
    const std::string key = reading.key.substr(0, reading.key.find(' '));
    if (key.find('.') == std::string::npos) continue;
    EXPECT_NE(find_field(key), nullptr) << key;
  }
}

// ---- the verb -------------------------------------------------------------------------------------------------------

TEST(KitOfOne, ChecksEveryWrittenPart) {
  pipeline::KitOptions options;
  options.dry_run = true;
  options.folder = std::filesystem::temp_directory_path() / "fusee-kit-test";
  const pipeline::KitResult made =
      pipeline::kit(read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/paper_optimum.toml"), options);
  EXPECT_EQ(made.ending, pipeline::KitEnding::done);
  EXPECT_FALSE(made.published);
  for (const Check& check : made.product.checks)
    EXPECT_TRUE(check.ok) << check.name << " " << check.value << " " << check.where;
  for (const kit::KitPart& part : made.product.plan.parts) {
    for (const char* what : {"_open_edges", "_overhang", "_volume_error", "_3mf_deviation"})
      EXPECT_TRUE(std::any_of(made.product.checks.begin(), made.product.checks.end(),
                              [&](const Check& check) { return check.name == part.name + what; }))
          << part.name << what;
  }
  EXPECT_EQ(made.outputs.back().name, "manifest.json");
}

TEST(KitOfOne, TendonLengthCoversItsPath) {
  pipeline::KitOptions options;
  options.dry_run = true;
  options.folder = std::filesystem::temp_directory_path() / "fusee-kit-test";
  const pipeline::KitResult made =
      pipeline::kit(read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/forearm.toml"), options);
  const formats::Product& product = made.product.pulley;
  for (const formats::KitCut& cut : formats::kit_cuts(made.product)) {
    const bool left = cut.side == transmission::Side::left;
    const profile::Outline& outline = left ? product.synthesis.p1 : product.synthesis.p2;
    const auto trace = formats::trace_tendon(product.joint.mechanism, outline, 0, 0);
    // Tendon 1 runs up the post, and along the link to the slide, which begins 2.5 mm beyond the post.
    double path = trace->free_length;
    if (left) {
      const kit::KitSizes& sizes = made.product.plan.sizes;
      path += sizes.link_low + sizes.link + sizes.flange - sizes.post_low;
      path += 2.5 + sizes.post;
    }
    EXPECT_GT(cut.between_knots, path);
    EXPECT_LT(cut.between_knots, path + 1.5 * perimeter(profile::parallel(outline, 0)));
    EXPECT_GT(cut.cut, cut.between_knots + 100);  // two tails of 50 mm
  }
}

// ---- plates to drill ------------------------------------------------------------------------------------------------

/// Two bearings of the catalogue lie in the link, on a ledge that touches the outer rings only. The spacer
/// ring below the inner rings passes through the drum.
void expect_bearings_seated(const kit::KitPlan& plan, const Joint& joint) {
  const auto part = [&](const std::string& name) {
    return std::find_if(plan.parts.begin(), plan.parts.end(),
                        [&](const kit::KitPart& one) { return one.name == name; });
  };
  const auto ring = part("bearing_ring"), link = part("link_template"), drum = part("drum");
  const auto bearing = std::find_if(bearing_types().begin(), bearing_types().end(), [&](const BearingType& one) {
    return std::any_of(plan.items.begin(), plan.items.end(), [&](const kit::KitItem& item) {
      return item.what.starts_with("ball bearing " + one.name + " ");
    });
  });
  ASSERT_EQ(ring == plan.parts.end(), bearing == bearing_types().end());
  if (ring == plan.parts.end()) return;
  const auto radius_at = [](const kit::KitPart& one, double z) {
    double least = 1e9;
    for (const Polygon& loop : solid::section(kit::placed_mesh(one, one.places.front(), 0), one.places.front().z + z)) {
      if (is_inside({loop}, {0, 0})) least = std::min(least, distance_to_edges(loop, {0, 0}));
    }
    return least;
  };
  const auto top = [](const kit::KitPart& one) { return one.body.slabs.back().high; };
  EXPECT_NEAR(radius_at(*link, top(*link) - 0.1), 0.5 * bearing->outer, 0.02);
  EXPECT_NEAR(top(*link) - link->body.slabs.front().high, 2 * bearing->width, 1e-9);
  EXPECT_LT(radius_at(*link, 0.5), 0.5 * bearing->outer - 0.2);
  EXPECT_GT(radius_at(*link, 0.5), 0.5 * bearing->spacer + 0.2);
  // The bearing's inner ring rests on it, and the ledge is clear of the parts below.
  EXPECT_NEAR(top(*ring), link->places.front().z + link->body.slabs.front().high, 1e-9);
  if (joint.drum_radius > 0) {
    EXPECT_GT(radius_at(*drum, 0.5), 0.5 * bearing->spacer + 0.4);
  }
}

class Template : public ::testing::TestWithParam<std::string> {};

/// Checks on the meshes that the plates have holes at every axis of the file and none between two of them.
TEST_P(Template, HasAHoleAtEveryAxis) {
  const Model model = model_of(GetParam());
  ASSERT_TRUE(model.plan.made());
  EXPECT_TRUE(model.plan.drilled);
  expect_known_names(model.plan);
  const Mechanism& mechanism = model.mechanism;
  const auto loops_of = [&](const std::string& name) {
    const auto part = std::find_if(model.plan.parts.begin(), model.plan.parts.end(),
                                   [&](const kit::KitPart& one) { return one.name == name; });
    if (part == model.plan.parts.end()) return std::vector<Polygon>();
    const solid::TriangleMesh mesh = kit::placed_mesh(*part, part->places.front(), 0);
    for (const Check& check : solid::check_mesh(mesh)) EXPECT_TRUE(check.ok) << name << ": " << check.name;
    return solid::section(mesh, part->places.front().z + 1.0);
  };
  const auto base = loops_of("base_template"), link = loops_of("link_template"), drum = loops_of("drum");
  const Guides& guides = mechanism.guides;
  const Vec2 G(0, -guides.OE - mechanism.pulley.EF);
  std::vector<Vec2> bored{{0, 0}, {-guides.EB, -guides.OE}, {guides.ED, -guides.OE}, G};
  if (mechanism.sheath.is_there()) {
    for (const double x : {-1.0, 1.0})
      bored.push_back(G + Vec2(x * mechanism.sheath.exit_across, mechanism.sheath.exit_above));
  }
  for (const Vec2& at : bored) EXPECT_FALSE(is_inside(base, at)) << at.transpose();
  // The outline, these holes, and those of the motor's screws if a motor fits.
  const auto mounted = std::find_if(motor_types().begin(), motor_types().end(), [&](const MotorType& motor) {
    return std::any_of(model.plan.items.begin(), model.plan.items.end(), [&](const kit::KitItem& item) {
      return item.what.starts_with(motor.name + ":") ||
             item.use.find("changes it: " + motor.name + ",") != std::string::npos;
    });
  });
  std::size_t screws = 0;
  if (mounted != motor_types().end()) screws = mounted->two_holes ? 2 : 4;
  EXPECT_EQ(base.size(), bored.size() + 1 + screws);
  EXPECT_TRUE(is_inside(base, 0.5 * (bored[1] + bored[0])));
  for (const auto& end : {mechanism.joint.attachment1, mechanism.joint.attachment2}) {
    const Vec2 at = end ? Vec2(end->across, end->along) : Vec2(0, mechanism.joint.R);
    EXPECT_FALSE(is_inside(link, at)) << at.transpose();
    EXPECT_GT(distance_to_edges(link.front(), at), 0.4);
  }
  EXPECT_FALSE(is_inside(link, {0, 0}));
  expect_bearings_seated(model.plan, mechanism.joint);
  EXPECT_EQ(drum.empty(), mechanism.joint.drum_radius == 0);
  if (drum.empty()) return;
  double most = 0;
  for (const Polygon& loop : drum) {
    for (const Vec2& point : loop) most = std::max(most, point.norm());
  }
  EXPECT_NEAR(most, mechanism.joint.drum_radius, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Template,
                         ::testing::Values("finger_mcp", "finger_pip", "ankle_exo", "elbow_idlers", "wrist_sheath",
                                           "gravity_arm"),
                         [](const auto& tested) { return tested.param; });

TEST(TemplatePage, DrawsDrumIdlersAndSheaths) {
  for (const char* profile : {"elbow_idlers", "wrist_sheath"}) {
    pipeline::KitOptions options;
    options.dry_run = true;
    options.folder = std::filesystem::temp_directory_path() / "fusee-kit-test";
    const pipeline::KitResult made = pipeline::kit(
        read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (std::string(profile) + ".toml")),
        options);
    ASSERT_EQ(made.ending, pipeline::KitEnding::done);
    const auto page = std::find_if(made.outputs.begin(), made.outputs.end(),
                                   [](const OutputFile& file) { return file.name == "kit.html"; });
    ASSERT_NE(page, made.outputs.end());
    const bool sheathed = made.product.pulley.joint.mechanism.sheath.is_there();
    EXPECT_EQ(page->bytes.find("class=\"kit-sheath\"") != std::string::npos, sheathed);
    EXPECT_EQ(page->bytes.find("Idlers onto bolts") != std::string::npos, !sheathed);
  }
}

TEST(KitHardware, ChoosesStockOfTheUnit) {
  EXPECT_EQ(kit::stock_rod(2.2, LengthUnit::mm), 2.5);
  EXPECT_EQ(kit::stock_rod(4.2, LengthUnit::mm), 5);
  EXPECT_DOUBLE_EQ(kit::stock_rod(4.26, LengthUnit::inch), 4.7625);  // 3/16 in
  EXPECT_EQ(kit::stock_rod(40, LengthUnit::mm), 40);
  EXPECT_EQ(kit::screw_words(kit::thread_within(3, LengthUnit::mm), 14), "M3 × 16");
  EXPECT_EQ(kit::screw_words(kit::thread_within(3, LengthUnit::inch), 14), "#4-40 × 5/8 in");
  EXPECT_EQ(kit::screw_words(kit::thread_within(1, LengthUnit::inch), 120), "#2-56 × 5 in");
}

}  // namespace
