/// \file
/// Which numbers of a made pulley are not those that its file declares, because the joint was identified to be another.
#pragma once

#include <vector>

#include "fusee/joint/as_it_is.h"
#include "fusee/mechanism/fields.h"

namespace fusee {

/// A declared key and what it became in the joint as it is.
struct DerivedNumber {
  const Field* field = nullptr;
  DeclaredMechanism made;  ///< whose value of the field is what was made for
};

/// In the order of the file; none where nothing was identified that moves a number.
std::vector<DerivedNumber> derived_numbers(const DeclaredMechanism& declared, const JointAsItIs& joint);

/// "-30 to 30 deg", "table".
std::string field_words(const Field& field, const DeclaredMechanism& mechanism);

}  // namespace fusee
