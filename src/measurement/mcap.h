/// \file
/// Internal: reads MCAP (mcap.dev, version 0), the default recording of ROS 2, from beginning to end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "measurement/bag_log.h"
#include "measurement/unpacking.h"

namespace fusee::measurement {

constexpr std::string_view k_mcap_magic("\x89MCAP0\r\n", 8);

/// Takes a file in blocks. The summary at the end of the file is not needed: an unfinished recording is read up to its
/// last whole message. A damaged chunk is omitted. Either adds a note.
class McapReader {
 public:
  explicit McapReader(BagLog& into) : into_(into) {}

  void add(std::string_view bytes);
  void finish();

 private:
  /// Part of the file that comes next: its magic number, then head and body of each record. `skipped` is the body of a
  /// record that is not needed, `over` all after the last record.
  enum class Part { magic, head, body, skipped, over };

  std::size_t fill(std::string_view bytes, std::size_t size);
  void begin_record();
  void end_record();
  void take_schema(std::string_view body);
  void take_channel(std::string_view body);
  void take_message(std::string_view body);
  void take_chunk(std::string_view body, bool is_cut_off);
  bool take_records(std::string_view records, std::vector<std::string_view>& messages);

  BagLog& into_;
  UnpackingLimit limit_;
  Part part_ = Part::magic;
  std::string held_;                                         ///< bytes of the current part so far
  unsigned char opcode_ = 0;                                 ///< of the current record
  std::uint64_t left_ = 0;                                   ///< bytes of the current record that are still to come
  std::unordered_map<std::uint16_t, std::string> schemas_;   ///< names of message types
  std::unordered_map<std::uint16_t, std::size_t> channels_;  ///< topics in BagLog
  std::size_t damaged_chunks_ = 0, too_large_chunks_ = 0;
};

}  // namespace fusee::measurement
