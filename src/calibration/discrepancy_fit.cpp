#include "calibration/discrepancy_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/decompositions.h"
#include "base/text.h"
#include "calibration/statistics.h"
#include "calibration/thresholds.h"
#include "measurement/strokes.h"
#include "measurement/value_range.h"

namespace fusee::calibration {
namespace {

/// Nodes of a drawn component.
constexpr int k_places = 61;
/// Harmonics: the least order in periods a turn, the largest, and the rows that a period requires.
constexpr double k_least_order = 1.0;
constexpr double k_most_order = 400.0;
constexpr double k_rows_a_period = 2.5;
/// Components of a description.
constexpr std::size_t k_most_parts = 4;

struct FactorWords {
  Factor factor;
  const char* name;
  const char* words;
};

constexpr FactorWords k_words[] = {
    {Factor::place, "place",
     "equal at each angle for all directions, loads and speeds: it comes from a part that turns or bends with the "
     "angle, from the motor's sensor to pulley, pins and the joint's sensor; turn the pulley on its shaft and see "
     "whether the error moves with it"},
    {Factor::direction, "direction",
     "changes sign with the direction of motion, at all loads and speeds: there is play or compliance between motor "
     "shaft and joint"},
    {Factor::reversal, "distance since the reversal",
     "decays after each reversal: friction or lost motion must be overcome before the joint follows"},
    {Factor::load, "load",
     "proportional to the load and changes sign with it: something in the loaded chain is compliant, from the anchor "
     "of the tendon to the frame that holds the pins"},
    {Factor::load_size, "load size",
     "grows with the size of the load, whichever its sign: something is compliant under the tension of both tendons"},
    {Factor::load_direction, "load and direction",
     "hysteresis that grows with the load: something rubs under the tendons' force, at pins, bearing or groove"},
    {Factor::speed, "speed", "grows with speed, equally in both directions: a dynamic cause, or the clock of the log"},
    {Factor::speed_direction, "speed and direction",
     "hysteresis that grows with speed: something is late or viscous, in a sensor, its filter or a bearing"},
    {Factor::run, "run", "one constant per run: something was touched, slipped or warmed between the runs"},
    {Factor::drift, "time", "drifts steadily within a run: something creeps, warms or comes loose"},
    {Factor::stroke, "stroke", "differs from stroke to stroke: something is loose or drifts"},
};

/// Rows in use: motor and joint angle, direction of the motor and sign of the load, ±1.
struct Angles {
  Eigen::VectorXd motor, joint;
  Eigen::VectorXd direction, load_sign;
  double motor_step = 0;  ///< median step from row to row while the motor moved
  double joint_step = 0;
};

/// Median step while the motor moves. Within a dwell, only noise changes the joint's angle.
double median_step(const Eigen::VectorXd& angle, const Eigen::VectorXd& motor) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < angle.size(); ++i) {
    if (motor[i] != motor[i - 1]) steps.push_back(std::abs(angle[i] - angle[i - 1]));
  }
  return steps.empty() ? 0.0 : measurement::median_of(steps);
}

Angles angles_of(const Evidence& evidence) {
  std::vector<const measurement::Sample*> all;
  for (const measurement::Run& run : evidence.measurement.runs) {
    for (const measurement::Sample& sample : run.samples) all.push_back(&sample);
  }
  const auto rows = static_cast<Eigen::Index>(evidence.rows_used());
  Angles angles{Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows), Eigen::VectorXd(rows)};
  Eigen::Index i = 0;
  for (const Block& block : evidence.blocks) {
    for (const std::size_t row : block.rows) {
      angles.motor[i] = all[row]->alpha;
      angles.joint[i] = all[row]->theta;
      angles.direction[i] = evidence.measurement.runs[block.run].strokes[block.stroke].direction;
      angles.load_sign[i] = all[row]->load < 0 ? -1.0 : 1.0;
      ++i;
    }
  }
  angles.motor_step = median_step(angles.motor, angles.motor);
  angles.joint_step = median_step(angles.joint, angles.motor);
  return angles;
}

/// Component of a factor, rows in use.
Eigen::VectorXd part_of(const Discrepancy& discrepancy, const Eigen::VectorXd& coefficients, Factor factor) {
  return sum_of_families(discrepancy, coefficients, [factor](Factor other) { return other == factor; });
}

/// Component for rising motor angle and positive load.
Eigen::VectorXd normalized(const Angles& angles, const Eigen::VectorXd& part, Factor factor) {
  switch (factor) {
    case Factor::direction:
    case Factor::load_direction:
    case Factor::speed_direction:
      return part.cwiseProduct(angles.direction);
    case Factor::load:
      return part.cwiseProduct(angles.load_sign);
    default:
      return part;
  }
}

