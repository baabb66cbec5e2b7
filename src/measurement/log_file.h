/// \file
/// Internal: formats of logs. The first bytes of a file decide, not its name.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "measurement/bag_log.h"
#include "measurement/mcap.h"
#include "measurement/row_reader.h"

namespace fusee::measurement {

enum class LogFormat { csv, mcap, sqlite, zstd, ros1 };

/// The format of a file that begins with these bytes.
LogFormat format_of(std::string_view start);

/// Takes one file in blocks.
class LogFile {
 public:
  /// With `bag`, the file is one part of a bag in several files, and no CSV text. `name` must outlive this object.
  LogFile(const std::string& name, const MeasurementOptions& options, std::size_t most_samples, BagLog* bag = nullptr);

  void add(std::string_view block);
  /// Ends the file. `write_ahead_log` reads the file FILE-wal beside a database; called only if the database has one.
  void end(const std::function<std::string()>& write_ahead_log);
  /// The rows, after end().
  LoggedRows finish();

 private:
  void begin(LogFormat format);
  void take(std::string_view block);
  void unpack_held();

  const std::string& name_;
  MeasurementOptions options_;
  std::size_t most_samples_;
  BagLog* bag_;
  std::optional<BagLog> own_bag_;
  std::optional<LogFormat> format_;
  std::string held_;  ///< bytes until the format is known; then a whole database or packed file
  std::unique_ptr<CsvReader> csv_;
  std::unique_ptr<McapReader> mcap_;
  bool is_unpacked_ = false;  ///< the bytes come from a packed file
};

}  // namespace fusee::measurement
