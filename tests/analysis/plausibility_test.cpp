// Plausibility warnings: each has a file that triggers it and a similar one that must not.
#include "analysis/plausibility.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <iostream>

#include "fusee/analysis.h"
#include "laws/random_mechanism.h"
#include "mechanism/catalogue.h"
#include "support/mechanisms.h"

namespace fusee::analysis {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* k_forearm = R"(schema = 1
name = "forearm"

[joint]
length_mm = 100.0
range_deg = [-30.0, 30.0]

[guides]
EB_mm = 50.0
ED_mm = 50.0
OE_mm = -40.0
radius_mm = 2.0

[pulley]
EF_mm = 80.0
r1_mm = 16.0

[tendon]
diameter_mm = 1.0
)";

MechanismFile file_with(const std::vector<Setting>& settings) {
  MechanismFile file;
  file.path = "arm.toml";
  file.mechanism = parse_mechanism(k_forearm, file.path, ".", settings, &file.warnings, &file.places);
  return file;
}

MechanismFile file_of(const Mechanism& mechanism) {
  MechanismFile file;
  file.mechanism = DeclaredMechanism(mechanism);
  return file;
}

/// All warnings as printed text.
std::vector<std::string> texts_of(const MechanismFile& file) {
  std::vector<std::string> texts;
  for (const Diagnostic& warning : plausibility_warnings(file)) {
    EXPECT_EQ(warning.severity, Severity::warning);
    texts.push_back(warning.message + " | " + warning.hint);
  }
  return texts;
}
std::vector<std::string> texts_of(const std::vector<Setting>& settings) { return texts_of(file_with(settings)); }

// ---- no warnings ----------------------------------------------------------------------------------------------------

TEST(Plausibility, AcceptsProfiles) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    const MechanismFile file = read_mechanism(entry.path());
    EXPECT_THAT(texts_of(file), IsEmpty()) << entry.path();
    EXPECT_THAT(tight_bends(file), IsEmpty()) << entry.path();
  }
  EXPECT_GE(files, 7);
}

TEST(Plausibility, AcceptsRatioJoints) {
  const DeclaredMechanism jaw =
      parse_mechanism("schema = 1\nname = \"jaw\"\n[transmission]\nkind = \"ratio\"\nratio = -1.09\n", "jaw.toml");
  MechanismFile file;
  file.mechanism = jaw;
  EXPECT_THAT(texts_of(file), IsEmpty());
  EXPECT_THAT(tight_bends(file), IsEmpty());
}

// OE lies between −0.5 R and 0.2 R. Warnings occur only for pins below the joint and a radius that varies fourfold and
// more, at most 1.6-fold with pins above: 3 of 300, 13 of 2000.
TEST(Plausibility, RarelyWarnsOfRandomJoints) {
  int warned = 0, cases = 0;
  testing::expect_law(300, [&](const Mechanism& mechanism) {
    ++cases;
    for (const Diagnostic& warning : plausibility_warnings(file_of(mechanism))) {
      ++warned;
      RC_ASSERT(warning.message.find("guides.OE_mm") == 0);
      RC_ASSERT(mechanism.guides.OE > 0);
    }
    return profile::synthesise(mechanism, {.advice = false}).made();
  });
  EXPECT_LE(warned, cases / 50);
}

