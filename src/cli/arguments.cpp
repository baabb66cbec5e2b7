#include "cli/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "cli/command.h"
#include "fusee/base.h"

namespace fusee::cli {
namespace {

std::string nearest_option(const std::string& word, const std::vector<Option>& options) {
  std::vector<std::string> names;
  for (const Option& option : options) names.emplace_back(option.name());
  return nearest_word(word.substr(0, word.find('=')), names);
}

UsageError unknown_option(const std::string& word, const Command& command, const std::vector<Option>& options) {
  const std::string nearest = nearest_option(word, options);
  const std::string help = "'fusee " + std::string(command.name) + " --help' lists the options";
  return UsageError("unknown option '" + word + "'", nearest.empty() ? help : "did you mean '" + nearest + "'?");
}

UsageError value_missing(const Option& option) {
  std::string meaning(option.meaning);
  std::replace(meaning.begin(), meaning.end(), '\n', ' ');
  const std::string name(option.name());
  return UsageError(name + " needs a value: " + name + " " + std::string(option.value), meaning);
}

/// CLI11's messages name its types and counts. Each of its errors is an option whose value is missing or unexpected.
UsageError usage_error_for(const CLI::ParseError& error, const CLI::App& app, const Command& command,
                           const std::vector<Option>& options) {
  const std::string message = error.what();
  if (const std::vector<std::string> unknown = app.remaining(); !unknown.empty())
    return unknown_option(unknown.front(), command, options);
  for (const Option& option : options) {
    const std::string name(option.name());
    if (message.find(name) != std::string::npos) return value_missing(option);
  }
  return UsageError(message);
}

/// CLI11 would accept --json=3 as --json.
void refuse_switch_values(const std::vector<Option>& options, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--") return;
    for (const Option& option : options) {
      const std::string name(option.name());
      if (option.value.empty() && word.rfind(name + "=", 0) == 0)
        throw UsageError(name + " is a switch and takes no value");
    }
  }
}

void check_count(const Command& command, const std::vector<std::string>& given) {
  const std::vector<std::string> expected = split(command.positionals, ' ');
  const std::string usage = "usage: fusee " + synopsis(command);
  const bool open_ended = command.positionals.ends_with("...");
  if (given.size() > expected.size() && !open_ended) {
    throw UsageError(
        "'" + given[expected.size()] + "' is one argument too many for '" + std::string(command.name) + "'", usage);
  }
  for (std::size_t i = given.size(); i < expected.size(); ++i) {
    if (expected[i][0] != '[') throw UsageError("'" + std::string(command.name) + "' needs " + expected[i], usage);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i].empty()) throw UsageError(expected[std::min(i, expected.size() - 1)] + " is empty", usage);
  }
}

void check_values(const Option& option, const std::vector<std::string>& values) {
  const std::string name(option.name());
  if (values.size() > 1 && !option.repeatable)
    throw UsageError(name + " is given " + std::to_string(values.size()) + " times");
  for (const std::string& value : values) {
    if (value.empty() || value.rfind("--", 0) == 0) throw value_missing(option);
  }
}