/// True if a component is a function of place, times a factor.
bool has_course(Factor factor) {
  return factor != Factor::reversal && factor != Factor::run && factor != Factor::drift && factor != Factor::stroke;
}

/// Draws the largest value of a component at each place.
void draw(const Angles& angles, const Eigen::VectorXd& part, DiscrepancyComponent& component) {
  measurement::ValueRange span;
  for (const double alpha : angles.motor) span.take(alpha);
  if (!span.any()) return;
  const measurement::Bins bins{span, k_places};
  std::map<int, double> largest;
  for (Eigen::Index i = 0; i < part.size(); ++i) {
    double& most = largest[bins.bin(angles.motor[i])];
    if (std::abs(part[i]) > std::abs(most)) most = part[i];
  }
  for (const auto& [bin, value] : largest) {
    component.alpha.push_back(0.5 * (bins.edge(bin) + bins.edge(bin + 1)));
    component.theta.push_back(value);
  }
}

/// Harmonic whose sine and cosine reduce the squares of the residual most.
struct Harmonic {
  double order = 0;
  double taken = 0;  ///< share of the squares that it removes
  Eigen::VectorXd part;
};

Harmonic strongest(const Eigen::VectorXd& angle, double row_step, const Eigen::VectorXd& residual) {
  Harmonic best;
  const double span = angle.maxCoeff() - angle.minCoeff();
  if (!(span > 0) || !(row_step > 0) || !(residual.squaredNorm() > 0)) return best;
  const double most = std::min(k_most_order, k_two_pi / (k_rows_a_period * row_step));
  const double step = 0.25 * k_two_pi / span;
  for (double order = std::max(k_least_order, 1.5 * k_two_pi / span); order < most; order += step) {
    Eigen::MatrixXd wave(residual.size(), 2);
    wave.col(0) = (order * angle).unaryExpr(&elementary::sin);
    wave.col(1) = (order * angle).unaryExpr(&elementary::cos);
    const Eigen::VectorXd projection = wave.transpose() * residual;
    const Eigen::VectorXd size = solved(wave.transpose() * wave, projection);
    const double taken = size.dot(projection) / residual.squaredNorm();
    if (taken > best.taken) best = {order, taken, wave * size};
  }
  return best;
}

/// Adds a harmonic of motor or joint if it is more than half of the residual beyond noise.
void find_harmonic(const Angles& angles, const Eigen::VectorXd& residual, double noise,
                   std::vector<DiscrepancyComponent>& parts) {
  const Harmonic motor = strongest(angles.motor, angles.motor_step, residual);
  const Harmonic joint = strongest(angles.joint, angles.joint_step, residual);
  const bool of_motor = motor.taken >= joint.taken;
  const Harmonic& best = of_motor ? motor : joint;
  const double squares = residual.squaredNorm();
  const double above = squares - static_cast<double>(residual.size()) * noise * noise;
  if (!(best.taken * squares > 0.5 * above) || !(above > 0.3 * static_cast<double>(residual.size()) * noise * noise))
    return;
  DiscrepancyComponent component;
  component.factor = of_motor ? "motor harmonic" : "joint harmonic";
  const double whole = std::round(best.order);
  component.order = std::abs(best.order - whole) < 0.15 ? whole : best.order;
  component.rms = rms_of(best.part);
  component.evidence = 0.5 * best.taken * squares / (noise * noise);
  component.words = "once in " + rounded(360.0 / component.order, 4) + "° of the " +
                    (of_motor ? "motor's shaft" : "joint") +
                    ", at all loads and directions: look for a part that turns with it, such as " +
                    (of_motor ? "poles, gear teeth or steps of the sensor" : "the sensor's ring or balls of a bearing");
  draw(angles, best.part, component);
  parts.push_back(std::move(component));
}

/// Discrepancy of a few factors, added one by one while the data require them. Of factors that can replace one another,
/// the description contains the one that explains most.
struct FactorSelection {
  Posterior posterior;
  std::vector<std::pair<const FactorWords*, double>> factors;  ///< with the evidence that each added, nats
};

/// Amplitudes without any factor. The error of the model itself, if considered, keeps its fixed amplitude.
Amplitudes no_discrepancy(const EvidenceModel& evidence_model, bool (*is_considered)(Factor)) {
  Amplitudes amplitudes = evidence_model.without_discrepancy();
  const std::vector<Family>& families = evidence_model.discrepancy().families;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (!is_considered(families[f].factor)) amplitudes.families[static_cast<Eigen::Index>(f)] = 0;
  }
  return amplitudes;
}

