/// \file
/// Internal: reads one log of any format into samples: CSV, MCAP, or a bag of ROS 2. It is read in blocks, since a log
/// may exceed the memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/measurement.h"
#include "measurement/columns.h"

namespace fusee::measurement {

/// Largest number of rows kept of all files. A file beyond its share is thinned by halves.
constexpr std::size_t k_most_samples = std::size_t{1} << 20;

/// Rows of one file, in its order and in the units of Sample.
struct LoggedRows {
  std::vector<Sample> samples;  ///< every `stride`-th row that holds both angles
  std::vector<std::string> notes;
  std::vector<std::string> sources;  ///< topics and clock of a bag; unused columns of a table. No part of results
  std::string load_unit;
  bool has_time = false, has_load = false, has_temperature = false;
  joint::Mounting mounting;
  std::size_t rows = 0;               ///< in the file
  std::size_t without_angle = 0;      ///< rows without α or θ
  std::size_t without_theta = 0;      ///< those of them with α
  long long first_without_angle = 0;  ///< line number of the first of them
  std::size_t stride = 1;
};

/// Rows of a CSV text. Throws InputError (name:line:column) with all faults, up to a readable number. `name` and
/// `options` must outlive the reader.
class CsvReader {
 public:
  CsvReader(const std::string& name, const MeasurementOptions& options, std::size_t most_samples);
  ~CsvReader();
  CsvReader(const CsvReader&) = delete;
  CsvReader& operator=(const CsvReader&) = delete;

  void add(std::string_view block);
  LoggedRows finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Calls settle_units() for the rows, and records which columns they have.
void settle_rows(std::vector<Column>& columns, const MeasurementOptions& options, const std::string& name,
                 LoggedRows& rows);

/// Reads a file's content, whose first bytes decide its format. Throws InputError.
LoggedRows read_rows(std::string_view text, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples = k_most_samples);
/// Reads a file, or the folder of a bag; `name` appears in messages.
LoggedRows read_rows(const std::filesystem::path& path, const std::string& name, const MeasurementOptions& options,
                     FileAccess& access, std::size_t most_samples = k_most_samples);

/// Throws InputError for an unknown role, or a unit that does not fit the role.
void check_roles(const MeasurementOptions& options);

/// "1 row", "7 rows".
std::string rows_text(std::size_t count);

}  // namespace fusee::measurement
