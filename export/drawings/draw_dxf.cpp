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
constexpr std::size_t k_most_ignored = 64;
constexpr std::size_t k_most_remarks = 20;

/// An INSERT: the entities of a block, turned, scaled and repeated in columns and rows.
struct DxfInsert {
  int columns;
  int rows;
  Eigen::Matrix2d turn;
  Vec2 step;
  Eigen::Matrix2d scaled;  ///< includes the turn
  Vec2 point;

  explicit DxfInsert(const DxfValues& values)
      : columns(std::max(1, values.integer(70, 1))),
        rows(std::max(1, values.integer(71, 1))),
        turn(Eigen::Rotation2D<double>(radians(values.real(50, 0))).toRotationMatrix()),
        step(values.real(44, 0), values.real(45, 0)),
        scaled(turn * Vec2(values.real(41, 1), values.real(42, 1)).asDiagonal()),
        point(values.point(10)) {}

  DrawingPlacement placed(const DrawingPlacement& outer, const Vec2& base, int row, int column) const {
    DrawingPlacement inner;
    inner.linear = outer.linear * scaled;
    inner.shift = outer(point + turn * Vec2(column * step.x(), row * step.y())) - inner.linear * base;
    return inner;
  }
};

/// The interpretation of an entity's values, before drawing.
struct UnderstoodEntity {
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
    drawing_.millimetres = dxf_.units ? *dxf_.units == 4 : dxf_.version == "AC1009";
    DrawingPlacement whole;
    whole.linear *= dxf_.unit_in_mm();
    for (const DxfEntity& entity : dxf_.entities) draw(entity, whole, "0", 0);
    drawing_.ignored.assign(ignored_.begin(), ignored_.end());
    return std::move(drawing_);
  }

 private:
  /// An invalid entity is skipped and counted. Excessive numbers end the reading.
  void draw(const DxfEntity& entity, const DrawingPlacement& placement, const std::string& block_layer, int depth) {
    UnderstoodEntity understood;
    try {
      understood = understand(entity, placement, block_layer);
    } catch (const InputError& error) {
      const Diagnostic& reason = error.diagnostics().front();
      if (drawing_.undrawn++ == 0) drawing_.first_undrawn = {reason.place.line, reason.message};
      return;
    }
    if (understood.in_paper_space) return;
    const EntityCurve& drawn = understood.drawn;
    if (!drawn.remark.empty()) remark(entity, drawn.remark);
    if (understood.insert) {
      insert(entity, understood, depth);
    } else if (drawn.curve) {
      add(entity, understood.layer, *drawn.curve);
    } else {
      ignore(entity, drawn.passed_over);
    }
  }

  UnderstoodEntity understand(const DxfEntity& entity, const DrawingPlacement& placement,
                              const std::string& block_layer) const {
    const DxfValues values(file_, entity.tags);
    UnderstoodEntity understood{values.integer(67, 0) == 1, std::string(values.text(8)), placement};
    if (understood.in_paper_space) return understood;
    // Layer 0 in a block stands for the insert's layer.
    if (understood.layer.empty() || understood.layer == "0") understood.layer = block_layer;
    if (const std::string why = hiding(entity, values, understood.layer); !why.empty()) {
      understood.drawn.passed_over = " hidden";
      understood.drawn.remark = "this " + std::string(entity.type) + " is not read: " + why;
      return understood;
    }
    if (values.point(210).norm() > 1e-6) {
      understood.drawn.passed_over = " out of the plane";
      constexpr auto k_curves = std::to_array<std::string_view>(
          {"LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "ARC", "ELLIPSE", "SPLINE", "INSERT"});
      if (std::find(k_curves.begin(), k_curves.end(), entity.type) != k_curves.end())
        understood.drawn.remark = "this " + std::string(entity.type) + " lies out of the plane and is not read";
      return understood;
    }
    // The x of an entity drawn from below is mirrored (except for those in world coordinates).
    const bool has_own_plane = entity.type != "LINE" && entity.type != "ELLIPSE" && entity.type != "SPLINE";
    if (has_own_plane && values.real(230, 1) < 0) understood.place.linear.col(0) *= -1;
    if (entity.type == "INSERT") {
      understood.insert.emplace(values);
      understood.block = &block_of(entity);
      return understood;
    }
    understood.drawn = curve_of(entity, file_, understood.place, k_sagitta);
    if (understood.drawn.curve) demand_near(entity, understood.drawn.curve->points);
    return understood;
  }

  /// Why an entity is not shown, or "". A block on a layer that is off shows its parts of other layers.
  std::string hiding(const DxfEntity& entity, const DxfValues& values, const std::string& layer) const {
    if (values.integer(60, 0) == 1) return "it is invisible";
    const auto hidden = dxf_.hidden_layers.find(lower(layer));
    if (hidden == dxf_.hidden_layers.end() || (entity.type == "INSERT" && !hidden->second)) return {};
    return "its layer " + quoted_bytes(layer) + " is " + (hidden->second ? "frozen" : "off");
  }

  void demand_near(const DxfEntity& entity, const Polygon& points) const {
    for (const Vec2& p : points) {
      if (p.cwiseAbs().maxCoeff() <= k_farthest) continue;
      fail_in_dxf(file_, entity.line,
                  "this " + std::string(entity.type) + " reaches (" + rounded(p.x()) + ", " + rounded(p.y()) +
                      ") mm, further than 10 km");
    }
  }

  void ignore(const DxfEntity& entity, const std::string& kind) {
    if (ignored_.size() >= k_most_ignored) return;
    const std::string name = quoted_bytes(entity.type);
    ignored_.insert(name.substr(1, name.size() - 2) + kind);
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

  void insert(const DxfEntity& entity, const UnderstoodEntity& understood, int depth) {
    if (depth >= k_deepest_block) {
      fail_in_dxf(file_, entity.line,
                  "blocks are nested more than " + std::to_string(k_deepest_block) + " deep (or in a ring)");
    }
    const DxfInsert& insert = *understood.insert;
    const DxfBlock& block = *understood.block;
    for (int row = 0; row < insert.rows; ++row) {
      for (int column = 0; column < insert.columns; ++column) {
        if (++inserts_ > k_most_inserts) {
          fail_in_dxf(file_, entity.line,
                      "the drawing inserts more than " + std::to_string(k_most_inserts) + " blocks");
        }
        const DrawingPlacement inner = insert.placed(understood.place, block.base, row, column);
        for (const DxfEntity& part : block.entities) {
          expanded_ += part.size;
          if (expanded_ > k_most_tags)
            fail_in_dxf(file_, entity.line, "the blocks of the drawing are inserted too often to be expanded");
          draw(part, inner, understood.layer, depth + 1);
        }
      }
    }
  }

  /// Removes repeated points, and a last point that closes the curve.
  void add(const DxfEntity& entity, const std::string& layer, const SampledCurve& curve) {
    DrawingPath path{layer, std::string(entity.type), entity.line, curve.closed, {}};
    path.in_space = entity.type == "POLYLINE" && (DxfValues(file_, entity.tags).integer(70, 0) & 8) != 0;
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
  std::size_t expanded_ = 0;  // tags
};

}  // namespace

Drawing draw_dxf(const DxfFile& dxf, const std::string& file) { return DxfDrawer(dxf, file).draw(); }

}  // namespace fusee::formats
