#include "measurement/ros_messages.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

namespace fusee::measurement {

/// Reads the numbers and texts of one message. After a fault all further reads are 0 or empty.
class CdrReader {
 public:
  /// The second byte of the encapsulation is 0 for big endian, 1 for little endian. Other values (parameter lists,
  /// XCDR2) are faults.
  explicit CdrReader(std::string_view bytes) : bytes_(bytes.substr(std::min(bytes.size(), k_encapsulation))) {
    ok_ = bytes.size() >= k_encapsulation && bytes[0] == 0 && (bytes[1] == 0 || bytes[1] == 1);
    swapped_ = ok_ && (bytes[1] == 1) != (std::endian::native == std::endian::little);
  }

  bool ok() const { return ok_; }

  template <typename Number>
  Number number() {
    at_ = (at_ + sizeof(Number) - 1) / sizeof(Number) * sizeof(Number);  // CDR aligns a number to its own size
    std::array<char, sizeof(Number)> raw{};
    if (!can_read(sizeof(Number))) return Number{};
    std::memcpy(raw.data(), bytes_.data() + at_, raw.size());
    at_ += raw.size();
    if (swapped_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Number>(raw);
  }

  std::string_view text() {
    const std::size_t length = number<std::uint32_t>();
    if (!can_read(length)) return {};
    std::string_view text = bytes_.substr(at_, length);
    at_ += length;
    if (text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }

  /// Number of elements of a sequence. It is a fault if they do not fit into the message with `least_size` bytes each.
  std::size_t count(std::size_t least_size) {
    const std::size_t elements = number<std::uint32_t>();
    return elements > 0 && !can_read(elements * least_size) ? 0 : elements;
  }

  std::vector<double> numbers() {
    std::vector<double> values(count(sizeof(double)));
    for (double& value : values) value = number<double>();
    return values;
  }

  /// Reads a std_msgs/Header. Returns its stamp in ns.
  std::int64_t header() {
    const std::int64_t seconds = number<std::int32_t>(), nanoseconds = number<std::uint32_t>();
    text();  // frame_id
    return seconds * 1'000'000'000 + nanoseconds;
  }

 private:
  static constexpr std::size_t k_encapsulation = 4;

  /// True if `size` more bytes exist; otherwise it is a fault.
  bool can_read(std::size_t size) {
    ok_ = ok_ && at_ <= bytes_.size() && size <= bytes_.size() - at_;
    return ok_;
  }

  std::string_view bytes_;  ///< behind the encapsulation, from which alignment counts
  std::size_t at_ = 0;      ///< index in bytes_ of the next byte
  bool ok_ = false, swapped_ = false;
};

namespace {

template <typename Number>
double read_as(CdrReader& reader) {
  return static_cast<double>(reader.number<Number>());
}

constexpr std::array k_message_types = {
    MessageType{"sensor_msgs/JointState", MessageKind::joint_state},
    MessageType{"geometry_msgs/Wrench", MessageKind::wrench},
    MessageType{"geometry_msgs/WrenchStamped", MessageKind::wrench_stamped},
    MessageType{"sensor_msgs/Temperature", MessageKind::temperature},
    MessageType{"std_msgs/Float64", MessageKind::number, read_as<double>},
    MessageType{"std_msgs/Float32", MessageKind::number, read_as<float>},
    MessageType{"std_msgs/Int64", MessageKind::number, read_as<std::int64_t>},
    MessageType{"std_msgs/Int32", MessageKind::number, read_as<std::int32_t>},
    MessageType{"std_msgs/Int16", MessageKind::number, read_as<std::int16_t>},
    MessageType{"std_msgs/Int8", MessageKind::number, read_as<std::int8_t>},
    MessageType{"std_msgs/UInt64", MessageKind::number, read_as<std::uint64_t>},
    MessageType{"std_msgs/UInt32", MessageKind::number, read_as<std::uint32_t>},
    MessageType{"std_msgs/UInt16", MessageKind::number, read_as<std::uint16_t>},
    MessageType{"std_msgs/UInt8", MessageKind::number, read_as<std::uint8_t>},
};

bool take_joint_state(CdrReader& reader, const TakeNumber& take) {
  std::vector<std::string_view> joints(reader.count(sizeof(std::uint32_t)));
  for (std::string_view& joint : joints) joint = reader.text();
  const std::array quantities = {std::pair{"/position", reader.numbers()}, std::pair{"/velocity", reader.numbers()},
                                 std::pair{"/effort", reader.numbers()}};
  if (!reader.ok()) return false;
  std::string name;
  for (const auto& [quantity, values] : quantities) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      name = i < joints.size() && !joints[i].empty() ? std::string(joints[i]) : std::to_string(i);
      take(name += quantity, values[i]);
    }
  }
  return true;
}

bool take_wrench(CdrReader& reader, const TakeNumber& take) {
  std::array<double, 6> values{};
  for (double& value : values) value = reader.number<double>();
  if (!reader.ok()) return false;
  constexpr std::array names = {"wrench/force/x",  "wrench/force/y",  "wrench/force/z",
                                "wrench/torque/x", "wrench/torque/y", "wrench/torque/z"};
  for (std::size_t i = 0; i < names.size(); ++i) take(names[i], values[i]);
  return true;
}

bool take_one(CdrReader& reader, const char* name, double value, const TakeNumber& take) {
  if (reader.ok()) take(name, value);
  return reader.ok();
}

}  // namespace

const MessageType* find_message_type(std::string_view name) {
  constexpr std::string_view k_ros2 = "/msg/";
  std::string plain(name);
  if (const std::size_t at = plain.find(k_ros2); at != std::string::npos) plain.replace(at, k_ros2.size(), "/");
  const auto found = std::find_if(k_message_types.begin(), k_message_types.end(),
                                  [&](const MessageType& type) { return type.name == plain; });
  return found == k_message_types.end() ? nullptr : &*found;
}

std::optional<std::int64_t> decode_message(const MessageType& type, std::string_view bytes, const TakeNumber& take) {
  CdrReader reader(bytes);
  const bool has_header = type.kind == MessageKind::joint_state || type.kind == MessageKind::wrench_stamped ||
                          type.kind == MessageKind::temperature;
  const std::int64_t stamp = has_header ? reader.header() : 0;
  bool taken = false;
  switch (type.kind) {
    case MessageKind::joint_state:
      taken = take_joint_state(reader, take);
      break;
    case MessageKind::wrench:
    case MessageKind::wrench_stamped:
      taken = take_wrench(reader, take);
      break;
    case MessageKind::temperature:
      taken = take_one(reader, "temperature", reader.number<double>(), take);
      break;
    case MessageKind::number:
      taken = take_one(reader, "data", type.read_number(reader), take);
      break;
  }
  if (!taken) return std::nullopt;
  return stamp;
}

}  // namespace fusee::measurement
