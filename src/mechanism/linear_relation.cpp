#include "mechanism/linear_relation.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "mechanism/field_text.h"
#include "mechanism/lengths.h"

namespace fusee {
namespace {

constexpr int k_max_depth = 32;

bool is_key_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_key_part(char c) { return is_key_start(c) || is_digit(c) || c == '.' || c == '[' || c == ']'; }

void add_term(LinearExpression& expression, const LinearTerm& term, double factor) {
  auto same = std::find_if(expression.terms.begin(), expression.terms.end(),
                           [&](const LinearTerm& t) { return t.key == term.key; });
  if (same == expression.terms.end()) same = expression.terms.insert(same, {term.key, 0.0});
  same->factor += factor * term.factor;
  if (same->factor == 0) expression.terms.erase(same);
}

void add(LinearExpression& sum, const LinearExpression& other, double factor) {
  sum.constant += factor * other.constant;
  for (const LinearTerm& term : other.terms) add_term(sum, term, factor);
}

LinearExpression scaled(const LinearExpression& expression, double factor) {
  LinearExpression product;
  add(product, expression, factor);
  return product;
}

/// Converts a relation in the file's unit to mm. It is a relation between lengths if its left side names a length; if
/// the left side names no key, the right side decides. Its lengths keep their factors, so that the key of a tie keeps
/// the factor 1. Constants and the factors of other keys are converted.
void convert_to_mm(LinearRelation& relation, LengthUnit units) {
  const auto is_of_length = [](const LinearTerm& term) { return is_length(term.key); };
  const std::vector<LinearTerm>& left = relation.left.terms;
  const bool is_between_lengths =
      std::any_of(left.begin(), left.end(), is_of_length) ||
      (left.empty() && std::any_of(relation.right.terms.begin(), relation.right.terms.end(), is_of_length));
  for (LinearExpression* side : {&relation.left, &relation.right}) {
    if (is_between_lengths) side->constant = to_mm(side->constant, units);
    for (LinearTerm& term : side->terms) {
      if (is_between_lengths && !is_of_length(term)) term.factor = to_mm(term.factor, units);
      if (!is_between_lengths && is_of_length(term)) term.factor = from_mm(term.factor, units);
    }
  }
}

/// Recursive descent: sum → product {+− product}; product → factor {*/ factor}; factor → number | key | (sum) |
/// −factor. After a fault every function returns at once; the first fault is kept.
class RelationParser {
 public:
  explicit RelationParser(std::string_view text) : text_(text) {}

  ParsedRelation parse() {
    ParsedRelation parsed;
    LinearExpression left = sum();
    const std::string sign = relation_sign();
    LinearExpression right = sum();
    skip_blanks();
    if (!fault_ && at_ < text_.size())
      fail(at_, "unexpected " + in_quotes(text_.substr(at_, 1)), "one relation of two sums, such as a <= 0.5 * b + 10");
    if (!fault_ && left.terms.empty() && right.terms.empty()) fail(0, "names no key", "fusee explain lists the keys");
    if (sign == ">=") std::swap(left, right);
    parsed.relation = {sign == "=" ? Relation::equal : Relation::at_most, std::move(left), std::move(right)};
    parsed.fault = std::move(fault_);
    return parsed;
  }

 private:
  void fail(std::size_t at, std::string message, std::string hint) {
    if (!fault_) fault_ = RelationFault{at, std::move(message), std::move(hint)};
  }
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  /// The next non-blank character, or 0 at the end or after a fault.
  char next() {
    skip_blanks();
    return fault_ || at_ >= text_.size() ? '\0' : text_[at_];
  }

