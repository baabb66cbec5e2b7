#include "mechanism/effect.h"
#include "mechanism/effects/by_hand.h"

namespace fusee {
namespace {

constexpr double k_dial = 1e-4;  // mm/N: resolution of a dial gauge, 0.005 mm, under a force of 50 N

std::vector<ManualReading> compliance_by_dial(const DeclaredMechanism& declared) {
  return hand_reading_in(declared.prior.guide_compliance, 1.0);
}

}  // namespace

Effect frame_compliance(JointKind) {
  Effect effect;
  effect.name = "frame_compliance";
  effect.place = ChainPlace::pins;
  effect.rank = 4;
  effect.signature =
      "proportional to the tension, strongest where the tendons wrap most on their pins; independent of direction";
  effect.separating_run = "hold a dial gauge against a guide pin and hang the load on the joint";
  effect.correctable_by = CorrectableBy::table;
  effect.needs = {.tendons = true};
  effect.parameters = {{.name = "mm_per_N",
                        .number = [](Imperfections& at) -> double& { return at.pins.compliance; },
                        .least = 0,
                        .most = 1,
                        .step = 2e-4,
                        .prior = 0.005,  // a printed bracket of some centimetres: 50 to 1000 N/mm
                        .shown = shown::as_is,
                        .key = key::plain("guide_give_mm_per_N", "mm_per_N", 0, 10,
                                          "displacement of each pin per newton of the tendon's force on it"),
                        .by_hand = {"hold a dial gauge against a guide pin, hang the load on the joint, and enter the "
                                    "displacement of the pin per newton of the tendon's force on it as "
                                    "prior.guide_give_mm_per_N",
                                    k_dial, compliance_by_dial, "prior.guide_give_mm_per_N", HandTool::dial_gauge}}};
  effect.starts = {{0.002}, {0.02}};
  return effect;
}

}  // namespace fusee
