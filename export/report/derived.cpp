#include "export/report/derived.h"

#include "fusee/base/text.h"

namespace fusee {
namespace {

bool is_same(const Field& field, const DeclaredMechanism& a, const DeclaredMechanism& b) {
  switch (field.kind) {
    case FieldKind::number:
      return field.get(a, 0) == field.get(b, 0);
    case FieldKind::range:
      return field.get(a, 0) == field.get(b, 0) && field.get(a, 1) == field.get(b, 1);
    case FieldKind::choice:
    case FieldKind::text:
    case FieldKind::boolean:
      return field.get_text(a) == field.get_text(b);
    case FieldKind::numbers:
    case FieldKind::texts:
      return true;  // lists ask and are not made
  }
  return true;
}

}  // namespace

std::vector<DerivedNumber> derived_numbers(const DeclaredMechanism& declared, const JointAsItIs& joint) {
  DeclaredMechanism made = declared;
  static_cast<Mechanism&>(made) = joint.mechanism;
  std::vector<DerivedNumber> derived;
  if (declared.transmission) return derived;
  for (const Field& field : fields()) {
    if (field.table != "transmission" && !is_same(field, declared, made)) derived.push_back({&field, made});
  }
  return derived;
}

std::string field_words(const Field& field, const DeclaredMechanism& mechanism) {
  const std::string unit = field.unit.empty() ? "" : " " + std::string(field.unit);
  if (field.kind == FieldKind::number) return rounded(field.get(mechanism, 0)) + unit;
  if (field.kind == FieldKind::range)
    return rounded(field.get(mechanism, 0)) + " to " + rounded(field.get(mechanism, 1)) + unit;
  return field.get_text(mechanism);
}

}  // namespace fusee
