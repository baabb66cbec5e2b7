// Unit errors, detected by implausible proportions of the joint.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "analysis/input_warning.h"
#include "base/text.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::analysis {
namespace {

// ---- angles ---------------------------------------------------------------------------------------------------------

/// No joint has a smaller range in degrees; in radians it is ±92°, wider than most.
constexpr double k_narrow_range = 1.6;
/// A smaller groove angle in degrees is practically parallel walls; in radians it is 120°, the maximum.
constexpr double k_narrow_groove = 2.1;

/// Distance from the next whole number below which a number is whole.
constexpr double k_whole = 1e-9;

/// A number that was written for degrees, if it is meant in radians.
double in_degrees(double written) { return degrees(written); }

/// True if a number in degrees equals a round angle in radians to three digits: 1.57, 0.7854. Whole and half degrees
/// are not taken for radians.
bool is_round_in_radians(double written) {
  constexpr double k_round_angle = 15.0;  // deg: its multiples are round
  constexpr double k_three_digits = 1e-3;
  const double multiple = std::abs(in_degrees(written)) / k_round_angle;
  const double nearest = std::round(multiple);
  const bool is_round = nearest > 0 && std::abs(multiple / nearest - 1.0) < k_three_digits;
  const bool is_whole_or_half_degree = !(std::abs(2.0 * written - std::round(2.0 * written)) > k_whole);
  return is_round && !is_whole_or_half_degree;
}

std::vector<InputWarning> range_warnings(const DeclaredMechanism& mechanism) {
  const double low = degrees(mechanism.joint.theta_min), high = degrees(mechanism.joint.theta_max);
  if (mechanism.transmission || std::max(-low, high) >= k_narrow_range) return {};
  return {{"joint.range_deg",
           "joint.range_deg = [" + rounded(low) + ", " + rounded(high) + "]: a joint that moves by less than " +
               rounded(k_narrow_range) + " deg looks like radians",
           "in degrees it would be [" + rounded(in_degrees(low), 3) + ", " + rounded(in_degrees(high), 3) + "]"}};
}

InputWarning radians_for_degrees(const std::string& key, double written) {
  return {key, setting_text(key, written) + " deg looks like radians",
          "in degrees it would be " + setting_text(key, std::round(in_degrees(written)))};
}

// ---- lengths --------------------------------------------------------------------------------------------------------

/// Plausible range of a length relative to OC. Profiles and 300 random joints from finger to arm (tests/laws) stay
/// within these bounds by a factor of two. A length that is wrong by a factor of ten exceeds them. Typical: EB and ED
/// 0.3 … 0.75, |OE| up to 0.5, EF 0.5 … 1.6, r1 0.11 … 0.2. A pulley may be far from its joint.
struct Proportion {
  const char* key;
  double least;  ///< of length / OC
  double most;
};
constexpr Proportion k_proportions[] = {
    {"guides.EB_mm", 0.09, 3.0},  {"guides.ED_mm", 0.09, 3.0},  {"guides.OE_mm", 0.0, 3.0},
    {"pulley.EF_mm", 0.15, 30.0}, {"pulley.r1_mm", 0.025, 1.0},
};
constexpr const char* k_reference_key = "joint.length_mm";

bool has_length(const DeclaredMechanism& mechanism, const char* key) { return is_used(*find_field(key), mechanism); }

/// The length relative to joint.length_mm.
double proportion(const DeclaredMechanism& mechanism, const char* key) {
  return std::abs(declared_number(mechanism, key)) / mechanism.joint.R;
}

bool is_odd(const DeclaredMechanism& mechanism, const Proportion& allowed) {
  if (!has_length(mechanism, allowed.key)) return false;
  const double value = proportion(mechanism, allowed.key);
  return value < allowed.least || value > allowed.most;
}

bool has_odd_proportions(const DeclaredMechanism& mechanism) {
  return std::any_of(std::begin(k_proportions), std::end(k_proportions),
                     [&](const Proportion& allowed) { return is_odd(mechanism, allowed); });
}

DeclaredMechanism with_number(DeclaredMechanism mechanism, const char* key, double value) {
  find_number_key(key)->set(mechanism, value);
  return mechanism;
}

constexpr double k_mm_per_inch = 25.4;

/// The unit of a length that is correct after multiplication by `factor`.
const char* written_in(double factor) {
  if (factor == 10.0) return "in cm";
  if (factor == k_mm_per_inch) return "in inches";
  if (factor == 1.0 / k_mm_per_inch) return "in mm";
  if (factor == 1000.0) return "in m";
  return "ten times too large";
}

/// Likely factors between a length as read and as meant, in groups from likely to unlikely.
std::vector<std::vector<double>> unit_factors(LengthUnit units) {
  if (units == LengthUnit::inch) return {{1.0 / k_mm_per_inch}, {10.0}, {0.1}};
  return {{10.0, k_mm_per_inch}, {0.1}, {1000.0}};
}

/// "is it in cm or in inches? guides.EB_mm = 50 mm or 127 mm would be in proportion"
std::string proportionate_text(const std::string& subject, const char* key, double value,
                               const std::vector<double>& factors, const std::string& after_values) {
  std::string units, values;
  for (const double factor : factors) {
    units += (units.empty() ? "" : " or ") + std::string(written_in(factor));
    values += (values.empty() ? setting_text(key, factor * value) : " or " + rounded(factor * value)) + " mm";
  }
  return subject + " " + units + "? " + values + after_values + " would be in proportion";
}

InputWarning odd_length(const DeclaredMechanism& mechanism, const char* key, const std::string& oddity,
                        const std::vector<double>& factors) {
  const double value = declared_number(mechanism, key);
  return {key, setting_text(key, value) + " mm " + oddity, proportionate_text("is it", key, value, factors, "")};
}

std::string beside_the_joint(const DeclaredMechanism& mechanism, const char* key) {
  return "is " + rounded(proportion(mechanism, key), 2) + " times " + k_reference_key;
}

/// The one length that, in another unit or units, makes all proportions plausible. The length of the joint is tried
/// last, because it is the reference of the others.
std::vector<InputWarning> single_length_warning(const DeclaredMechanism& mechanism) {
  const auto factors_that_suffice = [&](const char* key, std::vector<double> factors) {
    std::erase_if(factors, [&](double factor) {
      return has_odd_proportions(with_number(mechanism, key, factor * declared_number(mechanism, key)));
    });
    return factors;
  };
  for (const std::vector<double>& factors : unit_factors(mechanism.units)) {
    for (const Proportion& allowed : k_proportions) {
      if (!is_odd(mechanism, allowed)) continue;
      if (const auto sufficient = factors_that_suffice(allowed.key, factors); !sufficient.empty())
        return {odd_length(mechanism, allowed.key, beside_the_joint(mechanism, allowed.key), sufficient)};
    }
    if (const auto sufficient = factors_that_suffice(k_reference_key, factors); !sufficient.empty())
      return {odd_length(mechanism, k_reference_key, "is out of proportion to the others", sufficient)};
  }
  return {};
}

/// Reports each odd length separately.
std::vector<InputWarning> odd_lengths(const DeclaredMechanism& mechanism) {
  std::vector<InputWarning> warnings;
  for (const Proportion& allowed : k_proportions) {
    if (!is_odd(mechanism, allowed)) continue;
    warnings.push_back({allowed.key,
                        setting_text(allowed.key, declared_number(mechanism, allowed.key)) + " mm " +
                            beside_the_joint(mechanism, allowed.key),
                        std::string("are both in mm? The usual range is ") + rounded(allowed.least, 2) + " to " +
                            rounded(allowed.most, 2) + " times that"});
  }
  return warnings;
}

// ---- all lengths ----------------------------------------------------------------------------------------------------

/// A purchased part of fixed size, and the length that must be large compared with it. Profiles and random joints stay
/// below half of these ratios; in cm, most exceed at least one.
struct BoughtPart {
  const char* key;
  const char* reference;  ///< key of that length
  double most;            ///< of part / length
  const char* words;
};
constexpr BoughtPart k_bought[] = {
    {"tendon.diameter_mm", "joint.length_mm", 0.08, "a tendon"},
    {"tendon.diameter_mm", "pulley.r1_mm", 0.5, "a tendon"},
    {"guides.radius_mm", "guides.EB_mm", 0.35, "a pin"},
    {"body.bore_diameter_mm", "pulley.r1_mm", 1.6, "a shaft"},
};

/// A purchased part that is too large for its reference length; null if there is none.
const BoughtPart* too_large_part(const DeclaredMechanism& mechanism) {
  for (const BoughtPart& part : k_bought) {
    if (!has_length(mechanism, part.reference)) continue;
    if (declared_number(mechanism, part.key) > part.most * declared_number(mechanism, part.reference)) return &part;
  }
  return nullptr;
}

DeclaredMechanism all_lengths_times(DeclaredMechanism mechanism, double factor) {
  mechanism.joint.R *= factor;
  mechanism.pulley.EF *= factor;
  mechanism.pulley.r1 *= factor;
  for (double* length : {&mechanism.guides.EB, &mechanism.guides.ED, &mechanism.guides.OE}) *length *= factor;
  return mechanism;
}

std::vector<InputWarning> all_lengths_warning(const DeclaredMechanism& mechanism) {
  const BoughtPart* part = too_large_part(mechanism);
  if (part == nullptr) return {};
  const double size = declared_number(mechanism, part->key), length = declared_number(mechanism, part->reference);
  std::vector<double> factors{10.0, k_mm_per_inch};
  std::erase_if(factors,
                [&](double factor) { return too_large_part(all_lengths_times(mechanism, factor)) != nullptr; });
  if (factors.empty()) factors = {1000.0};
  const bool in_inches = std::count(factors.begin(), factors.end(), k_mm_per_inch) > 0;
  return {{part->reference,
           setting_text(part->reference, length) + " mm is small for " + part->words + " of " + rounded(size) +
               " mm (" + part->key + ")",
           proportionate_text("are the lengths of [joint], [guides] and [pulley]", k_reference_key, mechanism.joint.R,
                              factors, " and so on") +
               (in_inches ? " (units = \"inch\" for a file in inches)" : "") + "; or is " + part->key + " too large?"}};
}

/// No tendon of a catalogue is thicker. A diameter in mm that is read as inches exceeds it.
constexpr double k_thickest_tendon = 8.0;  // mm

std::vector<InputWarning> inch_file_warning(const DeclaredMechanism& mechanism) {
  const double diameter = mechanism.tendon.diameter;
  if (mechanism.units != LengthUnit::inch || diameter <= k_thickest_tendon) return {};
  const char* key = "tendon.diameter_mm";
  return {{key, setting_text(key, diameter) + " mm is thicker than any tendon",
           "are the file's lengths in mm? Then leave out units = \"inch\""}};
}

// ---- modulus --------------------------------------------------------------------------------------------------------

/// The softest tendon of the catalogue, nylon, has 2000 MPa, and rubber at most a hundred. In GPa the stiffest fibres
/// have some hundred.
constexpr double k_softest_tendon = 100.0;  // MPa

}  // namespace

