/// \file
/// Which types stand at namespace scope, read from the text of the sources.
#pragma once

#include <string>
#include <vector>

#include "pipeline/source_text.h"

namespace fusee::house {

/// struct, class, union, enum or alias at namespace scope; members of types and what stands in functions do not count,
/// nor do declarations without a body and specialisations.
struct TypeName {
  std::string scope;      ///< "fusee::cli"
  std::string name;       ///< "Column"
  bool one_file = false;  ///< in an unnamed namespace: no other file can mean it
  std::string where;      ///< "src/cli/table.h:13"
};

std::vector<TypeName> types_of(const Source& source);

/// A line for each name that two types of one namespace have: "fusee::Box: src/optimize/bound.h:13, export/…".
/// Types of unnamed namespaces may share a name with any other: the compiler refuses the one file that would see both.
std::vector<std::string> shared_names(const std::vector<TypeName>& types);

}  // namespace fusee::house
