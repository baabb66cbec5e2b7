/// \file
/// DXF in: ASCII, R12 to R2018. Straight and curved entities of model space come out as polylines in mm; open ones
/// whose ends meet (end_points.h: within 1e-4 mm) on one layer come out joined. What is no line (text, dimensions,
/// hatches …) is named in `ignored`.
///
/// Any bytes are safe: every number is checked, blocks nest 16 deep at most, and the whole drawing may hold 4 million
/// points.
#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "export/drawings/end_points.h"
#include "fusee/base/diagnostics.h"
#include "fusee/base/text.h"
#include "fusee/base/units.h"
#include "fusee/export/export.h"

namespace fusee {
namespace {

constexpr double k_sagitta = 0.001;  // of sampled curves, mm
constexpr std::size_t k_most_points = 4'000'000;
constexpr std::size_t k_most_inserts = 200'000;
constexpr std::size_t k_most_tags = 100'000'000;  // gone through while blocks are expanded
constexpr int k_deepest_block = 16;
constexpr int k_most_steps = 20'000;  // of one arc
constexpr double k_farthest = 1e7;    // mm from the origin

struct Tag {
  int code = 0;
  std::string_view value;
  int line = 0;  // of the value
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

[[noreturn]] void fail(const std::string& file, int line, std::string message, std::string hint = {}) {
  throw InputError(Diagnostic{Severity::error, {file, line, 0}, std::move(message), std::move(hint)});
}

/// What a message may show of foreign bytes.
std::string shown(std::string_view text) {
  std::string plain = "'";
  for (const char c : text.substr(0, 40)) plain += c >= ' ' && c <= '~' ? c : '?';
  return plain + "'";
}

/// Splits the bytes into tags, two lines each.
class TagReader {
 public:
  TagReader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  /// The next tag; a remark (999) is skipped. Null at the end of the bytes.
  std::optional<Tag> next() {
    for (;;) {
      const auto code_line = next_line();
      if (!code_line) return std::nullopt;
      const std::string_view text = trimmed(*code_line);
      if (text.empty() && position_ >= bytes_.size()) return std::nullopt;
      int code = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code);
      if (error != std::errc{} || end != text.data() + text.size() || code < -5 || code > 1071) {
        fail(file_, line_, "a group code (a whole number) should stand here, not " + shown(text),
             "the file is no DXF, or damaged from here on");
      }
      const auto value = next_line();
      if (!value)
        fail(file_, line_, "the file ends where the value of group " + std::to_string(code) + " should stand",
             "it was cut short: export it again");
      if (code != 999) return Tag{code, trimmed(*value), line_};
    }
  }

 private:
  std::optional<std::string_view> next_line() {
    if (position_ >= bytes_.size()) return std::nullopt;
    const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
    const std::string_view line = bytes_.substr(position_, end - position_);
    position_ = end + 1;
    ++line_;
    return line;
  }

  std::string_view bytes_;
  const std::string& file_;
  std::size_t position_ = 0;
  int line_ = 0;
};

/// One entity as it stands in the file; the vertices of an old POLYLINE are with it.
struct Entity {
  std::string_view type;
  int line = 0;
  std::vector<Tag> tags;
  std::vector<std::vector<Tag>> vertices;
  std::size_t size = 0;  ///< tags in all
};

struct Block {
  Vec2 base = Vec2::Zero();
  std::vector<Entity> entities;
};

/// Turns the numbers of an entity's tags into doubles, with the line in what goes wrong.
class Values {
 public:
  Values(const std::string& file, const std::vector<Tag>& tags) : file_(file), tags_(tags) {}

  static double parse(const std::string& file, const Tag& tag) {
    std::string_view text = tag.value;
    if (!text.empty() && text[0] == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool tiny = error == std::errc::result_out_of_range && text.find("e-") != std::string_view::npos;
    if (!tiny && (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))) {
      fail(file, tag.line,
           "a number should stand here (group " + std::to_string(tag.code) + "), not " + shown(tag.value));
    }
    return tiny ? 0 : value;
  }

