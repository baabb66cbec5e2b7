#include "paper/steps.h"

// The paper's figures, identified by its text and captions; each states its interpretation.

namespace fusee::paper {
namespace {

template <typename Value>
Curve curve(const std::string& name, const std::vector<StrokePlace>& stroke, Value value) {
  Curve drawn{name, {}};
  for (const StrokePlace& place : stroke) drawn.points.emplace_back(degrees(place.point.alpha), value(place));
  return drawn;
}

PaperFigure over_stroke(int number, std::string title, std::string reading, std::string y_name, std::string y_unit,
                        std::vector<Curve> curves) {
  return {number, std::move(title),  std::move(reading), "pulley angle α",
          "°",    std::move(y_name), std::move(y_unit),  std::move(curves)};
}

PaperFigure convergence(const optimize::GeneticResult& evolution) {
  PaperFigure figure{
      7,  "The genetic algorithm",     "mean and best of each generation", "generation", "", "largest T_b / F_c",
      "", {{"best", {}}, {"mean", {}}}};
  for (const optimize::Generation& generation : evolution.generations) {
    figure.curves[0].points.emplace_back(generation.number, generation.best);
    figure.curves[1].points.emplace_back(generation.number, generation.mean);
  }
  return figure;
}

}  // namespace

std::vector<PaperFigure> paper_figures(const PaperAssumptions& assumptions, const optimize::GeneticResult& evolution) {
  using Place = const StrokePlace&;
  const Mechanism mechanism = table_4_mechanism(assumptions);
  const std::vector<StrokePlace> stroke = paper_stroke(mechanism);
  PaperAssumptions smooth = assumptions;
  smooth.mu = 0;
  const std::vector<StrokePlace> without_friction = paper_stroke(table_4_mechanism(smooth));
  const double slope = (stroke.back().point.theta - stroke.front().point.theta) /
                       (stroke.back().point.alpha - stroke.front().point.alpha);
  std::vector<PaperFigure> figures;
  figures.push_back(over_stroke(4, "Lengths of the upper spans", "the geometry over the stroke: BC and CD [2],[3]",
                                "length", "mm",
                                {curve("BC", stroke, [](Place p) { return p.point.t1.free_upper; }),
                                 curve("CD", stroke, [](Place p) { return p.point.t2.free_upper; })}));
  figures.push_back(over_stroke(5, "Radius of P2", "r2 over the stroke, P1 round [4],[5]", "radius", "mm",
                                {curve("r1", stroke, [](Place p) { return p.point.t1.p; }),
                                 curve("r2", stroke, [](Place p) { return p.point.t2.p; })}));
  figures.push_back(convergence(evolution));
  figures.push_back(over_stroke(8, "Tension above the pin", "T2 at the optimum over the stroke [6]", "T2", "N",
                                {curve("T2", stroke, [](Place p) { return p.forces.T2; })}));
  figures.push_back(over_stroke(9, "Tension below the pin", "T_b with and without friction [7],[8]", "T_b", "N",
                                {curve("with friction", stroke, [](Place p) { return p.forces.Tb; }),
                                 curve("without", without_friction, [](Place p) { return p.forces.Tb; })}));
  figures.push_back(over_stroke(10, "Elongation of tendon 2", "Δ over the stroke [9]", "elongation", "mm",
                                {curve("elongation", stroke, [](Place p) { return p.forces.elongation; })}));
  figures.push_back(over_stroke(11, "Error of the joint by stretch", "Δθ over the stroke [10],[11]", "joint error", "°",
                                {curve("joint error", stroke, [](Place p) { return degrees(p.forces.theta_error); })}));
  figures.push_back(
      over_stroke(13, "Joint angle", "the model's curve θ(α), beside the straight line through its ends [1]-[4], [12]",
                  "joint angle θ", "°",
                  {curve("model", stroke, [](Place p) { return degrees(p.point.theta); }),
                   curve("straight line", stroke, [&](Place p) {
                     return degrees(stroke.front().point.theta + slope * (p.point.alpha - stroke.front().point.alpha));
                   })}));
  return figures;
}

}  // namespace fusee::paper