  std::string relation_sign() {
    const char c = next();
    const std::size_t begin = at_;
    const bool doubled = at_ + 1 < text_.size() && text_[at_ + 1] == '=';
    if ((c == '<' || c == '>') && doubled) {
      at_ += 2;
      return {c, '='};
    }
    if (c == '=' && !doubled) {
      ++at_;
      return "=";
    }
    fail(begin,
         c == '\0' ? "ends before its =, <= or >=" : "expected =, <= or >=, not " + in_quotes(text_.substr(begin, 1)),
         c == '<' || c == '>' ? "write <= or >=; strict relations are not supported"
                              : "one relation of two sums, such as a <= 0.5 * b + 10");
    return {};
  }

  LinearExpression sum() {
    LinearExpression total = product();
    for (char c = next(); c == '+' || c == '-'; c = next()) {
      ++at_;
      add(total, product(), c == '+' ? 1.0 : -1.0);
    }
    return total;
  }

  LinearExpression product() {
    LinearExpression total = factor();
    for (char c = next(); c == '*' || c == '/'; c = next()) {
      const std::size_t begin = at_++;
      const LinearExpression other = factor();
      if (fault_) break;
      if (c == '/') {
        if (!other.terms.empty() || other.constant == 0)
          fail(begin, "divides by something other than a nonzero number", "constraints are linear in the keys");
        total = scaled(total, 1.0 / other.constant);
      } else if (!total.terms.empty() && !other.terms.empty()) {
        fail(begin, "multiplies keys with each other", "constraints are linear: a number times a key");
      } else {
        total = total.terms.empty() ? scaled(other, total.constant) : scaled(total, other.constant);
      }
    }
    return total;
  }

  LinearExpression factor() {
    const char c = next();
    const std::size_t begin = at_;
    if (c == '-' || c == '+' || c == '(') {
      if (++depth_ > k_max_depth) fail(begin, "nests too deep", "a sum of keys times numbers is enough");
      ++at_;
      LinearExpression inner = c == '(' ? sum() : factor();
      if (c == '(' && next() == ')') {
        ++at_;
      } else if (c == '(') {
        fail(begin, "this ( is not closed", "add a )");
      }
      --depth_;
      return c == '-' ? scaled(inner, -1.0) : inner;
    }
    if (is_digit(c) || c == '.') return number();
    if (is_key_start(c)) return key();
    fail(begin,
         c == '\0' ? "ends where a number or a key should stand"
                   : "expected a number or a key, not " + in_quotes(text_.substr(begin, 1)),
         "one relation of two sums, such as a <= 0.5 * b + 10");
    return {};
  }

  LinearExpression number() {
    LinearExpression expression;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), expression.constant);
    if (error != std::errc() || !std::isfinite(expression.constant))
      fail(at_, "is not a number that can be used", "such as 0.5 or 2e3");
    at_ += static_cast<std::size_t>(end - begin);
    return expression;
  }

  LinearExpression key() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_key_part(text_[at_])) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (find_number_key(name)) return {{{name, 1.0}}, 0.0};
    const std::string nearest = nearest_word(name, number_key_names());
    fail(begin, in_quotes(name) + (find_field(name) ? " holds no single number" : " is not a key"),
         nearest.empty() ? "fusee explain lists the keys" : "did you mean " + nearest + "?");
    return {};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::optional<RelationFault> fault_;
};

}  // namespace

double LinearExpression::value(const DeclaredMechanism& mechanism) const {
  double total = constant;
  for (const LinearTerm& term : terms) total += term.factor * find_number_key(term.key)->get(mechanism);
  return total;
}

bool depends_on_units(std::string_view text) {
  const LinearRelation mm = parse_relation(text).relation, inch = parse_relation(text, LengthUnit::inch).relation;
  return mm.left.terms != inch.left.terms || mm.right.terms != inch.right.terms ||
         mm.left.constant != inch.left.constant || mm.right.constant != inch.right.constant;
}

ParsedRelation parse_relation(std::string_view text, LengthUnit units) {
  ParsedRelation parsed = RelationParser(text).parse();
  if (units != LengthUnit::mm) convert_to_mm(parsed.relation, units);
  return parsed;
}

}  // namespace fusee