  const Tag* find(int code) const {
    const auto found = std::find_if(tags_.begin(), tags_.end(), [code](const Tag& t) { return t.code == code; });
    return found == tags_.end() ? nullptr : &*found;
  }
  std::string_view text(int code) const {
    const Tag* tag = find(code);
    return tag ? tag->value : std::string_view{};
  }
  double real(int code, double fallback) const {
    const Tag* tag = find(code);
    return tag ? parse(file_, *tag) : fallback;
  }
  int integer(int code, int fallback) const {
    const Tag* tag = find(code);
    if (!tag) return fallback;
    const double value = parse(file_, *tag);
    if (value != std::floor(value) || std::abs(value) > 1e9) {
      fail(file_, tag->line,
           "a whole number should stand here (group " + std::to_string(code) + "), not " + shown(tag->value));
    }
    return static_cast<int>(value);
  }
  Vec2 point(int code) const { return {real(code, 0), real(code + 10, 0)}; }

 private:
  const std::string& file_;
  const std::vector<Tag>& tags_;
};

/// Plane affine map: block coordinates → drawing, mm.
struct Placement {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Vec2 shift = Vec2::Zero();

  Vec2 operator()(const Vec2& p) const { return linear * p + shift; }
  /// How much a length can grow at most.
  double growth() const { return std::max(linear.norm(), 1e-12); }
};

struct Curve {
  Polygon points;
  bool closed = false;
};

int arc_steps(double radius, double turn, double sagitta) {
  if (!(radius > sagitta)) return 8;
  const double steps = std::ceil(std::abs(turn) / std::sqrt(8 * sagitta / radius));
  return static_cast<int>(std::clamp(steps, 2.0, static_cast<double>(k_most_steps)));
}

/// From `from` (which is not repeated) to `to`: the arc of a bulge, tan of a quarter of its turning.
void append_bulge(Polygon& points, const Vec2& from, const Vec2& to, double bulge, double sagitta) {
  if (bulge != 0 && std::abs(bulge) < 1e6 && (to - from).norm() > 0) {
    const double turn = 4 * std::atan(bulge);
    const Vec2 centre = 0.5 * (from + to) + turned_left(to - from) * ((1 - bulge * bulge) / (4 * bulge));
    const Vec2 spoke = from - centre;
    const int steps = arc_steps(spoke.norm(), turn, sagitta);
    for (int i = 1; i < steps; ++i) {
      points.push_back(centre + Eigen::Rotation2D<double>(turn * i / steps).toRotationMatrix() * spoke);
    }
  }
  points.push_back(to);
}

struct BulgeVertex {
  Vec2 place = Vec2::Zero();
  double bulge = 0;
};

Curve bulge_curve(const std::vector<BulgeVertex>& vertices, bool closed, double sagitta) {
  Curve curve{{}, closed};
  if (vertices.empty()) return curve;
  curve.points.push_back(vertices.front().place);
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    append_bulge(curve.points, vertices[i].place, vertices[i + 1].place, vertices[i].bulge, sagitta);
  }
  if (closed && vertices.size() > 1) {
    append_bulge(curve.points, vertices.back().place, vertices.front().place, vertices.back().bulge, sagitta);
    curve.points.pop_back();
  }
  return curve;
}

Curve arc_curve(const Vec2& centre, double radius, double from, double to, double sagitta) {
  Curve curve;
  while (to <= from) to += k_two_pi;
  const int steps = arc_steps(radius, to - from, sagitta);
  for (int i = 0; i <= steps; ++i) curve.points.push_back(centre + radius * unit(from + (to - from) * i / steps));
  return curve;
}

Curve closed_by_full_turn(Curve curve) {
  curve.points.pop_back();
  curve.closed = true;
  return curve;
}

/// A (rational) B-spline by de Boor's recursion.
struct Spline {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec3> poles;  // (x w, y w, w)

