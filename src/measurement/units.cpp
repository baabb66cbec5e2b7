#include "measurement/units.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/text.h"
#include "fusee/base.h"
#include "measurement/log_text.h"
#include "transmission/load.h"

namespace fusee::measurement {
namespace {

constexpr double k_kg = transmission::k_gravity;  // N
constexpr double k_lb = 4.4482216152605;          // N
constexpr double k_inch = 25.4;                   // mm

constexpr std::array k_units = {
    Unit{"s", "s sec secs second seconds sek sekunde sekunden", Quantity::time, "s", 1},
    Unit{"ms", "ms msec msecs milli millis millisecond milliseconds", Quantity::time, "s", 1e-3},
    Unit{"us", "us µs μs usec usecs micro micros microsecond microseconds", Quantity::time, "s", 1e-6},
    Unit{"ns", "ns nsec nsecs nano nanos nanosecond nanoseconds %time", Quantity::time, "s", 1e-9},
    Unit{"min", "min mins minute minutes", Quantity::time, "s", 60},
    Unit{"h", "h hr hrs hour hours", Quantity::time, "s", 3600},
    Unit{"d", "d day days", Quantity::time, "s", 86400},

    Unit{"deg", "deg degs degree degrees ° º grad grade gradi grados graus graden degré degrés stopnie stopni",
         Quantity::angle, "rad", radians(1.0)},
    Unit{"rad", "rad rads radian radians", Quantity::angle, "rad", 1},
    Unit{"mdeg", "mdeg millideg millidegree millidegrees", Quantity::angle, "rad", radians(1e-3)},
    Unit{"cdeg", "cdeg centideg centidegree centidegrees", Quantity::angle, "rad", radians(1e-2)},
    Unit{"mrad", "mrad millirad milliradian milliradians", Quantity::angle, "rad", 1e-3},
    Unit{"arcmin", "arcmin arcmins arcminute arcminutes moa", Quantity::angle, "rad", radians(1.0 / 60)},
    Unit{"arcsec", "arcsec arcsecs arcsecond arcseconds", Quantity::angle, "rad", radians(1.0 / 3600)},
    Unit{"gon", "gon gons gradian gradians", Quantity::angle, "rad", radians(0.9)},
    Unit{"turns", "turn turns rev revs revolution revolutions rot rotation rotations umdrehungen", Quantity::angle,
         "rad", k_two_pi},
    Unit{"counts", "count counts cnt cnts tick ticks pulse pulses step steps lsb raw inc incs increment increments adc",
         Quantity::angle, "rad", 0},

    Unit{"N", "n newton newtons", Quantity::load, "N", 1},
    Unit{"mN", "mn millinewton millinewtons", Quantity::load, "N", 1e-3},
    Unit{"cN", "cn", Quantity::load, "N", 1e-2},
    Unit{"daN", "dan", Quantity::load, "N", 10},
    Unit{"kN", "kn kilonewton kilonewtons", Quantity::load, "N", 1e3},
    Unit{"kg", "kg kgs kgf kp kilo kilos kilogram kilograms", Quantity::load, "N", k_kg},
    Unit{"g", "g gr gf gram grams gramm", Quantity::load, "N", 1e-3 * k_kg},
    Unit{"mg", "mg mgf", Quantity::load, "N", 1e-6 * k_kg},
    Unit{"lbf", "lbf lb lbs pound pounds", Quantity::load, "N", k_lb},
    Unit{"ozf", "ozf oz ounce ounces", Quantity::load, "N", k_lb / 16},
    Unit{"Nm", "nm", Quantity::load, "Nm", 1},
    Unit{"Nmm", "nmm", Quantity::load, "Nmm", 1},
    Unit{"mNm", "mnm", Quantity::load, "Nmm", 1},
    Unit{"Ncm", "ncm", Quantity::load, "Nmm", 10},
    Unit{"kgcm", "kgcm kgfcm", Quantity::load, "Nmm", 10 * k_kg},
    Unit{"kgmm", "kgmm kgfmm", Quantity::load, "Nmm", k_kg},
    Unit{"kgm", "kgm kgfm", Quantity::load, "Nmm", 1000 * k_kg},
    Unit{"gcm", "gcm gfcm", Quantity::load, "Nmm", 1e-2 * k_kg},
    Unit{"gmm", "gmm gfmm", Quantity::load, "Nmm", 1e-3 * k_kg},
    Unit{"lbin", "lbin lbfin lbsin inlb inlbf inlbs", Quantity::load, "Nmm", k_lb* k_inch},
    Unit{"lbft", "lbft lbfft lbsft ftlb ftlbf ftlbs", Quantity::load, "Nmm", 12 * k_lb* k_inch},
    Unit{"ozin", "ozin ozfin inoz inozf", Quantity::load, "Nmm", k_lb / 16 * k_inch},

    Unit{"C", "c °c degc celsius", Quantity::temperature, "C", 1},
    Unit{"K", "k kelvin", Quantity::temperature, "C", 1, -273.15},
    Unit{"F", "f °f degf fahrenheit", Quantity::temperature, "C", 5.0 / 9, -160.0 / 9},
};

/// Lower case without marks between letters: "kgf·cm" and "kgf*cm" become "kgfcm".
std::string squeezed(std::string_view text) {
  std::string letters;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i, 2) == "\xC2\xB7" || text.substr(i, 2) == "\xC2\xA0") {
      ++i;
    } else if (std::string_view(" \t*.-_").find(text[i]) == std::string_view::npos) {
      letters += text[i];
    }
  }
  return lower(letters);
}

