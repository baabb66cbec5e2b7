/// \file
/// The tendon that lies on a pulley: along the arc, how much material (unstretched length) an arc length holds.
#pragma once

#include <vector>

namespace fusee {

/// A piece of arc over which the density (material per arc length: 1/(1 + strain)) changes linearly. mm.
struct WoundPiece {
  double from = 0;  ///< arc
  double to = 0;
  double density_from = 1;
  double density_to = 1;

  double length() const { return to - from; }
  /// Arc length × mean density.
  double material() const { return 0.5 * (density_from + density_to) * length(); }
};

/// Last wound, first paid out. Friction on the pulley is taken to hold what was wound (many turns of e^{μφ}); or, where
/// it keeps no strain, every arc holds what it held at first.
class WoundProfile {
 public:
  WoundProfile() = default;
  /// Everything below `arc` was wound at `density`.
  WoundProfile(double arc, double density, bool keeps_strain = true)
      : arc_(arc), base_density_(density), keeps_strain_(keeps_strain) {}

  double arc() const { return arc_; }
  bool keeps_strain() const { return keeps_strain_; }
  /// Material between the arc `down_to` and the present end; negative above the end, where it will be wound as at
  /// first.
  double material_above(double down_to) const;
  /// Winds on to the arc `to`, whose end holds `density`, starting with `density_now`.
  void wind(double to, double density_now, double density);
  /// Winds on at the density of the beginning.
  WoundPiece wind_as_at_first(double to);
  /// Takes off what lies above `down_to`; the pieces, outermost first.
  std::vector<WoundPiece> pay_out(double down_to);

 private:
  double arc_ = 0;
  double base_density_ = 1;
  bool keeps_strain_ = true;
  std::vector<WoundPiece> pieces_;
};

}  // namespace fusee
