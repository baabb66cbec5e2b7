/// \file
/// Internal: from the bytes of one CSV file to samples. Read in blocks: a log may be larger than the memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/measurement/measurement.h"

namespace fusee {

/// Rows kept of all files together; beyond a file's share every second one goes, again and again.
constexpr std::size_t k_most_samples = std::size_t{1} << 20;

/// The rows of one file in its order, in the units of Sample.
struct LoggedRows {
  std::vector<Sample> samples;  ///< every `stride`-th row that holds both angles
  std::vector<std::string> notes;
  std::string load_unit;
  bool has_time = false, has_load = false, has_temperature = false;
  Mounting mounting;
  std::size_t rows = 0;  ///< in the file
  std::size_t without_angle = 0;
  std::size_t without_theta = 0;      ///< of these: with α alone
  long long first_without_angle = 0;  ///< line
  std::size_t stride = 1;
};

/// InputError (name:line:column) with all that is wrong, up to a number that a person can read.
LoggedRows read_rows(std::string_view text, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples = k_most_samples);
/// The same of a file; `name` stands in the messages.
LoggedRows read_rows(const std::filesystem::path& path, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples = k_most_samples);

/// InputError for a role that no column can have, or a unit that a role cannot.
void check_roles(const MeasurementOptions& options);

/// "1 row", "7 rows".
std::string rows_text(std::size_t count);

}  // namespace fusee