double declared_number(const DeclaredMechanism& mechanism, const char* key) {
  return find_number_key(key)->get(mechanism);
}

std::string setting_text(const std::string& key, double value) { return key + " = " + rounded(value); }

std::vector<InputWarning> angle_warnings(const DeclaredMechanism& mechanism) {
  std::vector<InputWarning> warnings = range_warnings(mechanism);
  const double tilt = degrees(mechanism.load.tilt), groove = degrees(mechanism.body.groove_angle);
  if (mechanism.load.mass_kg > 0 && is_round_in_radians(tilt))
    warnings.push_back(radians_for_degrees("load.tilt_deg", tilt));
  const bool is_whole = std::abs(groove - std::round(groove)) < k_whole;
  if (mechanism.body.groove != Groove::flat && groove > 0 && groove < k_narrow_groove && !is_whole)
    warnings.push_back(radians_for_degrees("body.groove_angle_deg", groove));
  return warnings;
}

std::vector<InputWarning> length_warnings(const DeclaredMechanism& mechanism) {
  // With a drum or attachments OC is no reference length, and neither is it for a pulley at the end of a sheath.
  if (mechanism.transmission) return {};
  if (auto inch = inch_file_warning(mechanism); !inch.empty()) return inch;
  if (!mechanism.joint.is_plain() || mechanism.sheath.is_there()) return {};
  if (!has_odd_proportions(mechanism)) return all_lengths_warning(mechanism);
  std::vector<InputWarning> warnings = single_length_warning(mechanism);
  return warnings.empty() ? odd_lengths(mechanism) : warnings;
}

std::vector<InputWarning> modulus_warnings(const DeclaredMechanism& mechanism) {
  const double modulus = mechanism.tendon.modulus;
  if (mechanism.transmission || modulus >= k_softest_tendon) return {};
  const char* key = "tendon.modulus_MPa";
  return {{key, setting_text(key, modulus) + " MPa is softer than any tendon",
           "is it in GPa? " + setting_text(key, 1000.0 * modulus) + " MPa would be that"}};
}

}  // namespace fusee::analysis
