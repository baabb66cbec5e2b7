/// \file
/// Internal: the parts of the reproduction.
#pragma once

#include "fusee/transmission.h"
#include "paper/reproduction.h"

namespace fusee::paper {

/// The mechanism of Table 4, the paper's optimum: R 1, EB = ED 0.5, OE −0.4 in the paper's unit of length.
Mechanism table_4_mechanism(const PaperAssumptions& assumptions);

/// The results of equations [1]-[11] at one point of the stroke.
struct StrokePlace {
  transmission::TransmissionPoint point;
  transmission::PaperForces forces;
};
/// `steps` + 1 points, evenly spaced in α over the range. Empty if the joint has a dead centre in its range.
std::vector<StrokePlace> paper_stroke(const Mechanism& mechanism, int steps = 60);

/// Largest distance of θ(α) from its best straight line, deg.
double nonlinearity(const std::vector<StrokePlace>& stroke);
/// Largest distance of θ(α) from the least-squares line through the points of the stroke, deg.
double least_squares_nonlinearity(const std::vector<StrokePlace>& stroke);

std::vector<Claim> paper_claims(const Reproduction& so_far, const RunContext& context);
std::vector<PaperFigure> paper_figures(const PaperAssumptions& assumptions, const optimize::GeneticResult& evolution);
std::vector<LawCost> law_costs(const PaperAssumptions& assumptions);
/// True if it is proven that no design within the bounds has a max T_b/F_c below that of Table 4 by more than two
/// millionths.
bool table_4_is_optimal(const PaperAssumptions& assumptions);

}  // namespace fusee::paper
