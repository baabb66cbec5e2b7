/// \file
/// The module `fusee-step`: converts plain values to an OpenCASCADE solid and AP214, and reads such a file back. It is
/// the only file that includes OpenCASCADE, and it has no pulley types.
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepAlgoAPI_Section.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GCPnts_TangentialDeflection.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_FreeBounds.hxx>
#include <ShapeFix_Face.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_HSequenceOfShape.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/golden_section.h"
#include "export/step/step_part.h"

namespace fusee::formats {
namespace {

// Tolerance of sewing nearly equal rows, mm: a circle, and the spline over another row's knots that represents it.
constexpr double k_sewn = 1e-5;
// Sagitta, mm, and turn between points, rad, of the floors that are read from a file.
constexpr double k_floor_sagitta = 1e-5;
constexpr double k_floor_turn = 0.02;
constexpr double k_same_height = 1e-9;  // mm
// Largest diagonal of a file, mm.
constexpr double k_largest = 5000;

gp_Pnt point_at(const Vec2& point, double z) { return {point.x(), point.y(), z}; }
gp_Pnt point_at(const Vec3& point) { return {point.x(), point.y(), point.z()}; }
gp_Vec vector_along(const Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }
gp_Ax3 about_axis(double z) { return {gp_Pnt(0, 0, z), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)}; }

/// Distinct knots and their multiplicities.
struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger times;
};

Knots knots_of(const std::vector<double>& flat) {
  std::vector<double> values;
  std::vector<int> times;
  for (const double knot : flat) {
    if (!values.empty() && values.back() == knot) {
      ++times.back();
    } else {
      values.push_back(knot);
      times.push_back(1);
    }
  }
  const int count = static_cast<int>(values.size());
  Knots knots{TColStd_Array1OfReal(1, count), TColStd_Array1OfInteger(1, count)};
  for (int i = 0; i < count; ++i) {
    knots.values(i + 1) = values[static_cast<std::size_t>(i)];
    knots.times(i + 1) = times[static_cast<std::size_t>(i)];
  }
  return knots;
}

Handle(Geom_BSplineCurve) curve_of(const StepSpline& spline, double z) {
  TColgp_Array1OfPnt poles(1, static_cast<int>(spline.poles.size()));
  for (std::size_t i = 0; i < spline.poles.size(); ++i) poles(static_cast<int>(i) + 1) = point_at(spline.poles[i], z);
  const Knots knots = knots_of(spline.knots);
  return new Geom_BSplineCurve(poles, knots.values, knots.times, k_step_degree);
}

Handle(Geom_BSplineCurve) curve_of(const std::vector<double>& flat_knots, const std::vector<Vec3>& points) {
  TColgp_Array1OfPnt poles(1, static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) poles(static_cast<int>(i) + 1) = point_at(points[i]);
  const Knots knots = knots_of(flat_knots);
  return new Geom_BSplineCurve(poles, knots.values, knots.times, k_step_degree);
}

/// Inserts the knots of `other` that `curve` lacks. The curve stays as it is.
void take_knots_of(const Handle(Geom_BSplineCurve) & curve, const Handle(Geom_BSplineCurve) & other) {
  TColStd_Array1OfReal values(1, other->NbKnots());
  TColStd_Array1OfInteger times(1, other->NbKnots());
  other->Knots(values);
  other->Multiplicities(times);
  curve->InsertKnots(values, times, 1e-12, false);
}

/// A surface with rows of poles over one knot vector. Across the rows its degree is their number minus one.
Handle(Geom_BSplineSurface)
    surface_through(const std::vector<Handle(Geom_BSplineCurve)>& rows, const std::vector<double>& weights) {
  const int across = static_cast<int>(rows.size()), along = rows.front()->NbPoles();
  TColgp_Array2OfPnt poles(1, along, 1, across);
  TColStd_Array2OfReal weight(1, along, 1, across);
  for (int j = 1; j <= across; ++j) {
    for (int i = 1; i <= along; ++i) {
      poles(i, j) = rows[static_cast<std::size_t>(j) - 1]->Pole(i);
      weight(i, j) = weights[static_cast<std::size_t>(j) - 1];
    }
  }
  TColStd_Array1OfReal u(1, rows.front()->NbKnots()), v(1, 2);
  TColStd_Array1OfInteger u_times(1, rows.front()->NbKnots()), v_times(1, 2);
  rows.front()->Knots(u);
  rows.front()->Multiplicities(u_times);
  v(1) = 0;
  v(2) = 1;
  v_times(1) = v_times(2) = across;
  return new Geom_BSplineSurface(poles, weight, u, v, u_times, v_times, k_step_degree, across - 1);
}

TopoDS_Face bounded(const Handle(Geom_Surface) & surface, double u1, double u2, double v1, double v2) {
  const BRepBuilderAPI_MakeFace face(surface, u1, u2, v1, v2, Precision::Confusion());
  if (!face.IsDone()) throw std::runtime_error("a face of the body cannot be made");
  return face.Face();
}

TopoDS_Shape sewn(const std::vector<TopoDS_Face>& faces) {
  BRepBuilderAPI_Sewing sewing(k_sewn);
  for (const TopoDS_Face& face : faces) sewing.Add(face);
  sewing.Perform();
  if (sewing.NbFreeEdges() != 0)
    throw std::runtime_error(std::to_string(sewing.NbFreeEdges()) + " edges of the body stay open");
  return sewing.SewedShape();
}

TopoDS_Solid outward(const TopoDS_Solid& solid) {
  TopoDS_Solid turned = solid;
  BRepLib::OrientClosedSolid(turned);
  return turned;
}

