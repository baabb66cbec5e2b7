#include "measurement/sqlite_bag.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>

namespace fusee::measurement {
namespace {

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8U) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void put_big_endian(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (8 * (3 - i)));
}

// ---- file format (sqlite.org/fileformat.html) -----------------------------------------------------------------------

constexpr std::size_t k_header_size = 100;
// Offsets in the header of a database.
constexpr std::size_t k_write_version = 18, k_read_version = 19;  // value 2: with a write-ahead log
constexpr std::size_t k_page_count = 28;
constexpr std::size_t k_change_counter = 24, k_valid_for = 92;  // the page count is valid if these two agree

std::size_t page_size(std::string_view database) {
  const std::size_t size = big_endian(database, 14) & 0xFFFFU;  // bytes 16 and 17
  return size == 1 ? 65536 : size;                              // 1 stands for 65536
}

/// Running checksum of a write-ahead log, over pairs of 32-bit words.
struct Checksum {
  std::uint32_t first = 0, second = 0;
  bool is_big_endian = false;

  void add(std::string_view bytes) {
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first += word(bytes, at) + second;
      second += word(bytes, at + 4) + first;
    }
  }

 private:
  std::uint32_t word(std::string_view bytes, std::size_t at) const {
    const std::uint32_t value = big_endian(bytes, at);
    return is_big_endian ? value
                         : (value >> 24U) | ((value >> 8U) & 0xFF00U) | ((value << 8U) & 0xFF0000U) | (value << 24U);
  }
};

/// Puts the committed pages of a write-ahead log into the database. A recorder that was killed had not moved them yet.
void apply_write_ahead_log(std::string_view log, std::string& database) {
  constexpr std::size_t k_log_header = 32, k_frame_header = 24;  // bytes
  constexpr std::uint32_t k_magic = 0x377F0682U;                 // its last bit: checksums are big endian
  const std::size_t size = page_size(database);
  if (log.size() < k_log_header || (big_endian(log, 0) & ~1U) != k_magic || big_endian(log, 8) != size) return;
  Checksum sum;
  sum.is_big_endian = (big_endian(log, 0) & 1U) != 0;
  sum.add(log.substr(0, 24));
  if (sum.first != big_endian(log, 24) || sum.second != big_endian(log, 28)) return;
  const std::string_view salt = log.substr(16, 8);
  std::map<std::uint32_t, std::string_view> pages;  // of the current transaction
  for (std::size_t at = k_log_header; at + k_frame_header + size <= log.size(); at += k_frame_header + size) {
    const std::string_view head = log.substr(at, k_frame_header), page = log.substr(at + k_frame_header, size);
    sum.add(head.substr(0, 8));
    sum.add(page);
    if (head.substr(8, 8) != salt || sum.first != big_endian(head, 16) || sum.second != big_endian(head, 20)) return;
    const std::uint32_t number = big_endian(head, 0);              // of the page, from 1
    const std::uint32_t pages_after_commit = big_endian(head, 4);  // 0 for all but the last frame of a transaction
    if (number == 0) return;
    pages[number] = page;
    if (pages_after_commit == 0) continue;
    const bool is_too_large = pages_after_commit > k_largest_database / size ||
                              pages_after_commit > (database.size() + log.size()) / size + 1;
    if (is_too_large || pages.rbegin()->first > pages_after_commit) return;
    database.resize(pages_after_commit * size);
    for (const auto& [index, bytes] : pages) std::memcpy(database.data() + (index - 1) * size, bytes.data(), size);
    pages.clear();
  }
}

/// Makes a file that is cut off readable: it is reduced to its whole pages. True if pages are missing.
bool cut_to_whole_pages(std::string& database) {
  const std::size_t size = page_size(database), pages = database.size() / size;
  const bool is_count_valid = big_endian(database, k_change_counter) == big_endian(database, k_valid_for);
  const bool is_cut_off = database.size() % size != 0 || (is_count_valid && pages < big_endian(database, k_page_count));
  database.resize(pages * size);
  put_big_endian(database, k_page_count, static_cast<std::uint32_t>(pages));
  return is_cut_off;
}

// ---- queries --------------------------------------------------------------------------------------------------------

