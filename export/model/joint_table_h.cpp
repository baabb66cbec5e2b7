// A header that C99 and C++17 compile without warnings, with 32-bit arithmetic only and without a library.

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "export/model/words.h"
#include "export/tool.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

using namespace model_words;

/// Text that can neither end a comment nor continue beyond a line's end. A '?' could begin a trigraph for a backslash.
std::string in_comment(const std::string& text) {
  std::string clean;
  for (const char c : cleaned_line(text)) clean += c == '*' || c == '\\' || c == '?' ? '_' : c;
  return clean;
}

std::string upper(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

std::string array(const std::string& name, const std::vector<float>& values) {
  std::string text = "static const float " + name + "[" + std::to_string(values.size()) + "] = {\n", line = " ";
  constexpr std::size_t k_width = 110;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string cell = " " + c_float(values[i]) + (i + 1 < values.size() ? "," : "");
    if (line.size() + cell.size() > k_width) {
      text += line + "\n";
      line = " ";
    }
    line += cell;
  }
  return text + line + "};\n\n";
}

/// Writes the header, for a table in degrees or in counts.
class Header {
 public:
  explicit Header(const ModelProduct& product)
      : product_(product), table_(product.table), prefix_(product.prefix), macro_prefix_(upper(product.prefix)) {}

  std::string text() const {
    std::string text = comment() + "#ifndef " + macro_prefix_ + "_JOINT_TABLE_H\n#define " + macro_prefix_ +
                       "_JOINT_TABLE_H\n\n#include <stdint.h>\n\n" + limits();
    const std::vector<std::string> names = way_names();
    for (std::size_t way = 0; way < names.size(); ++way) {
      text += array(prefix_ + "_theta" + names[way] + "_table", table_.ways[way].theta_deg);
      text += array(prefix_ + "_motor" + names[way] + "_table", table_.ways[way].motor);
    }
    text += array(prefix_ + "_slope_table", table_.slope);
    if (!table_.holding.empty()) text += array(prefix_ + "_holding_table", table_.holding);
    text += lookup();
    for (std::size_t way = 0; way < names.size(); ++way) text += conversions(names[way], table_.ways[way]);
    if (names.size() > 1) text += mean_conversions();
    return text + torques() + (table_.unit.ticks ? unwrap() : "") + "#endif\n";
  }

 private:
  bool has_ticks() const { return table_.unit.ticks; }
  std::string motor_type() const { return has_ticks() ? "int32_t" : "float"; }
  std::string motor_word() const { return has_ticks() ? "count" : "alpha_deg"; }
  std::vector<std::string> way_names() const {
    return table_.ways.size() > 1 ? std::vector<std::string>{"_up", "_down"} : std::vector<std::string>{""};
  }
  long long whole(double value) const { return std::llround(value); }
  std::string zero() const { return std::to_string(whole(table_.unit.zero)); }