TopoDS_Solid solid_of(const TopoDS_Shape& sewn_faces) {
  TopExp_Explorer shells(sewn_faces, TopAbs_SHELL);
  if (!shells.More()) throw std::runtime_error("the body's faces are no shell");
  return outward(BRepBuilderAPI_MakeSolid(TopoDS::Shell(shells.Current())).Solid());
}

// ---- the body: rows and bands ---------------------------------------------------------------------------------------

class BodyMaker {
 public:
  explicit BodyMaker(const StepPart& part) : part_(part) {}

  TopoDS_Solid solid() {
    for (std::size_t k = 0; k < part_.bands.size(); ++k) {
      for (std::size_t s = 0; s + 1 < part_.sectors.size(); ++s) faces_.push_back(band_face(k, s));
    }
    cap(part_.rows.front(), nullptr);
    const StepRow& top = part_.rows.back();
    if (part_.hub) {
      const StepRow foot{top.z, part_.hub->radius}, head{part_.hub->high, part_.hub->radius};
      cap(top, &foot);
      for (std::size_t s = 0; s + 1 < part_.sectors.size(); ++s)
        faces_.push_back(bounded(new Geom_CylindricalSurface(about_axis(top.z), foot.radius), part_.sectors[s],
                                 part_.sectors[s + 1], 0, head.z - top.z));
      cap(head, nullptr);
    } else {
      cap(top, nullptr);
    }
    return solid_of(sewn(faces_));
  }

 private:
  TopoDS_Edge edge(const StepRow& row, std::size_t s) const {
    if (row.radius > 0) {
      const Handle(Geom_Circle) circle = new Geom_Circle(about_axis(row.z).Ax2(), row.radius);
      return BRepBuilderAPI_MakeEdge(circle, part_.sectors[s], part_.sectors[s + 1]);
    }
    return BRepBuilderAPI_MakeEdge(curve_of(row.pieces[s], row.z));
  }

  TopoDS_Wire loop(const StepRow& row) const {
    BRepBuilderAPI_MakeWire wire;
    for (std::size_t s = 0; s + 1 < part_.sectors.size(); ++s) wire.Add(edge(row, s));
    if (!wire.IsDone()) throw std::runtime_error("a row does not close");
    return wire.Wire();
  }

  void cap(const StepRow& rim, const StepRow* hole) {
    BRepBuilderAPI_MakeFace face(gp_Pln(about_axis(rim.z)), loop(rim));
    if (hole) face.Add(TopoDS::Wire(loop(*hole).Reversed()));
    if (!face.IsDone()) throw std::runtime_error("an end of the body cannot be made");
    faces_.push_back(face.Face());
  }

  TopoDS_Face band_face(std::size_t k, std::size_t s) const {
    const StepRow &low = part_.rows[k], &high = part_.rows[k + 1];
    const StepBand& band = part_.bands[k];
    if (std::abs(high.z - low.z) < k_same_height) return flat_face(low, high, s);
    if (band.lower.empty()) return turned_face(low, high, band, s);
    std::vector<Handle(Geom_BSplineCurve)> rows{curve_of(band.lower[s], low.z)};
    if (!band.corner.empty()) rows.push_back(curve_of(band.corner[s], band.corner_z));
    rows.push_back(curve_of(band.upper[s], high.z));
    if (band.corner.empty()) {
      take_knots_of(rows[0], rows[1]);
      take_knots_of(rows[1], rows[0]);
    }
    const std::vector<double> weights =
        band.corner.empty() ? std::vector<double>{1, 1} : std::vector<double>{1, band.weight, 1};
    return bounded(surface_through(rows, weights), part_.sectors[s], part_.sectors[s + 1], 0, 1);
  }

  TopoDS_Face flat_face(const StepRow& low, const StepRow& high, std::size_t s) const {
    const TopoDS_Edge inner = edge(low, s), outer = edge(high, s);
    const auto end = [](const TopoDS_Edge& edge, bool last) {
      return BRep_Tool::Pnt(last ? TopExp::LastVertex(edge) : TopExp::FirstVertex(edge));
    };
    BRepBuilderAPI_MakeWire wire(inner);
    wire.Add(BRepBuilderAPI_MakeEdge(end(inner, true), end(outer, true)));
    wire.Add(outer);
    wire.Add(BRepBuilderAPI_MakeEdge(end(outer, false), end(inner, false)));
    const BRepBuilderAPI_MakeFace face(gp_Pln(about_axis(low.z)), wire.Wire());
    if (!face.IsDone()) throw std::runtime_error("a step of the body cannot be made");
    return face.Face();
  }

  TopoDS_Face turned_face(const StepRow& low, const StepRow& high, const StepBand& band, std::size_t s) const {
    const double from = part_.sectors[s], to = part_.sectors[s + 1];
    const double rise = high.z - low.z, out = high.radius - low.radius;
    if (band.seat_radius > 0) {
      // The angle about a torus's circle counts from the side away from the axis. The seat is on the side of the axis.
      const auto angle = [&](const StepRow& row) {
        return M_PI - elementary::asin((row.z - band.seat_z) / band.seat_radius);
      };
      return bounded(new Geom_ToroidalSurface(about_axis(band.seat_z), band.seat_middle, band.seat_radius), from, to,
                     angle(high), angle(low));
    }
    if (std::abs(out) < k_same_height)
      return bounded(new Geom_CylindricalSurface(about_axis(low.z), low.radius), from, to, 0, rise);
    return bounded(new Geom_ConicalSurface(about_axis(low.z), elementary::atan2(out, rise), low.radius), from, to, 0,
                   elementary::hypot(out, rise));
  }

  const StepPart& part_;
  std::vector<TopoDS_Face> faces_;
};

// ---- the body: a skin of faces --------------------------------------------------------------------------------------

class SkinMaker {
 public:
  explicit SkinMaker(const StepSkin& skin) : skin_(skin) {}