FactorSelection select_factors(const EvidenceModel& evidence_model, const TangentSums& sums, double size,
                               bool (*is_considered)(Factor)) {
  const std::vector<Family>& families = evidence_model.discrepancy().families;
  FactorSelection found;
  found.posterior = evidence_model.best(sums, no_discrepancy(evidence_model, is_considered));
  for (std::size_t step = 0; step < k_most_parts; ++step) {
    const FactorWords* taken = nullptr;
    Posterior better = found.posterior;
    for (const FactorWords& factor : k_words) {
      if (!is_considered(factor.factor)) continue;
      Amplitudes wider = found.posterior.amplitudes;
      bool any = false;
      for (std::size_t f = 0; f < families.size(); ++f) {
        double& amplitude = wider.families[static_cast<Eigen::Index>(f)];
        if (families[f].factor != factor.factor || amplitude > 0) continue;
        amplitude = size;
        any = true;
      }
      if (!any) continue;
      Posterior trial = evidence_model.best(sums, wider);
      if (trial.log_evidence <= better.log_evidence) continue;
      better = std::move(trial);
      taken = &factor;
    }
    const double gain = better.log_evidence - found.posterior.log_evidence;
    if (taken == nullptr || gain < k_thresholds.strong) break;
    found.posterior = std::move(better);
    found.factors.emplace_back(taken, gain);
  }
  return found;
}

/// Excess of the noise over the floor, rad². A floor from few repeats may be exceeded by chance.
double noise_beyond_floor(const Evidence& evidence, double noise) {
  const double ratio = elementary::pow(noise / evidence.floor, 2);
  const double rows = evidence.evidence_model->independent_share() * static_cast<double>(evidence.rows_used());
  const bool is_badly_known = evidence.floor_freedom < k_thresholds.noise_freedom;
  if (is_badly_known && ratio < rarest_ratio(rows, evidence.floor_freedom)) return 0;
  return std::max(0.0, ratio - 1.0) * evidence.floor * evidence.floor;
}

}  // namespace

bool is_of_place(Factor factor) { return factor == Factor::place || factor == Factor::direction; }

bool is_any(Factor) { return true; }

DiscrepancyFit describe_discrepancy(const Evidence& evidence, const Fit& fit, bool (*is_considered)(Factor)) {
  const EvidenceModel& evidence_model = *evidence.evidence_model;
  const Discrepancy& discrepancy = evidence_model.discrepancy();
  const Tangent tangent = tangent_of(evidence, fit);
  const TangentSums sums = evidence_model.sums_of(tangent);
  const Angles angles = angles_of(evidence);
  const FactorSelection all =
      select_factors(evidence_model, sums, std::max(evidence.floor, rms_of(tangent.residual)), is_considered);
  DiscrepancyFit unmodelled;
  const double excess = noise_beyond_floor(evidence, all.posterior.amplitudes.noise);
  const Amplitudes nothing = no_discrepancy(evidence_model, is_considered);
  const Posterior as_noise = excess > 0 ? evidence_model.at(sums, nothing) : evidence_model.best(sums, nothing);
  unmodelled.evidence = all.posterior.log_evidence - as_noise.log_evidence;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(discrepancy.columns.rows());
  for (const auto& [factor, gain] : all.factors) {
    const Eigen::VectorXd part = part_of(discrepancy, all.posterior.coefficients, factor->factor);
    sum += part;
    DiscrepancyComponent component;
    component.factor = factor->name;
    component.words = factor->words;
    component.rms = rms_of(part);
    component.evidence = gain;
    if (component.rms < k_thresholds.usual_discrepancy * evidence.floor) continue;
    if (has_course(factor->factor)) draw(angles, normalized(angles, part, factor->factor), component);
    unmodelled.parts.push_back(std::move(component));
  }
  unmodelled.rms = elementary::hypot(rms_of(sum), std::sqrt(excess));
  Eigen::VectorXd residual = tangent.residual - sum + part_of(discrepancy, all.posterior.coefficients, Factor::place);
  if (tangent.x.size() > 0) residual -= tangent.J * all.posterior.step;
  find_harmonic(angles, residual, evidence.floor, unmodelled.parts);
  std::stable_sort(unmodelled.parts.begin(), unmodelled.parts.end(),
                   [](const DiscrepancyComponent& a, const DiscrepancyComponent& b) { return a.rms > b.rms; });
  unmodelled.posterior = all.posterior;
  return unmodelled;
}

bool is_unexplained(const DiscrepancyFit& unmodelled, double floor) {
  return unmodelled.evidence > k_thresholds.decisive && unmodelled.rms > k_thresholds.usual_discrepancy * floor;
}

}  // namespace fusee::calibration