  std::string comment() const {
    const model::TableErrors& errors = table_.errors;
    std::vector<std::string> lines{"joint_table.h: " + product_.mechanism.name + ", by " + std::string(k_tool) +
                                   " model"};
    const std::vector<std::string> source = curve_words(product_.curves.sensed, product_, true);
    lines.insert(lines.end(), source.begin(), source.end());
    const model::AngleMap& map = product_.curves.sensed.middle;
    const auto degrees_text = [](double angle) { return rounded(degrees(angle), 6); };
    lines.push_back("alpha (motor) from " + degrees_text(map.alpha_min) + " to " + degrees_text(map.alpha_max) +
                    " deg, theta (joint) from " + degrees_text(map.theta_min) + " to " + degrees_text(map.theta_max) +
                    " deg; beyond its ends every table is constant.");
    lines.push_back("Straight lines between " + std::to_string(table_.pieces + 1) +
                    " entries, in 32-bit arithmetic, miss that by");
    lines.push_back("  " + at_most_deg(errors.theta) + " deg at most in theta read from the motor,");
    lines.push_back("  " + at_most_deg(errors.returned) +
                    " deg at most in the theta that results at the motor angle read");
    lines.push_back("  from theta (" + at_most_deg(errors.motor) + " deg at most at the motor).");
    if (has_ticks()) {
      const double half_count = k_pi / std::abs(table_.unit.per_turn);  // rad
      double steepest = 0;
      for (const float slope : table_.slope) steepest = std::max(steepest, double(slope));
      lines.push_back("Motor in counts: " + rounded(std::abs(table_.unit.per_turn), 9) + " a turn, " +
                      (table_.unit.per_turn < 0 ? "fewer" : "more") + " as alpha increases, " + zero() +
                      " at alpha = 0. They continue over the end of a turn:");
      lines.push_back("pass the reading of an encoder that restarts each turn through " + prefix_ +
                      "_unwrap(). A whole count is " + at_most_deg(half_count * steepest) +
                      " deg of theta off at most.");
    }
    lines.push_back(
        "Slope: d(theta)/d(alpha) = joint speed per motor speed = motor torque per joint torque without friction.");
    if (table_.ways.size() > 1)
      lines.push_back(
          "_up: the motor came from below (alpha increased), _down: from above; without either: the mean of both.");
    if (table_.holding.empty()) {
      lines.push_back("[load] of the file is empty: no torque is required to hold it.");
    } else {
      lines.push_back(
          "Holding torque: motor torque towards +alpha that holds [load] of the file, without friction, N mm.");
    }
    std::string text = "/*\n";
    for (const std::string& line : lines) text += " * " + in_comment(line) + "\n";
    return text + " */\n";
  }

  std::string limits() const {
    return "#define " + macro_prefix_ + "_THETA_FIRST_DEG (" + c_float(table_.theta_first_deg) + ")\n#define " +
           macro_prefix_ + "_THETA_LAST_DEG (" + c_float(table_.theta_last_deg) + ")\n\n";
  }

  /// Linear interpolation in a table, constant beyond its ends.
  std::string lookup() const {
    return "static inline float " + prefix_ +
           "_between(const float *table, float at) {\n"
           "  int i;\n"
           "  if (!(at > 0.0f)) return table[0];\n"
           "  if (!(at < " +
           c_float(static_cast<float>(table_.pieces)) + ")) return table[" + std::to_string(table_.pieces) +
           "];\n"
           "  i = (int)at;\n"
           "  return table[i] + (at - (float)i) * (table[i + 1] - table[i]);\n"
           "}\n\n";
  }

  /// C literal: steps of a table per unit of its argument.
  std::string steps_per_unit(float first, float last) const {
    return c_float(static_cast<float>(table_.pieces / (double(last) - double(first))));
  }

  /// C expression: index (with fraction) of the motor's angle in a table.
  std::string table_position(const model::OneWayTable& way) const {
    std::string value = motor_word();
    if (has_ticks()) {
      // Clamped just beyond the ends before the subtraction, so that no count overflows.
      const long long low = whole(std::floor(table_.unit.zero + double(way.first))) - 1,
                      high = whole(std::ceil(table_.unit.zero + double(way.last))) + 1;
      value = "(float)((count < " + std::to_string(low) + " ? " + std::to_string(low) + " : count > " +
              std::to_string(high) + " ? " + std::to_string(high) + " : count) - (" + zero() + "))";
    }
    return "(" + value + " - (" + c_float(way.first) + ")) * " + steps_per_unit(way.first, way.last);
  }

  /// C statements that return the motor angle `value`. Counts are rounded half away from 0 and shifted by their zero.
  std::string motor_value(const std::string& value) const {
    if (!has_ticks()) return "  return " + value + ";\n";
    return "  const float count = " + value + ";\n  return " + zero() +
           " + (int32_t)(count < 0.0f ? count - 0.5f : count + 0.5f);\n";
  }

