/// \file
/// Which numbers of a made pulley are not those that its file declares, because the joint was identified to be another.
#pragma once

#include <vector>

#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/fields.h"

namespace fusee {

/// What was made for, key by key of the file.
struct DerivedNumbers {
  DeclaredMechanism made;            ///< the file with the numbers of the joint as it is
  std::vector<const Field*> fields;  ///< whose value there is not the declared one, in the order of the file
};

/// No fields where nothing was identified that moves a number.
DerivedNumbers derived_numbers(const DeclaredMechanism& declared, const JointAsItIs& joint);

/// "-30 to 30 deg", "table".
std::string field_words(const Field& field, const DeclaredMechanism& mechanism);

}  // namespace fusee
