#include "mechanism/catalogue.h"

#include <gmock/gmock.h>

#include <sstream>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/horn_faults.h"

namespace fusee {
namespace {

using testing::Contains;
using testing::IsEmpty;

TEST(Catalogue, HornsAreValid) {
  ASSERT_FALSE(horns().empty());
  for (const HornType& type : horns()) {
    EXPECT_THAT(faults_of(type.horn), IsEmpty()) << type.name;
    EXPECT_EQ(find_horn(type.name), &type);
    Mechanism mechanism;
    mechanism.horn = type.horn;
    for (const Field& field : fields()) {
      if (field.table != "horn") continue;
      EXPECT_GE(number_of(mechanism, field), field.least) << type.name << " " << field.key;
      EXPECT_LE(number_of(mechanism, field), field.most) << type.name << " " << field.key;
    }
  }
  EXPECT_EQ(find_horn(k_own_horn), nullptr);
}

// A misspelt key of an optional number would silently be 0.
TEST(Catalogue, KeysOfHornsShaftsAndMotorsAreKnown) {
  const auto keys_in = [](const char* file) {
    std::istringstream text(read_file(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles/catalogue" / file, 1 << 20));
    std::vector<std::string> keys;
    for (std::string line; std::getline(text, line);) {
      if (const std::size_t equals = line.find(" = "); equals != std::string::npos && line[0] != '#')
        keys.push_back(line.substr(0, equals));
    }
    return keys;
  };
  const std::vector<std::string> words{"name", "description", "source"};
  for (const std::string& key : keys_in("horns.toml"))
    EXPECT_TRUE(find_field("horn." + key) != nullptr || testing::Value(words, Contains(key))) << key;
  const std::vector<std::string> of_models{"fits", "travel_deg", "stall_torque_Nmm", "speed_deg_per_s", "holds"};
  const std::vector<std::string> motors = keys_in("motors.toml");
  // The models follow the plate patterns, whose last key is head_mm.
  const auto first_of_models = std::find(motors.rbegin(), motors.rend(), "head_mm").base();
  for (auto key = first_of_models; key != motors.end(); ++key)
    EXPECT_TRUE(testing::Value(words, Contains(*key)) || testing::Value(of_models, Contains(*key))) << *key;
  for (const std::string& key : keys_in("shafts.toml"))
    EXPECT_TRUE(key == "diameter_mm" || key == "flat_mm" || testing::Value(words, Contains(key))) << key;
}

TEST(Catalogue, ShaftsAreRoundOrFlat) {
  ASSERT_FALSE(shafts().empty());
  for (const ShaftType& type : shafts()) {
    EXPECT_EQ(find_shaft(type.name), &type);
    EXPECT_EQ(type.bore == Bore::d, type.flat > 0.5 * type.diameter) << type.name;
    EXPECT_LT(type.flat, type.diameter) << type.name;
  }
  EXPECT_EQ(find_shaft("none"), nullptr);
}

// Parts of a test rig fit together: a bearing on its screw, a board's holes on the board, screws clear of the parts
// they hold.
TEST(Catalogue, BearingsBoardsAndMotorsAreConsistent) {
  double outer_before = 1e9;
  for (const BearingType& type : bearing_types()) {
    EXPECT_LT(type.bore, type.spacer) << type.name;
    EXPECT_LT(type.spacer, type.outer) << type.name;
    EXPECT_LT(type.outer, outer_before) << type.name << ": the largest first";
    outer_before = type.outer;
  }
  for (const BoardType& type : board_types()) {
    EXPECT_TRUE(((type.pitch.array() + type.hole) < type.size.array()).all()) << type.name;
    EXPECT_GT(type.pitch.norm(), type.magnet + type.hole) << type.name;
    EXPECT_GT(type.gap, 0) << type.name;
  }
  for (const MotorType& type : motor_types()) {
    EXPECT_NE(type.shaft > 0, type.face > 0) << type.name << ": a shaft or a horn";
    EXPECT_FALSE(type.fits.empty()) << type.name;
    for (const std::string& name : type.fits)
      EXPECT_TRUE(find_shaft(name) != nullptr || find_horn(name) != nullptr) << type.name << " " << name;
    if (type.pilot > 0) {
      EXPECT_GT(std::hypot(type.hole_x, type.hole_front), 0.5 * (type.pilot + type.hole)) << type.name;
    } else {
      EXPECT_GT(type.hole_front - 0.5 * type.hole, type.front) << type.name;
      EXPECT_GT(type.hole_back - 0.5 * type.hole, type.back) << type.name;
    }
  }
}

// A motor's largest power, a quarter of stall torque times free speed, is below 200 W. A misspelt key would be read as
// no limit.
TEST(Catalogue, MotorModelsHaveFiguresAndSources) {
  ASSERT_GT(motor_models().size(), 20u);
  for (const MotorModel& model : motor_models()) {
    EXPECT_EQ(find_motor_model(model.name), &model) << "a name occurs twice";
    EXPECT_GT(model.stall_torque, 1) << model.name;
    EXPECT_TRUE(model.travel == 0 || model.travel >= radians(90)) << model.name;
    EXPECT_TRUE(model.speed == 0 || (degrees(model.speed) > 60 && degrees(model.speed) < 5000)) << model.name;
    EXPECT_LT(model.stall_torque / 1000 * model.speed / 4, 200) << model.name << ": W";
    EXPECT_TRUE(testing::Value(model.source, testing::ContainsRegex("rpm|s/60 deg|holding torque|no figure found")))
        << model.name;
    for (const std::string& name : model.fits)
      EXPECT_TRUE(find_shaft(name) != nullptr || find_horn(name) != nullptr) << model.name << " " << name;
  }
  EXPECT_EQ(find_motor_model("none"), nullptr);
}

// Speeds are given as rpm or s/60° in the source, torques as kgf·cm, kgf·mm, N·m or N·cm: the first number of each.
TEST(Catalogue, MotorModelsAgreeWithTheirSources) {
  for (const MotorModel& model : motor_models()) {
    const std::string text = model.source;
    const auto before = [&text](const std::string& unit) -> double {
      const std::size_t at = text.find(unit);
      if (at == std::string::npos) return 0;
      const std::size_t begin = text.find_last_not_of("0123456789.", at - 1);
      return std::stod(text.substr(begin + 1, at - begin - 1));
    };
    const double torque = std::max(
        {98.0665 * before(" kgf·cm"), 9.80665 * before(" kgf·mm"), 1000 * before(" N·m"), 10 * before(" N·cm")});
    if (torque > 0) {
      EXPECT_NEAR(model.stall_torque / torque, 1, 2e-3) << model.name;
    }
    const double turn = before(" s/60 deg");
    const double speed = turn > 0 ? 60 / turn : 6 * before(" rpm");
    if (speed > 0) {
      EXPECT_NEAR(degrees(model.speed) / speed, 1, 2e-3) << model.name;
    }
  }
}

TEST(Catalogue, TendonsArePhysical) {
  ASSERT_FALSE(tendon_types().empty());
  for (const TendonType& type : tendon_types()) {
    const double area = 3.14159 / 4 * type.diameter * type.diameter;
    EXPECT_GT(type.breaking_strength / area, 100) << type.name;   // MPa
    EXPECT_LT(type.breaking_strength / area, 4000) << type.name;  // fibres break at 3600
    EXPECT_LT(type.breaking_strength / area, type.modulus) << type.name;
    EXPECT_GE(type.bend_ratio, 5) << type.name;
  }
}

TEST(Catalogue, ShrinkagesAreOrdered) {
  ASSERT_FALSE(material_types().empty());
  for (const MaterialType& type : material_types()) {
    EXPECT_LE(type.shrinkage_least, type.shrinkage_typical) << type.name;
    EXPECT_LE(type.shrinkage_typical, type.shrinkage_most) << type.name;
    EXPECT_LE(type.shrinkage_most, 3) << type.name;
  }
}

}  // namespace
}  // namespace fusee
