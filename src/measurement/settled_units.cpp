// Determines units that neither option nor column name states from the values.

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "fusee/base.h"
#include "measurement/columns.h"
#include "measurement/log_text.h"

namespace fusee::measurement {
namespace {

// ---- time -----------------------------------------------------------------------------------------------------------

/// Plausible as s since 1970: years 2000 to 2100.
bool is_since_1970(double seconds) { return seconds > 9.4e8 && seconds < 4.2e9; }

/// Mean time between rows, in the unit of the column. Steps back in time, where the clock restarts, are omitted.
double mean_step(const std::vector<Sample>& samples) {
  double sum = 0, steps = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double step = samples[i].time - samples[i - 1].time;
    if (!(step >= 0)) continue;
    sum += step;
    ++steps;
  }
  return steps > 0 ? sum / steps : 0;
}

// ---- counts ---------------------------------------------------------------------------------------------------------

/// Counts a turn of absolute encoders in joints and servos.
constexpr std::array k_absolute_encoders = {4096.0, 16384.0};
/// Counts a turn of further encoders, accepted only if the values jump by a whole turn.
constexpr std::array k_wrapping_encoders = {256.0,   400.0,   512.0,    600.0,    800.0,    1000.0,   1024.0,  1200.0,
                                            1600.0,  2000.0,  2048.0,   2400.0,   2500.0,   3200.0,   3600.0,  4000.0,
                                            4096.0,  5000.0,  8000.0,   8192.0,   10000.0,  16384.0,  20000.0, 32768.0,
                                            40000.0, 65536.0, 131072.0, 262144.0, 524288.0, 1048576.0};

double largest_jump(const std::vector<Sample>& samples, double Sample::*value) {
  double largest = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    largest = std::max(largest, std::abs(samples[i].*value - samples[i - 1].*value));
  return largest;
}

/// Counts a turn of an encoder that restarts at 0 after a turn; 0 if the values do not show it. For the usual absolute
/// encoders, a value in the upper half of the turn is enough; for others, the values must jump by a turn.
double plausible_ticks(const Column& column, const std::vector<Sample>& samples) {
  if (!column.whole || column.least < 0) return 0;
  for (const double ticks : k_absolute_encoders) {
    if (column.most < ticks && column.most >= ticks / 2) return ticks;
  }
  const double jump = largest_jump(samples, member_of(column.role));
  const auto next = std::upper_bound(k_wrapping_encoders.begin(), k_wrapping_encoders.end(), column.most);
  return next != k_wrapping_encoders.end() && jump > 0.9 * *next ? *next : 0;
}

/// Unwraps an overflowing counter of 16 or 32 bits. A jump of a single-turn encoder is left to unwrap().
std::size_t unwrap_counter(std::vector<Sample>& samples, double Sample::*value, double ticks_per_turn) {
  std::size_t wraps = 0;
  double shift = 0, before = samples.front().*value;
  for (Sample& sample : samples) {
    const double here = sample.*value, jump = here - before;
    if (!std::isnan(here)) before = here;
    for (const double size : {65536.0, 4294967296.0}) {  // 16 and 32 bits
      const bool is_overflow = size > std::abs(ticks_per_turn) && std::abs(std::abs(jump) - size) < 0.1 * size;
      if (!is_overflow) continue;
      shift -= std::copysign(size, jump);
      ++wraps;
    }
    sample.*value = here + shift;
  }
  return wraps;
}

// ---- all columns ----------------------------------------------------------------------------------------------------

class UnitFinder {
 public:
  UnitFinder(std::vector<Column>& columns, std::vector<Sample>& samples, const MeasurementOptions& options,
             std::string name)
      : columns_(columns), samples_(samples), options_(options), name_(std::move(name)) {}

  /// Returns one line about unusual units.
  std::string settle() {
    if (samples_.empty()) return {};
    for (Column& column : columns_) {
      if (column.quantity == Quantity::time) find_time_unit(column);
      if (column.quantity == Quantity::angle && member_of(column.role) != nullptr) find_angle_unit(column);
      if (column.role == "load") compare_with_declared_load(column);
    }
    if (!problems_.empty()) throw InputError(problems_);
    for (Column& column : columns_) convert(column);
    if (!problems_.empty()) throw InputError(problems_);
    return notes_;
  }

 private:
  void add_note(const std::string& note) { notes_ += (notes_.empty() ? "" : "; ") + note; }

  void add_problem(const std::string& message, const std::string& hint) {
    problems_.push_back(InputError(name_, message, hint).diagnostics().front());
  }

  static std::string values_of(const Column& column) {
    return (column.whole ? "whole numbers from " : "numbers from ") + rounded(column.least) + " to " +
           rounded(column.most);
  }

