/// \file
/// The command line taken apart: CLI11 does the splitting; what is wrong is said in our own words (UsageError, exit 2).
#pragma once

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism/file.h"

namespace fusee::cli {

struct Command;

/// The command line cannot be understood. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(std::string message, std::string hint = {});
  const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

struct Option {
  std::string_view flags;  ///< "-o,--out"; the last one names it
  std::string_view value;  ///< "DIR"; "FILE...": all words up to the next option; "" for a switch
  std::string_view meaning;
  bool repeatable = false;
  std::string_view choices = {};  ///< "ac1015 r12": the words that it takes, where they are few

  std::string_view name() const { return flags.substr(flags.rfind(',') + 1); }
};

/// The options that every command takes, before or after its name.
const std::vector<Option>& common_options();
/// All that a command takes: its own, and those.
std::vector<Option> options_of(const Command& command);
/// The parts between separators that are not empty.
std::vector<std::string> split(std::string_view text, char separator);

class Arguments {
 public:
  /// What follows the program's name, without the command. Throws UsageError.
  Arguments(const Command& command, const std::vector<std::string>& words);

  const std::vector<std::string>& positionals() const { return positionals_; }
  bool has(std::string_view option) const { return values_.count(std::string(option)) > 0; }
  std::optional<std::string> text(std::string_view option) const;
  /// Of a repeatable option, in order; empty when it is not given.
  std::vector<std::string> texts(std::string_view option) const;
  /// A finite number within [least, most], or `fallback` when the option is not given. `unit` stands in the message.
  double number(std::string_view option, double fallback, double least, double most, std::string_view unit) const;
  /// All --set, in order.
  std::vector<Setting> settings() const;

 private:
  std::vector<std::string> positionals_;
  std::map<std::string, std::vector<std::string>> values_;
};

/// The place of the command's name among `words`: the first that is neither an option nor an option's value.
std::optional<std::size_t> find_command(const std::vector<std::string>& words);
/// Whether a switch such as "--json" stands anywhere, for the time before (or without) a proper parse.
bool has_switch(const std::vector<std::string>& words, std::string_view option);

}  // namespace fusee::cli