  TopoDS_Solid solid() {
    for (const Vec3& corner : skin_.corners) {
      TopoDS_Vertex vertex;
      builder_.MakeVertex(vertex, point_at(corner), k_joined);
      corners_.push_back(vertex);
    }
    for (const StepSkin::Edge& edge : skin_.edges) edges_.push_back(edge_of(edge));
    TopoDS_Shell shell;
    builder_.MakeShell(shell);
    for (const StepSkin::Face& face : skin_.faces) builder_.Add(shell, face_of(face));
    shell.Closed(true);
    TopoDS_Solid solid;
    builder_.MakeSolid(solid);
    builder_.Add(solid, shell);
    return outward(solid);
  }

 private:
  // Gap between adjacent faces by rounding to the resolution, mm.
  static constexpr double k_joined = 5e-6;

  TopoDS_Edge edge_of(const StepSkin::Edge& edge) {
    double from = 0, to = 1;
    const Vec3 &first = skin_.corners[edge.first], &last = skin_.corners[edge.last];
    Handle(Geom_Curve) curve;
    if (const auto* spline = std::get_if<StepSkin::Curve>(&edge.along)) {
      curve = curve_of(spline->knots, spline->poles);
      from = spline->knots.front();
      to = spline->knots.back();
    } else if (const auto* arc = std::get_if<StepSkin::Arc>(&edge.along)) {
      TColgp_Array1OfPnt poles(1, 3);
      poles(1) = point_at(first);
      poles(2) = point_at(arc->corner);
      poles(3) = point_at(last);
      TColStd_Array1OfReal weights(1, 3), knots(1, 2);
      weights(1) = weights(3) = 1;
      weights(2) = arc->weight;
      knots(1) = 0;
      knots(2) = 1;
      TColStd_Array1OfInteger times(1, 2);
      times(1) = times(2) = 3;
      curve = new Geom_BSplineCurve(poles, weights, knots, times, 2);
    } else if (const auto* round = std::get_if<StepSkin::Round>(&edge.along)) {
      curve = new Geom_Circle(about_axis(first.z()).Ax2(), round->radius);
      from = round->from;
      to = round->to;
    } else {
      curve = new Geom_Line(point_at(first), vector_along(last - first));
      to = (last - first).norm();
    }
    TopoDS_Edge made;
    builder_.MakeEdge(made, curve, k_joined);
    builder_.Add(made, corners_[edge.first].Oriented(TopAbs_FORWARD));
    builder_.Add(made, corners_[edge.last].Oriented(TopAbs_REVERSED));
    builder_.Range(made, from, to);
    return made;
  }

  Handle(Geom_Surface) surface_of(const StepSkin::Face& face) const {
    if (const auto* plane = std::get_if<StepSkin::Plane>(&face.surface))
      return new Geom_Plane(point_at(plane->point), gp_Dir(vector_along(plane->outward)));
    if (const auto* cylinder = std::get_if<StepSkin::Cylinder>(&face.surface))
      return new Geom_CylindricalSurface(about_axis(0), cylinder->radius);
    const auto& patch = std::get<StepSkin::Patch>(face.surface);
    std::vector<Handle(Geom_BSplineCurve)> rows;
    for (const std::vector<Vec3>& row : patch.rows) rows.push_back(curve_of(patch.knots, row));
    std::vector<double> weights(rows.size(), 1.0);
    if (rows.size() == 3) weights[1] = patch.weight;
    return surface_through(rows, weights);
  }

  TopoDS_Face face_of(const StepSkin::Face& face) {
    const Handle(Geom_Surface) surface = surface_of(face);
    TopoDS_Face made;
    builder_.MakeFace(made, surface, k_joined);
    const bool is_flat = std::holds_alternative<StepSkin::Plane>(face.surface);
    for (const std::vector<StepSkin::Use>& loop : face.loops) {
      TopoDS_Wire wire;
      builder_.MakeWire(wire);
      for (const StepSkin::Use& use : loop) {
        const TopoDS_Edge& edge = edges_[use.edge];
        if (!is_flat) place_on(made, edge, use);
        builder_.Add(wire, edge.Oriented(use.backwards ? TopAbs_REVERSED : TopAbs_FORWARD));
      }
      wire.Closed(true);
      builder_.Add(made, wire);
    }
    return made;
  }

  // A straight line in the face's parameters, with the speed of the edge.
  void place_on(const TopoDS_Face& face, const TopoDS_Edge& edge, const StepSkin::Use& use) {
    double from = 0, to = 0;
    BRep_Tool::Range(edge, from, to);
    TColgp_Array1OfPnt2d poles(1, 2);
    poles(1) = gp_Pnt2d(use.from.x(), use.from.y());
    poles(2) = gp_Pnt2d(use.to.x(), use.to.y());
    TColStd_Array1OfReal knots(1, 2);
    knots(1) = from;
    knots(2) = to;
    TColStd_Array1OfInteger times(1, 2);
    times(1) = times(2) = 2;
    builder_.UpdateEdge(edge, new Geom2d_BSplineCurve(poles, knots, times, 1), face, k_joined);
  }

  const StepSkin& skin_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> corners_;
  std::vector<TopoDS_Edge> edges_;
};

// ---- cut features ---------------------------------------------------------------------------------------------------

class ToolMaker {
 public:
  TopoDS_Shape operator()(const StepPrism& prism) const {
    const gp_Ax3 frame(point_at(Vec3(prism.origin + prism.low * prism.z)), vector_along(prism.z),
                       vector_along(prism.x));
    BRepBuilderAPI_MakeFace face(gp_Pln(frame), wire_of(prism.outer, frame));
    for (const StepContour& loop : prism.inner) face.Add(wire_of(loop, frame));
    if (!face.IsDone()) throw std::runtime_error("a hole's outline is no face");
    ShapeFix_Face fixed(face.Face());
    fixed.FixOrientation();
    const TopoDS_Shape body =
        BRepPrimAPI_MakePrism(fixed.Face(), vector_along((prism.high - prism.low) * prism.z)).Shape();
    return prism.ceiling ? below(body, *prism.ceiling) : body;
  }

