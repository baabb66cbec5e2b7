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

/// Takes a file in blocks. It needs no summary, so that a recording without its end is read, too: every whole message
/// of it counts. A damaged chunk is omitted. Both give a note.
class McapReader {
 public:
  explicit McapReader(BagLog& into) : into_(into) {}

  void add(std::string_view bytes);
  void finish();

 private:
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
  std::string held_;                                         ///< of the current part
  unsigned char opcode_ = 0;                                 ///< of the current record
  std::uint64_t left_ = 0;                                   ///< bytes of the current record that are still to come
  std::unordered_map<std::uint16_t, std::string> schemas_;   ///< names of message types
  std::unordered_map<std::uint16_t, std::size_t> channels_;  ///< topics in BagLog
  std::size_t damaged_ = 0, too_large_ = 0;
};

}  // namespace fusee::measurement
