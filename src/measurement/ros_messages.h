/// \file
/// Internal: decodes ROS 2 messages in CDR (OMG DDSI-RTPS, plain CDR of both byte orders) into named numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace fusee::measurement {

class CdrReader;
/// Reads the number of a std_msgs message.
using ReadNumber = double (*)(CdrReader&);

enum class MessageKind { joint_state, wrench, wrench_stamped, temperature, number };

struct MessageType {
  std::string_view name;  ///< "sensor_msgs/JointState"
  MessageKind kind = MessageKind::number;
  ReadNumber read_number = nullptr;  ///< for MessageKind::number
};

/// The type of that name, "sensor_msgs/msg/JointState" or "sensor_msgs/JointState"; nullptr if it has no numbers for a
/// role.
const MessageType* find_message_type(std::string_view name);

/// Called with the part of a number's name behind its topic: "motor/position", "wrench/force/x", "data".
using TakeNumber = std::function<void(std::string_view name, double value)>;

/// Decodes one message. Returns the stamp of its header in ns, 0 without one; nothing for a malformed message, of which
/// no number is taken. An unnamed joint is called by its index.
std::optional<std::int64_t> decode_message(const MessageType& type, std::string_view bytes, const TakeNumber& take);

}  // namespace fusee::measurement
