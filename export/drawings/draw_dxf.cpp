#include "export/drawings/draw_dxf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/text.h"
#include "export/drawings/entity_curves.h"
#include "export/drawings/join_paths.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

constexpr double k_sagitta = 0.0007;  // of sampled curves, mm; 0.001 is guaranteed
constexpr double k_farthest = 1e7;    // mm from the origin
constexpr std::size_t k_most_inserts = 200'000;
constexpr std::size_t k_most_tags = 100'000'000;  // processed while blocks are expanded
constexpr int k_deepest_block = 16;
constexpr int k_polyline_3d_flag = 8;  // of group 70
constexpr std::size_t k_most_ignored = 64;
constexpr std::size_t k_most_remarks = 20;

/// An INSERT: the entities of a block, turned, scaled and repeated in columns and rows.
struct DxfInsert {
  int columns;               ///< group 70
  int rows;                  ///< group 71
  Eigen::Matrix2d rotation;  ///< group 50, deg
  Vec2 spacing;              ///< of columns and rows: groups 44 and 45
  Eigen::Matrix2d linear;    ///< scale (groups 41 and 42), then rotation
  Vec2 point;                ///< where the block's base point is placed: group 10

  explicit DxfInsert(const DxfValues& values)
      : columns(std::max(1, values.integer(70, 1))),
        rows(std::max(1, values.integer(71, 1))),
        rotation(Eigen::Rotation2D<double>(radians(values.real(50, 0))).toRotationMatrix()),
        spacing(values.real(44, 0), values.real(45, 0)),
        linear(rotation * Vec2(values.real(41, 1), values.real(42, 1)).asDiagonal()),
        point(values.point(10)) {}

  DrawingPlacement placed(const DrawingPlacement& outer, const Vec2& base, int row, int column) const {
    DrawingPlacement inner;
    inner.linear = outer.linear * linear;
    inner.shift = outer(point + rotation * Vec2(column * spacing.x(), row * spacing.y())) - inner.linear * base;
    return inner;
  }
};

/// An entity with its values interpreted, before it is added to the drawing.
struct InterpretedEntity {
  bool in_paper_space = false;
  std::string layer;
  DrawingPlacement place;
  std::optional<DxfInsert> insert = std::nullopt;
  const DxfBlock* block = nullptr;  ///< the insert's block
  EntityCurve drawn = {};
};

class DxfDrawer {
 public:
  DxfDrawer(const DxfFile& dxf, const std::string& file) : dxf_(dxf), file_(file) {}

  Drawing draw() {
    drawing_.version = dxf_.version;
    // Without units, a file of R12 (AC1009) is taken as mm, because R12 has no key for them.
    constexpr int k_insunits_of_mm = 4;
    drawing_.millimetres = dxf_.units ? *dxf_.units == k_insunits_of_mm : dxf_.version == "AC1009";
    DrawingPlacement in_mm;
    in_mm.linear *= dxf_.unit_in_mm();
    for (const DxfEntity& entity : dxf_.entities) draw(entity, in_mm, "0", 0);
    drawing_.ignored.assign(ignored_.begin(), ignored_.end());
    return std::move(drawing_);
  }

 private:
  /// An entity that is invalid, or further away than k_farthest, is skipped and counted. A drawing with too many inserts,
  /// points or tags, or with blocks nested too deep, throws InputError.
  void draw(const DxfEntity& entity, const DrawingPlacement& placement, const std::string& block_layer, int depth) {
    InterpretedEntity interpreted;
    try {
      interpreted = interpret(entity, placement, block_layer);
    } catch (const InputError& error) {
      const Diagnostic& reason = error.diagnostics().front();
      if (drawing_.undrawn++ == 0) drawing_.first_undrawn = {reason.place.line, reason.message};
      return;
    }
    if (interpreted.in_paper_space) return;
    const EntityCurve& drawn = interpreted.drawn;
    if (!drawn.remark.empty()) remark(entity, drawn.remark);
    if (interpreted.insert) {
      insert(entity, interpreted, depth);
    } else if (drawn.curve) {
      add(entity, interpreted.layer, *drawn.curve);
    } else {
      ignore(entity, drawn.skipped_kind);
    }
  }