  TopoDS_Shape operator()(const StepFrustum& frustum) const {
    const double height = frustum.high - frustum.low;
    const gp_Ax2 axis(point_at(frustum.low_centre, frustum.low), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0));
    if (frustum.low_centre == frustum.high_centre) {
      if (frustum.low_radius == frustum.high_radius)
        return BRepPrimAPI_MakeCylinder(axis, frustum.low_radius, height).Shape();
      return BRepPrimAPI_MakeCone(axis, frustum.low_radius, frustum.high_radius, height).Shape();
    }
    BRepOffsetAPI_ThruSections loft(true, true);
    const auto add = [&loft](const Vec2& centre, double z, double radius) {
      const gp_Circ circle(gp_Ax2(point_at(centre, z), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), radius);
      loft.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire());
    };
    add(frustum.low_centre, frustum.low, frustum.low_radius);
    add(frustum.high_centre, frustum.high, frustum.high_radius);
    return loft.Shape();
  }

  TopoDS_Shape operator()(const StepTurned& turned) const {
    BRepBuilderAPI_MakePolygon section;
    for (const Vec2& corner : turned.section)
      section.Add(gp_Pnt(turned.centre.x() + corner.x() * elementary::cos(turned.from),
                         turned.centre.y() + corner.x() * elementary::sin(turned.from), corner.y()));
    section.Close();
    const gp_Ax1 axis(point_at(turned.centre, 0), gp_Dir(0, 0, 1));
    const TopoDS_Face face = BRepBuilderAPI_MakeFace(section.Wire(), true);
    return BRepPrimAPI_MakeRevol(face, axis, turned.turn).Shape();
  }

  TopoDS_Shape operator()(const StepChannel& channel) const {
    BRepOffsetAPI_ThruSections loft(false, true);
    loft.CheckCompatibility(false);
    std::vector<TopoDS_Face> faces;
    for (const StepRing& ring : channel.rings) {
      const RingEdges edges = edges_of(ring);
      BRepBuilderAPI_MakeWire wire(edges.circle, edges.right, edges.left);
      loft.AddWire(wire.Wire());
      if (&ring != &channel.rings.front() && &ring != &channel.rings.back()) continue;
      faces.push_back(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(edges.circle, edges.chord).Wire(), true));
      faces.push_back(
          BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(edges.right, edges.left, edges.chord).Wire(), true));
    }
    loft.Build();
    for (TopExp_Explorer side(loft.Shape(), TopAbs_FACE); side.More(); side.Next())
      faces.push_back(TopoDS::Face(side.Current()));
    return solid_of(sewn(faces));
  }

  TopoDS_Shape operator()(const solid::TriangleMesh& mesh) const {
    std::vector<TopoDS_Face> faces;
    for (const auto& [a, b, c] : mesh.triangles) {
      BRepBuilderAPI_MakePolygon corners(point_at(mesh.vertices[a]), point_at(mesh.vertices[b]),
                                         point_at(mesh.vertices[c]), true);
      faces.push_back(BRepBuilderAPI_MakeFace(corners.Wire(), true));
    }
    ShapeUpgrade_UnifySameDomain whole(solid_of(sewn(faces)));
    whole.Build();
    return whole.Shape();
  }

 private:
  /// Edges of a section with a peaked ceiling: the arc below it, both sides of the ceiling, and the chord between the
  /// ceiling's feet.
  struct RingEdges {
    TopoDS_Edge circle, right, left, chord;
  };
  static RingEdges edges_of(const StepRing& ring) {
    const auto at = [&](double angle) {
      return point_at(
          Vec3(ring.middle + ring.radius * (elementary::cos(angle) * ring.level + elementary::sin(angle) * ring.up)));
    };
    const gp_Pnt left = at(M_PI_2 + ring.gap), right = at(M_PI_2 - ring.gap), top = point_at(ring.ridge);
    return {BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(left, at(-M_PI_2), right).Value()),
            BRepBuilderAPI_MakeEdge(right, top), BRepBuilderAPI_MakeEdge(top, left),
            BRepBuilderAPI_MakeEdge(right, left)};
  }

  static TopoDS_Wire wire_of(const StepContour& contour, const gp_Ax3& frame) {
    const auto place = [&frame](const Vec2& point) {
      return gp_Pnt(frame.Location().XYZ() + point.x() * frame.XDirection().XYZ() +
                    point.y() * frame.YDirection().XYZ());
    };
    BRepBuilderAPI_MakeWire wire;
    Vec2 from = contour.start;
    for (const StepContour::Piece& piece : contour.pieces) {
      if ((piece.to - from).norm() > 1e-6) {
        if (piece.via)
          wire.Add(
              BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(place(from), place(*piece.via), place(piece.to)).Value()));
        else
          wire.Add(BRepBuilderAPI_MakeEdge(place(from), place(piece.to)));
        from = piece.to;
      }
    }
    if (!wire.IsDone()) throw std::runtime_error("a hole's outline does not close");
    return wire.Wire();
  }

  /// The part of a body below a plane, seen along its normal.
  static TopoDS_Shape below(const TopoDS_Shape& body, const StepPrism::Ceiling& ceiling) {
    Bnd_Box box;
    BRepBndLib::Add(body, box);
    const double reach = 2 * std::sqrt(box.SquareExtent());
    const gp_Pln plane(point_at(ceiling.point), gp_Dir(vector_along(ceiling.normal)));
    const TopoDS_Face face = BRepBuilderAPI_MakeFace(plane, -reach, reach, -reach, reach);
    const gp_Vec down = -2 * reach * vector_along(ceiling.normal.normalized());
    const TopoDS_Shape kept = BRepPrimAPI_MakePrism(face, down).Shape();
    return BRepAlgoAPI_Common(body, kept).Shape();
  }
};

