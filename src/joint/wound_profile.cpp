#include "joint/wound_profile.h"

#include <algorithm>

namespace fusee {
namespace {

/// The part of `piece` above the arc `from`.
WoundPiece upper_part(const WoundPiece& piece, double from) {
  const double share = (from - piece.from) / piece.length();
  return {from, piece.to, piece.density_from + share * (piece.density_to - piece.density_from), piece.density_to};
}

}  // namespace

double WoundProfile::material_above(double down_to) const {
  double material = 0;
  double end = arc_;
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend() && end > down_to; ++piece) {
    material += (piece->from >= down_to ? *piece : upper_part(*piece, down_to)).material();
    end = std::max(piece->from, down_to);
  }
  return material + base_density_ * (end - down_to);
}

void WoundProfile::wind(double to, double density_now, double density) {
  pieces_.push_back({arc_, to, density_now, density});
  arc_ = to;
}

WoundPiece WoundProfile::wind_as_at_first(double to) {
  const WoundPiece piece{arc_, to, base_density_, base_density_};
  arc_ = to;
  return piece;
}

std::vector<WoundPiece> WoundProfile::pay_out(double down_to) {
  std::vector<WoundPiece> paid;
  while (!pieces_.empty() && arc_ > down_to) {
    WoundPiece& last = pieces_.back();
    if (last.from >= down_to) {
      paid.push_back(last);
      arc_ = last.from;
      pieces_.pop_back();
      continue;
    }
    paid.push_back(upper_part(last, down_to));
    last.density_to = paid.back().density_from;
    last.to = arc_ = down_to;
  }
  if (arc_ > down_to) paid.push_back({down_to, arc_, base_density_, base_density_});
  arc_ = down_to;
  return paid;
}

}  // namespace fusee
