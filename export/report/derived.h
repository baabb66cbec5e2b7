/// \file
/// Internal: numbers of a pulley that differ from its file's because the joint was identified.
#pragma once

#include <vector>

#include "fusee/joint.h"
#include "fusee/mechanism_file.h"

namespace fusee::formats {

/// The mechanism that the pulley is made for, and its fields that differ from the declared ones.
struct DerivedNumbers {
  DeclaredMechanism made;            ///< the declared mechanism with the numbers of the identified joint
  std::vector<const Field*> fields;  ///< fields with a value other than the declared one, in the order of the file
};

/// No fields if no identified number differs.
DerivedNumbers derived_numbers(const DeclaredMechanism& declared, const joint::IdentifiedJoint& joint);

/// A field's value in words, such as "-30 to 30 deg" or "table".
std::string field_words(const Field& field, const DeclaredMechanism& mechanism);

}  // namespace fusee::formats
