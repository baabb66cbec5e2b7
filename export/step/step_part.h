/// \file
/// Internal: the part for pulley.step in plain values, the interface between fusee and the module step_occt.cpp, which
/// has no pulley types. mm as printed, rad.
///
/// The body is a stack of closed rows about the axis, joined by bands. All are cut at the same directions into pieces
/// without a seam. The parameter of every row is the direction ψ of its outward normal, so all edges of a band lie at
/// constant parameters of its surface.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fusee/base.h"
#include "fusee/solid.h"

namespace fusee::formats {

inline constexpr int k_step_degree = 5;

/// A clamped B-spline of the given degree over ψ.
struct StepSpline {
  std::vector<double> knots;  ///< repeated by multiplicity
  std::vector<Vec2> poles;
};

/// A closed curve of the body at one height.
struct StepRow {
  double z = 0;
  double radius = 0;                    ///< > 0: a circle about the axis
  std::vector<StepSpline> pieces = {};  ///< of a row that is no circle, one for each sector
};

/// The surface between a row and the next one.
struct StepBand {
  /// Both rows of a ruled surface, one spline for each sector; empty if both are circles. Each row has its own knots.
  std::vector<StepSpline> lower = {}, upper = {};
  /// A groove's seat is an arc in every half-plane along the normal. Its tangents meet in the row `corner`, whose poles
  /// have this weight. seat_radius 0: straight. If both rows are circles, the seat is a torus about the circle with the
  /// radius seat_middle at the height seat_z.
  double seat_radius = 0;
  double seat_middle = 0;
  double seat_z = 0;
  double corner_z = 0;
  double weight = 1;
  std::vector<StepSpline> corner = {};
};

/// A closed contour of straight segments and arcs through `via`.
struct StepContour {
  struct Piece {
    Vec2 to;
    std::optional<Vec2> via = {};
  };
  Vec2 start = Vec2::Zero();
  std::vector<Piece> pieces = {};
};

/// The prism of `outer` minus the other contours, from `low` to `high` along `z`, seen with `x` to the right.
struct StepPrism {
  Vec3 origin = Vec3::Zero();
  Vec3 x = Vec3::UnitX();
  Vec3 z = Vec3::UnitZ();
  StepContour outer = {};
  std::vector<StepContour> inner = {};
  double low = 0;
  double high = 0;
  /// A plane that limits the prism to the part below it, seen along its normal.
  struct Ceiling {
    Vec3 point, normal;
  };
  std::optional<Ceiling> ceiling = {};
};

/// A frustum between two horizontal circles, of which one may be offset.
struct StepFrustum {
  Vec2 low_centre = Vec2::Zero(), high_centre = Vec2::Zero();
  double low = 0, high = 0;  ///< heights
  double low_radius = 0, high_radius = 0;
};

/// A section (radius, z) turned about a vertical axis, counter-clockwise from direction `from`.
struct StepTurned {
  Vec2 centre = Vec2::Zero();
  Polygon section = {};
  double from = 0;
  double turn = 0;
};

/// A section of a channel: a circle in the plane of `level` and `up`, open by the angle `gap` on both sides of its top,
/// below a peaked ceiling with its ridge at `ridge`.
struct StepRing {
  Vec3 middle, level, up;
  double radius = 0;
  double gap = 0;
  Vec3 ridge;
};
/// A channel through rings; the part up to the second ring is straight.
struct StepChannel {
  std::vector<StepRing> rings = {};
};

/// Any of these solids.
using StepSolid = std::variant<StepPrism, StepFrustum, StepTurned, StepChannel, solid::TriangleMesh>;
/// A feature to cut or to add: the intersection of its solids.
struct StepTool {
  std::vector<StepSolid> common;
};

struct StepHub {
  double radius = 0;
  double high = 0;  ///< z of its upper face
};

/// A body with helical rows: faces with corners and edges, each edge between two faces.
struct StepSkin {
  /// The curve of an edge from its first corner to its last.
  struct Straight {};
  struct Curve {
    std::vector<double> knots;
    std::vector<Vec3> poles;
  };
  /// An arc whose end tangents meet in `corner`, a pole with this weight.
  struct Arc {
    Vec3 corner;
    double weight = 1;
  };
  /// A circle about the axis, counter-clockwise.
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
  /// Rows of poles over one knot vector, from below. The middle one of three has a weight.
  struct Patch {
    std::vector<double> knots;
    std::vector<std::vector<Vec3>> rows;
    double weight = 1;
  };
  /// An edge of a face, and its course in the parameters of a patch.
  struct Use {
    std::size_t edge = 0;
    bool backwards = false;
    Vec2 from = Vec2::Zero(), to = Vec2::Zero();
  };
  struct Face {
    std::variant<Plane, Cylinder, Patch> surface;
    std::vector<std::vector<Use>> loops;  ///< seen from outside, the first counter-clockwise, others clockwise
  };

  std::vector<Vec3> corners = {};
  std::vector<Edge> edges = {};
  std::vector<Face> faces = {};
};

struct StepPart {
  std::string name;
  std::vector<double> sectors;  ///< directions at which the rows are cut, and the first again after a turn
  std::vector<StepRow> rows;    ///< from the bottom up
  std::vector<StepBand> bands;  ///< one fewer than rows
  std::optional<StepHub> hub = {};
  std::optional<StepSkin> skin = {};  ///< replaces rows, bands and hub
  std::vector<StepTool> cuts = {};
  std::vector<StepTool> raised = {};  ///< features to add
  double z_mate = 0;                  ///< boundary of P1 and P2
  double z_top = 0;                   ///< upper end of P2
};

/// Measurements requested of a written file.
struct StepQuestion {
  std::vector<double> planes = {};  ///< heights of sections
  std::vector<Vec3> points = {};    ///< points whose distance from the surface is measured
  /// Gives approximate points of helical groove floors in the file's mesh; null: none.
  std::function<std::vector<Vec3>(const solid::TriangleMesh& mesh)> floors = {};
};

/// Properties of a written file after reading it back.
struct StepReading {
  int solids = 0;
  int edges = 0;
  int unpaired_edges = 0;  ///< edges that do not belong to two faces
  int faces = 0;
  int open_faces = 0;     ///< faces whose mesh does not end at their edges
  bool is_valid = false;  ///< by the kernel's own check
  double volume = 0;
  double area = 0;
  std::vector<Polygon> sections;  ///< the outermost loops at the planes, within some 1e-5 mm; empty: none
  std::vector<double> distances;  ///< of the points from the surface
  /// For each approximate floor point: the lowest point of the surface in its half-plane through the axis. The middle of
  /// a level floor.
  std::vector<Vec3> floors;
};

/// The symbol exported by the module `fusee-step`.
struct StepMaker {
  /// The file's bytes; if empty, `complaint` gives the error.
  std::string (*write)(const StepPart& part, std::string& complaint);
  StepReading (*read)(const std::string& path, const StepQuestion& question);
};
inline constexpr const char* k_step_maker = "fusee_step_maker_2";

}  // namespace fusee::formats
