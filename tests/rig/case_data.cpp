#include "rig/case_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <utility>
#include <vector>

#include "base/json.h"
#include "calibration/words.h"
#include "fusee/base.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "joint/joint_effects.h"
#include "rig/sharpness.h"

namespace fusee::rig {
namespace {

constexpr std::size_t k_rows_of_run = 200;
/// Number of times at which a slip may have happened: as many as the fits search.
constexpr int k_slip_times = 24;
/// Smaller changes than this are invisible, rad.
constexpr double k_nothing = 1e-9;

using Values = std::vector<double>;

/// The predicted joint angles of the rows that are written.
class SampledJoint {
 public:
  explicit SampledJoint(const CaseInput& input)
      : declared_(input.declared), log_(measurement::bench_log(input.measurement)) {
    for (std::size_t run = 0; run < log_.size(); ++run) {
      const std::size_t all = log_[run].rows.size(), count = std::min(all, k_rows_of_run);
      for (std::size_t k = 0; k < count; ++k) rows_.emplace_back(run, k * all / count);
    }
  }

  const std::vector<std::pair<std::size_t, std::size_t>>& rows() const { return rows_; }  ///< run, row

  Values predicted(const Imperfections& at) const {
    const joint::Readings all = joint::predict(declared_, at, log_);
    Values angles;
    for (const auto& [run, row] : rows_) angles.push_back(all[run][row]);
    return angles;
  }

  /// Times spread evenly over the session.
  Values slip_times() const {
    const Values clock = joint::bench_clock(log_);
    const double first = clock.front() + log_.front().rows.front().time;
    const double last = clock.back() + log_.back().rows.back().time;
    Values times;
    for (int i = 0; i < k_slip_times; ++i) times.push_back(first + (i + 0.5) / k_slip_times * (last - first));
    return times;
  }