// Most input errors in random joints are detected.
TEST(Plausibility, DetectsErrorsInRandomJoints) {
  struct Kind {
    const char* name;
    void (*introduce)(Mechanism&);
    double least;  ///< fraction that is detected
    int seen = 0;
  };
  std::vector<Kind> kinds = {
      {"range in radians",
       [](Mechanism& m) {
         m.joint.theta_min = radians(m.joint.theta_min);
         m.joint.theta_max = radians(m.joint.theta_max);
       },
       1.0},
      {"EB in cm", [](Mechanism& m) { m.guides.EB /= 10; }, 1.0},
      {"joint in cm", [](Mechanism& m) { m.joint.R /= 10; }, 0.9},
      {"all in cm",
       [](Mechanism& m) {
         for (double* length : {&m.joint.R, &m.guides.EB, &m.guides.ED, &m.guides.OE, &m.pulley.EF, &m.pulley.r1})
           *length /= 10;
       },
       0.75},
      {"modulus in GPa", [](Mechanism& m) { m.tendon.modulus /= 1000; }, 1.0},
  };
  int cases = 0;
  testing::expect_law(100, [&](const Mechanism& mechanism) {
    ++cases;
    for (Kind& kind : kinds) {
      Mechanism faulty = mechanism;
      kind.introduce(faulty);
      kind.seen += likely_input_errors(file_of(faulty)).empty() ? 0 : 1;
    }
    return profile::synthesise(mechanism, {.advice = false}).made();
  });
  for (const Kind& kind : kinds) {
    EXPECT_GE(kind.seen, kind.least * cases) << kind.name;
    std::cout << kind.name << ": " << kind.seen << " of " << cases << " seen\n";
  }
}

// ---- the sign of OE -------------------------------------------------------------------------------------------------

TEST(SignOfOE, WarnsOfUnevenPulley) {
  EXPECT_THAT(texts_of({{"guides.OE_mm", "40"}}),
              ElementsAre(AllOf(HasSubstr("guides.OE_mm = 40 mm: positive is below the joint"),
                                HasSubstr("the radius of P2 varies 10-fold"), HasSubstr("did you mean -40 mm?"))));
}

TEST(SignOfOE, WarnsIfOnlyOppositeIsFeasible) {
  MechanismFile file = read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/linear_wrist.toml");
  file.mechanism.guides.OE *= -1;
  ASSERT_FALSE(profile::synthesise(file.mechanism, {.advice = false}).made());
  EXPECT_THAT(texts_of(file),
              ElementsAre(AllOf(HasSubstr("no such pulley can be made"), HasSubstr("did you mean -37.5 mm?"))));
}

TEST(SignOfOE, AcceptsPinsBelow) {
  EXPECT_THAT(texts_of({{"guides.OE_mm", "10"}, {"joint.range_deg", "[-15, 15]"}}), IsEmpty());
  EXPECT_THAT(texts_of({{"guides.OE_mm", "0"}}), IsEmpty());
  // No pulley exists with either sign: the sign is not the error.
  EXPECT_THAT(texts_of({{"guides.OE_mm", "40"}, {"pulley.r1_mm", "60"}}), IsEmpty());
}

// ---- radians --------------------------------------------------------------------------------------------------------

TEST(Radians, WarnsInRange) {
  EXPECT_THAT(texts_of({{"joint.range_deg", "[-0.5236, 0.7854]"}}),
              ElementsAre(AllOf(HasSubstr("joint.range_deg = [-0.5236, 0.7854]"), HasSubstr("[-30, 45]"))));
  EXPECT_THAT(texts_of({{"joint.range_deg", "[0, 1.5708]"}}), ElementsAre(HasSubstr("[0, 90]")));
  EXPECT_THAT(texts_of({{"joint.range_deg", "[-2, 2]"}}), IsEmpty());
}

TEST(Radians, WarnsInTilt) {
  const auto tilted = [](const char* tilt) {
    return texts_of({{"load.mass_kg", "0.2"}, {"load.lever_mm", "50"}, {"load.tilt_deg", tilt}});
  };
  EXPECT_THAT(tilted("1.5708"), ElementsAre(AllOf(HasSubstr("load.tilt_deg = 1.571"), HasSubstr("= 90"))));
  EXPECT_THAT(tilted("-3.14"), ElementsAre(HasSubstr("load.tilt_deg = -180")));
  for (const char* fine : {"0", "90", "1.5", "5.5", "3", "-2.2", "180"}) EXPECT_THAT(tilted(fine), IsEmpty()) << fine;
  EXPECT_THAT(texts_of({{"load.tilt_deg", "1.5708"}}), IsEmpty());  // nothing has weight
}

TEST(Radians, WarnsInGroove) {
  EXPECT_THAT(texts_of({{"body.groove_angle_deg", "0.8727"}}),
              ElementsAre(AllOf(HasSubstr("body.groove_angle_deg"), HasSubstr("= 50"))));
  for (const char* fine : {"0", "1", "2", "5", "50"})
    EXPECT_THAT(texts_of({{"body.groove_angle_deg", fine}}), IsEmpty()) << fine;
}