/// True for an option whose value is the next word. Switches of one letter ("-qv") and values in the same word
/// ("--set=a.b=1", "-oDIR") take no further word.
bool takes_next_word(const std::string& word) {
  for (const Command& command : commands()) {
    for (const Option& option : options_of(command)) {
      if (option.value.empty()) continue;
      const std::vector<std::string> flags = split(option.flags, ',');
      if (std::find(flags.begin(), flags.end(), word) != flags.end()) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(separator), text.size());
    if (end > 0) parts.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

std::vector<Option> options_of(const Command& command) {
  std::vector<Option> options = command.options;
  options.insert(options.end(), common_options().begin(), common_options().end());
  return options;
}

UsageError::UsageError(const std::string& message, std::string hint)
    : std::runtime_error(message), hint_(std::move(hint)) {}

const std::vector<Option>& common_options() {
  static const std::vector<Option> options = {
      {"--json", "", "print one JSON document on stdout, and nothing else"},
      {"--set", "KEY=VALUE", "use VALUE for a key of the mechanism file, such as\npulley.r1_mm=18; repeatable", true},
      {"--force", "", "overwrite files that fusee did not write"},
      {"--dry-run", "", "do everything except writing files"},
      {"--bundle", "FILE",
       "pack options, version and all input files into FILE,\na zip, also if the run fails; 'fusee replay' reruns it"},
      {"-q,--quiet", "", "print errors only: no warnings, no progress"},
      {"-v,--verbose", "", "print each step and every check"},
      {"--no-color", "", "no colours; the variable NO_COLOR does the same"},
      {"-h,--help", "", "print this help"},
      {"--version", "", "print the version"},
  };
  return options;
}

Arguments::Arguments(const Command& command, const std::vector<std::string>& words) {
  const std::vector<Option> options = options_of(command);
  refuse_switch_values(options, words);
  std::map<std::string, bool> switches;
  CLI::App app;
  app.set_help_flag();
  app.add_option("arguments", positionals_);
  for (const Option& option : options) {
    const std::string name(option.name());
    if (option.value.empty()) {
      app.add_flag(std::string(option.flags), switches[name]);
    } else {
      CLI::Option* const added = app.add_option(std::string(option.flags), values_[name]);
      const bool takes_several = option.value.ends_with("...");
      takes_several ? added->expected(1, CLI::detail::expected_max_vector_size) : added->expected(1);
      added->allow_extra_args(takes_several)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 reads from the back
  } catch (const CLI::ParseError& error) {
    throw usage_error_for(error, app, command, options);
  }
  for (const Option& option : options) {
    const std::string name(option.name());
    const bool is_switch = option.value.empty();
    const bool is_given = is_switch ? switches[name] : !values_[name].empty();
    if (!is_given)
      values_.erase(name);
    else if (is_switch)
      values_.try_emplace(name);  // without values: has() asks for the name only
    else
      check_values(option, values_[name]);
  }
  if (!has("--help") && !has("--version")) check_count(command, positionals_);
}

std::optional<std::string> Arguments::text(std::string_view option) const {
  const auto found = values_.find(std::string(option));
  if (found == values_.end()) return std::nullopt;
  return found->second.front();
}

std::vector<std::string> Arguments::texts(std::string_view option) const {
  const auto found = values_.find(std::string(option));
  return found == values_.end() ? std::vector<std::string>() : found->second;
}

double Arguments::number(std::string_view option, double fallback, double least, double most,
                         std::string_view unit) const {
  const std::optional<std::string> given = text(option);
  if (!given) return fallback;
  double value = 0;
  const char* end = given->data() + given->size();
  const auto [stop, error] = std::from_chars(given->data(), end, value);
  const bool is_number = error == std::errc() && stop == end;
  if (!is_number || !std::isfinite(value) || value < least || value > most) {
    throw UsageError(std::string(option) + " must be a number from " + shortest(least) + " to " + shortest(most) + " " +
                     std::string(unit) + "; '" + *given + "' is not");
  }
  return value;
}

double Arguments::whole_number(std::string_view option, double fallback, double least, double most,
                               std::string_view unit) const {
  const double value = number(option, fallback, least, most, unit);
  if (value == std::floor(value)) return value;
  throw UsageError(std::string(option) + " must be a whole number; '" + *text(option) + "' is not");
}

std::vector<Setting> Arguments::settings() const {
  const auto found = values_.find("--set");
  if (found == values_.end()) return {};
  std::vector<Setting> settings;
  for (const std::string& text : found->second) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw UsageError("--set takes table.key=value; '" + text + "' is not of that form",
                       "for example: --set pulley.r1_mm=18");
    }
    const auto without_blanks = [](const std::string& part) {
      const std::size_t first = part.find_first_not_of(" \t");
      return first == std::string::npos ? "" : part.substr(first, part.find_last_not_of(" \t") - first + 1);
    };
    settings.push_back({without_blanks(text.substr(0, equals)), without_blanks(text.substr(equals + 1))});
  }
  return settings;
}

namespace {

/// ".pulley.r1_mm=15" for each setting. Characters that a shell or a file system may not take become "_", and a long
/// name is cut off; then a hash keeps different settings apart.
std::string settings_in_name(const std::vector<Setting>& settings) {
  constexpr std::size_t k_longest = 80;
  constexpr std::string_view k_safe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+=";
  std::string all;
  for (const Setting& setting : settings) all += "." + setting.key + "=" + setting.value;
  std::string name = all.substr(0, k_longest);
  for (char& c : name) {
    if (k_safe.find(c) == std::string_view::npos) c = '_';
  }
  return name == all ? name : name + "." + sha256(all).substr(0, 8);
}

}  // namespace

std::filesystem::path output_folder(const Arguments& arguments, const std::string& ending) {
  if (const auto folder = arguments.text("--out")) return *folder;
  const std::filesystem::path spec = arguments.positionals().front();
  // The stems of "..toml" and "...toml" are no folder names but "." and "..".
  const std::filesystem::path stem = spec.stem();
  const std::string name = (stem == "." || stem == ".." ? spec.filename() : stem).string();
  return std::filesystem::path("out") / (name + ending + settings_in_name(arguments.settings()));
}

std::optional<std::size_t> find_command(const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--") return i + 1 < words.size() ? std::optional(i + 1) : std::nullopt;
    if (words[i].size() < 2 || words[i][0] != '-') return i;
    if (takes_next_word(words[i])) ++i;
  }
  return std::nullopt;
}

bool has_switch(const std::vector<std::string>& words, std::string_view option) {
  const auto end = std::find(words.begin(), words.end(), "--");
  return std::find(words.begin(), end, option) != end;
}

}  // namespace fusee::cli
