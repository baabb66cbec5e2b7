// Slips of units: what they leave is a joint of odd proportions.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "analysis/likely_slip.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/mechanism/fields.h"

namespace fusee {
namespace {

// ---- angles ---------------------------------------------------------------------------------------------------------

/// A range within this, in degrees, is no joint's; in radians it is ±92°, wider than most.
constexpr double k_narrow_range = 1.6;
/// A groove whose walls stand within this, in degrees, holds a tendon as well as parallel walls do; in radians 120°,
/// the widest that there is.
constexpr double k_narrow_groove = 2.1;

double in_degrees(double written) { return degrees(written); }

/// Whether a number of degrees is that of a round angle in radians, to three digits: 1.57, 0.7854. A number of whole or
/// half degrees is nobody's radians.
bool is_round_in_radians(double written) {
  const double fifteenths = std::abs(in_degrees(written)) / 15.0;
  const double nearest = std::round(fifteenths);
  const bool near = nearest > 0 && std::abs(fifteenths / nearest - 1.0) < 1e-3;
  return near && std::abs(2.0 * written - std::round(2.0 * written)) > 1e-9;
}

std::vector<LikelySlip> slipped_range(const DeclaredMechanism& mechanism) {
  const double low = degrees(mechanism.joint.theta_min), high = degrees(mechanism.joint.theta_max);
  if (mechanism.transmission || std::max(-low, high) >= k_narrow_range) return {};
  return {{"joint.range_deg",
           "joint.range_deg = [" + rounded(low) + ", " + rounded(high) + "]: a joint that moves by less than " +
               rounded(k_narrow_range) + " deg looks like radians",
           "in degrees it would be [" + rounded(in_degrees(low), 3) + ", " + rounded(in_degrees(high), 3) + "]"}};
}

LikelySlip radians_for_degrees(const std::string& key, double written) {
  return {key, setting_text(key, written) + " deg looks like radians",
          "in degrees it would be " + setting_text(key, std::round(in_degrees(written)))};
}

// ---- lengths --------------------------------------------------------------------------------------------------------

/// A length of the mechanism and how large it may be beside OC before it is odd. The profiles and 300 random joints
/// from finger to arm (tests/laws) lie within half of these all the way, and a tenth or tenfold of theirs beyond: EB
/// and ED 0.3 … 0.75, |OE| up to 0.5, EF 0.5 … 1.6, r1 0.11 … 0.2. A pulley may stand far off from its joint.
struct Proportion {
  const char* key;
  double least;
  double most;
};
constexpr Proportion k_proportions[] = {
    {"guides.EB_mm", 0.09, 3.0},  {"guides.ED_mm", 0.09, 3.0},  {"guides.OE_mm", 0.0, 3.0},
    {"pulley.EF_mm", 0.15, 30.0}, {"pulley.r1_mm", 0.025, 1.0},
};
constexpr const char* k_length = "joint.length_mm";

bool has_length(const DeclaredMechanism& mechanism, const char* key) { return is_used(*find_field(key), mechanism); }

/// Per joint.length_mm.
double proportion(const DeclaredMechanism& mechanism, const char* key) {
  return std::abs(declared_number(mechanism, key)) / mechanism.joint.R;
}

bool is_odd(const DeclaredMechanism& mechanism, const Proportion& allowed) {
  if (!has_length(mechanism, allowed.key)) return false;
  const double here = proportion(mechanism, allowed.key);
  return here < allowed.least || here > allowed.most;
}

bool has_odd_proportions(const DeclaredMechanism& mechanism) {
  return std::any_of(std::begin(k_proportions), std::end(k_proportions),
                     [&](const Proportion& allowed) { return is_odd(mechanism, allowed); });
}

DeclaredMechanism with_number(DeclaredMechanism mechanism, const char* key, double value) {
  find_number_key(key)->set(mechanism, value);
  return mechanism;
}

/// What a length that is right when taken `factor` times was written in.
const char* written_in(double factor) {
  return factor == 10.0 ? "in cm" : factor == 1000.0 ? "in m" : "ten times too large";
}

LikelySlip odd_length(const DeclaredMechanism& mechanism, const char* key, const std::string& how, double factor) {
  const double value = declared_number(mechanism, key);
  return {key, setting_text(key, value) + " mm " + how,
          std::string("is it written ") + written_in(factor) + "? " + setting_text(key, factor * value) +
              " mm would be in proportion"};
}

std::string beside_the_joint(const DeclaredMechanism& mechanism, const char* key) {
  return "is " + rounded(proportion(mechanism, key), 2) + " times " + k_length;
}

/// The one length that, in another unit, brings all into proportion. That of the joint comes last: the others are held
/// against it.
std::vector<LikelySlip> one_slipped_length(const DeclaredMechanism& mechanism) {
  const auto mends = [&](const char* key, double factor) {
    return !has_odd_proportions(with_number(mechanism, key, factor * declared_number(mechanism, key)));
  };
  for (const double factor : {10.0, 0.1, 1000.0}) {
    for (const Proportion& allowed : k_proportions) {
      if (is_odd(mechanism, allowed) && mends(allowed.key, factor))
        return {odd_length(mechanism, allowed.key, beside_the_joint(mechanism, allowed.key), factor)};
    }
    if (mends(k_length, factor)) return {odd_length(mechanism, k_length, "is out of proportion to the others", factor)};
  }
  return {};
}

/// Where more than one number is odd, each by itself.
std::vector<LikelySlip> odd_lengths(const DeclaredMechanism& mechanism) {
  std::vector<LikelySlip> slips;
  for (const Proportion& allowed : k_proportions) {
    if (!is_odd(mechanism, allowed)) continue;
    slips.push_back({allowed.key,
                     setting_text(allowed.key, declared_number(mechanism, allowed.key)) + " mm " +
                         beside_the_joint(mechanism, allowed.key),
                     std::string("are both in mm? It is ordinarily ") + rounded(allowed.least, 2) + " to " +
                         rounded(allowed.most, 2) + " times that"});
  }
  return slips;
}

// ---- all lengths ----------------------------------------------------------------------------------------------------

/// A bought part, which has its size whatever the joint is, and the length that it must be small beside. Profiles and
/// random joints stay below half of these ratios, and a tenth of most of them lies beyond at least one.
struct BoughtPart {
  const char* key;
  const char* beside;
  double most;
  const char* words;
};
constexpr BoughtPart k_bought[] = {
    {"tendon.diameter_mm", "joint.length_mm", 0.08, "a tendon"},
    {"tendon.diameter_mm", "pulley.r1_mm", 0.5, "a tendon"},
    {"guides.radius_mm", "guides.EB_mm", 0.35, "a pin"},
    {"body.bore_diameter_mm", "pulley.r1_mm", 1.6, "a shaft"},
};

const BoughtPart* too_large_part(const DeclaredMechanism& mechanism) {
  for (const BoughtPart& part : k_bought) {
    if (!has_length(mechanism, part.beside)) continue;
    if (declared_number(mechanism, part.key) > part.most * declared_number(mechanism, part.beside)) return &part;
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

std::vector<LikelySlip> all_lengths_slipped(const DeclaredMechanism& mechanism) {
  const BoughtPart* part = too_large_part(mechanism);
  if (part == nullptr) return {};
  const double size = declared_number(mechanism, part->key), length = declared_number(mechanism, part->beside);
  const auto in_proportion = [&](double factor) {
    return too_large_part(all_lengths_times(mechanism, factor)) == nullptr;
  };
  const double factor = in_proportion(10.0) ? 10.0 : 1000.0;
  return {{part->beside,
           setting_text(part->beside, length) + " mm is small for " + part->words + " of " + rounded(size) + " mm (" +
               part->key + ")",
           std::string("are the lengths of [joint], [guides] and [pulley] ") + written_in(factor) + "? " +
               setting_text(k_length, factor * mechanism.joint.R) + " mm and so on would be in proportion; or is " +
               part->key + " too large?"}};
}

// ---- modulus --------------------------------------------------------------------------------------------------------

/// The softest tendon of the catalogue, nylon, has 2000 MPa; rubber has a hundred at most. In GPa the stiffest fibres
/// have some hundred.
constexpr double k_softest_tendon = 100.0;  // MPa

}  // namespace

double declared_number(const DeclaredMechanism& mechanism, const char* key) {
  return find_number_key(key)->get(mechanism);
}

std::string setting_text(const std::string& key, double value) { return key + " = " + rounded(value); }

std::vector<LikelySlip> slipped_angles(const DeclaredMechanism& mechanism) {
  std::vector<LikelySlip> slips = slipped_range(mechanism);
  const double tilt = degrees(mechanism.load.tilt), groove = degrees(mechanism.body.groove_angle);
  if (mechanism.load.mass > 0 && is_round_in_radians(tilt)) slips.push_back(radians_for_degrees("load.tilt_deg", tilt));
  const bool is_whole = std::abs(groove - std::round(groove)) < 1e-9;
  if (mechanism.body.groove != Groove::flat && groove > 0 && groove < k_narrow_groove && !is_whole)
    slips.push_back(radians_for_degrees("body.groove_angle_deg", groove));
  return slips;
}

std::vector<LikelySlip> slipped_lengths(const DeclaredMechanism& mechanism) {
  // With drum and attachments OC is no measure of the joint, nor of a pulley that stands elsewhere.
  if (mechanism.transmission || !mechanism.joint.is_plain() || mechanism.sheath.is_there()) return {};
  if (!has_odd_proportions(mechanism)) return all_lengths_slipped(mechanism);
  std::vector<LikelySlip> slips = one_slipped_length(mechanism);
  return slips.empty() ? odd_lengths(mechanism) : slips;
}

std::vector<LikelySlip> slipped_modulus(const DeclaredMechanism& mechanism) {
  const double modulus = mechanism.tendon.modulus;
  if (mechanism.transmission || modulus >= k_softest_tendon) return {};
  const char* key = "tendon.modulus_MPa";
  return {{key, setting_text(key, modulus) + " MPa is softer than any tendon",
           "is it in GPa? " + setting_text(key, 1000.0 * modulus) + " MPa would be that"}};
}

}  // namespace fusee
