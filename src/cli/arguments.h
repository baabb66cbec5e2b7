/// \file
/// Parses the command line with CLI11; errors have fusee's own words (UsageError, exit 2).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism_file.h"

namespace fusee::cli {

struct Command;

/// The command line cannot be understood. Exit code 2.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message, std::string hint = {});
  const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

struct Option {
  std::string_view flags;  ///< "-o,--out"; the last flag is the option's name
  std::string_view value;  ///< "DIR"; "FILE..." takes all words up to the next option; "" for a switch
  std::string_view meaning;
  bool repeatable = false;
  std::string_view choices = {};  ///< "ac1015 r12": accepted words, if there are few

  std::string_view name() const { return flags.substr(flags.rfind(',') + 1); }
};

/// The largest value of --seed where it is a 32-bit number: 2³² − 1.
inline constexpr double k_largest_seed = 4294967295.0;

/// The options of every command, accepted before or after its name.
const std::vector<Option>& common_options();
/// The command's own options and common_options().
std::vector<Option> options_of(const Command& command);
/// The non-empty parts between separators.
std::vector<std::string> split(std::string_view text, char separator);

class Arguments {
 public:
  /// `words`: the arguments after the command's name. Throws UsageError.
  Arguments(const Command& command, const std::vector<std::string>& words);

  const std::vector<std::string>& positionals() const { return positionals_; }
  bool has(std::string_view option) const { return values_.count(std::string(option)) > 0; }
  std::optional<std::string> text(std::string_view option) const;
  /// The values of a repeatable option, in order; empty if it is not given.
  std::vector<std::string> texts(std::string_view option) const;
  /// A finite number within [least, most]; `fallback` if the option is not given. `unit` is for the message.
  double number(std::string_view option, double fallback, double least, double most, std::string_view unit) const;
  /// As number(), for whole numbers.
  double whole_number(std::string_view option, double fallback, double least, double most, std::string_view unit) const;
  /// The values of --set, in order.
  std::vector<Setting> settings() const;

 private:
  std::vector<std::string> positionals_;
  std::map<std::string, std::vector<std::string>> values_;  ///< given options; a switch has an empty list
};

/// Index of the command's name: the first word that is neither an option nor an option's value.
std::optional<std::size_t> find_command(const std::vector<std::string>& words);
/// True if a switch such as "--json" occurs anywhere, for use before or without parsing.
bool has_switch(const std::vector<std::string>& words, std::string_view option);

/// The folder of -o, or out/<name of the first argument><ending>. Settings of --set are part of that name: a trial does
/// not replace the output of the file.
std::filesystem::path output_folder(const Arguments& arguments, const std::string& ending = {});

}  // namespace fusee::cli
