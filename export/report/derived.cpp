#include "export/report/derived.h"

#include "base/text.h"

namespace fusee::formats {
namespace {

bool is_same(const Field& field, const DeclaredMechanism& a, const DeclaredMechanism& b) {
  switch (field.kind) {
    case FieldKind::number:
      return field.get(a, 0) == field.get(b, 0);
    case FieldKind::range:
    case FieldKind::point:
      return field.get(a, 0) == field.get(b, 0) && field.get(a, 1) == field.get(b, 1);
    case FieldKind::choice:
    case FieldKind::text:
    case FieldKind::boolean:
      return field.get_text(a) == field.get_text(b);
    case FieldKind::numbers:
    case FieldKind::texts:
      return true;  // lists are input and never derived
  }
  return true;
}

}  // namespace

DerivedNumbers derived_numbers(const DeclaredMechanism& declared, const joint::IdentifiedJoint& joint) {
  DerivedNumbers derived{declared, {}};
  static_cast<Mechanism&>(derived.made) = joint.mechanism;
  if (declared.transmission) return derived;
  for (const Field& field : fields()) {
    if (field.table != "transmission" && !is_same(field, declared, derived.made)) derived.fields.push_back(&field);
  }
  return derived;
}

std::string field_words(const Field& field, const DeclaredMechanism& mechanism) {
  const std::string unit = field.unit.empty() ? "" : " " + std::string(field.unit);
  if (field.kind == FieldKind::number) return rounded(field.get(mechanism, 0)) + unit;
  if (field.kind == FieldKind::range)
    return rounded(field.get(mechanism, 0)) + " to " + rounded(field.get(mechanism, 1)) + unit;
  if (field.kind == FieldKind::point)
    return "[" + rounded(field.get(mechanism, 0)) + ", " + rounded(field.get(mechanism, 1)) + "]" + unit;
  return field.get_text(mechanism);
}

}  // namespace fusee::formats