  Vec2 at(double t, std::size_t span) const {
    std::vector<Vec3> d(poles.begin() + static_cast<std::ptrdiff_t>(span) - degree,
                        poles.begin() + static_cast<std::ptrdiff_t>(span) + 1);
    const auto p = static_cast<std::size_t>(degree);
    for (std::size_t r = 1; r <= p; ++r) {
      for (std::size_t j = p; j >= r; --j) {
        const double low = knots[j + span - p];
        const double width = knots[j + 1 + span - r] - low;
        const double a = width > 0 ? (t - low) / width : 0;
        d[j] = (1 - a) * d[j - 1] + a * d[j];
      }
    }
    return d[p].head<2>() / d[p].z();
  }

  /// Points after `from` up to and with `to`, halving until the middle lies on the chord.
  void sample(Polygon& out, std::size_t span, double t0, const Vec2& from, double t1, const Vec2& to, double sagitta,
              int depth) const {
    const double tm = 0.5 * (t0 + t1);
    const Vec2 middle = at(tm, span);
    // The first halvings are made anyway: an inflection may put the middle on the chord.
    const bool flat = (middle - 0.5 * (from + to)).norm() <= sagitta;
    if (depth >= 12 || (flat && depth >= 2)) {
      out.push_back(to);
      return;
    }
    sample(out, span, t0, from, tm, middle, sagitta, depth + 1);
    sample(out, span, tm, middle, t1, to, sagitta, depth + 1);
  }
};

/// The reader's work on one file.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : file_(file), tags_(bytes, file) {}

  Drawing read() {
    read_sections();
    if (!saw_entities_) fail(file_, 0, "the file has no ENTITIES section", "is it a DXF drawing?");
    drawing_.version = version_.empty() ? "AC1009" : version_;
    drawing_.millimetres = units_ ? *units_ == 4 : drawing_.version == "AC1009";
    Placement whole;
    whole.linear *= unit_in_mm();
    for (const Entity& entity : entities_) draw(entity, whole, "0", 0);
    drawing_.ignored.assign(ignored_.begin(), ignored_.end());
    return std::move(drawing_);
  }

 private:
  // The file's structure ----------------------------------------------------------------------------------------------

  Tag required() {
    const auto tag = tags_.next();
    if (!tag) fail(file_, last_line_, "the file ends without EOF", "it was cut short: export it again");
    last_line_ = tag->line;
    return *tag;
  }

  void read_sections() {
    for (Tag tag = required(); !(tag.code == 0 && tag.value == "EOF"); tag = required()) {
      if (tag.code != 0 || tag.value != "SECTION") {
        fail(file_, tag.line, "a SECTION or EOF should stand here, not " + shown(tag.value), "is it a DXF drawing?");
      }
      const Tag name = required();
      if (name.code != 2) fail(file_, name.line, "the section's name (group 2) should stand here");
      if (name.value == "HEADER") {
        read_header();
      } else if (name.value == "BLOCKS") {
        read_blocks();
      } else if (name.value == "ENTITIES") {
        saw_entities_ = true;
        read_entities(required(), entities_, "ENDSEC");
      } else {
        while (!is(required(), "ENDSEC")) {
        }
      }
    }
  }

  static bool is(const Tag& tag, std::string_view keyword) { return tag.code == 0 && tag.value == keyword; }

  void read_header() {
    std::string_view variable;
    for (Tag tag = required(); !is(tag, "ENDSEC"); tag = required()) {
      if (tag.code == 9) variable = tag.value;
      if (variable == "$ACADVER" && tag.code == 1) version_ = std::string(tag.value.substr(0, 16));
      if (variable == "$INSUNITS" && tag.code == 70) {
        const double value = Values::parse(file_, tag);
        units_ = value >= 0 && value < 100 ? static_cast<int>(value) : -1;
      }
    }
  }

  /// Tags up to the next group 0, which is returned.
  Tag read_tags(std::vector<Tag>& tags) {
    for (;;) {
      const Tag tag = required();
      if (tag.code == 0) return tag;
      tags.push_back(tag);
    }
  }