TopoDS_Shape shape_of(const StepTool& tool) {
  TopoDS_Shape shape;
  for (const StepSolid& solid : tool.common) {
    TopoDS_Shape next = std::visit(ToolMaker(), solid);
    for (TopExp_Explorer solids(next, TopAbs_SOLID); solids.More(); solids.Next()) {
      next = outward(TopoDS::Solid(solids.Current()));
      break;
    }
    shape = shape.IsNull() ? next : BRepAlgoAPI_Common(shape, next).Shape();
  }
  return shape;
}

template <typename Operation>
TopoDS_Shape combined(const TopoDS_Shape& body, const std::vector<StepTool>& tools) {
  if (tools.empty()) return body;
  TopTools_ListOfShape bodies, shapes;
  bodies.Append(body);
  for (const StepTool& tool : tools) shapes.Append(shape_of(tool));
  Operation operation;
  operation.SetArguments(bodies);
  operation.SetTools(shapes);
  operation.SetRunParallel(false);
  operation.Build();
  if (!operation.IsDone()) throw std::runtime_error("the cut features cannot be subtracted");
  return operation.Shape();
}

TopoDS_Solid only_solid(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(shape, TopAbs_SOLID, solids);
  if (solids.Extent() != 1) throw std::runtime_error(std::to_string(solids.Extent()) + " solids are left of the part");
  return TopoDS::Solid(solids(1));
}

/// Replaces curves of many poles by equal ones with fewer poles. The kernel makes such curves where a cut meets a face
/// with an uneven parameter, because it steps by microns there. Curves of the body's own degree are kept.
void shorten_curves(const TopoDS_Shape& shape) {
  constexpr int k_many_poles = 30, k_most_pieces = 20;
  constexpr double k_near = 1e-6;  // mm
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    const TopoDS_Edge edge = TopoDS::Edge(edges(i));
    if (BRep_Tool::Degenerated(edge)) continue;
    double from = 0, to = 0;
    TopLoc_Location location;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, location, from, to);
    const Handle(Geom_BSplineCurve) spline = Handle(Geom_BSplineCurve)::DownCast(curve);
    if (spline.IsNull() || spline->Degree() == k_step_degree || spline->NbPoles() <= k_many_poles) continue;
    const Handle(Geom_Curve) piece = new Geom_TrimmedCurve(spline, from, to);
    const GeomConvert_ApproxCurve shorter(piece, k_near, GeomAbs_C1, k_most_pieces, k_step_degree);
    if (!shorter.HasResult() || shorter.MaxError() > 2 * k_near) continue;
    if (shorter.Curve()->NbPoles() < spline->NbPoles())
      BRep_Builder().UpdateEdge(edge, shorter.Curve(), location, BRep_Tool::Tolerance(edge));
  }
}

// ---- names, colours, bytes ------------------------------------------------------------------------------------------

struct Zone {
  const char* name;
  Quantity_Color colour;
};

const Zone& zone_of(const TopoDS_Face& face, const StepPart& part) {
  static const Zone zones[] = {{"P1", Quantity_Color(0.20, 0.45, 0.75, Quantity_TOC_sRGB)},
                               {"P2", Quantity_Color(0.85, 0.45, 0.20, Quantity_TOC_sRGB)},
                               {"hub", Quantity_Color(0.60, 0.60, 0.60, Quantity_TOC_sRGB)}};
  constexpr double k_above = 1e-3;  // mm
  Bnd_Box box;
  BRepBndLib::AddOptimal(face, box, false, false);
  double x1, y1, low, x2, y2, high;
  box.Get(x1, y1, low, x2, y2, high);
  if (low > part.z_top - k_above && high > part.z_top + k_above) return zones[2];
  return 0.5 * (low + high) < part.z_mate ? zones[0] : zones[1];
}

/// The STEP file of a solid, with the name and colour of each face.
std::string step_bytes(const TopoDS_Solid& solid, const StepPart& part) {
  const Handle(TDocStd_Document) document = new TDocStd_Document("XmlXCAF");
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TDF_Label whole = shapes->AddShape(solid, false);
  TDataStd_Name::Set(whole, TCollection_ExtendedString(part.name.c_str(), true));
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); ++i) {
    const Zone& zone = zone_of(TopoDS::Face(faces(i)), part);
    const TDF_Label label = shapes->AddSubShape(whole, faces(i));
    if (label.IsNull()) continue;
    TDataStd_Name::Set(label, zone.name);
    colours->SetColor(label, zone.colour, XCAFDoc_ColorSurf);
  }
  STEPCAFControl_Writer writer;
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);
  Interface_Static::SetIVal("write.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("write.step.schema", "AP214IS");
  Interface_Static::SetCVal("write.step.unit", "MM");
  Interface_Static::SetCVal("write.step.product.name", "pulley");
  writer.SetNameMode(true);
  writer.SetColorMode(true);
  writer.SetLayerMode(false);
  writer.SetPropsMode(false);
  if (!writer.Transfer(document, STEPControl_AsIs)) throw std::runtime_error("the solid cannot be written");
  const Handle(XSControl_WorkSession) session = writer.ChangeWriter().WS();
  const Handle(StepData_StepModel) model = Handle(StepData_StepModel)::DownCast(session->Model());
  // The header has neither date nor machine, so that equal parts give equal bytes.
  APIHeaderSection_MakeHeader header(model);
  header.SetName(new TCollection_HAsciiString("pulley.step"));
  header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, new TCollection_HAsciiString(""));
  header.SetOrganizationValue(1, new TCollection_HAsciiString(""));
  header.SetOriginatingSystem(new TCollection_HAsciiString("fusee"));
  header.SetPreprocessorVersion(new TCollection_HAsciiString("OpenCASCADE"));
  header.SetAuthorisation(new TCollection_HAsciiString(""));
  StepData_StepWriter text(model);
  text.SendModel(Handle(StepData_Protocol)::DownCast(session->Protocol()));
  std::ostringstream bytes;
  bytes.imbue(std::locale::classic());
  text.Print(bytes);
  return bytes.str();
}

