/// \file
/// Writes and reads drawings as DXF, and checks them for faults that stop a workshop's machine. The same input gives
/// the same bytes.
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

/// The body's sizes without shrinkage and hole compensation, which apply to prints only.
BodyLayout layout_to_cut(Mechanism mechanism, const SynthesisResult& synthesis);

/// The pulley's curves at true size about the axis, with marks of its home position.
std::string profile_dxf(const Product& product, DxfVersion version);
/// The part as a stack of plates to cut, nested on sheets.
std::string plates_dxf(const Product& product, DxfVersion version);

/// One closed or open path of a drawing. Arcs and circles are points within 0.001 mm.
struct DrawingPath {
  std::string layer;
  std::string entity;  ///< "LWPOLYLINE", "CIRCLE" …
  int line = 0;        ///< line in the file
  bool closed = false;
  Polygon points;
  bool in_space = false;                          ///< `points` is its plan
  std::optional<double> diameter = std::nullopt;  ///< of a whole circle: the exact value, not that of the points
};

/// An unusual entity without effect; entities of one kind are combined.
struct DrawingRemark {
  int line = 0;  ///< of the first one
  std::string text;
  std::size_t count = 1;
};
/// The reason why an entity was omitted.
struct UndrawnEntity {
  int line = 0;
  std::string why;
};

struct Drawing {
  std::string version;               ///< "AC1015", "AC1009" …
  bool millimetres = false;          ///< $INSUNITS = 4, or absent in R12
  std::vector<DrawingPath> paths;    ///< in mm; paths that meet on one layer are joined
  std::vector<std::string> ignored;  ///< kinds of entity that were skipped
  std::vector<DrawingRemark> remarks = {};
  std::size_t undrawn = 0;  ///< entities whose values draw no curve
  UndrawnEntity first_undrawn = {};
};

/// Reads ASCII DXF, R12 to R2018. Entities that cannot be drawn are counted and skipped. Throws InputError with the
/// line if the file as a whole cannot be read.
Drawing read_dxf(std::string_view bytes, const std::string& file_name);

/// Checks for drawable entities, closed contours, meeting ends, self-crossings, duplicate lines and the smallest
/// feature: one Check each. Duplicate lines are tested once, and checks that an earlier fault makes meaningless are
/// omitted.
std::vector<Check> check_drawing(const Drawing& drawing);

}  // namespace fusee
