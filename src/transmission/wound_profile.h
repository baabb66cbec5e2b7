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

/// Last wound, first paid out. Friction on the pulley is taken to hold what was wound (many turns of e^{μφ}).
class WoundProfile {
 public:
  WoundProfile() = default;
  /// Everything below `arc` was wound at `density`.
  WoundProfile(double arc, double density) : arc_(arc), base_density_(density) {}

  double arc() const { return arc_; }
  /// Material between the arc `down_to` and the present end.
  double material_above(double down_to) const;
  /// Winds on to the arc `to`, whose end holds `density`, starting with `density_now`.
  void wind(double to, double density_now, double density);
  /// Takes off what lies above `down_to`; the pieces, outermost first.
  std::vector<WoundPiece> pay_out(double down_to);

 private:
  double arc_ = 0;
  double base_density_ = 1;
  std::vector<WoundPiece> pieces_;
};

}  // namespace fusee
