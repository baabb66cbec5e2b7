/// \file
/// Internal: the parts of the reproduction.
#pragma once

#include "fusee/transmission.h"
#include "paper/reproduction.h"

namespace fusee::paper {

/// The paper's optimum: R 1, EB = ED 0.5, OE −0.4 in its unit of length.
Mechanism table_4_mechanism(const PaperAssumptions& assumptions);

/// The forces [1]-[11] at one point of the stroke.
struct StrokePlace {
  transmission::TransmissionPoint point;
  transmission::PaperForces forces;
};
/// Evenly spaced in α; empty where the law does not exist.
std::vector<StrokePlace> paper_stroke(const Mechanism& mechanism, int steps = 60);

/// Largest distance of θ(α) from its best straight line, deg.
double nonlinearity(const std::vector<StrokePlace>& stroke);
/// Largest distance from the least squares line through evenly spaced α.
double least_squares_nonlinearity(const std::vector<StrokePlace>& stroke);

std::vector<Claim> paper_claims(const Reproduction& so_far, const RunContext& context);
std::vector<PaperFigure> paper_figures(const PaperAssumptions& assumptions, const optimize::GeneticResult& evolution);
std::vector<LawCost> law_costs(const PaperAssumptions& assumptions);
/// True if no design of the box is better than Table 4 by more than a millionth.
bool table_4_is_optimal(const PaperAssumptions& assumptions);

}  // namespace fusee::paper
