#include <vector>

#include "mechanism/effects/attachment.h"

namespace fusee {
namespace {

std::vector<ManualReading> across1_by_caliper(const DeclaredMechanism& declared) {
  if (!declared.joint.attachment1) return {};
  return hand_reading(declared.prior.attachment1_across, declared.joint.attachment1->across);
}
std::vector<ManualReading> along1_by_caliper(const DeclaredMechanism& declared) {
  if (!declared.joint.attachment1) return {};
  return hand_reading(declared.prior.attachment1_along, declared.joint.attachment1->along);
}

}  // namespace

Effect attachment1_place(JointKind) {
  Effect effect = attachment_effect(1);
  effect.name = "attachment1_place";
  effect.parameters = {
      attachment_part(
          "across_mm", [](Imperfections& at) -> double& { return at.joint.end1.across; },
          key::plain("attachment1_across_mm", "mm", -10000, 10000, "added to the first number of joint.attachment1_mm"),
          {"measure how far to the right of the joint's axis tendon 1 ends at home and enter it as "
           "prior.attachment1_across_mm",
           k_caliper, across1_by_caliper, "prior.attachment1_across_mm"},
          {"tendon 1 ends further left", "tendon 1 ends further right"}),
      attachment_part(
          "along_mm", [](Imperfections& at) -> double& { return at.joint.end1.along; },
          key::plain("attachment1_along_mm", "mm", -10000, 10000, "added to the second number of joint.attachment1_mm"),
          {"measure how far along the link from the joint's axis tendon 1 ends and enter it as "
           "prior.attachment1_along_mm",
           k_caliper, along1_by_caliper, "prior.attachment1_along_mm"},
          {"tendon 1 ends nearer to the axis", "tendon 1 ends further along the link"})};
  return effect;
}

}  // namespace fusee