// ---- lengths --------------------------------------------------------------------------------------------------------

TEST(Lengths, SuggestsUnitOfOneLength) {
  const auto expect = [](const std::string& key, const char* value, const std::string& meant) {
    EXPECT_THAT(texts_of({{key, value}}),
                ElementsAre(AllOf(HasSubstr(key + " = " + value + " mm"), HasSubstr(key + " = " + meant + " mm"))));
  };
  expect("guides.EB_mm", "5", "50");
  expect("guides.ED_mm", "5", "50");
  expect("pulley.EF_mm", "8", "80");
  expect("pulley.r1_mm", "1.6", "16");
  expect("joint.length_mm", "10", "100");
  // Ten times too large.
  expect("guides.EB_mm", "500", "50");
  expect("guides.OE_mm", "-400", "-40");
  expect("pulley.r1_mm", "160", "16");
  expect("joint.length_mm", "1000", "100");
}

TEST(Lengths, ReportsTwoOddLengths) {
  EXPECT_THAT(texts_of({{"guides.EB_mm", "5"}, {"pulley.r1_mm", "160"}}),
              ElementsAre(HasSubstr("guides.EB_mm"), HasSubstr("pulley.r1_mm")));
}

TEST(Lengths, AcceptsUnusualProportions) {
  EXPECT_THAT(texts_of({{"pulley.EF_mm", "600"}}), IsEmpty());  // a distant motor
  EXPECT_THAT(texts_of({{"guides.EB_mm", "20"}, {"guides.ED_mm", "20"}}), IsEmpty());
  EXPECT_THAT(texts_of({{"pulley.r1_mm", "5"}}), IsEmpty());
  EXPECT_THAT(texts_of({{"guides.OE_mm", "0"}}), IsEmpty());
}

std::vector<Setting> all_times(double factor) {
  const auto text = [factor](double value) { return std::to_string(value * factor); };
  return {{"joint.length_mm", text(100)}, {"guides.EB_mm", text(50)}, {"guides.ED_mm", text(50)},
          {"guides.OE_mm", text(-40)},    {"pulley.EF_mm", text(80)}, {"pulley.r1_mm", text(16)}};
}

TEST(Lengths, DetectsAllLengthsInCm) {
  EXPECT_THAT(texts_of(all_times(0.1)),
              ElementsAre(AllOf(HasSubstr("joint.length_mm = 10 mm is small for a tendon of 1 mm"),
                                HasSubstr("in cm or in inches?"), HasSubstr("joint.length_mm = 100"))));
  std::vector<Setting> thin = all_times(0.1);
  thin.push_back({"tendon.diameter_mm", "0.2"});
  EXPECT_THAT(texts_of(thin), ElementsAre(HasSubstr("a pin of 2 mm (guides.radius_mm)")));
  thin.push_back({"guides.radius_mm", "0.3"});
  EXPECT_THAT(texts_of(thin), IsEmpty());  // a joint of a centimetre with matching parts
  thin.push_back({"body.bore_diameter_mm", "5"});
  EXPECT_THAT(texts_of(thin), ElementsAre(HasSubstr("a shaft of 5 mm (body.bore_diameter_mm)")));
}

TEST(Lengths, DetectsInches) {
  const std::vector<Setting> in_inches = all_times(1 / 25.4);
  EXPECT_THAT(texts_of(in_inches), ElementsAre(AllOf(HasSubstr("in inches?"), HasSubstr("100 mm and so on"),
                                                     HasSubstr("units = \"inch\""))));
  std::vector<Setting> read_as_inches = in_inches;
  read_as_inches.insert(read_as_inches.end(), {{"units", "inch"},
                                               {"tendon.diameter_mm", "1 mm"},
                                               {"guides.radius_mm", "2 mm"},
                                               {"body.bore_diameter_mm", "5 mm"}});
  EXPECT_THAT(texts_of(read_as_inches), IsEmpty());
  EXPECT_THAT(texts_of({{"units", "inch"}}), ElementsAre(HasSubstr("thicker than any tendon")));
}

