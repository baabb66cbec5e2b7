#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "fusee/joint.h"
#include "fusee/pipeline.h"
#include "pipeline/design.h"
#include "pipeline/multi_turn.h"
#include "pipeline/without_law.h"

namespace fusee::pipeline {
namespace {

constexpr std::size_t k_largest_input = 8 << 20;  // bytes
/// Largest counts of the table's 32-bit integers, which end at 2.1·10⁹.
constexpr double k_most_counts = 2e9;
const std::vector<std::string> k_model_names = {
    "joint.xml",     "joint_tendons.xml", "joint.urdf",   "joint_ros2_control.urdf",
    "joint_table.h", "joint_table.json",  "manifest.json"};

/// compensation.csv that calibrate() wrote next to its corrected.toml, as confirmed by both manifests.
std::optional<std::filesystem::path> compensation_beside(const MechanismFile& file, FileAccess& files) {
  const std::filesystem::path mechanism = file.path, csv = mechanism.parent_path() / "compensation.csv";
  try {
    const std::string manifest = read_file(mechanism.parent_path() / "manifest.json", k_largest_input, files);
    if (!formats::names_output(manifest, mechanism.filename().string(), file.sha256)) return std::nullopt;
    if (!formats::names_output(manifest, csv.filename().string(), sha256(read_file(csv, k_largest_input, files))))
      return std::nullopt;
    return csv;
  } catch (const InputError&) {
    return std::nullopt;  // no manifest
  }
}

void take_compensation(formats::ModelProduct& product, const ModelOptions& options, FileAccess& files) {
  const auto path = options.compensation ? options.compensation : compensation_beside(product.file, files);
  if (!path || path->empty()) return;
  const std::vector<model::TwoWayRow> rows =
      model::read_compensation(read_file(*path, k_largest_input, files), path->string());
  product.curves.sensed = model::two_way_curve(model::refined(rows, transmission::Transmission(product.file.mechanism)),
                                               model::CurveSource::compensation);
  product.compensation = path->filename().string();
}

/// Throws unless the counts of the whole range, and a tenth beyond it, fit into 32 bits.
void demand_countable(const formats::ModelProduct& product, const model::MotorUnit& unit) {
  if (!unit.ticks) return;
  double most = 0;
  for (const double alpha : {product.curves.sensed.middle.alpha_min, product.curves.sensed.middle.alpha_max})
    most = std::max(most, std::abs(unit.of(1.1 * alpha)));
  if (most > k_most_counts)
    throw InputError("--ticks-per-turn", "counts of this joint reach " + rounded(most) + ": too large for 32 bits",
                     "use fewer counts a turn, or a --zero-ticks nearer to 0");
}

// ---- changes that make it possible ----------------------------------------------------------------------------------

/// The angle in deg, rounded up to three digits.
std::string limit_deg(double angle) {
  const double value = degrees(angle), scale = elementary::pow(10.0, 2 - std::floor(elementary::log10(value)));
  return rounded(std::ceil(value * scale) / scale, 3);
}

/// The law over `share` of its range. Limits are truncated to thousandths of a degree.
DeclaredMechanism narrowed(DeclaredMechanism mechanism, double share) {
  const auto truncated = [share](double angle) { return radians(std::trunc(1000 * share * degrees(angle)) / 1000); };
  mechanism.joint.theta_min = truncated(mechanism.joint.theta_min);
  mechanism.joint.theta_max = truncated(mechanism.joint.theta_max);
  return mechanism;
}

/// True if a polynomial has an error of at most `most`, rad.
bool has_polynomial(const DeclaredMechanism& mechanism, double most) {
  if (!(mechanism.joint.theta_max > mechanism.joint.theta_min)) return false;
  const transmission::Transmission law(mechanism);
  if (law.dead_centre() || !model::grows(law)) return false;
  const auto curves = model::joint_curves(mechanism);
  return curves && model::fit_equality(curves->physical.middle).error <= most;
}

std::vector<ModelChange> changes_for_polynomial(const formats::ModelProduct& product, const ModelOptions& options) {
  std::vector<ModelChange> changes;
  if (product.equality.error < radians(k_largest_limit_deg))
    changes.push_back({"--max-error-deg " + limit_deg(product.equality.error)});
  if (product.tendons) changes.push_back({"--no-polynomial"});
  double possible = 0, impossible = 1;  // shares of the range, found by bisection to 1/256
  for (int i = 0; i < 8; ++i) {
    const double share = 0.5 * (possible + impossible);
    if (has_polynomial(narrowed(product.file.mechanism, share), options.most_error))
      possible = share;
    else
      impossible = share;
  }
  if (possible > 0) {
    const Joint joint = narrowed(product.file.mechanism, possible).joint;
    const std::string value =
        "[" + rounded(degrees(joint.theta_min), 7) + ", " + rounded(degrees(joint.theta_max), 7) + "]";
    changes.push_back({"joint.range_deg = " + value, "joint.range_deg", value});
  }
  return changes;
}

std::vector<ModelChange> changes_for_table(const formats::ModelProduct& product, const ModelOptions& options) {
  for (double most = 2 * options.most_table_error; most < radians(k_largest_limit_deg); most *= 2) {
    if (const auto table = model::joint_table(product.curves.sensed, product.mechanism, options.unit, most))
      return {{"--max-table-error-deg " + limit_deg(std::max(table->errors.theta, table->errors.returned))}};
  }
  return {};
}

// ---- the steps ------------------------------------------------------------------------------------------------------

/// False if there is no θ(α) to fit; the reason is in `result`.
bool find_curves(ModelResult& result, const ModelOptions& options, FileAccess& files) {
  formats::ModelProduct& product = result.product;
  const DeclaredMechanism& declared = product.file.mechanism;
  if (declared.transmission)
    throw InputError(product.file.path, "a joint with [transmission] has no range to model",
                     "[transmission] is for 'fusee calibrate'");
  result.without_law = without_law(declared);
  if (!result.without_law && !model::grows(transmission::Transmission(declared))) {
    result.without_law = profile::synthesise(declared);
    if (profile::failed_of(result.without_law->conditions).empty()) {
      profile::Condition condition;
      condition.name = "law_grows";
      condition.ok = false;
      condition.message = "theta does not grow with alpha over the whole range";
      result.without_law->conditions.push_back(condition);
    }
  }
  if (result.without_law) {
    result.ending = ModelEnding::no_law;
    return false;
  }
  product.mechanism = joint::identified_joint(declared).mechanism;
  // For several turns the obstacle would be that one turn does not suffice.
  const auto obstacle = note_on_turns(product.file) ? std::nullopt : profile::obstacle_to(product.mechanism);
  if (obstacle)
    product.file.warnings.push_back({Severity::warning,
                                     {product.file.path},
                                     "no pulley can have this law: " + obstacle->message,
                                     "'fusee build' lists changes that make it possible"});
  const auto curves = model::joint_curves(declared);
  if (!curves) {
    result.ending = ModelEnding::no_equilibrium;
    return false;
  }
  product.curves = *curves;
  take_compensation(product, options, files);
  demand_countable(product, options.unit);
  return true;
}

/// False if a polynomial or table is not accurate enough; the reason is in `result`.
bool find_fits(ModelResult& result, const ModelOptions& options, const RunContext& context) {
  formats::ModelProduct& product = result.product;
  const model::AngleMap& map = product.curves.physical.middle;
  product.equality = model::fit_equality(map);
  product.line = model::fit_line(map);
  product.tendons = model::tendon_model(product.mechanism, map, product.without_tendons);
  if (product.tendons && product.tendons->error > options.most_error) {
    product.without_tendons =
        "the pulley's polynomial is off by " + rounded(degrees(product.tendons->error), 2) + " deg";
    product.tendons.reset();
  }
  if (!product.tendons) product.notes.push_back("joint_tendons.xml is not written: " + product.without_tendons);
  for (std::size_t i = 0; product.tendons && i < 2; ++i) {
    if (const std::string& why = product.tendons->omission[i]; !why.empty())
      product.notes.push_back("joint_tendons.xml omits tendon " + std::to_string(i + 1) + ": " + why);
  }
  if (options.with_polynomial && !(product.equality.error <= options.most_error)) {
    result.ending = ModelEnding::polynomial_off;
    result.changes = changes_for_polynomial(product, options);
    return false;
  }
  context.begin_step("making tables");
  const auto table =
      model::joint_table(product.curves.sensed, product.mechanism, options.unit, options.most_table_error);
  if (!table) {
    result.ending = ModelEnding::table_off;
    result.changes = changes_for_table(product, options);
    return false;
  }
  product.table = *table;
  return true;
}

void write_files(ModelResult& result) {
  formats::ModelProduct& product = result.product;
  std::vector<OutputFile>& outputs = result.outputs;
  if (product.with_polynomial) outputs.push_back({"joint.xml", formats::mujoco_joint_xml(product)});
  if (product.tendons) outputs.push_back({"joint_tendons.xml", formats::mujoco_tendons_xml(product)});
  outputs.push_back({"joint.urdf", formats::joint_urdf(product)});
  outputs.push_back({"joint_ros2_control.urdf", formats::ros2_control_urdf(product)});
  outputs.push_back({"joint_table.h", formats::joint_table_h(product)});
  outputs.push_back({"joint_table.json", formats::joint_table_json(product)});
  product.checks = formats::check_model(product, outputs);
  outputs.push_back({"manifest.json", formats::model_manifest_json(product, outputs)});
}

}  // namespace

ModelResult model(const MechanismFile& file, const ModelOptions& options, const RunContext& context) {
  ModelResult result;
  formats::ModelProduct& product = result.product;
  product.file = with_plausibility_warnings_and_turns(file);
  if (options.declared) product.file.mechanism.identified = {};
  product.with_polynomial = options.with_polynomial;
  product.most_error = options.most_error;
  product.most_table_error = options.most_table_error;
  product.prefix = options.prefix.empty() ? formats::c_prefix(file.mechanism.name) : options.prefix;
  OutputFolder target(options.folder, options.force, context);
  target.claim(k_model_names);
  context.begin_step("simulating the joint");
  if (!find_curves(result, options, *context.files)) return result;
  context.begin_step("fitting");
  if (!find_fits(result, options, context)) return result;
  context.begin_step("writing and checking");
  write_files(result);
  result.ending = all_ok(product.checks) ? ModelEnding::done : ModelEnding::check_failed;
  if (options.dry_run) return result;
  if (result.ending != ModelEnding::done && target.has_earlier_run() && !options.force) return result;
  for (const OutputFile& output : result.outputs) target.stage(output);
  target.withdraw(k_model_names);
  target.publish(product.file.warnings);
  result.published = true;
  return result;
}

}  // namespace fusee::pipeline