/// Suppresses the kernel's messages. Errors are reported by return values only.
void silence_kernel() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream)); }

std::string write(const StepPart& part, std::string& complaint) {
  silence_kernel();
  try {
    TopoDS_Shape shape = part.skin ? SkinMaker(*part.skin).solid() : BodyMaker(part).solid();
    shape = combined<BRepAlgoAPI_Cut>(shape, part.cuts);
    shape = combined<BRepAlgoAPI_Fuse>(shape, part.raised);
    const TopoDS_Solid solid = only_solid(shape);
    shorten_curves(solid);
    return step_bytes(solid, part);
  } catch (const Standard_Failure& failure) {
    complaint = std::string(failure.DynamicType()->Name()) + " " + failure.GetMessageString();
  } catch (const std::runtime_error& error) {
    complaint = error.what();
  }
  return {};
}

// ---- read again -----------------------------------------------------------------------------------------------------

int unpaired_edges(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  std::vector<int> uses(static_cast<std::size_t>(edges.Extent()) + 1, 0);
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    for (TopExp_Explorer of_face(faces.Current(), TopAbs_EDGE); of_face.More(); of_face.Next())
      ++uses[static_cast<std::size_t>(edges.FindIndex(of_face.Current()))];
  }
  int unpaired = 0;
  for (int i = 1; i <= edges.Extent(); ++i) {
    const bool degenerate = BRep_Tool::Degenerated(TopoDS::Edge(edges(i)));
    if (!degenerate && uses[static_cast<std::size_t>(i)] != 2) ++unpaired;
  }
  return unpaired;
}

/// True if the boundary of the face's mesh runs along all of its edges.
bool mesh_closes(const TopoDS_Face& face) {
  using Link = std::pair<int, int>;
  const auto link = [](int a, int b) { return Link(std::min(a, b), std::max(a, b)); };
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull() || mesh->NbTriangles() == 0) return false;
  std::map<Link, int> uses;
  for (int i = 1; i <= mesh->NbTriangles(); ++i) {
    int a, b, c;
    mesh->Triangle(i).Get(a, b, c);
    for (const Link& side : {link(a, b), link(b, c), link(c, a)}) ++uses[side];
  }
  std::set<Link> boundary, along_edges;
  for (const auto& [side, count] : uses) {
    if (count == 1) boundary.insert(side);
    if (count > 2) return false;
  }
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    const Handle(Poly_PolygonOnTriangulation) polygon =
        BRep_Tool::PolygonOnTriangulation(TopoDS::Edge(edges.Current()), mesh, location);
    if (polygon.IsNull()) return false;
    for (int i = 1; i < polygon->NbNodes(); ++i) along_edges.insert(link(polygon->Node(i), polygon->Node(i + 1)));
  }
  return boundary == along_edges;
}

/// Number of faces whose mesh is not closed. `finely`: the mesh must show grooves, and the wall of 0.02 mm between a
/// channel and the end of a groove.
int open_faces(const TopoDS_Shape& shape, bool finely) {
  const double sagitta = finely ? 0.01 : 0.05, turn = finely ? 0.2 : 0.3;  // mm, rad
  BRepMesh_IncrementalMesh(shape, sagitta, false, turn, false);
  int open = 0;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next())
    open += mesh_closes(TopoDS::Face(faces.Current())) ? 0 : 1;
  return open;
}

Polygon points_of(const TopoDS_Wire& wire) {
  Polygon points;
  for (BRepTools_WireExplorer edges(wire); edges.More(); edges.Next()) {
    const BRepAdaptor_Curve curve(edges.Current());
    const GCPnts_TangentialDeflection drawn(curve, k_floor_turn, k_floor_sagitta);
    Polygon of_edge;
    for (int i = 1; i <= drawn.NbPoints(); ++i) of_edge.emplace_back(drawn.Value(i).X(), drawn.Value(i).Y());
    if (edges.Current().Orientation() == TopAbs_REVERSED) std::reverse(of_edge.begin(), of_edge.end());
    points.insert(points.end(), of_edge.begin(), of_edge.end() - 1);
  }
  return points;
}

double area_of(const Polygon& points) {
  double area = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    area += 0.5 * cross(a, b);
  }
  return area;
}

/// The loop of the section with the largest area. `smooth`: curves instead of chords.
Polygon floor_at(const TopoDS_Shape& shape, double z, bool smooth) {
  BRepAlgoAPI_Section section(shape, gp_Pln(about_axis(z)), false);
  section.Approximation(smooth);
  section.Build();
  Handle(TopTools_HSequenceOfShape) edges = new TopTools_HSequenceOfShape, wires = new TopTools_HSequenceOfShape;
  for (TopExp_Explorer found(section.Shape(), TopAbs_EDGE); found.More(); found.Next()) edges->Append(found.Current());
  ShapeAnalysis_FreeBounds::ConnectEdgesToWires(edges, 1e-4, false, wires);
  Polygon largest;
  double most = 0;
  for (int i = 1; i <= wires->Length(); ++i) {
    Polygon points = points_of(TopoDS::Wire(wires->Value(i)));
    const double area = area_of(points);
    if (std::abs(area) <= most) continue;
    most = std::abs(area);
    if (area < 0) std::reverse(points.begin(), points.end());
    largest = std::move(points);
  }
  return largest;
}