  void find_time_unit(Column& column) {
    if (column.is_date) {
      column.unit = find_unit(Quantity::time, "s");
      return add_note("time in time stamps");
    }
    if (column.unit != nullptr) {
      if (column.unit != usual_unit(Quantity::time) || column.is_given)
        add_note("time in " + std::string(column.unit->name));
      return;
    }
    for (const char* const spelling : {"s", "ms", "us", "ns"}) {
      const Unit* unit = find_unit(Quantity::time, spelling);
      if (!is_since_1970(column.most * unit->factor)) continue;
      column.unit = unit;
      return add_note(std::string("time in ") + spelling + " since 1970");
    }
    const double step = mean_step(samples_);
    constexpr double k_shortest_step = 1e-6;  // s
    if (step > 0 && step < k_shortest_step) {
      return add_problem(
          "the unit of " + shown(column.name) + " is unknown: as s, the rows are " + rounded(step, 3) + " s apart",
          "end the column's name in its unit (_s, _min, _days), or give --unit time=d for days");
    }
    if (step > k_longest_step || (column.whole && step >= 1)) {
      return add_problem(
          "the unit of " + shown(column.name) + " is unknown: as s, the rows are " + rounded(step, 3) + " s apart",
          "end the column's name in its unit (_s, _ms, _us, _ns), or give --unit time=ms");
    }
    column.unit = find_unit(Quantity::time, "s");
    add_note("time taken as s, as the name " + shown(column.name) + " states no unit");
  }

  void find_angle_unit(Column& column) {
    if (!(column.most >= column.least)) column.unit = usual_unit(Quantity::angle);  // no values
    if (column.unit != nullptr && column.unit->is_counts() && !column.whole && column.ticks_per_turn == 0) {
      if (column.is_given)
        return add_problem(
            shown(column.name) + " has " + values_of(column) + ", which are no counts of an encoder",
            "leave out --zero-ticks " + column.role + ", or give --ticks-per-turn " + column.role + "=N too");
      column.unit = nullptr;  // a name such as "raw" does not mean counts here
    }
    if (column.unit == nullptr) {
      find_unit_of_values(column);
    } else if (column.unit->is_counts()) {
      find_ticks(column);
    } else if (column.unit != usual_unit(Quantity::angle) || column.is_given) {
      add_note(column.role + " in " + std::string(column.unit->name));
    } else if (column.whole && column.most - column.least > 360) {
      add_note(column.role + ": " + values_of(column) + ", read as degrees; if they are counts, --ticks-per-turn " +
               column.role + "=4096");
    }
  }

  void find_ticks(Column& column) {
    if (column.ticks_per_turn != 0) {
      return add_note(column.role + " in counts of " + rounded(std::abs(column.ticks_per_turn), 9) + " a turn" +
                      (column.ticks_per_turn < 0 ? ", falling" : "") +
                      (column.home_reading != 0 ? ", " + rounded(column.home_reading, 9) + " at home" : ""));
    }
    column.ticks_per_turn = plausible_ticks(column, samples_);
    if (column.ticks_per_turn == 0 && column.least >= 0 && column.most < found_ticks_)
      column.ticks_per_turn = found_ticks_;  // of α's encoder, assumed to be of the same type
    if (column.ticks_per_turn == 0) {
      return add_problem(column.role + ": " + shown(column.name) + " has " + values_of(column) +
                             ", which look like counts of an encoder",
                         "give the counts a turn, --ticks-per-turn " + column.role + "=4096, or their unit: --unit " +
                             column.role + "=deg");
    }
    found_ticks_ = column.ticks_per_turn;
    add_note(column.role + ": " + values_of(column) + ", taken as counts of " + rounded(column.ticks_per_turn, 9) +
             " a turn" + (column.home_reading != 0 ? ", " + rounded(column.home_reading, 9) + " at home" : "") +
             " (--ticks-per-turn " + column.role + "=N overrides this)");
  }

  void find_unit_of_values(Column& column) {
    const double declared_span = column.role == "alpha" ? options_.alpha_span : options_.theta_span;  // rad; 0: unknown
    const bool within_a_turn = column.least >= -360 && column.most <= 360;
    const bool counts_by_values = column.whole && plausible_ticks(column, samples_) > 0;
    if (column.whole && (!within_a_turn || counts_by_values || found_ticks_ > 0)) {
      column.unit = find_unit(Quantity::angle, "counts");
      return find_ticks(column);
    }
    column.unit = find_unit(Quantity::angle, column.whole        ? "deg"
                                             : declared_span > 0 ? nearest_unit(declared_span, column)
                                                                 : likely_unit(column));
    add_note(column.role + " taken as " + std::string(column.unit->name) + ", as the name " + shown(column.name) +
             " states no unit (--unit " + column.role + "=" + (column.unit->name == "deg" ? "rad" : "deg") +
             " overrides this)");
  }

  /// The unit in which the range of the values is nearest to the declared range.
  static const char* nearest_unit(double declared_span, const Column& column) {
    const char* best = "deg";
    double least = 1e300;
    for (const char* const spelling : {"deg", "rad", "turns", "mdeg"}) {
      const double ratio = (column.most - column.least) * find_unit(Quantity::angle, spelling)->factor / declared_span;
      const double off = std::abs(elementary::log(ratio));
      if (off >= least) continue;
      least = off;
      best = spelling;
    }
    return best;
  }

