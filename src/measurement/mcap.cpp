#include "measurement/mcap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <vector>

namespace fusee::measurement {
namespace {

// A record is an opcode of 1 byte, a length of 8 bytes and a body. All numbers are little endian.
constexpr std::size_t k_head_size = 9;
enum Opcode : unsigned char { k_invalid = 0, k_footer = 2, k_schema = 3, k_channel = 4, k_message = 5, k_chunk = 6 };

/// A chunk is buffered as a whole; recorders write chunks of 1 to 4 MB.
constexpr std::size_t k_largest_chunk = std::size_t{256} << 20;

/// Reads the fields of a record. After a fault all further reads are 0 or empty.
class FieldReader {
 public:
  explicit FieldReader(std::string_view body) : rest_(body) {}

  bool ok() const { return ok_; }

  template <typename Number>
  Number number() {
    Number value = 0;
    const std::string_view raw = bytes(sizeof(Number));
    for (std::size_t i = 0; i < raw.size(); ++i)
      value = static_cast<Number>(value | (static_cast<Number>(static_cast<unsigned char>(raw[i])) << (8 * i)));
    return value;
  }
  std::string_view text() { return bytes(number<std::uint32_t>()); }
  std::string_view bytes(std::uint64_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) return {};
    const std::string_view found = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return found;
  }
  std::string_view rest() const { return ok_ ? rest_ : std::string_view(); }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

/// CRC-32 as in zip and zlib: reflected polynomial 0xEDB88320, by a table of all bytes.
std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
      entries[i] = value;
    }
    return entries;
  }();
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes) sum = (sum >> 8U) ^ table[(sum ^ static_cast<unsigned char>(c)) & 0xFFU];
  return ~sum;
}

std::optional<Packing> packing_of(std::string_view name) {
  if (name.empty()) return Packing::none;
  if (name == "zstd") return Packing::zstd;
  if (name == "lz4") return Packing::lz4;
  return std::nullopt;
}

/// True for the records from which messages are read.
bool is_needed(unsigned char opcode) {
  return opcode == k_schema || opcode == k_channel || opcode == k_message || opcode == k_chunk;
}

}  // namespace

void McapReader::add(std::string_view bytes) {
  while (!bytes.empty() && part_ != Part::over) {
    std::size_t taken = 0;
    if (part_ == Part::magic) {
      taken = fill(bytes, k_mcap_magic.size());
      if (held_.size() == k_mcap_magic.size()) {
        part_ = Part::head;
        held_.clear();
      }
    } else if (part_ == Part::head) {
      taken = fill(bytes, k_head_size);
      if (held_.size() == k_head_size) begin_record();
    } else {
      taken = static_cast<std::size_t>(std::min<std::uint64_t>(left_, bytes.size()));
      if (part_ == Part::body) held_.append(bytes.substr(0, taken));
      left_ -= taken;
      if (left_ == 0) end_record();
    }
    bytes.remove_prefix(taken);
  }
}

/// Appends bytes to held_ until it holds `size` bytes. Returns the number of appended bytes.
std::size_t McapReader::fill(std::string_view bytes, std::size_t size) {
  const std::size_t count = std::min(bytes.size(), size - held_.size());
  held_.append(bytes.substr(0, count));
  return count;
}

void McapReader::begin_record() {
  FieldReader head(held_);
  opcode_ = head.number<unsigned char>();
  left_ = head.number<std::uint64_t>();
  held_.clear();
  if (opcode_ == k_invalid || opcode_ == k_footer) {
    part_ = Part::over;
    if (opcode_ == k_invalid) into_.add_note("the recording is damaged: its records end without a footer");
    return;
  }
  const std::size_t most = opcode_ == k_chunk ? k_largest_chunk : k_largest_message;
  part_ = is_needed(opcode_) && left_ <= most ? Part::body : Part::skipped;
  if (opcode_ == k_chunk && left_ > most) ++too_large_chunks_;
  if (left_ == 0) end_record();
}

void McapReader::end_record() {
  if (part_ == Part::body) {
    if (opcode_ == k_schema) take_schema(held_);
    if (opcode_ == k_channel) take_channel(held_);
    if (opcode_ == k_message) take_message(held_);
    if (opcode_ == k_chunk) take_chunk(held_, /*is_cut_off=*/false);
  }
  held_.clear();
  part_ = Part::head;
}

