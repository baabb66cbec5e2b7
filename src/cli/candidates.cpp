#include "cli/candidates.h"

#include <algorithm>

#include "cli/command.h"
#include "fusee/mechanism_file.h"

namespace fusee::cli {
namespace {

/// Splits a line like a shell, with quotes and backslashes removed; the last word is being typed.
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words = {""};
  char quote = 0;  // the open quote, if any
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote == 0 && (c == ' ' || c == '\t')) {
      if (!words.back().empty()) words.emplace_back();
    } else if (c == '\\' && quote != '\'' && i + 1 < line.size()) {
      words.back() += line[++i];
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (quote != 0 && c == quote) {
      quote = 0;
    } else {
      words.back() += c;
    }
  }
  return words;
}

std::string one_line(std::string_view meaning) {
  std::string text(meaning);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

const Option* option_named(const std::vector<Option>& options, const std::string& word) {
  const auto found = std::find_if(options.begin(), options.end(), [&word](const Option& option) {
    const std::vector<std::string> flags = split(option.flags, ',');
    return std::find(flags.begin(), flags.end(), word) != flags.end();
  });
  return found == options.end() ? nullptr : &*found;
}

Json fields_of_a_mechanism() { return parse_json(explain_json(""))["fields"]; }

/// Keys such as "pulley.r1_mm="; after "=" the words that the key accepts, such as "pulley.law=compensate".
Candidates settings(const std::string& typed) {
  Candidates found;
  const std::string key = typed.substr(0, typed.find('='));
  const bool wants_value = key.size() < typed.size();
  for (const Json& field : fields_of_a_mechanism()) {
    const std::string name = field["name"];
    if (!wants_value) {
      found.words.push_back({name + "=", field["meaning"]});
      continue;
    }
    const char* const list = field.contains("known") ? "known" : "choices";
    if (name != key || !field.contains(list)) continue;
    for (const Json& choice : field[list]) found.words.push_back({key + "=" + choice.get<std::string>(), ""});
  }
  found.goes_on = !wants_value;
  return found;
}

Candidates keys() {
  Candidates found;
  for (const Json& field : fields_of_a_mechanism()) found.words.push_back({field["name"], field["meaning"]});
  return found;
}

Candidates names_of_commands() {
  Candidates found;
  for (const Command& command : commands())
    found.words.push_back({std::string(command.name), std::string(command.summary)});
  return found;
}

Candidates names_of_templates() {
  Candidates found;
  for (const Template& known : templates()) found.words.push_back({std::string(known.name), known.description});
  return found;
}

Candidates files(const std::string& ending = "") {
  Candidates found;
  found.files = true;
  found.ending = ending;
  return found;
}

Candidates values(const Option& option, const std::string& typed) {
  if (option.value == "KEY=VALUE") return settings(typed);
  if (option.value.starts_with("FILE") || option.value == "DIR") return files();
  if (option.value.ends_with(".toml")) return files(".toml");
  Candidates found;
  for (const std::string& word : split(option.choices, ' ')) found.words.push_back({word, ""});
  return found;
}

Candidates names_of_options(const std::vector<Option>& options) {
  Candidates found;
  for (const Option& option : options) found.words.push_back({std::string(option.name()), one_line(option.meaning)});
  return found;
}

/// Candidates for an argument by its name in the usage line, such as "SPEC RUN.csv...".
Candidates argument_candidates(const Command& command, std::size_t index) {
  const std::vector<std::string> expected = split(command.positionals, ' ');
  if (expected.empty() || (index >= expected.size() && !command.positionals.ends_with("..."))) return {};
  const std::string& name = expected[std::min(index, expected.size() - 1)];
  const auto contains = [&name](const char* word) { return name.find(word) != std::string::npos; };
  if (contains("TEMPLATE")) return names_of_templates();
  if (contains("KEY")) return keys();
  if (contains("COMMAND")) return names_of_commands();
  if (contains("SHELL")) {
    Candidates shells;
    for (const char* shell : {"bash", "zsh", "fish"}) shells.words.push_back({shell, ""});
    return shells;
  }
  if (contains("SPEC")) return files(".toml");
  if (contains(".csv")) return files(".csv");
  return files();
}

/// All possible words at this place, including those that do not begin as typed.
Candidates unfiltered_candidates(const std::vector<std::string>& words, const std::string& typed) {
  const std::vector<std::string> before(words.begin(), words.end() - 1);
  const auto command_index = find_command(before);
  const auto known = std::find_if(commands().begin(), commands().end(), [&](const Command& command) {
    return command_index && command.name == before[*command_index];
  });
  if (command_index && known == commands().end()) return {};
  const std::vector<Option> options = command_index ? options_of(*known) : common_options();
  const Option* previous = before.empty() ? nullptr : option_named(options, before.back());
  if (previous != nullptr && !previous->value.empty()) return values(*previous, typed);
  if (typed.rfind('-', 0) == 0) return names_of_options(options);
  if (!command_index) return names_of_commands();
  std::size_t argument_count = 0;
  const Option* takes_more = nullptr;  // the last option, if it takes all words up to the next one
  for (std::size_t i = *command_index + 1; i < before.size(); ++i) {
    const Option* option = option_named(options, before[i]);
    if (option != nullptr) takes_more = option->value.ends_with("...") ? option : nullptr;
    if (option != nullptr && !option->value.empty()) ++i;
    if (option == nullptr && before[i].rfind('-', 0) != 0) ++argument_count;
  }
  return takes_more != nullptr ? values(*takes_more, typed) : argument_candidates(*known, argument_count);
}

}  // namespace

Candidates candidates(std::string_view line) {
  std::vector<std::string> words = words_of(line);
  if (words.size() < 2) return {};  // only the program's name
  words.erase(words.begin());
  Candidates found = unfiltered_candidates(words, words.back());
  found.words.erase(std::remove_if(found.words.begin(), found.words.end(),
                                   [&](const Candidate& one) { return one.word.rfind(words.back(), 0) != 0; }),
                    found.words.end());
  return found;
}

}  // namespace fusee::cli