bool has_word(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const std::size_t end = list.find(' ');
    if (list.substr(0, end) == word) return true;
    if (end == std::string_view::npos) return false;
    list.remove_prefix(end + 1);
  }
  return false;
}

struct NameAndUnit {
  std::string_view base, unit;
};

/// Splits "load [kg]", "load in kg", "load, kg" and "load/kg". Empty for other forms.
std::optional<NameAndUnit> split_stated_unit(std::string_view name) {
  for (const char* const pair : {"[]", "()", "{}", "<>"}) {
    const std::size_t open = name.rfind(pair[0]);
    if (open == std::string_view::npos || name.back() != pair[1]) continue;
    return NameAndUnit{trimmed(name.substr(0, open)), trimmed(name.substr(open + 1, name.size() - open - 2))};
  }
  for (const std::string_view mark : {std::string_view(" in "), std::string_view(","), std::string_view("/")}) {
    const std::size_t at = name.rfind(mark);
    if (at == std::string_view::npos || at == 0) continue;
    const NameAndUnit parts{trimmed(name.substr(0, at)), trimmed(name.substr(at + mark.size()))};
    if (!parts.base.empty() && !parts.unit.empty()) return parts;
  }
  return std::nullopt;
}

/// Index at which the last word of "load_kg", "load kg" or "loadKg" begins; npos for a single word.
std::size_t last_word_begin(std::string_view name) {
  const std::size_t mark = name.find_last_of("_ .-:");
  if (mark != std::string_view::npos) return mark + 1;
  for (std::size_t i = name.size(); i-- > 1;) {
    const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_large = [](char c) { return c >= 'A' && c <= 'Z'; };
    if (is_large(name[i]) && is_small(name[i - 1])) return i;
  }
  return std::string_view::npos;
}

/// True for letters alone; every byte beyond ASCII counts as one.
bool is_letters(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
  });
}

/// Lower case without separators at the end.
std::string base_of(std::string_view text) {
  while (!text.empty() && std::string_view(" _.-:").find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  return lower(trimmed(text));
}

}  // namespace

const Unit* find_unit(Quantity quantity, std::string_view spelling) {
  const std::string word = squeezed(spelling);
  if (word.empty()) return nullptr;
  for (const Unit& unit : k_units) {
    if (unit.quantity == quantity && has_word(unit.spellings, word)) return &unit;
  }
  return nullptr;
}

const Unit* usual_unit(Quantity quantity) {
  for (const Unit& unit : k_units) {
    if (unit.quantity == quantity) return &unit;  // the first of each quantity
  }
  return nullptr;
}

std::string unit_names(Quantity quantity) {
  std::string names;
  for (const Unit& unit : k_units) {
    if (unit.quantity == quantity) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  }
  return names;
}

ColumnName parse_column_name(std::string_view name, Quantity quantity) {
  name = trimmed(name);
  ColumnName parsed;
  if (name.empty()) return parsed;
  if (const auto parts = split_stated_unit(name)) {
    parsed.unit = find_unit(quantity, parts->unit);
    const bool in_brackets = std::string_view("])}>").find(name.back()) != std::string_view::npos;
    // Names such as "Motor, left" and "joint/position" state no unit.
    if (parsed.unit != nullptr || in_brackets) {
      parsed.base = base_of(parts->base);
      parsed.states_unit = true;
      if (parsed.unit == nullptr) parsed.unknown_unit = parts->unit;
      return parsed;
    }
  }
  const std::size_t last = last_word_begin(name);
  // The longest suffix that is a unit: "tau_kgf_cm" before "tau_kgf". The limit bounds the work on untrusted names.
  constexpr std::size_t k_longest_unit = 40;
  for (std::size_t at = name.size() - std::min(name.size(), k_longest_unit); at < name.size(); ++at) {
    const bool begins_word =
        at == 0 || at == last || std::string_view("_ .-:").find(name[at - 1]) != std::string_view::npos;
    if (!begins_word) continue;
    const Unit* unit = find_unit(quantity, name.substr(at));
    if (unit == nullptr) continue;
    parsed.base = base_of(at == 0 ? name : name.substr(0, at));
    parsed.unit = unit;
    return parsed;
  }
  parsed.base = lower(name);
  if (last == std::string_view::npos || name[last - 1] != '_' || !is_letters(name.substr(last))) return parsed;
  parsed.base = base_of(name.substr(0, last));
  parsed.unknown_unit = name.substr(last);
  return parsed;
}

}  // namespace fusee::measurement
