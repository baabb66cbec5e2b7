#include "mechanism/horn_faults.h"

#include "base/text.h"
#include "fusee/base.h"

namespace fusee {
namespace {

// A bore with fewer teeth neither centres the pulley nor transmits a torque well, and no servo has one.
constexpr int k_min_teeth = 6;

class Faults {
 public:
  explicit Faults(const Horn& horn) : horn_(horn) {}

  std::vector<HornFault> all() {
    if (horn_.spline_teeth > 0) {
      check_spline();
      check_spline_without_horn();
    } else {
      check_no_spline();
      check_bolts();
      check_boss();
      if (horn_.centre_hole <= 0) lacks("centre_hole_mm", "access to the central screw");
    }
    return std::move(faults_);
  }

 private:
  void report(std::string_view key, std::string message, std::string hint) {
    faults_.push_back({key, std::move(message), std::move(hint)});
  }
  void lacks(std::string_view key, std::string_view reason) {
    report(key, "horn." + std::string(key) + " is missing or 0",
           "add " + std::string(key) + " under [horn]: " + std::string(reason));
  }

  void check_spline() {
    if (horn_.spline_teeth < k_min_teeth) {
      report("spline_teeth", "horn.spline_teeth = " + std::to_string(horn_.spline_teeth) + " is too small",
             "at least " + std::to_string(k_min_teeth) + "; 0: no toothed shaft");
    }
    if (horn_.spline_diameter <= 0) lacks("spline_diameter_mm", "over the shaft's teeth, for example 5.92");
    if (horn_.spline_depth <= 0) lacks("spline_depth_mm", "of the shaft's teeth, for example 0.3");
    // Teeth deeper than wide have flanks steeper than any serration (DIN 5481: 60° between them).
    const double pitch = k_pi * horn_.spline_diameter / horn_.spline_teeth;
    if (horn_.spline_diameter > 0 && horn_.spline_depth > pitch) {
      report("spline_depth_mm",
             "horn.spline_depth_mm = " + shortest(horn_.spline_depth) + " mm exceeds the width of the teeth, " +
                 rounded(pitch, 3) + " mm",
             "make horn.spline_depth_mm smaller, or horn.spline_teeth");
    }
    if (horn_.spline_length > 0 && horn_.centre_hole <= 0)
      lacks("centre_hole_mm", "the screw that holds the pulley on the shaft passes through it");
    if (horn_.spline_length <= 0 && horn_.centre_hole > 0) {
      report("centre_hole_mm", "horn.centre_hole_mm conflicts with teeth that go through",
             "add spline_length_mm, the length of the shaft in the pulley, or leave out centre_hole_mm");
    }
  }

  // A pulley is mounted either on a servo's shaft or on a horn.
  void check_spline_without_horn() {
    const bool boss = horn_.boss_diameter > 0 || horn_.boss_height > 0;
    const bool bolts = horn_.bolt_count > 0 || horn_.bolt_circle > 0 || horn_.bolt_hole > 0;
    if (!boss && !bolts) return;
    report("spline_teeth",
           std::string("horn.spline_teeth is for the servo's bare shaft, ") +
               (boss ? "horn.boss_diameter_mm" : "horn.bolt_circle_mm") + " for a horn",
           "leave out the keys spline_..., or those of the horn");
  }

  void check_no_spline() {
    if (horn_.spline_diameter > 0 || horn_.spline_depth > 0 || horn_.spline_length > 0)
      lacks("spline_teeth", "number of teeth of the shaft");
  }

  void check_bolts() {
    if (horn_.bolt_count <= 0 && horn_.bolt_circle <= 0) {
      if (horn_.spline_diameter > 0) return;
      return lacks("bolt_circle_mm", "screws hold the pulley on the horn (or spline_teeth, on the servo's shaft)");
    }
    if (horn_.bolt_count <= 0) {
      lacks("bolt_count", "number of screws on the circle of " + shortest(horn_.bolt_circle) + " mm");
    }
    if (horn_.bolt_circle <= 0) lacks("bolt_circle_mm", "the diameter on which the screws stand");
    if (horn_.bolt_hole <= 0)
      lacks("bolt_hole_mm", "clearance holes of the screws: 2.2 for M2, 3.2 for M3 (ISO 273, fine)");
  }

  void check_boss() {
    if (horn_.boss_height > 0 && horn_.boss_diameter <= 0) lacks("boss_diameter_mm", "the boss sinks into the pulley");
    if (horn_.boss_diameter > 0 && horn_.boss_height <= 0) lacks("boss_height_mm", "depth of the boss in the pulley");
  }

  const Horn& horn_;
  std::vector<HornFault> faults_;
};

}  // namespace

std::vector<HornFault> faults_of(const Horn& horn) { return Faults(horn).all(); }

}  // namespace fusee
