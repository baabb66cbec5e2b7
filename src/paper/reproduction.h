/// \file
/// Reproduction of the paper's tables, figures and claims: its statements, the results of its equations [1]-[12], and
/// the assumed numbers.
///
/// The paper states no r1, EF, F_c, μ and no unit of length; PaperAssumptions supplies them. Its BG, which it does not
/// state either, follows from EB and EF. For μ, r1 and EF the windows in which a claim holds are computed.
#pragma once

#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/optimize.h"

namespace fusee::paper {

/// Numbers that the paper does not state, and its tendon.
struct PaperAssumptions {
  double unit = 100;      ///< length of the paper's unit, mm
  double r1 = 20;         ///< radius of the round pulley P1, mm
  double EF = 60;         ///< distance of the pulley's axis below the line of the pins, mm
  double mu = 0.2;        ///< friction coefficient between tendon and pin
  double tip_force = 20;  ///< F_c, N
  double diameter = 4;    ///< diameter of the tendon, mm; stated by the paper
  double modulus = 3000;  ///< Young's modulus of the tendon, MPa; stated by the paper
};

/// The paper's mechanism with point pins, EB = ED, and these lengths in mm.
Mechanism paper_mechanism(const PaperAssumptions& assumptions, double R, double ED, double OE);
/// The paper's optimization problem: the least max T_b/F_c over R, EB = ED and OE.
MechanismFile paper_problem_file(const PaperAssumptions& assumptions);

/// An interval of one assumed number, the others fixed, in which a claim holds.
struct Window {
  double low = 0;
  double high = 0;
  bool open_low = false;   ///< `low` is the end of the searched range, where the claim still holds
  bool open_high = false;  ///< `high` is the end of the searched range, where the claim still holds
};
/// Windows of one assumed number.
struct ParameterWindows {
  std::string parameter;  ///< "mu", "r1", "EF"
  std::string unit;
  double searched_low = 0;
  double searched_high = 0;
  std::vector<Window> windows;
};

/// A claim holds for all searched numbers, for some, or for none.
enum class Verdict { holds, holds_only_if, does_not_hold };
std::string_view verdict_text(Verdict verdict);

/// A statement of the paper, beside the results of its equations.
struct Claim {
  std::string name;  ///< snake_case
  std::string paper_says;
  std::string equations_give;
  Verdict verdict = Verdict::does_not_hold;
  std::vector<ParameterWindows> windows;  ///< for mu, r1, EF; empty where no assumed number matters
};

/// One row of Table 4. Lengths in mm, by the assumed unit of length.
struct OptimumRow {
  std::string symbol;
  double lower = 0;     ///< lower bound of the search
  double upper = 0;     ///< upper bound of the search
  double paper = 0;     ///< the paper's optimum
  double computed = 0;  ///< the certified optimum
};

/// A curve of a figure.
struct Curve {
  std::string name;
  std::vector<Vec2> points;
};
/// One figure of the paper, computed.
struct PaperFigure {
  int number = 0;
  std::string title;
  std::string reading;  ///< assumed content of the figure
  std::string x_name, x_unit, y_name, y_unit;
  std::vector<Curve> curves;
};

/// Results of one law of P1 on the paper's optimum, for the comparison of both laws.
struct LawCost {
  std::string law;  ///< "compensate" or "linear"
  /// Largest distance of θ(α) from its best straight line, deg.
  double nonlinearity = 0;
  double r1_least = 0, r1_most = 0, r2_least = 0, r2_most = 0;  ///< mm
  double bend_radius = 0;                                       ///< minimum on P1 or P2, mm; negative: concave
  double tension = 0;                                           ///< largest T_b/F_c
  double torque = 0;                                            ///< largest T_b r2/F_c, mm
  double torque_ripple = 0;                                     ///< maximum / minimum torque
};

/// Windows of μ in which Table 4 is the optimum, for one r1 and EF, mm.
struct MuWindow {
  double r1 = 0;
  double EF = 0;
  std::vector<Window> windows;
};

/// Result of reproduce_paper().
struct Reproduction {
  PaperAssumptions assumptions;
  std::vector<OptimumRow> table_4;
  double optimum = 0;  ///< max T_b/F_c, certified
  double relative_gap = 0;
  std::vector<Claim> claims;
  std::vector<PaperFigure> figures;
  std::vector<LawCost> laws;
  std::vector<MuWindow> mu_windows;
};

/// Computes table, claims, figures and laws. Throws Stopped between steps if `context` requests a stop.
Reproduction reproduce_paper(const PaperAssumptions& assumptions = {}, const RunContext& context = {});

}  // namespace fusee::paper
