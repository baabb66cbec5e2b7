/// \file
/// Drawings out and in, as DXF; and what a shop's machine would stumble over in one. The same input gives the same
/// bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/base/check.h"
#include "fusee/base/plane.h"
#include "fusee/export/product.h"

namespace fusee {

enum class DxfVersion { ac1015, r12 };

/// The body's sizes without shrinkage and hole compensation, which are a print's.
BodyLayout layout_to_cut(Mechanism mechanism, const SynthesisResult& synthesis);

/// The pulley's curves at true size about the axis, with marks that say how it sits at home.
std::string profile_dxf(const Product& product, DxfVersion version);
/// The part as a stack of plates to cut, nested on sheets.
std::string plates_dxf(const Product& product, DxfVersion version);

/// One closed or open path of a drawing; arcs and circles come as points within 0.001 mm.
struct DrawingPath {
  std::string layer;
  std::string entity;  ///< "LWPOLYLINE", "CIRCLE" …
  int line = 0;        ///< in the file
  bool closed = false;
  Polygon points;
  bool in_space = false;                          ///< `points` is its plan
  std::optional<double> diameter = std::nullopt;  ///< of a whole circle: its own, not that of the points
};

/// An odd entity that did no harm; those of one kind together.
struct DrawingRemark {
  int line = 0;  ///< of the first
  std::string text;
  std::size_t count = 1;
};
/// The reason why an entity was left out.
struct UndrawnEntity {
  int line = 0;
  std::string why;
};

struct Drawing {
  std::string version;               ///< "AC1015", "AC1009" …
  bool millimetres = false;          ///< $INSUNITS = 4, or absent in R12
  std::vector<DrawingPath> paths;    ///< in mm; what meets on one layer is joined
  std::vector<std::string> ignored;  ///< kinds of entity that were passed over
  std::vector<DrawingRemark> remarks = {};
  std::size_t undrawn = 0;  ///< entities whose values draw no curve
  UndrawnEntity first_undrawn = {};
};

/// ASCII DXF, R12 to R2018. Entities that cannot be drawn are counted and the rest is read. InputError with the line
/// where the file as a whole cannot be read.
Drawing read_dxf(std::string_view bytes, const std::string& file_name);

/// Entities that can be drawn, closed contours, ends that meet, no self-crossing, no duplicate lines, smallest feature:
/// one Check each. Lines that are drawn twice are looked at once, and what only an earlier fault makes fail is left
/// out.
std::vector<Check> check_drawing(const Drawing& drawing);

}  // namespace fusee
