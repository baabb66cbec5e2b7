/// \file
/// Linear relations between keys of the mechanism file, parsed from text: "guides.EB_mm <= 0.5 * joint.length_mm".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism.h"

namespace fusee {

struct LinearTerm {
  std::string key;  ///< known to find_number_key()
  double factor = 0;

  bool operator==(const LinearTerm&) const = default;
};

/// constant + Σ factor · key, in the keys' units: lengths in mm. Keys are distinct and factors are not 0.
struct LinearExpression {
  std::vector<LinearTerm> terms;
  double constant = 0;

  double value(const DeclaredMechanism& mechanism) const;
};

enum class Relation { equal, at_most };

/// left = right, or left <= right ("a >= b" is stored as b <= a).
struct LinearRelation {
  Relation relation = Relation::equal;
  LinearExpression left;
  LinearExpression right;
};

/// Reason why a text is not a linear relation, with its byte offset.
struct RelationFault {
  std::size_t at = 0;
  std::string message;
  std::string hint;
};

struct ParsedRelation {
  LinearRelation relation;
  std::optional<RelationFault> fault;  ///< if set, the relation is invalid
};

/// Parses numbers, keys, + − * / and parentheses on both sides of one of = <= >=, written for a file of `units`. Terms
/// that are not linear in the keys are faults.
ParsedRelation parse_relation(std::string_view text, LengthUnit units = LengthUnit::mm);

/// True if a relation without faults means something else in an inch file: it has a length as a plain number.
bool depends_on_units(std::string_view text);

}  // namespace fusee
