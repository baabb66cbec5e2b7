/// \file
/// Linear relations between keys of the mechanism file, from text: "guides.EB_mm <= 0.5 * joint.length_mm".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/mechanism.h"

namespace fusee {

struct LinearTerm {
  std::string key;  ///< known to find_number_key()
  double factor = 0;
};

/// constant + Σ factor · key, in the file's units. No key stands twice and no factor is 0.
struct LinearExpression {
  std::vector<LinearTerm> terms;
  double constant = 0;

  double value(const DeclaredMechanism& mechanism) const;
};

enum class Relation { equal, at_most };

/// left = right, or left <= right ("a >= b" is read as b <= a).
struct LinearRelation {
  Relation relation = Relation::equal;
  LinearExpression left;
  LinearExpression right;
};

/// Why a text is no linear relation, and where: bytes from its beginning.
struct RelationFault {
  std::size_t at = 0;
  std::string message;
  std::string hint;
};

struct ParsedRelation {
  LinearRelation relation;
  std::optional<RelationFault> fault;  ///< set: the relation is worth nothing
};

/// Numbers, keys, + − * / and parentheses on both sides of one of = <= >=. What is not linear in the keys is a fault.
ParsedRelation parse_relation(std::string_view text);

}  // namespace fusee
