/// \file
/// The part as pulley.step has it, in plain values: what fusee knows of it, for what writes it and knows no pulley
/// (step_occt.cpp). mm as printed, rad.
///
/// The body is a stack of closed rows about the axis, joined by bands, each cut at the same directions into pieces
/// without a seam. A row's parameter is the direction ψ of its outward normal, on every row: all edges of a band lie at
/// constant parameters of its surface.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fusee/base/plane.h"
#include "fusee/solid/mesh.h"

namespace fusee {

inline constexpr int k_step_degree = 5;

/// A clamped B-spline of that degree over ψ.
struct StepSpline {
  std::vector<double> knots;  ///< each as often as it counts
  std::vector<Vec2> poles;
};

struct StepRow {
  double z = 0;
  double radius = 0;                    ///< > 0: a circle about the axis
  std::vector<StepSpline> pieces = {};  ///< of a row that is none, one for each sector
};

enum class StepZone { p1, p2, hub };

/// What joins a row and the next one.
struct StepBand {
  /// Ruled, unless both rows are circles; on each one's own knots.
  std::vector<StepSpline> lower = {}, upper = {};
  /// A groove's seat, an arc in every half-plane through the axis along the normal: the row of its corners, with their
  /// weight; seat_radius 0: straight. Where both rows are circles the torus' middle stands at this radius and height.
  double seat_radius = 0;
  double seat_middle = 0;
  double seat_z = 0;
  double corner_z = 0;
  double weight = 1;
  std::vector<StepSpline> corner = {};
};

/// Closed; from point to point straight, or an arc through `via`.
struct StepContour {
  struct Piece {
    Vec2 to;
    std::optional<Vec2> via = {};
  };
  Vec2 start = Vec2::Zero();
  std::vector<Piece> pieces = {};
};

/// outer without the others, from `low` to `high` along `z`, seen with `x` to the right.
struct StepPrism {
  Vec3 origin = Vec3::Zero();
  Vec3 x = Vec3::UnitX();
  Vec3 z = Vec3::UnitZ();
  StepContour outer = {};
  std::vector<StepContour> inner = {};
  double low = 0;
  double high = 0;
  /// Nothing of it stands beyond this plane, seen along its normal.
  struct Roof {
    Vec3 point, normal;
  };
  std::optional<Roof> roof = {};
};

/// Between two horizontal circles.
struct StepFrustum {
  Vec2 low_centre = Vec2::Zero(), high_centre = Vec2::Zero();
  double low = 0, high = 0;
  double low_radius = 0, high_radius = 0;
};

/// A section (radius, z) turned about a vertical axis, counter-clockwise from direction `from`.
struct StepTurned {
  Vec2 centre = Vec2::Zero();
  Polygon section = {};
  double from = 0;
  double turn = 0;
};

/// A section of a channel: a circle in the plane of `level` and `up`, open by `gap` to both sides of its top, and the
/// gable over it up to `ridge`.
struct StepRing {
  Vec3 middle, level, up;
  double radius = 0;
  double gap = 0;
  Vec3 ridge;
};
/// Through rings; the part up to the second is straight.
struct StepChannel {
  std::vector<StepRing> rings = {};
};

/// What all of these have in common.
using StepSolid = std::variant<StepPrism, StepFrustum, StepTurned, StepChannel, TriangleMesh>;
struct StepTool {
  std::vector<StepSolid> common;
};

struct StepHub {
  double radius = 0;
  double high = 0;
};

/// A body whose rows climb: faces with their corners and edges, each edge between two faces.
struct StepSkin {
  /// What an edge runs along from its first corner to its last.
  struct Straight {};
  struct Curve {
    std::vector<double> knots;
    std::vector<Vec3> poles;
  };
  /// Through the corner of its two tangents, with that one's weight.
  struct Arc {
    Vec3 corner;
    double weight = 1;
  };
  /// About the axis, counter-clockwise.
  struct Round {
    double radius = 0;
    double from = 0, to = 0;
  };
  struct Edge {
    std::size_t first = 0, last = 0;
    std::variant<Straight, Curve, Arc, Round> along = {};
  };

  struct Plane {
    Vec3 point, outward;
  };
  struct Cylinder {
    double radius = 0;
  };
  /// Rows of poles over one knot vector, from below; the middle one of three with a weight.
  struct Patch {
    std::vector<double> knots;
    std::vector<std::vector<Vec3>> rows;
    double weight = 1;
  };
  /// An edge of a face, and where it runs among the parameters of a patch, as the edge does.
  struct Use {
    std::size_t edge = 0;
    bool backwards = false;
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  };
  struct Face {
    std::variant<Plane, Cylinder, Patch> surface;
    std::vector<std::vector<Use>> loops;  ///< seen from outside the first counter-clockwise, others clockwise
  };

  std::vector<Vec3> corners = {};
  std::vector<Edge> edges = {};
  std::vector<Face> faces = {};
};

struct StepPart {
  std::string name;
  std::vector<double> sectors;  ///< directions at which the rows are cut, and the first a turn on
  std::vector<StepRow> rows;    ///< from the bottom up
  std::vector<StepBand> bands;  ///< one less
  std::optional<StepHub> hub = {};
  std::optional<StepSkin> skin = {};  ///< in place of rows, bands and hub
  std::vector<StepTool> cuts = {};
  std::vector<StepTool> raised = {};
  double z_mate = 0;  ///< between P1 and P2
  double z_top = 0;   ///< of P2
};

/// What is asked of a written file beside.
struct StepQuestion {
  std::vector<double> planes = {};  ///< heights of sections
  std::vector<Vec3> places = {};    ///< how far they are from its surface
  /// Where in its mesh grooves have their grounds, more or less; null: nowhere.
  std::function<std::vector<Vec3>(const TriangleMesh& mesh)> grounds = {};
};

/// What a written file is, read again.
struct StepReading {
  int solids = 0;
  int edges = 0;
  int unpaired_edges = 0;  ///< that are not on two faces
  int faces = 0;
  int open_faces = 0;     ///< whose mesh does not close with its edges
  bool is_valid = false;  ///< to the kernel's own check
  double volume = 0;
  double area = 0;
  std::vector<Polygon> sections;  ///< the outermost loops at the planes, within some 1e-5 mm; empty: there is none
  std::vector<double> distances;  ///< of the places from the surface
  /// The surface itself in the half-planes of the grounds: its lowest places, and of a level ground the middle.
  std::vector<Vec3> grounds;
};

/// What the module `fusee-step` exports under this name.
struct StepMaker {
  /// The file's bytes; empty: `complaint` says what did not go.
  std::string (*write)(const StepPart& part, std::string& complaint);
  StepReading (*read)(const std::string& path, const StepQuestion& question);
};
inline constexpr const char* k_step_maker = "fusee_step_maker_2";

}  // namespace fusee