/// The floor with smooth curves. The kernel finds none between the halves of profiles/elbow_idlers.toml. For a part
/// of that size chords are accurate enough.
Polygon floor_at(const TopoDS_Shape& shape, double z) {
  Polygon floor = floor_at(shape, z, true);
  return floor.empty() ? floor_at(shape, z, false) : floor;
}

/// Distinct nodes of the faces' meshes, and triangles that face outwards.
solid::TriangleMesh mesh_of(const TopoDS_Shape& shape) {
  solid::TriangleMesh mesh;
  for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
    const TopoDS_Face face = TopoDS::Face(faces.Current());
    TopLoc_Location location;
    const Handle(Poly_Triangulation) of_face = BRep_Tool::Triangulation(face, location);
    if (of_face.IsNull()) continue;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 1; i <= of_face->NbNodes(); ++i) {
      const gp_Pnt node = of_face->Node(i).Transformed(location.Transformation());
      mesh.vertices.emplace_back(node.X(), node.Y(), node.Z());
    }
    const bool turned = face.Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= of_face->NbTriangles(); ++i) {
      int a, b, c;
      of_face->Triangle(i).Get(a, b, c);
      if (turned) std::swap(b, c);
      mesh.triangles.push_back({first + static_cast<std::uint32_t>(a) - 1, first + static_cast<std::uint32_t>(b) - 1,
                                first + static_cast<std::uint32_t>(c) - 1});
    }
  }
  return mesh;
}

/// Nodes of the faces' meshes in a lattice of cells: start points for nearest-point searches.
class SurfaceSamples {
 public:
  explicit SurfaceSamples(const TopoDS_Shape& shape) {
    for (TopExp_Explorer faces(shape, TopAbs_FACE); faces.More(); faces.Next()) {
      const TopoDS_Face face = TopoDS::Face(faces.Current());
      TopLoc_Location location;
      const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
      if (mesh.IsNull() || !mesh->HasUVNodes()) continue;
      surfaces_.push_back(BRep_Tool::Surface(face));
      for (int i = 1; i <= mesh->NbNodes(); ++i) {
        const gp_Pnt node = mesh->Node(i);
        const gp_Pnt2d uv = mesh->UVNode(i);
        cells_[cell_of(node)].push_back({node, uv.X(), uv.Y(), surfaces_.size() - 1});
      }
    }
  }