  /// C functions between motor and joint angle. `suffix`: "_up", "_down" or "".
  std::string conversions(const std::string& suffix, const model::OneWayTable& table) const {
    const std::string theta = prefix_ + "_theta" + suffix,
                      motor = prefix_ + (has_ticks() ? "_count" : "_alpha") + suffix;
    return "/* The joint's angle, deg. */\nstatic inline float " + theta + "_deg(" + motor_type() + " " + motor_word() +
           ") {\n  return " + prefix_ + "_between(" + theta + "_table, " + table_position(table) +
           ");\n}\n\n/* The motor angle for a joint angle. */\nstatic inline " + motor_type() + " " + motor +
           (has_ticks() ? "" : "_deg") + "(float theta_deg) {\n" +
           motor_value(prefix_ + "_between(" + prefix_ + "_motor" + suffix + "_table, (theta_deg - (" +
                       c_float(table_.theta_first_deg) + ")) * " +
                       steps_per_unit(table_.theta_first_deg, table_.theta_last_deg) + ")") +
           "}\n\n";
  }

  std::string mean_conversions() const {
    const std::string motor = prefix_ + (has_ticks() ? "_count" : "_alpha");
    std::string mean = "0.5f * (" + motor + "_up_deg(theta_deg) + " + motor + "_down_deg(theta_deg))";
    // The sum of two counts may overflow.
    if (has_ticks())
      mean = motor + "_up(theta_deg) + (" + motor + "_down(theta_deg) - " + motor + "_up(theta_deg)) / 2";
    return "/* The mean of both directions. */\nstatic inline float " + prefix_ + "_theta_deg(" + motor_type() + " " +
           motor_word() + ") {\n  return 0.5f * (" + prefix_ + "_theta_up_deg(" + motor_word() + ") + " + prefix_ +
           "_theta_down_deg(" + motor_word() + "));\n}\n\nstatic inline " + motor_type() + " " + motor +
           (has_ticks() ? "" : "_deg") + "(float theta_deg) {\n  return " + mean + ";\n}\n\n";
  }

  std::string torques() const {
    const std::string place = table_position(table_.ways.front()), argument = motor_type() + " " + motor_word();
    std::string text =
        "/* d(theta)/d(alpha). */\nstatic inline float " + prefix_ + "_slope(" + argument + ") {\n  return " + prefix_ +
        "_between(" + prefix_ + "_slope_table, " + place +
        ");\n}\n\n/* Motor torque for a joint torque, without friction: virtual work. */\nstatic inline float " +
        prefix_ + "_motor_torque(" + argument + ", float joint_torque) {\n  return joint_torque * " + prefix_ +
        "_slope(" + motor_word() + ");\n}\n\n/* Speed of the joint for a speed of the motor. */\nstatic inline float " +
        prefix_ + "_joint_speed(" + argument + ", float motor_speed) {\n  return motor_speed * " + prefix_ + "_slope(" +
        motor_word() + ");\n}\n\n";
    if (!table_.holding.empty())
      text += "/* Motor torque that holds the declared load, N mm. */\nstatic inline float " + prefix_ +
              "_holding_torque_Nmm(" + argument + ") {\n  return " + prefix_ + "_between(" + prefix_ +
              "_holding_table, " + place + ");\n}\n\n";
    return text;
  }

  /// The C function for encoders that restart each turn.
  std::string unwrap() const {
    const std::string turn = std::to_string(whole(std::abs(table_.unit.per_turn)));
    return "/* The count nearest to the last one that an encoder shows as `reading` (0 to " + turn +
           " - 1). Called at least twice a turn. */\n"
           "static inline int32_t " +
           prefix_ +
           "_unwrap(int32_t reading, int32_t last) {\n"
           "  int32_t step = (reading - last % " +
           turn + ") % " + turn +
           ";\n"
           "  if (step > " +
           turn + " / 2) step -= " + turn +
           ";\n"
           "  if (step < -(" +
           turn + " / 2)) step += " + turn +
           ";\n"
           "  return last + step;\n"
           "}\n\n";
  }

  const ModelProduct& product_;
  const model::JointTable& table_;
  std::string prefix_, macro_prefix_;
};

}  // namespace

std::string joint_table_h(const ModelProduct& product) { return Header(product).text(); }

}  // namespace fusee::formats