TEST(Lengths, AcceptsThickTendon) {
  EXPECT_THAT(texts_of({{"tendon.diameter_mm", "4"}, {"tendon.modulus_MPa", "3000"}}), IsEmpty());
}

// ---- the tendon -----------------------------------------------------------------------------------------------------

TEST(Modulus, WarnsOfGPa) {
  EXPECT_THAT(texts_of({{"tendon.modulus_MPa", "40"}}), ElementsAre(HasSubstr("tendon.modulus_MPa = 40000")));
  for (const TendonType& type : tendon_types())
    EXPECT_THAT(texts_of({{"tendon.modulus_MPa", std::to_string(type.modulus)}}), IsEmpty()) << type.name;
  // In Pa it is no valid modulus.
  EXPECT_THROW(file_with({{"tendon.modulus_MPa", "40e9"}}), InputError);
}

TEST(Overload, WarnsBeyondDeclaredStrength) {
  const std::vector<Setting> loaded = {{"load.tip_force_N", "50"}, {"tendon.strength_N", "60"}};
  EXPECT_THAT(
      texts_of(loaded),
      ElementsAre(AllOf(HasSubstr("exceeds its strength of 30 N there (tendon.strength_N, tendon.knot_efficiency)"),
                        HasSubstr("[load]"))));
  EXPECT_THAT(texts_of({{"load.tip_force_N", "50"}, {"tendon.strength_N", "200"}}), IsEmpty());
}

TEST(Overload, WarnsBeyondEstimatedStrength) {
  const std::vector<std::string> texts = texts_of({{"load.tip_force_N", "500"}, {"tendon.diameter_mm", "0.9"}});
  EXPECT_THAT(texts, ElementsAre(HasSubstr("an estimate from hmpe-1.0 of the catalogue by its section")));
  EXPECT_THAT(texts_of({{"load.tip_force_N", "200"}, {"tendon.diameter_mm", "0.9"}}), IsEmpty());
  // A tendon unlike any of the catalogue causes no warning.
  EXPECT_THAT(texts_of({{"load.tip_force_N", "500"}, {"tendon.modulus_MPa", "300000"}}), IsEmpty());
}

TEST(Overload, AgreesWithAnalysis) {
  DeclaredMechanism loaded = testing::forearm();
  loaded.load.tip_force = 50;
  loaded.tendon.strength = 60;
  const AnalysisResult table = analyse(loaded, {.steps = 12, .samples = 10});
  MechanismFile file;
  file.mechanism = loaded;
  const auto warning = overloaded_tendon(file);
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->message, tendon_breaks({table.largest_tension, table.largest_at_joint}, *table.strength)->message);
}

TEST(Bends, WarnOfTightBends) {
  MechanismFile file = file_with({{"tendon.bend_ratio", "40"}});
  ASSERT_THAT(tight_bends(file), SizeIs(2));
  EXPECT_THAT(tight_bends(file).front().message, HasSubstr("tendon.bend_ratio"));
  EXPECT_THAT(tight_bends(file_with({})), IsEmpty());
}

// ---- places ---------------------------------------------------------------------------------------------------------

TEST(Places, WarningsNameTheirKey) {
  MechanismFile file;
  file.path = "arm.toml";
  std::string text = k_forearm;
  text.replace(text.find("-40.0"), 5, "40.0");
  file.mechanism = parse_mechanism(text, file.path, ".", {}, &file.warnings, &file.places);
  const MechanismFile warned = with_plausibility_warnings(file);
  ASSERT_THAT(warned.warnings, SizeIs(1));
  EXPECT_THAT(to_text(warned.warnings.front()), HasSubstr("arm.toml:11:9: warning: guides.OE_mm = 40 mm"));
  EXPECT_EQ(file_with({{"guides.OE_mm", "40"}}).place_of("guides.OE_mm").file, "--set guides.OE_mm=40");
  EXPECT_EQ(file.place_of("tendon.strength_N").line, 0);
}

}  // namespace
}  // namespace fusee::analysis
