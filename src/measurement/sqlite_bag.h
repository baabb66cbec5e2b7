/// \file
/// Internal: reads the SQLite files of ros2 bag.
#pragma once

#include <string>
#include <string_view>

#include "measurement/bag_log.h"

namespace fusee::measurement {

constexpr std::string_view k_sqlite_magic("SQLite format 3", 16);  // with its final 0
/// Bytes. A database is read from memory.
constexpr std::size_t k_largest_database = std::size_t{2} << 30;

/// True if the database has a write-ahead log beside it, FILE-wal, that belongs to it.
bool has_write_ahead_log(std::string_view database);

/// Takes all messages, in the order of recording. `write_ahead_log`: the content of FILE-wal, "" without one. A file
/// that is cut off or damaged is read as far as it goes, with a note. Throws InputError (`name`) if it is no bag.
void read_sqlite_bag(std::string database, std::string_view write_ahead_log, const std::string& name, BagLog& into);

}  // namespace fusee::measurement