  /// Reads entities, the first of which begins with `tag`, up to group 0 `end`.
  void read_entities(Tag tag, std::vector<Entity>& entities, std::string_view end) {
    while (!is(tag, end)) {
      if (tag.code != 0)
        fail(file_, tag.line, "an entity (group 0) should stand here, not group " + std::to_string(tag.code));
      if (tag.value == "EOF")
        fail(file_, tag.line, "EOF stands where " + std::string(end) + " should", "the file is damaged");
      Entity entity{tag.value, tag.line, {}, {}, 1};
      tag = read_tags(entity.tags);
      entity.size += entity.tags.size();
      if (entity.type == "POLYLINE") {
        while (is(tag, "VERTEX")) {
          entity.vertices.emplace_back();
          tag = read_tags(entity.vertices.back());
          entity.size += 1 + entity.vertices.back().size();
        }
      }
      if (entity.type != "SEQEND" && entity.type != "ATTRIB") entities.push_back(std::move(entity));
    }
  }

  void read_blocks() {
    for (Tag tag = required(); !is(tag, "ENDSEC");) {
      if (!is(tag, "BLOCK")) fail(file_, tag.line, "a BLOCK should stand here, not " + shown(tag.value));
      std::vector<Tag> head;
      tag = read_tags(head);
      const Values values(file_, head);
      Block block{values.point(10), {}};
      read_entities(tag, block.entities, "ENDBLK");
      blocks_.insert_or_assign(std::string(values.text(2)), std::move(block));
      std::vector<Tag> end;
      tag = read_tags(end);
    }
  }

  double unit_in_mm() const {
    switch (units_.value_or(0)) {
      case 1:
        return 25.4;
      case 2:
        return 304.8;
      case 5:
        return 10;
      case 6:
        return 1000;
      case 8:
        return 25.4e-6;
      case 9:
        return 0.0254;
      case 10:
        return 914.4;
      case 13:
        return 1e-3;
      case 14:
        return 100;
      default:
        return 1;
    }
  }

  // Entities → curves -------------------------------------------------------------------------------------------------

  void draw(const Entity& entity, const Placement& placement, const std::string& block_layer, int depth) {
    const Values values(file_, entity.tags);
    if (values.integer(67, 0) == 1) return;  // paper space
    std::string layer(values.text(8));
    if (layer.empty() || layer == "0") layer = block_layer;  // layer 0 in a block is the insert's
    Placement in_place = placement;
    const Vec2 tilt = values.point(210);
    const bool has_own_plane = entity.type != "LINE" && entity.type != "ELLIPSE" && entity.type != "SPLINE";
    if (tilt.norm() > 1e-6) {
      ignore(entity, " out of the plane");
      return;
    }
    // An entity drawn from below has its x mirrored (but for those in world coordinates).
    if (has_own_plane && values.real(230, 1) < 0) in_place.linear.col(0) *= -1;
    if (entity.type == "INSERT") {
      insert(entity, values, in_place, layer, depth);
      return;
    }
    if (auto curve = to_curve(entity, values, k_sagitta / in_place.growth()))
      add(entity, layer, std::move(*curve), in_place);
  }

  void ignore(const Entity& entity, const std::string& why = {}) {
    if (ignored_.size() >= 64) return;
    const std::string name = shown(entity.type);
    ignored_.insert(name.substr(1, name.size() - 2) + why);
  }

  std::optional<Curve> to_curve(const Entity& entity, const Values& values, double sagitta) {
    if (entity.type == "LINE") return Curve{{values.point(10), values.point(11)}, false};
    if (entity.type == "LWPOLYLINE") return lwpolyline(entity, values, sagitta);
    if (entity.type == "POLYLINE") return polyline(entity, values, sagitta);
    if (entity.type == "CIRCLE" || entity.type == "ARC") return circle_or_arc(entity, values, sagitta);
    if (entity.type == "ELLIPSE") return ellipse(entity, values, sagitta);
    if (entity.type == "SPLINE") return spline(entity, values, sagitta);
    ignore(entity);
    return std::nullopt;
  }

  Curve lwpolyline(const Entity& entity, const Values& values, double sagitta) {
    std::vector<BulgeVertex> vertices;
    for (const Tag& tag : entity.tags) {
      if (tag.code == 10) vertices.push_back({{Values::parse(file_, tag), 0}, 0});
      if (vertices.empty()) continue;
      if (tag.code == 20) vertices.back().place.y() = Values::parse(file_, tag);
      if (tag.code == 42) vertices.back().bulge = Values::parse(file_, tag);
    }
    return bulge_curve(vertices, values.integer(70, 0) & 1, sagitta);
  }