struct SqliteCloser {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// A read-only database in memory. It may be untrusted: views, triggers and functions in its schema are disabled.
class Database {
 public:
  explicit Database(std::string& bytes) {
    sqlite3* opened = nullptr;
    const int code = sqlite3_open_v2(":memory:", &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
    database_.reset(opened);
    demand(code == SQLITE_OK, "SQLite has no database in memory");
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    const auto size = static_cast<sqlite3_int64>(bytes.size());
    sqlite3_deserialize(opened, "main", reinterpret_cast<unsigned char*>(bytes.data()), size, size,
                        SQLITE_DESERIALIZE_READONLY);
    // Damaged pages that refer to each other could be followed without end. The limit is 10⁷ steps, and four
    // for each byte.
    constexpr int k_steps_between_calls = 10'000;
    calls_left_ = 1'000 + static_cast<std::int64_t>(bytes.size()) / k_steps_between_calls * 4;
    sqlite3_progress_handler(opened, k_steps_between_calls, &Database::is_too_long, this);
  }

  /// Calls `take` for each row; false if the database is damaged there.
  template <typename Take>
  bool query(const std::string& text, const Take& take) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(database_.get(), text.c_str(), -1, &prepared, nullptr) != SQLITE_OK) return false;
    const std::unique_ptr<sqlite3_stmt, SqliteCloser> statement(prepared);
    for (;;) {
      const int code = sqlite3_step(prepared);
      if (code != SQLITE_ROW) return code == SQLITE_DONE;
      take(prepared);
    }
  }

 private:
  static int is_too_long(void* self) { return --static_cast<Database*>(self)->calls_left_ < 0 ? 1 : 0; }

  std::unique_ptr<sqlite3, SqliteCloser> database_;
  std::int64_t calls_left_ = 0;  ///< of the progress handler, before a query is stopped
};

std::string_view blob(sqlite3_stmt* row, int column) {
  const void* const bytes = sqlite3_column_blob(row, column);
  return {static_cast<const char*>(bytes),
          bytes == nullptr ? 0 : static_cast<std::size_t>(sqlite3_column_bytes(row, column))};
}

/// Topics with numbers: id in the database → index in the log. Empty if they cannot be read.
std::optional<std::map<sqlite3_int64, std::size_t>> read_topics(Database& database, BagLog& into) {
  std::map<sqlite3_int64, std::size_t> topics;
  const bool is_read =
      database.query("SELECT id, name, type, serialization_format FROM topics", [&](sqlite3_stmt* row) {
        const std::size_t topic = into.add_topic(blob(row, 1), blob(row, 2), blob(row, 3));
        if (topic != BagLog::k_not_used) topics[sqlite3_column_int64(row, 0)] = topic;
      });
  if (!is_read && topics.empty()) return std::nullopt;
  return topics;
}

}  // namespace

bool has_write_ahead_log(std::string_view database) {
  return database.size() >= k_header_size && database[k_read_version] == 2;
}

void read_sqlite_bag(std::string bytes, std::string_view write_ahead_log, const std::string& name, BagLog& into) {
  const std::size_t page = bytes.size() < k_header_size ? 0 : page_size(bytes);
  const bool is_power_of_two = (page & (page - 1)) == 0;
  if (page < 512 || !is_power_of_two || bytes.size() < page)
    throw InputError(name, "is a SQLite file that is cut off in its first page", "record it again");
  apply_write_ahead_log(write_ahead_log, bytes);
  bytes[k_write_version] = bytes[k_read_version] = 1;  // a database in memory has no write-ahead log
  const bool is_cut_off = cut_to_whole_pages(bytes);
  Database database(bytes);
  const auto topics = read_topics(database, into);
  if (!topics)
    throw InputError(name, "is a SQLite file without the topics of ros2 bag, or it is damaged",
                     "give a bag that ros2 bag recorded");
  std::string ids;
  for (const auto& [id, topic] : *topics) ids += (ids.empty() ? "" : ",") + std::to_string(id);
  const bool is_whole =
      database.query("SELECT topic_id, timestamp, data FROM messages NOT INDEXED WHERE topic_id IN (" + ids + ")",
                     [&](sqlite3_stmt* row) {
                       const auto topic = topics->find(sqlite3_column_int64(row, 0));
                       const std::string_view data = blob(row, 2);
                       if (topic != topics->end() && data.size() <= k_largest_message)
                         into.add_message(topic->second, sqlite3_column_int64(row, 1), data);
                     });
  if (is_cut_off || !is_whole)
    into.add_note(std::string("the recording is ") + (is_cut_off ? "unfinished: its file is cut off" : "damaged") +
                  "; the " + std::to_string(into.messages()) + " messages before that are read");
}

}  // namespace fusee::measurement