  /// Distance from the surfaces that have a node nearby; infinite if there is none.
  double distance(const gp_Pnt& point) const {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [surface, start] : near(point)) best = std::min(best, foot_distance(point, *start.second));
    return best;
  }

  /// The lowest point of the groove near `point`: of the surface points nearby in its half-plane through the axis, that
  /// with the smallest radius. For a level floor, its middle. `point` itself if there is none.
  gp_Pnt floor_near(const gp_Pnt& point) const {
    // The ends of walls are as low as the level floor between them, which is preferred.
    constexpr double k_level = 1e-5;  // mm
    // Points further away belong to another turn.
    constexpr double k_near = 0.25;  // mm
    gp_Pnt best = point;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [surface, start] : near(point)) {
      const auto found = lowest_on(*surfaces_[surface], point, *start.second);
      if (!found || found->place.Distance(point) > k_near) continue;
      const double radius = radius_of(found->place) - (found->is_level ? k_level : 0.0);
      if (radius >= least) continue;
      least = radius;
      best = found->place;
    }
    return best;
  }

 private:
  static constexpr double k_cell = 1.5;  // mm
  using Cell = std::array<int, 3>;
  struct Node {
    gp_Pnt place;
    double u, v;
    std::size_t surface;
  };

  static Cell cell_of(const gp_Pnt& point) {
    return {static_cast<int>(std::floor(point.X() / k_cell)), static_cast<int>(std::floor(point.Y() / k_cell)),
            static_cast<int>(std::floor(point.Z() / k_cell))};
  }

  /// The nearest node of every surface with nodes nearby.
  std::map<std::size_t, std::pair<double, const Node*>> near(const gp_Pnt& point) const {
    std::map<std::size_t, std::pair<double, const Node*>> of_surface;
    const Cell middle = cell_of(point);
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          const auto found = cells_.find({middle[0] + i, middle[1] + j, middle[2] + k});
          if (found == cells_.end()) continue;
          for (const Node& node : found->second) {
            const double away = node.place.SquareDistance(point);
            const auto [known, is_new] = of_surface.emplace(node.surface, std::pair(away, &node));
            if (!is_new && away < known->second.first) known->second = {away, &node};
          }
        }
      }
    }
    return of_surface;
  }

  static double radius_of(const gp_Pnt& point) { return elementary::hypot(point.X(), point.Y()); }

  struct Crossing {
    gp_Pnt place;
    bool inside = false;  ///< inside the patch
  };

  struct LowestPoint {
    gp_Pnt place;
    bool is_level = false;  ///< the patch has the same radius all across the groove
  };

  /// The lowest point of a patch in the point's half-plane, searched over the rows v.
  static std::optional<LowestPoint> lowest_on(const Geom_Surface& surface, const gp_Pnt& point, const Node& start) {
    constexpr int k_narrowings = 24;
    // No patch across a groove is wider.
    constexpr double k_far = 3;       // mm
    constexpr double k_level = 1e-5;  // mm
    double u1, u2, v1, v2;
    surface.Bounds(u1, u2, v1, v2);
    if (Precision::IsInfinite(v1) || Precision::IsInfinite(v2)) return std::nullopt;
    double u = start.u;
    const auto at = [&](double v) { return across(surface, point, u, v); };
    const auto radius_at = [&](double v) {
      const auto crossing = at(v);
      return crossing ? radius_of(crossing->place) : std::numeric_limits<double>::quiet_NaN();
    };
    const auto halfway = at(0.5 * (v1 + v2));
    if (!halfway || halfway->place.Distance(point) > k_far) return std::nullopt;
    const double first = radius_at(v1), last = radius_at(v2), level = radius_at(0.5 * (v1 + v2));
    const bool is_level = std::abs(first - level) < k_level && std::abs(last - level) < k_level;
    const Bracket rows{v1, v2};
    const auto lowest = at(is_level ? rows.middle() : golden_section(rows, k_narrowings, radius_at).middle());
    if (!lowest || !lowest->inside) return std::nullopt;
    return LowestPoint{lowest->place, is_level};
  }

  /// The crossing of row v with the point's half-plane, by Newton's method from u. A half-plane may cross some rows
  /// slightly beyond the end of a patch, so the row is extended slightly.
  static std::optional<Crossing> across(const Geom_Surface& surface, const gp_Pnt& point, double& u, double v) {
    constexpr int k_steps = 20;
    constexpr double k_near = 1e-10;
    constexpr double k_past_end = 0.1, k_most_past = 0.05, k_at_end = 1e-6;
    double u1, u2, v1, v2;
    surface.Bounds(u1, u2, v1, v2);
    const double past = std::min(k_past_end * (u2 - u1), k_most_past);
    for (int i = 0; i < k_steps; ++i) {
      gp_Pnt here;
      gp_Vec along, up;
      surface.D1(u, v, here, along, up);
      // Signed distance from the plane through the axis and `point`, and its derivative by u.
      const double distance = (point.X() * here.Y() - point.Y() * here.X()) / radius_of(point);
      const double slope = (point.X() * along.Y() - point.Y() * along.X()) / radius_of(point);
      if (std::abs(distance) < k_near) {
        const bool is_ahead = point.X() * here.X() + point.Y() * here.Y() > 0;
        if (!is_ahead) return std::nullopt;
        return Crossing{here, u > u1 - k_at_end && u < u2 + k_at_end};
      }
      if (slope == 0) break;
      u = std::clamp(u - distance / slope, u1 - past, u2 + past);
    }
    return std::nullopt;
  }

  /// Gauss-Newton iteration to the perpendicular foot on the surface.
  double foot_distance(const gp_Pnt& point, const Node& start) const {
    constexpr int k_steps = 12;
    const Geom_Surface& surface = *surfaces_[start.surface];
    double u1, u2, v1, v2, u = start.u, v = start.v, best = std::numeric_limits<double>::infinity();
    surface.Bounds(u1, u2, v1, v2);
    for (int i = 0; i < k_steps; ++i) {
      gp_Pnt at;
      gp_Vec along, across;
      surface.D1(u, v, at, along, across);
      const gp_Vec residual(at, point);
      best = std::min(best, residual.Magnitude());
      const double aa = along.SquareMagnitude(), ab = along.Dot(across), bb = across.SquareMagnitude();
      const double determinant = aa * bb - ab * ab;
      if (!(determinant > 0)) break;
      const double a = along.Dot(residual), b = across.Dot(residual);
      u = std::clamp(u + (bb * a - ab * b) / determinant, u1, u2);
      v = std::clamp(v + (aa * b - ab * a) / determinant, v1, v2);
    }
    return best;
  }

  std::vector<Handle(Geom_Surface)> surfaces_;
  std::map<Cell, std::vector<Node>> cells_;
};

StepReading read(const std::string& path, const StepQuestion& question) {
  silence_kernel();
  StepReading reading;
  try {
    STEPControl_Reader reader;
    if (reader.ReadFile(path.c_str()) != IFSelect_RetDone) return reading;
    reader.TransferRoots();
    const TopoDS_Shape shape = reader.OneShape();
    if (shape.IsNull()) return reading;
    Bnd_Box box;
    BRepBndLib::Add(shape, box);
    // A file in another unit would take too long to triangulate.
    if (std::sqrt(box.SquareExtent()) > k_largest) return reading;
    TopTools_IndexedMapOfShape solids, edges, faces;
    TopExp::MapShapes(shape, TopAbs_SOLID, solids);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    reading.solids = solids.Extent();
    reading.edges = edges.Extent();
    reading.faces = faces.Extent();
    reading.unpaired_edges = unpaired_edges(shape);
    reading.is_valid = BRepCheck_Analyzer(shape).IsValid();
    GProp_GProps volume, area;
    // With the default tolerance the volume is off by 2 % on long trimmed splines.
    BRepGProp::VolumeProperties(shape, volume, 1e-5);
    BRepGProp::SurfaceProperties(shape, area);
    reading.volume = volume.Mass();
    reading.area = area.Mass();
    for (const double z : question.planes) reading.sections.push_back(floor_at(shape, z));
    reading.open_faces = open_faces(shape, question.floors != nullptr);
    if (question.floors) {
      const SurfaceSamples nearest(shape);
      for (const Vec3& place : question.points) reading.distances.push_back(nearest.distance(point_at(place)));
      for (const Vec3& place : question.floors(mesh_of(shape))) {
        const gp_Pnt found = nearest.floor_near(point_at(place));
        reading.floors.emplace_back(found.X(), found.Y(), found.Z());
      }
    }
  } catch (const Standard_Failure&) {
    reading.is_valid = false;
  }
  return reading;
}

}  // namespace
}  // namespace fusee::formats

extern "C" __attribute__((visibility("default")))
const fusee::formats::StepMaker fusee_step_maker_2{fusee::formats::write, fusee::formats::read};