  std::optional<Curve> polyline(const Entity& entity, const Values& values, double sagitta) {
    const int flags = values.integer(70, 0);
    if (flags & (16 | 64)) {
      ignore(entity, " mesh");
      return std::nullopt;
    }
    std::vector<BulgeVertex> vertices;
    for (const std::vector<Tag>& tags : entity.vertices) {
      const Values vertex(file_, tags);
      if (vertex.integer(70, 0) & 16) continue;  // a spline's frame, not its curve
      vertices.push_back({vertex.point(10), vertex.real(42, 0)});
    }
    return bulge_curve(vertices, flags & 1, sagitta);
  }

  Curve circle_or_arc(const Entity& entity, const Values& values, double sagitta) {
    const double radius = values.real(40, 0);
    if (!(radius > 0) || radius > 1e9)
      fail(file_, entity.line, "the radius of this " + std::string(entity.type) + " is " + shortest(radius),
           "it must be above 0");
    if (entity.type == "CIRCLE") return closed_by_full_turn(arc_curve(values.point(10), radius, 0, k_two_pi, sagitta));
    const double from = radians(std::remainder(values.real(50, 0), 360.0));
    const double to = radians(std::remainder(values.real(51, 0), 360.0));
    return arc_curve(values.point(10), radius, from, to, sagitta);
  }

  Curve ellipse(const Entity& entity, const Values& values, double sagitta) {
    const Vec2 centre = values.point(10);
    const Vec2 major = values.point(11);
    const double ratio = values.real(40, 1);
    if (!(major.norm() > 0) || major.norm() > 1e9 || !(ratio > 0) || ratio > 1) {
      fail(file_, entity.line,
           "the axes of this ELLIPSE are " + shortest(major.norm()) + " and " + shortest(ratio) + " times that");
    }
    const Vec2 minor = turned_left(major) * (values.real(230, 1) < 0 ? -ratio : ratio);
    const double from = std::remainder(values.real(41, 0), k_two_pi);
    const double sweep_asked = values.real(42, k_two_pi) - values.real(41, 0);
    const bool full = std::abs(sweep_asked) >= k_two_pi - 1e-9;
    double to = std::remainder(values.real(42, k_two_pi), k_two_pi);
    if (to <= from) to += k_two_pi;
    if (full) to = from + k_two_pi;
    Curve curve = arc_curve(Vec2::Zero(), 1, from, to, sagitta / major.norm());
    for (Vec2& p : curve.points) p = centre + p.x() * major + p.y() * minor;
    return full ? closed_by_full_turn(std::move(curve)) : curve;
  }

  std::optional<Curve> spline(const Entity& entity, const Values& values, double sagitta) {
    Spline spline;
    spline.degree = values.integer(71, 3);
    std::vector<double> weights;
    for (const Tag& tag : entity.tags) {
      if (tag.code == 40) spline.knots.push_back(Values::parse(file_, tag));
      if (tag.code == 41) weights.push_back(Values::parse(file_, tag));
      if (tag.code == 10) spline.poles.emplace_back(Values::parse(file_, tag), 0, 1);
      if (tag.code == 20 && !spline.poles.empty()) spline.poles.back().y() = Values::parse(file_, tag);
    }
    if (spline.poles.empty()) {
      ignore(entity, " without control points");
      return std::nullopt;
    }
    check_spline(entity, spline, weights);
    for (std::size_t i = 0; i < weights.size(); ++i) spline.poles[i] *= weights[i];
    return sampled(spline, sagitta);
  }

