/// \file
/// The types at namespace scope, read from the text of the sources.
#pragma once

#include <string>
#include <vector>

#include "pipeline/source_text.h"

namespace fusee::house {

/// A struct, class, union, enum or alias at namespace scope. Nested types, types in functions, declarations without
/// body and specialisations do not count.
struct TypeName {
  std::string scope;      ///< "fusee::cli"
  std::string name;       ///< "Column"
  bool one_file = false;  ///< in an unnamed namespace: invisible to other files
  std::string where;      ///< "src/cli/table.h:13"
};

std::vector<TypeName> types_of(const Source& source);

/// One line for each name of two types in one namespace: "fusee::Box: src/optimize/bound.h:13, export/…". Types of
/// unnamed namespaces may share a name: the compiler refuses a file that sees both.
std::vector<std::string> shared_names(const std::vector<TypeName>& types);

}  // namespace fusee::house