  /// Without a declared range: ROS positions are radians, and so are motions below 2π in the column's unit. A joint does
  /// not turn more than twice: its positions are degrees then, and so are those of its motor.
  const char* likely_unit(const Column& column) const {
    const auto is_wide_joint = [](const Column& other) {
      return other.role == "theta" && other.unit == nullptr && other.most - other.least > 2 * k_two_pi;
    };
    const bool is_position = lower(column.name).find("position") != std::string::npos &&
                             std::none_of(columns_.begin(), columns_.end(), is_wide_joint);
    return is_position || column.most - column.least <= k_two_pi ? "rad" : "deg";
  }

  /// Loads without a stated unit that are far from the declared one are in another unit: 200 g are not 200 N. A stated
  /// unit is trusted, with a note.
  void compare_with_declared_load(const Column& column) {
    constexpr double k_far = 10;  // times the declared load, or its inverse
    const double largest = std::max(std::abs(column.least), std::abs(column.most));
    if (options_.load_scale == 0 || column.is_given || column.unit->base != "N" || !(largest > 0)) return;
    if (!std::isfinite(largest)) return;  // empty
    const double ratio = largest * column.unit->factor / options_.load_scale;
    if (ratio < k_far && ratio > 1 / k_far) return;
    const std::string words = " reaches " + rounded(largest, 4) +
                              (column.is_unit_stated ? " " + std::string(column.unit->name) : "") +
                              (column.is_unit_stated ? ", " : ": as N, ") + rounded(ratio, 2) +
                              " times the declared load of " + rounded(options_.load_scale, 3) + " N";
    if (column.is_unit_stated) {
      if (ratio > 1)
        add_note("load: " + shown(column.name) + words + "; if its unit is another, add --unit load=g or the like");
      return;
    }
    const Unit* const other = find_unit(Quantity::load, ratio > 1 ? "g" : "kg");
    add_problem("the unit of " + shown(column.name) + " is unknown: it" + words,
                "state the unit: --unit load=" + std::string(other->name) + " (" + rounded(largest, 4) + " " +
                    std::string(other->name) + " is " + rounded(largest * other->factor, 3) + " N), or --unit load=N");
  }

  void convert(const Column& column) {
    double Sample::*const value = member_of(column.role);
    if (value == nullptr || column.unit == nullptr) return;
    if (column.unit->is_counts()) {
      convert_counts(column, value);
    } else if (column.home_reading != 0) {
      add_note(column.role + ": the sensor reads " + rounded(column.home_reading, 9) + " " +
               std::string(column.unit->name) + " at home");
      scale(value, column.unit->factor, -column.home_reading * column.unit->factor);
    } else {
      if (column.role == "load" && column.unit->factor != 1)
        add_note("load in " + std::string(column.unit->name) + ", converted to " + std::string(column.unit->base));
      scale(value, column.unit->factor, column.unit->offset);
    }
    if (column.quantity == Quantity::angle) check_for_wild_angles(column, value);
  }

  void check_for_wild_angles(const Column& column, double Sample::*value) {
    const auto is_implausible = [&](const Sample& sample) { return std::abs(sample.*value) > radians(k_largest_deg); };
    const auto implausible = std::find_if(samples_.begin(), samples_.end(), is_implausible);
    if (implausible == samples_.end()) return;
    add_problem(
        shown(column.name) + " reaches " + rounded(degrees((*implausible).*value)) + " deg, which is not an angle",
        "leave the cell empty where nothing was logged");
  }

  void scale(double Sample::*value, double factor, double offset) {
    if (factor == 1 && offset == 0) return;
    for (Sample& sample : samples_) sample.*value = sample.*value * factor + offset;
  }

  void convert_counts(const Column& column, double Sample::*value) {
    const std::size_t wraps = unwrap_counter(samples_, value, column.ticks_per_turn);
    if (wraps > 0)
      add_note("the counter of " + column.role + " overflowed " + std::to_string(wraps) +
               (wraps == 1 ? " time" : " times") + ", unwrapped");
    for (Sample& sample : samples_)
      sample.*value = (sample.*value - column.home_reading) / column.ticks_per_turn * k_two_pi;
  }

  std::vector<Column>& columns_;
  std::vector<Sample>& samples_;
  const MeasurementOptions& options_;
  std::string name_;
  std::string notes_;  ///< in one line
  std::vector<Diagnostic> problems_;
  double found_ticks_ = 0;  ///< counts a turn of the last column whose values determined them; 0: none
};

}  // namespace

std::string settle_units(std::vector<Column>& columns, std::vector<Sample>& samples, const MeasurementOptions& options,
                         const std::string& name) {
  return UnitFinder(columns, samples, options, name).settle();
}

}  // namespace fusee::measurement