  void check_spline(const Entity& entity, const Spline& spline, const std::vector<double>& weights) const {
    const std::size_t poles = spline.poles.size();
    const auto order = static_cast<std::size_t>(spline.degree) + 1;
    const bool fits = spline.degree >= 1 && spline.degree <= 11 && poles >= order &&
                      spline.knots.size() == poles + order && std::is_sorted(spline.knots.begin(), spline.knots.end());
    if (!fits) {
      fail(file_, entity.line,
           "this SPLINE of degree " + std::to_string(spline.degree) + " has " + std::to_string(poles) +
               " control points and " + std::to_string(spline.knots.size()) +
               " knots, which do not fit or are not in order");
    }
    const bool weighted =
        weights.empty() || (weights.size() == poles &&
                            std::all_of(weights.begin(), weights.end(), [](double w) { return w > 1e-9 && w < 1e9; }));
    if (!weighted) fail(file_, entity.line, "the weights of this SPLINE are not one positive number a control point");
  }

  Curve sampled(const Spline& spline, double sagitta) {
    Curve curve;
    for (auto span = static_cast<std::size_t>(spline.degree); span < spline.poles.size(); ++span) {
      const double t0 = spline.knots[span];
      const double t1 = spline.knots[span + 1];
      if (!(t1 > t0)) continue;
      const Vec2 from = spline.at(t0, span);
      if (curve.points.empty()) curve.points.push_back(from);
      spline.sample(curve.points, span, t0, from, t1, spline.at(t1, span), sagitta, 0);
      if (curve.points.size() > k_most_points) break;  // add() says so
    }
    return curve;
  }

  void insert(const Entity& entity, const Values& values, const Placement& placement, const std::string& layer,
              int depth) {
    const std::string name(values.text(2));
    const auto block = blocks_.find(name);
    if (block == blocks_.end())
      fail(file_, entity.line, "this INSERT names the block " + shown(name) + ", which the file does not hold");
    if (depth >= k_deepest_block)
      fail(file_, entity.line,
           "blocks are nested more than " + std::to_string(k_deepest_block) + " deep (or in a ring)");
    const int columns = std::max(1, values.integer(70, 1));
    const int rows = std::max(1, values.integer(71, 1));
    Placement own;
    own.linear = Eigen::Rotation2D<double>(radians(values.real(50, 0))).toRotationMatrix();
    const Vec2 step = {values.real(44, 0), values.real(45, 0)};
    const Eigen::Matrix2d scaled = own.linear * Vec2(values.real(41, 1), values.real(42, 1)).asDiagonal();
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        if (++inserts_ > k_most_inserts)
          fail(file_, entity.line, "the drawing inserts more than " + std::to_string(k_most_inserts) + " blocks");
        Placement whole;
        whole.linear = placement.linear * scaled;
        whole.shift = placement(values.point(10) + own.linear * Vec2(column * step.x(), row * step.y())) -
                      whole.linear * block->second.base;
        for (const Entity& part : block->second.entities) {
          expanded_ += part.size;
          if (expanded_ > k_most_tags)
            fail(file_, entity.line, "the blocks of the drawing are inserted too often to be expanded");
          draw(part, whole, layer, depth + 1);
        }
      }
    }
  }

  /// Puts a curve in its place in the drawing; repeated points go, and a last point that closes the curve.
  void add(const Entity& entity, const std::string& layer, Curve curve, const Placement& placement) {
    DrawingPath path{layer, std::string(entity.type), entity.line, curve.closed, {}};
    points_ += curve.points.size();
    if (points_ > k_most_points)
      fail(file_, entity.line, "the drawing has more than " + std::to_string(k_most_points) + " points");
    path.points.reserve(curve.points.size());
    for (const Vec2& p : curve.points) {
      const Vec2 placed = placement(p);
      if (!(placed.cwiseAbs().maxCoeff() <= k_farthest)) {
        fail(file_, entity.line,
             "this " + path.entity + " reaches (" + rounded(placed.x()) + ", " + rounded(placed.y()) +
                 ") mm, further than 10 km");
      }
      if (path.points.empty() || placed != path.points.back()) path.points.push_back(placed);
    }
    if (path.points.size() > 2 && (path.points.front() - path.points.back()).norm() <= k_joined) {
      path.closed = true;
      path.points.pop_back();
    }
    if (path.points.size() < 2) {
      ignore(entity, " of no length");
      return;
    }
    drawing_.paths.push_back(std::move(path));
  }

  const std::string& file_;
  TagReader tags_;
  int last_line_ = 0;
  bool saw_entities_ = false;
  std::string version_;
  std::optional<int> units_;
  std::vector<Entity> entities_;
  std::map<std::string, Block> blocks_;
  Drawing drawing_;
  std::set<std::string> ignored_;
  std::size_t points_ = 0;
  std::size_t inserts_ = 0;
  std::size_t expanded_ = 0;  // tags
};