  InterpretedEntity interpret(const DxfEntity& entity, const DrawingPlacement& placement,
                              const std::string& block_layer) const {
    const DxfValues values(file_, entity.tags);
    InterpretedEntity interpreted{values.integer(67, 0) == 1, std::string(values.text(8)), placement};
    if (interpreted.in_paper_space) return interpreted;
    // Layer 0 in a block stands for the insert's layer.
    if (interpreted.layer.empty() || interpreted.layer == "0") interpreted.layer = block_layer;
    if (const std::string why = why_hidden(entity, values, interpreted.layer); !why.empty()) {
      interpreted.drawn.skipped_kind = " hidden";
      interpreted.drawn.remark = "this " + std::string(entity.type) + " is not read: " + why;
      return interpreted;
    }
    const Vec2 tilt = values.point(210);  // x and y of the normal: 0 for an entity in the plane
    if (tilt.norm() > 1e-6) {
      interpreted.drawn.skipped_kind = " out of the plane";
      constexpr auto k_curves = std::to_array<std::string_view>(
          {"LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "ARC", "ELLIPSE", "SPLINE", "INSERT"});
      if (std::find(k_curves.begin(), k_curves.end(), entity.type) != k_curves.end())
        interpreted.drawn.remark = "this " + std::string(entity.type) + " lies out of the plane and is not read";
      return interpreted;
    }
    // An entity drawn from below has a mirrored x, except for types in world coordinates.
    const bool has_own_plane = entity.type != "LINE" && entity.type != "ELLIPSE" && entity.type != "SPLINE";
    if (has_own_plane && values.real(230, 1) < 0) interpreted.place.linear.col(0) *= -1;
    if (entity.type == "INSERT") {
      interpreted.insert.emplace(values);
      interpreted.block = &block_of(entity);
      return interpreted;
    }
    interpreted.drawn = curve_of(entity, file_, interpreted.place, k_sagitta);
    if (interpreted.drawn.curve) refuse_distant(entity, interpreted.drawn.curve->points);
    return interpreted;
  }

  /// Why an entity is not shown, or "". A block on a layer that is off shows its parts of other layers.
  std::string why_hidden(const DxfEntity& entity, const DxfValues& values, const std::string& layer) const {
    if (values.integer(60, 0) == 1) return "it is invisible";
    const auto hidden = dxf_.hidden_layers.find(lower(layer));
    if (hidden == dxf_.hidden_layers.end() || (entity.type == "INSERT" && !hidden->second)) return {};
    return "its layer " + quoted_bytes(layer) + " is " + (hidden->second ? "frozen" : "off");
  }

  void refuse_distant(const DxfEntity& entity, const Polygon& points) const {
    for (const Vec2& p : points) {
      if (p.cwiseAbs().maxCoeff() <= k_farthest) continue;
      fail_in_dxf(file_, entity.line,
                  "this " + std::string(entity.type) + " reaches (" + rounded(p.x()) + ", " + rounded(p.y()) +
                      ") mm, further than 10 km");
    }
  }

  /// Lists the type of a skipped entity, followed by `kind`, such as " hidden".
  void ignore(const DxfEntity& entity, const std::string& kind) {
    if (ignored_.size() >= k_most_ignored) return;
    const std::string quoted = quoted_bytes(entity.type);
    const std::string type = quoted.substr(1, quoted.size() - 2);  // without its quotes
    ignored_.insert(type + kind);
  }

  /// Entities of one kind with the same problem give one remark.
  void remark(const DxfEntity& entity, const std::string& text) {
    for (DrawingRemark& known : drawing_.remarks) {
      if (known.text != text) continue;
      ++known.count;
      return;
    }
    if (drawing_.remarks.size() < k_most_remarks) drawing_.remarks.push_back({entity.line, text});
  }

  const DxfBlock& block_of(const DxfEntity& entity) const {
    const std::string name(DxfValues(file_, entity.tags).text(2));
    const auto block = dxf_.blocks.find(lower(name));
    if (block == dxf_.blocks.end()) {
      fail_in_dxf(file_, entity.line,
                  "this INSERT names the block " + quoted_bytes(name) + ", which the file does not hold");
    }
    return block->second;
  }

  void insert(const DxfEntity& entity, const InterpretedEntity& interpreted, int depth) {
    if (depth >= k_deepest_block) {
      fail_in_dxf(file_, entity.line,
                  "blocks are nested more than " + std::to_string(k_deepest_block) + " deep (or in a ring)");
    }
    const DxfInsert& insert = *interpreted.insert;
    const DxfBlock& block = *interpreted.block;
    for (int row = 0; row < insert.rows; ++row) {
      for (int column = 0; column < insert.columns; ++column) {
        if (++inserts_ > k_most_inserts) {
          fail_in_dxf(file_, entity.line,
                      "the drawing inserts more than " + std::to_string(k_most_inserts) + " blocks");
        }
        const DrawingPlacement inner = insert.placed(interpreted.place, block.base, row, column);
        for (const DxfEntity& part : block.entities) {
          expanded_tags_ += part.size;
          if (expanded_tags_ > k_most_tags)
            fail_in_dxf(file_, entity.line, "the blocks of the drawing are inserted too often to be expanded");
          draw(part, inner, interpreted.layer, depth + 1);
        }
      }
    }
  }

  /// Removes repeated points, and a last point that closes the curve.
  void add(const DxfEntity& entity, const std::string& layer, const SampledCurve& curve) {
    DrawingPath path{layer, std::string(entity.type), entity.line, curve.closed, {}};
    path.in_space =
        entity.type == "POLYLINE" && (DxfValues(file_, entity.tags).integer(70, 0) & k_polyline_3d_flag) != 0;
    path.diameter = curve.diameter;
    points_ += curve.points.size();
    if (points_ > k_most_points) {
      fail_in_dxf(file_, entity.line, "the drawing has more than " + std::to_string(k_most_points) + " points");
    }
    path.points.reserve(curve.points.size());
    for (const Vec2& p : curve.points) {
      if (path.points.empty() || p != path.points.back()) path.points.push_back(p);
    }
    close_where_ends_meet(path);
    if (path.points.size() < 2) {
      remark(entity, "this " + path.entity + " draws nothing: it has no length");
      ignore(entity, " of no length");
      return;
    }
    drawing_.paths.push_back(std::move(path));
  }

  const DxfFile& dxf_;
  const std::string& file_;
  Drawing drawing_;
  std::set<std::string> ignored_;
  std::size_t points_ = 0;
  std::size_t inserts_ = 0;
  std::size_t expanded_tags_ = 0;
};

}  // namespace

Drawing draw_dxf(const DxfFile& dxf, const std::string& file) { return DxfDrawer(dxf, file).draw(); }

}  // namespace fusee::formats