 private:
  const Mechanism& declared_;
  joint::BenchLog log_;
  std::vector<std::pair<std::size_t, std::size_t>> rows_;
};

struct Column {
  std::string title;
  Values values;  ///< rad
};

/// Values of all numbers of the effect at which slopes are taken; zeros are the declared joint.
std::vector<Values> starts_of(const Effect& effect, const SampledJoint& joint) {
  std::vector<Values> starts = effect.starts;
  if (effect.starts_in_time) {
    for (const double time : joint.slip_times()) starts.push_back({0.0, time});
  }
  const auto is_searched = [](const EffectParameter& parameter) { return parameter.searched; };
  if (std::none_of(effect.parameters.begin(), effect.parameters.end(), is_searched))
    starts.insert(starts.begin(), Values(effect.parameters.size(), 0.0));
  return starts;
}

/// (b − a) `factor`; empty if no change is visible, or if the joint has no equilibrium at a row.
Values scaled_difference(const Values& a, const Values& b, double factor) {
  Values difference;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference.push_back(factor * (b[i] - a[i]));
    if (!std::isfinite(difference.back())) return {};
    most = std::max(most, std::abs(difference.back()));
  }
  return most > k_nothing ? difference : Values{};
}

void add_columns(const Effect& effect, const SampledJoint& joint, std::vector<Column>& columns) {
  const std::vector<Values> starts = starts_of(effect, joint);
  for (std::size_t s = 0; s < starts.size(); ++s) {
    Imperfections at;
    for (std::size_t p = 0; p < effect.parameters.size(); ++p) set_value(at, effect.parameters[p], starts[s][p]);
    const Values there = joint.predicted(at);
    for (std::size_t p = 0; p < effect.parameters.size(); ++p) {
      const EffectParameter& parameter = effect.parameters[p];
      if (parameter.searched) continue;
      Imperfections moved = at;
      double factor = 1;
      if (starts[s][p] == 0) {
        set_value(moved, parameter, parameter.step);
      } else {
        reset(moved, parameter);
        factor = -parameter.step / starts[s][p];
      }
      Values values = scaled_difference(there, joint.predicted(moved), factor);
      if (!values.empty())
        columns.push_back({effect.name + "/" + parameter.name + "/" + std::to_string(s), std::move(values)});
    }
  }
}

std::vector<int> directions(const measurement::Run& run) {
  std::vector<int> all(run.samples.size(), 0);
  for (const measurement::Stroke& stroke : run.strokes) {
    for (std::size_t row = stroke.first; row <= stroke.last; ++row) all[row] = stroke.direction;
  }
  return all;
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string slopes_csv(const CaseInput& input) {
  const SampledJoint joint(input);
  std::vector<Column> columns = {{"declared_deg", joint.predicted({})}};
  for (const Effect* effect : joint::effects_of(input.declared)) {
    if (effect->is_tested) add_columns(*effect, joint, columns);
  }
  std::string text = "run,time_s,alpha_deg,theta_deg,load_N,direction";
  for (const Column& column : columns) text += "," + column.title;
  text += "\n";
  std::vector<std::vector<int>> direction;
  for (const measurement::Run& run : input.measurement.runs) direction.push_back(directions(run));
  for (std::size_t i = 0; i < joint.rows().size(); ++i) {
    const auto [run, row] = joint.rows()[i];
    const measurement::Sample& sample = input.measurement.runs[run].samples[row];
    text += std::to_string(run + 1);
    for (const double value :
         {sample.time, degrees(sample.alpha), degrees(sample.theta), std::isfinite(sample.load) ? sample.load : 0.0})
      text += "," + text_of(value);
    text += "," + std::to_string(direction[run][row]);
    for (const Column& column : columns) text += "," + text_of(degrees(column.values[i]));
    text += "\n";
  }
  return text;
}

Json truth_of(const Case& made, const std::string& kind) {
  Json faults = Json::array();
  for (std::size_t i = 0; i < made.faults.size(); ++i) {
    const Fault& fault = find_fault(made.faults[i]);
    Json numbers = Json::object();
    if (fault.numbers != nullptr) {
      for (const auto& [name, value] : fault.numbers(made.hidden, made.joint)) numbers[name] = result_json(value);
    }
    faults.push_back({{"name", fault.name},
                      {"is_modelled", has_name(fault.name)},
                      {"kin", fault.kin},
                      {"seen_in_noise_rms", i < made.seen.size() ? result_json(made.seen[i]) : Json()},
                      {"numbers", numbers}});
  }
  return {{"kind", kind},
          {"seed", made.seed},
          {"faults", faults},
          {"groove_friction_differs", made.hidden.groove_friction != HiddenFaults{}.groove_friction},
          {"sensor_noise_deg", angle_json(made.sensors.noise)}};
}

Json answer_of(const TimedAnswer& answer) {
  const calibration::Calibration& found = answer.found;
  Json effects = Json::array();
  for (const calibration::FoundEffect& effect : found.effects) {
    Json numbers = Json::array();
    for (const calibration::FittedParameter& number : effect.parameters) {
      numbers.push_back({{"name", number.name},
                         {"value", result_json(number.value)},
                         {"ci95", {result_json(number.low), result_json(number.high)}},
                         {"ci95_if_only", {result_json(number.low_if_only), result_json(number.high_if_only)}}});
    }
    effects.push_back({{"name", effect.name},
                       {"group", effect.group},
                       {"log_odds", result_json(effect.evidence)},
                       {"log_odds_over_unmodelled", result_json(effect.unmodelled.log_odds)},
                       {"numbers", numbers}});
  }
  return {{"verdict", calibration::word(found.verdict)},
          {"effects", effects},
          {"unmodelled_log_odds", result_json(unmodelled_log_odds(found))},
          {"unexplained_rms_deg", angle_json(found.unexplained_rms)},
          {"noise_floor_deg", angle_json(found.noise.rms)},
          {"seconds", result_json(answer.seconds)}};
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw OutputError("cannot write " + path.string(), "check free space and permissions");
}

}  // namespace

CaseInput read_case(const Case& made, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> runs;
  for (std::size_t run = 0; run < made.logs.size(); ++run)
    runs.push_back(folder / ("run_" + std::to_string(run + 1) + ".csv"));
  CaseInput input{read_mechanism(folder / "spec.toml").mechanism, measurement::read_measurement(runs)};
  measurement::compare_with_declared(input.declared, input.measurement);
  return input;
}

void write_case_data(const Case& made, const std::string& kind, const TimedAnswer* answer,
                     const std::filesystem::path& folder) {
  Json json = truth_of(made, kind);
  json["answer"] = answer != nullptr ? answer_of(*answer) : Json();
  write(folder / "slopes.csv", slopes_csv(read_case(made, folder)));
  // Last: a folder with case.json is complete.
  write(folder / "case.json", json_text(json, 1));
}

}  // namespace fusee::rig