// Chains → loops
// -------------------------------------------------------------------------------------------------------

/// One end of an open path.
struct End {
  std::size_t path = 0;
  bool last = false;
};

/// Joins open paths of one layer where exactly two ends meet; a place where three or more meet stays open, for nobody
/// knows which go on.
class Joiner {
 public:
  explicit Joiner(std::vector<DrawingPath>& paths) : paths_(paths), used_(paths.size(), false) {}

  std::vector<DrawingPath> join() {
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (paths_[i].closed) continue;
      ends_of(i, false).push_back({i, false});
      ends_of(i, true).push_back({i, true});
    }
    std::vector<DrawingPath> joined;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (!used_[i]) joined.push_back(chain_of(i));
    }
    return joined;
  }

 private:
  std::vector<End>& ends_of(std::size_t path, bool last) {
    const Polygon& points = paths_[path].points;
    Layer& layer = layers_[paths_[path].layer];
    const std::size_t node = layer.points.number(last ? points.back() : points.front());
    if (node >= layer.ends.size()) layer.ends.resize(node + 1);
    return layer.ends[node];
  }

  /// The end that goes on where `path` ends, if there is exactly one.
  std::optional<End> next(std::size_t path, bool last) {
    const std::vector<End>& ends = ends_of(path, last);
    if (ends.size() != 2) return std::nullopt;
    const End& other = ends[0].path == path && ends[0].last == last ? ends[1] : ends[0];
    return used_[other.path] ? std::nullopt : std::optional<End>(other);
  }

  /// Lengthens `chain`, which ends with the `last` end of path `i`.
  void extend(Polygon& chain, std::size_t i, bool last) {
    while (const auto end = next(i, last)) {
      const Polygon& points = paths_[end->path].points;
      if (end->last) {
        chain.insert(chain.end(), points.rbegin() + 1, points.rend());
      } else {
        chain.insert(chain.end(), points.begin() + 1, points.end());
      }
      used_[end->path] = true;
      i = end->path;
      last = !end->last;
    }
  }

  DrawingPath chain_of(std::size_t i) {
    DrawingPath path = std::move(paths_[i]);
    paths_[i].points = {path.points.front(), path.points.back()};  // its ends are still looked up
    paths_[i].layer = path.layer;
    used_[i] = true;
    if (path.closed) return path;
    extend(path.points, i, true);
    std::reverse(path.points.begin(), path.points.end());
    extend(path.points, i, false);
    std::reverse(path.points.begin(), path.points.end());
    if (path.points.size() > 2 && (path.points.front() - path.points.back()).norm() <= k_joined) {
      path.closed = true;
      path.points.pop_back();
    }
    return path;
  }

  struct Layer {
    EndPoints points;
    std::vector<std::vector<End>> ends;
  };
  std::vector<DrawingPath>& paths_;
  std::vector<bool> used_;
  std::map<std::string, Layer> layers_;
};

void refuse_other_formats(std::string_view bytes, const std::string& file) {
  if (bytes.starts_with("AutoCAD Binary DXF"))
    fail(file, 0, "this is a binary DXF", "save it as ASCII DXF (R12, or 2000 and later)");
  if (bytes.starts_with("AC10"))
    fail(file, 0, "this is a DWG drawing", "save it as ASCII DXF (R12, or 2000 and later)");
  if (trimmed(bytes.substr(0, 64)).empty()) fail(file, 0, "the file is empty");
}

}  // namespace

Drawing read_dxf(std::string_view bytes, const std::string& file_name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  refuse_other_formats(bytes, file_name);
  Drawing drawing = Reader(bytes, file_name).read();
  drawing.paths = Joiner(drawing.paths).join();
  return drawing;
}

}  // namespace fusee
