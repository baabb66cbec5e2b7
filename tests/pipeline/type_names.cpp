#include "pipeline/type_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <regex>

namespace fusee::house {
namespace {

struct Word {
  std::string text;
  std::size_t at = 0;
};
/// Tokens since the last ; { or }.
using Head = std::vector<Word>;

/// The scope that a brace opens.
struct Scope {
  bool is_namespace = false;
  std::string name;  ///< "" for an unnamed namespace
};

bool is_name(const std::string& text) {
  return !text.empty() && (std::isalpha(static_cast<unsigned char>(text.front())) != 0 || text.front() == '_');
}
bool has(const Head& head, const std::string& text) {
  return std::any_of(head.begin(), head.end(), [&](const Word& word) { return word.text == text; });
}

/// True for keywords that begin a type.
bool is_keyword(const Word& word) {
  return word.text == "struct" || word.text == "class" || word.text == "union" || word.text == "enum";
}

/// Replaces preprocessor lines by blanks.
std::string without_directives(std::string code) {
  bool directive = false;
  for (std::size_t at = 0; at < code.size();) {
    const std::size_t end = std::min(code.find('\n', at), code.size());
    const std::size_t first = code.find_first_not_of(" \t", at);
    directive = directive || (first < end && code[first] == '#');
    const bool goes_on = end > at && code[end - 1] == '\\';
    if (directive)
      std::fill(code.begin() + static_cast<std::ptrdiff_t>(at), code.begin() + static_cast<std::ptrdiff_t>(end), ' ');
    directive = directive && goes_on;
    at = end + 1;
  }
  return code;
}

std::vector<Word> words_of(const std::string& code) {
  static const std::regex pattern("[A-Za-z_][A-Za-z_0-9]*|[0-9][A-Za-z_0-9.']*|::|\\S");
  std::vector<Word> words;
  for (std::sregex_iterator i(code.begin(), code.end(), pattern), end; i != end; ++i)
    words.push_back({i->str(), static_cast<std::size_t>(i->position())});
  return words;
}

/// Index after the bracket that closes the `open` at `at`.
std::size_t closed(const Head& head, std::size_t at, const std::string& open, const std::string& close) {
  int depth = 0;
  for (; at < head.size(); ++at) {
    depth += head[at].text == open ? 1 : head[at].text == close ? -1 : 0;
    if (depth == 0) return at + 1;
  }
  return at;
}

/// Removes `template <…>` before a declaration, and [[attributes]] in it.
Head declaration_of(const Head& head) {
  Head left;
  for (std::size_t at = 0; at < head.size();) {
    if (head[at].text == "[") {
      at = closed(head, at, "[", "]");
    } else if (head[at].text == "template") {
      at = closed(head, at + 1, "<", ">");
    } else {
      left.push_back(head[at++]);
    }
  }
  return left;
}

/// The type that a head before a body defines; nested types and specialisations define no name of their own.
std::optional<Word> defined_by(const Head& whole) {
  const Head head = declaration_of(whole);
  if (head.empty() || !is_keyword(head.front()) || has(head, "=") || has(head, "(")) return {};
  const std::size_t i = head.size() > 1 && is_keyword(head[1]) ? 2 : 1;  // enum class
  if (i >= head.size() || !is_name(head[i].text)) return {};
  const std::string next = i + 1 < head.size() ? head[i + 1].text : "";
  return next == "<" || next == "::" ? std::nullopt : std::optional(head[i]);
}

/// The alias that a head before a semicolon defines.
std::optional<Word> alias_of(const Head& whole) {
  const Head head = declaration_of(whole);
  if (head.size() > 2 && head[0].text == "using" && head[2].text == "=") return head[1];
  if (head.size() > 2 && head[0].text == "typedef") return head.back();
  return {};
}

Scope scope_of(const Head& head) {
  if (!has(head, "namespace")) return {};
  Scope scope{true, ""};
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (head[i].text != "namespace" && head[i].text != "inline") scope.name += head[i].text;
  }
  return scope;
}

class Finder {
 public:
  explicit Finder(const Source& source) : source_(source) {}

  std::vector<TypeName> types() {
    for (const Word& word : words_of(without_directives(code_of(source_.text)))) take(word);
    return std::move(types_);
  }

 private:
  void take(const Word& word) {
    if (word.text == "{") {
      add(defined_by(head_));
      scopes_.push_back(scope_of(head_));
    } else if (word.text == "}") {
      if (!scopes_.empty()) scopes_.pop_back();
    } else if (word.text == ";") {
      add(alias_of(head_));
    } else {
      head_.push_back(word);
      return;
    }
    head_.clear();
  }

  void add(const std::optional<Word>& name) {
    if (!name) return;
    TypeName type{"", name->text, false, source_.path + ":" + std::to_string(line_at(source_.text, name->at))};
    for (const Scope& scope : scopes_) {
      if (!scope.is_namespace) return;
      if (scope.name.empty()) type.one_file = true;
      if (!scope.name.empty()) type.scope += (type.scope.empty() ? "" : "::") + scope.name;
    }
    types_.push_back(std::move(type));
  }

  const Source& source_;
  Head head_;
  std::vector<Scope> scopes_;
  std::vector<TypeName> types_;
};

}  // namespace

std::vector<TypeName> types_of(const Source& source) { return Finder(source).types(); }

std::vector<std::string> shared_names(const std::vector<TypeName>& types) {
  std::map<std::string, std::vector<std::string>> places;
  for (const TypeName& type : types) {
    if (!type.one_file) places[type.scope + "::" + type.name].push_back(type.where);
  }
  std::vector<std::string> shared;
  for (const auto& [name, where] : places) {
    if (where.size() < 2) continue;
    std::string line = name + ": " + where.front();
    for (std::size_t i = 1; i < where.size(); ++i) line += ", " + where[i];
    shared.push_back(line);
  }
  return shared;
}

}  // namespace fusee::house