void McapReader::finish() {
  if (part_ != Part::over) {
    // A chunk that the recorder did not finish has whole messages, too.
    if (part_ == Part::body && opcode_ == k_chunk) take_chunk(held_, /*is_cut_off=*/true);
    into_.add_note("the recording is unfinished: it ends without a footer; the " + std::to_string(into_.messages()) +
                   " whole messages before its end are read");
  }
  if (damaged_chunks_ > 0)
    into_.add_note(std::to_string(damaged_chunks_) + " chunks of the recording are damaged: omitted");
  if (too_large_chunks_ > 0)
    into_.add_note(std::to_string(too_large_chunks_) + " chunks of the recording are too large: omitted");
}

void McapReader::take_schema(std::string_view body) {
  FieldReader fields(body);
  const auto id = fields.number<std::uint16_t>();
  const std::string_view name = fields.text();
  constexpr std::size_t k_longest_name = 1000;
  if (fields.ok() && name.size() <= k_longest_name) schemas_[id] = name;
}

void McapReader::take_channel(std::string_view body) {
  FieldReader fields(body);
  const auto id = fields.number<std::uint16_t>();
  const auto schema = schemas_.find(fields.number<std::uint16_t>());
  const std::string_view topic = fields.text(), encoding = fields.text();
  if (fields.ok())
    channels_[id] = into_.add_topic(topic, schema == schemas_.end() ? std::string_view() : schema->second, encoding);
}

void McapReader::take_message(std::string_view body) {
  FieldReader fields(body);
  const auto channel = channels_.find(fields.number<std::uint16_t>());
  fields.number<std::uint32_t>();  // sequence number
  const auto log_time = fields.number<std::uint64_t>();
  fields.number<std::uint64_t>();  // time of publication, unknown to most recorders
  if (!fields.ok() || channel == channels_.end() || channel->second == BagLog::k_not_used) return;
  constexpr auto k_latest_stamp = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  into_.add_message(channel->second, static_cast<std::int64_t>(std::min(log_time, k_latest_stamp)), fields.rest());
}

/// `is_cut_off`: the file ends within the chunk.
void McapReader::take_chunk(std::string_view body, bool is_cut_off) {
  FieldReader fields(body);
  fields.number<std::uint64_t>();  // time of the first message
  fields.number<std::uint64_t>();  // time of the last message
  const auto size = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  const std::optional<Packing> packing = packing_of(fields.text());
  const auto packed_size = fields.number<std::uint64_t>();
  std::string_view packed = fields.rest();
  if (!is_cut_off && fields.ok()) packed = fields.bytes(packed_size);
  if (!fields.ok() || !packing) {
    if (!is_cut_off) ++damaged_chunks_;
    return;
  }
  const std::size_t most = std::min({limit_.raise_for(packed.size()), k_largest_chunk, static_cast<std::size_t>(size)});
  const UnpackedBytes records = unpack(*packing, packed, most);
  limit_.use(records.bytes.size());
  const bool has_checksum = crc != 0;
  const bool is_whole = records.bytes.size() == size && (!has_checksum || crc32(records.bytes) == crc);
  std::vector<std::string_view> messages;
  const bool records_fill_chunk = take_records(records.bytes, messages);
  if (!is_cut_off && (!is_whole || !records_fill_chunk)) {
    if (size > most)
      ++too_large_chunks_;
    else
      ++damaged_chunks_;
    return;
  }
  for (const std::string_view message : messages) take_message(message);
}

/// Takes the channels of a chunk and collects its messages; false if the records do not fill it.
bool McapReader::take_records(std::string_view records, std::vector<std::string_view>& messages) {
  while (!records.empty()) {
    FieldReader fields(records);
    const auto opcode = fields.number<unsigned char>();
    const auto length = fields.number<std::uint64_t>();
    const std::string_view body = fields.bytes(length);
    if (!fields.ok()) return false;
    records = fields.rest();
    if (opcode == k_schema) take_schema(body);
    if (opcode == k_channel) take_channel(body);
    if (opcode == k_message && body.size() <= k_largest_message) messages.push_back(body);
  }
  return true;
}

}  // namespace fusee::measurement
