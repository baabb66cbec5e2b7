#include <vector>

#include "mechanism/effects/attachment.h"

namespace fusee {
namespace {

std::vector<ManualReading> across2_by_caliper(const DeclaredMechanism& declared) {
  if (!declared.joint.attachment2) return {};
  return hand_reading(declared.prior.attachment2_across, declared.joint.attachment2->across);
}
std::vector<ManualReading> along2_by_caliper(const DeclaredMechanism& declared) {
  if (!declared.joint.attachment2) return {};
  return hand_reading(declared.prior.attachment2_along, declared.joint.attachment2->along);
}

}  // namespace

Effect attachment2_place(JointKind) {
  Effect effect = attachment_effect(2);
  effect.name = "attachment2_place";
  effect.parameters = {
      attachment_part(
          "across_mm", [](Imperfections& at) -> double& { return at.joint.end2.across; },
          key::plain("attachment2_across_mm", "mm", -10000, 10000, "added to the first number of joint.attachment2_mm"),
          {"measure how far to the right of the joint's axis tendon 2 ends at home and enter it as "
           "prior.attachment2_across_mm",
           k_caliper, across2_by_caliper, "prior.attachment2_across_mm"},
          {"tendon 2 ends further left", "tendon 2 ends further right"}),
      attachment_part(
          "along_mm", [](Imperfections& at) -> double& { return at.joint.end2.along; },
          key::plain("attachment2_along_mm", "mm", -10000, 10000, "added to the second number of joint.attachment2_mm"),
          {"measure how far along the link from the joint's axis tendon 2 ends and enter it as "
           "prior.attachment2_along_mm",
           k_caliper, along2_by_caliper, "prior.attachment2_along_mm"},
          {"tendon 2 ends nearer to the axis", "tendon 2 ends further along the link"})};
  return effect;
}

}  // namespace fusee
