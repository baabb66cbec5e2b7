#include "python/values.h"

#include <array>
#include <cstdint>
#include <utility>

#include "fusee/base.h"
#include "fusee/export.h"

namespace fusee::python {
namespace {

// ---- arrays ---------------------------------------------------------------------------------------------------------

/// An owner for arrays that are views of the value: it lives as long as the last of them.
py::capsule owner_of(std::shared_ptr<const void> value) {
  return {new std::shared_ptr<const void>(std::move(value)),
          [](void* held) { delete static_cast<std::shared_ptr<const void>*>(held); }};
}

py::array view(const py::capsule& owner, const py::dtype& type, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides, const void* first) {
  static const double no_number = 0;  // address of empty arrays: with a null pointer pybind11 allocates memory
  py::array array(type, std::move(shape), std::move(strides), first != nullptr ? first : &no_number, owner);
  // pybind11 has no public function that makes an array read-only.
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Rows in a value that `owner` keeps alive, `stride` bytes apart.
template <typename Row>
struct Rows {
  const py::capsule& owner;
  const Row* first = nullptr;
  std::size_t count = 0;
  py::ssize_t stride = sizeof(Row);

  /// One member of each row, which has members itself.
  template <typename Part>
  Rows<Part> part(Part Row::*member) const {
    return {owner, first == nullptr ? nullptr : &(first->*member), count, stride};
  }
  /// One number of each row, as an array.
  py::array operator()(double Row::*member) const {
    const double* start = first == nullptr ? nullptr : &(first->*member);
    return view(owner, py::dtype::of<double>(), {static_cast<py::ssize_t>(count)}, {stride}, start);
  }
};

template <typename Row>
Rows<Row> rows_of(const py::capsule& owner, const std::vector<Row>& rows) {
  return {owner, rows.empty() ? nullptr : rows.data(), rows.size(), sizeof(Row)};
}

py::array numbers(const py::capsule& owner, const std::vector<double>& values) {
  return view(owner, py::dtype::of<double>(), {static_cast<py::ssize_t>(values.size())}, {sizeof(double)},
              values.empty() ? nullptr : values.data());
}

/// Points in the plane or in space, one row each. get(row) is the point, whose coordinates follow each other in memory.
template <typename Row, typename Get>
py::array points_of(const py::capsule& owner, const std::vector<Row>& rows, py::ssize_t dimensions, Get get) {
  const double* first = rows.empty() ? nullptr : get(rows.front()).data();
  return view(owner, py::dtype::of<double>(), {static_cast<py::ssize_t>(rows.size()), dimensions},
              {static_cast<py::ssize_t>(sizeof(Row)), static_cast<py::ssize_t>(sizeof(double))}, first);
}

// ---- small values ---------------------------------------------------------------------------------------------------

template <typename Item, typename Convert>
py::tuple tuple_of(const std::vector<Item>& items, Convert convert) {
  py::tuple tuple(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) tuple[i] = convert(items[i]);
  return tuple;
}

py::object number_or_none(const std::optional<double>& value) {
  return value ? py::object(py::float_(*value)) : py::none();
}

std::string_view side_word(transmission::Side side) { return side == transmission::Side::left ? "left" : "right"; }

/// The number, or the word if the value is one.
py::object number_or_word(double number, const std::string& word, bool is_word) {
  return is_word ? py::object(to_str(word)) : py::float_(number);
}

py::dict to_dict(const profile::Change& change) {
  const bool is_word = !change.to_word.empty();
  py::dict dict;
  dict["key"] = to_str(change.key);
  dict["value"] = number_or_word(change.to, change.to_word, is_word);
  dict["was"] = number_or_word(change.from, change.from_word, is_word);
  dict["unit"] = to_str(change.unit);
  dict["text"] = to_str(change.text);
  return dict;
}

py::dict to_dict(const profile::Condition& condition) {
  py::dict dict;
  dict["name"] = to_str(condition.name);
  dict["ok"] = condition.ok;
  dict["alpha_rad"] = condition.alpha;
  dict["value"] = condition.value;
  dict["limit"] = condition.limit;
  dict["unit"] = to_str(condition.unit);
  dict["message"] = to_str(condition.message);
  return dict;
}

py::dict to_dict(const Check& check) {
  py::dict dict;
  dict["name"] = to_str(check.name);
  dict["value"] = check.value;
  dict["limit"] = check.limit;
  dict["unit"] = to_str(check.unit);
  dict["ok"] = check.ok;
  dict["where"] = to_str(check.where);
  return dict;
}

std::string_view severity_word(Severity severity) {
  constexpr std::array<std::string_view, 3> k_words = {"error", "warning", "note"};  // in the order of Severity
  return k_words.at(static_cast<std::size_t>(severity));
}

py::dict to_dict(const Diagnostic& diagnostic) {
  py::dict dict;
  dict["severity"] = to_str(severity_word(diagnostic.severity));
  dict["file"] = path_to_str(diagnostic.place.file);
  dict["line"] = diagnostic.place.line;
  dict["column"] = diagnostic.place.column;
  dict["message"] = to_str(diagnostic.message);
  dict["hint"] = to_str(diagnostic.hint);
  return dict;
}

// ---- parts of results -----------------------------------------------------------------------------------------------

py::dict to_dict(const Rows<transmission::TransmissionPoint>& rows) {
  const Rows<transmission::TendonPoint> t1 = rows.part(&transmission::TransmissionPoint::t1),
                                        t2 = rows.part(&transmission::TransmissionPoint::t2);
  py::dict dict;
  dict["alpha_rad"] = rows(&transmission::TransmissionPoint::alpha);
  dict["theta_rad"] = rows(&transmission::TransmissionPoint::theta);
  dict["dtheta_dalpha"] = rows(&transmission::TransmissionPoint::g);
  dict["r1_mm"] = t1(&transmission::TendonPoint::p);
  dict["r2_mm"] = t2(&transmission::TendonPoint::p);
  dict["m1_mm"] = t1(&transmission::TendonPoint::m);
  dict["m2_mm"] = t2(&transmission::TendonPoint::m);
  dict["wrap1_rad"] = t1(&transmission::TendonPoint::wrap);
  dict["wrap2_rad"] = t2(&transmission::TendonPoint::wrap);
  dict["length1_mm"] = t1(&transmission::TendonPoint::length);
  dict["length2_mm"] = t2(&transmission::TendonPoint::length);
  return dict;
}

py::dict to_dict(const Rows<transmission::PaperForces>& rows) {
  py::dict dict;
  dict["tension1_N"] = rows(&transmission::PaperForces::T1);
  dict["tension2_N"] = rows(&transmission::PaperForces::T2);
  dict["tension_below_pin_N"] = rows(&transmission::PaperForces::Tb);
  dict["elongation_mm"] = rows(&transmission::PaperForces::elongation);
  dict["theta_error_rad"] = rows(&transmission::PaperForces::theta_error);
  dict["motor_torque_Nmm"] = rows(&transmission::PaperForces::motor_torque);
  dict["stiffness_Nmm_per_rad"] = rows(&transmission::PaperForces::stiffness);
  return dict;
}

py::dict to_dict(const Rows<joint::EquilibriumPoint>& rows) {
  const Rows<joint::TendonState> t1 = rows.part(&joint::EquilibriumPoint::t1),
                                 t2 = rows.part(&joint::EquilibriumPoint::t2);
  py::dict dict;
  dict["theta_rad"] = rows(&joint::EquilibriumPoint::theta);
  dict["tension1_N"] = t1(&joint::TendonState::lower);
  dict["tension2_N"] = t2(&joint::TendonState::lower);
  dict["tension1_joint_N"] = t1(&joint::TendonState::upper);
  dict["tension2_joint_N"] = t2(&joint::TendonState::upper);
  dict["slack1_mm"] = t1(&joint::TendonState::slack);
  dict["slack2_mm"] = t2(&joint::TendonState::slack);
  dict["motor_torque_Nmm"] = rows(&joint::EquilibriumPoint::motor_torque);
  dict["load_torque_Nmm"] = rows(&joint::EquilibriumPoint::load_torque);
  dict["stiffness_Nmm_per_rad"] = rows(&joint::EquilibriumPoint::stiffness);
  return dict;
}

py::dict to_dict(const py::capsule& owner, const profile::Outline& outline) {
  const Rows<profile::OutlinePoint> rows = rows_of(owner, outline.points);
  py::dict dict;
  dict["side"] = to_str(side_word(outline.side));
  dict["psi_rad"] = rows(&profile::OutlinePoint::psi);
  dict["position_mm"] = points_of(owner, outline.points, 2,
                                  [](const profile::OutlinePoint& point) -> const Vec2& { return point.position; });
  dict["normal"] = points_of(owner, outline.points, 2,
                             [](const profile::OutlinePoint& point) -> const Vec2& { return point.normal; });
  dict["curvature_radius_mm"] = rows(&profile::OutlinePoint::curvature_radius);
  dict["active_first"] = outline.active_first;
  dict["active_last"] = outline.active_last;
  return dict;
}

py::dict to_dict(const py::capsule& owner, const profile::SynthesisResult& result) {
  py::dict dict;
  dict["made"] = result.made();
  dict["p1"] = to_dict(owner, result.p1);
  dict["p2"] = to_dict(owner, result.p2);
  dict["stroke"] = to_dict(rows_of(owner, result.stroke));
  dict["conditions"] = to_python(result.conditions);
  dict["advice"] = to_python(result.advice);
  dict["warnings"] = to_python(result.warnings);
  dict["brief"] = to_str(result.brief());
  return dict;
}

py::dict to_dict(const py::capsule& owner, const profile::RewindResult& result) {
  const Rows<profile::RewindPoint> rows = rows_of(owner, result.points);
  py::dict dict;
  dict["alpha_rad"] = rows(&profile::RewindPoint::alpha);
  dict["theta_declared_rad"] = rows(&profile::RewindPoint::theta_declared);
  dict["theta_rad"] = rows(&profile::RewindPoint::theta);
  dict["slack_mm"] = rows(&profile::RewindPoint::excess);
  dict["max_theta_error_rad"] = result.max_theta_error;
  dict["max_theta_error_at_rad"] = result.max_theta_error_at;
  dict["max_slack_mm"] = result.max_excess;
  dict["max_slack_at_rad"] = result.max_excess_at;
  return dict;
}

py::dict to_dict(const py::capsule& owner, const solid::TriangleMesh& mesh) {
  py::dict dict;
  dict["vertices_mm"] = points_of(owner, mesh.vertices, 3, [](const Vec3& vertex) -> const Vec3& { return vertex; });
  const std::size_t row = sizeof(std::array<std::uint32_t, 3>);
  dict["triangles"] = view(owner, py::dtype::of<std::uint32_t>(), {static_cast<py::ssize_t>(mesh.triangles.size()), 3},
                           {static_cast<py::ssize_t>(row), static_cast<py::ssize_t>(sizeof(std::uint32_t))},
                           mesh.triangles.empty() ? nullptr : mesh.triangles.data());
  return dict;
}

py::dict to_dict(const analysis::Extreme& extreme) {
  py::dict dict;
  dict["value"] = extreme.value;
  dict["alpha_rad"] = extreme.alpha;
  return dict;
}

py::dict to_dict(const analysis::TensionExtreme& extreme) {
  py::dict dict;
  dict["tension_N"] = extreme.tension;
  dict["alpha_rad"] = extreme.alpha;
  dict["tendon"] = extreme.tendon == transmission::Side::left ? 1 : 2;
  dict["below_pin"] = extreme.below_pin;
  dict["rising"] = extreme.rising;
  return dict;
}

py::tuple to_tuple(const std::vector<analysis::AlphaRange>& ranges) {
  return tuple_of(ranges, [](const analysis::AlphaRange& range) { return py::make_tuple(range.from, range.to); });
}

py::dict to_dict(const analysis::ErrorSource& source) {
  py::dict dict;
  dict["name"] = to_str(source.name);
  dict["meaning"] = to_str(source.meaning);
  dict["least_rad"] = source.least;
  dict["most_rad"] = source.most;
  dict["worst_at_rad"] = source.worst_at;
  return dict;
}

py::dict to_dict(const analysis::ToleranceEffect& effect) {
  py::dict dict;
  dict["key"] = to_str(effect.key);
  dict["theta_by_derivative_rad"] = effect.theta_by_derivative;
  dict["theta_by_monte_carlo_rad"] = effect.theta_by_monte_carlo;
  dict["theta_at_rad"] = effect.theta_at;
  dict["slack_by_derivative_mm"] = effect.excess_by_derivative;
  dict["slack_by_monte_carlo_mm"] = effect.excess_by_monte_carlo;
  dict["slack_at_rad"] = effect.excess_at;
  return dict;
}

py::object to_object(const std::optional<analysis::Strength>& strength) {
  if (!strength) return py::none();
  py::dict dict;
  dict["tension_N"] = strength->tension;
  dict["at_knot_N"] = strength->at_knot;
  dict["source"] = to_str(strength->source);
  return dict;
}

py::object to_object(const std::optional<analysis::MotorCheck>& motor) {
  if (!motor) return py::none();
  const auto positive_or_none = [](double limit) { return limit > 0 ? py::object(py::float_(limit)) : py::none(); };
  py::dict dict;
  dict["model"] = to_str(motor->model);
  dict["enforced"] = motor->enforced;
  dict["ok"] = motor->ok();
  dict["travel_rad"] = motor->travel;
  dict["travel_limit_rad"] = positive_or_none(motor->travel_limit);
  dict["torque_Nmm"] = motor->torque.value;
  dict["torque_at_rad"] = motor->torque.alpha;
  dict["torque_limit_Nmm"] = positive_or_none(motor->torque_limit);
  dict["speed_limit_rad_per_s"] = positive_or_none(motor->speed_limit);
  dict["joint_speed_rad_per_s"] =
      motor->speed_limit > 0 ? py::object(py::float_(motor->joint_speed)) : py::object(py::none());
  dict["joint_speed_needed_rad_per_s"] = positive_or_none(motor->joint_speed_needed);
  dict["sufficient_models"] = tuple_of(motor->sufficient_models, [](const std::string& name) { return to_str(name); });
  dict["advice"] = to_python(motor->advice.alone);
  return dict;
}

py::dict to_dict(const analysis::UnderLoad& load) {
  py::dict dict;
  dict["theta_error_rad"] = to_dict(load.theta_error);
  dict["slack1_rad"] = to_tuple(load.slack1);
  dict["slack2_rad"] = to_tuple(load.slack2);
  dict["taut_pretension_N"] = number_or_none(load.taut_pretension);
  dict["lost_at_rad"] = number_or_none(load.lost_at);
  dict["safety_factor"] = number_or_none(load.safety_factor());
  dict["motor"] = to_object(load.motor);
  return dict;
}

py::tuple knots_of(const solid::Holding& holding) {
  return tuple_of(holding.knots, [&holding](const solid::KnotHold& knot) {
    py::dict dict;
    dict["side"] = to_str(side_word(knot.side));
    dict["alpha_rad"] = knot.alpha;
    dict["wrap_left_rad"] = knot.wrap_left;
    dict["tension_N"] = knot.tension;
    dict["at_knot_N"] = knot.at_knot;
    dict["share"] = number_or_none(holding.share(knot));
    return dict;
  });
}

py::tuple placements_of(const pipeline::RewoundPart& part) {
  return tuple_of(part.placements, [](const solid::Placement& placement) {
    py::dict dict;
    dict["axis_mm"] = py::make_tuple(placement.axis.x(), placement.axis.y());
    dict["turned_rad"] = placement.turn;
    dict["turned_over"] = placement.turned_over;
    dict["deviation_mm"] = placement.deviation;
    return dict;
  });
}

std::string_view place_word(pipeline::PartPlace place) {
  // In the order of PartPlace.
  constexpr std::array<std::string_view, 3> k_words = {"as_made", "found", "not_recognised"};
  return k_words.at(static_cast<std::size_t>(place));
}

// ---- searches -------------------------------------------------------------------------------------------------------

/// The keys that a design changes, ties included: key → value.
py::dict numbers_of(const optimize::Problem& problem, const optimize::Design& design) {
  py::dict dict;
  for (const optimize::MovingKey& moving : problem.moving) dict[to_str(moving.key)] = moving.value(design);
  return dict;
}

py::tuple front_of(const pipeline::OptimizeResult& result) {
  const auto* pareto = std::get_if<optimize::ParetoResult>(&result.search);
  if (pareto == nullptr) return py::tuple();
  return tuple_of(pareto->front, [&result](const optimize::FrontPoint& point) {
    py::dict dict;
    dict["numbers"] = numbers_of(result.problem, point.design);
    dict["values"] = tuple_of(point.values, [](double value) { return py::float_(value); });
    return dict;
  });
}

void add_proof(const pipeline::OptimizeResult& result, py::dict& dict) {
  const auto* certified = std::get_if<optimize::CertifiedResult>(&result.search);
  dict["proven"] = certified != nullptr && certified->proven;
  dict["lower_bound"] = certified != nullptr ? py::object(py::float_(certified->lower_bound)) : py::none();
  dict["relative_gap"] = certified != nullptr ? py::object(py::float_(certified->relative_gap)) : py::none();
}

// ---- runs -----------------------------------------------------------------------------------------------------------

py::tuple residuals_of(const py::capsule& owner, const formats::CalibrationProduct& product) {
  const std::vector<measurement::Run>& runs = product.measurement.runs;
  py::list list;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const calibration::Calibration& calibration = product.calibration;
    if (i >= calibration.residuals_before.size() || i >= calibration.residuals_after.size()) break;
    const Rows<measurement::Sample> rows = rows_of(owner, runs[i].samples);
    py::dict dict;
    dict["name"] = path_to_str(runs[i].name);
    dict["alpha_rad"] = rows(&measurement::Sample::alpha);
    dict["theta_rad"] = rows(&measurement::Sample::theta);
    dict["before_rad"] = numbers(owner, calibration.residuals_before[i]);
    dict["after_rad"] = numbers(owner, calibration.residuals_after[i]);
    list.append(dict);
  }
  return py::tuple(list);
}

py::tuple without_law_conditions(const std::optional<profile::SynthesisResult>& without_law) {
  return to_python(without_law ? without_law->conditions : std::vector<profile::Condition>{});
}

py::tuple without_law_advice(const std::optional<profile::SynthesisResult>& without_law) {
  return to_python(without_law ? without_law->advice : std::vector<profile::Change>{});
}

py::dict step_of(const plan::PlanStep& step, const std::string& file) {
  py::dict dict;
  dict["words"] = to_str(step.words);
  dict["minutes"] = step.minutes;
  dict["by_minutes"] = step.end_minute;
  dict["sees"] = to_python(step.detects);
  dict["tells"] = to_python(step.resolves);
  dict["file"] = to_str(file);
  return dict;
}

}  // namespace

py::str to_str(std::string_view text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

py::str path_to_str(const std::string& path) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeFSDefaultAndSize(path.data(), static_cast<py::ssize_t>(path.size())));
}

py::tuple to_python(const std::vector<std::string>& texts) {
  return tuple_of(texts, [](const std::string& text) { return to_str(text); });
}
py::tuple to_python(const std::vector<Diagnostic>& diagnostics) {
  return tuple_of(diagnostics, [](const Diagnostic& diagnostic) { return to_dict(diagnostic); });
}
py::tuple to_python(const std::vector<profile::Condition>& conditions) {
  return tuple_of(conditions, [](const profile::Condition& condition) { return to_dict(condition); });
}
py::tuple to_python(const std::vector<Check>& checks) {
  return tuple_of(checks, [](const Check& check) { return to_dict(check); });
}
py::tuple to_python(const std::vector<profile::Change>& changes) {
  return tuple_of(changes, [](const profile::Change& change) { return to_dict(change); });
}
py::dict to_python(const std::vector<OutputFile>& files) {
  py::dict dict;
  for (const OutputFile& file : files) dict[to_str(file.name)] = py::bytes(file.bytes);
  return dict;
}

py::dict to_python(std::shared_ptr<const profile::SynthesisResult> result) {
  return to_dict(owner_of(result), *result);
}

py::dict to_python(std::shared_ptr<const pipeline::RewoundPart> result) {
  py::dict dict = to_dict(owner_of(result), result->as_built);
  dict["place"] = to_str(place_word(result->place));
  dict["alone"] = result->alone ? py::object(to_str(side_word(*result->alone))) : py::none();
  dict["placements"] = placements_of(*result);
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::BuildResult> result) {
  // In the order of BuildStatus.
  constexpr std::array<std::string_view, 3> k_status = {"done", "infeasible", "check_failed"};
  const formats::Product& product = result->product;
  const py::capsule owner = owner_of(result);
  py::dict dict;
  dict["status"] = to_str(k_status.at(static_cast<std::size_t>(result->status)));
  dict["synthesis"] = to_dict(owner, product.synthesis);
  dict["mesh"] = to_dict(owner, product.pulley.mesh);
  dict["as_built"] = to_dict(owner, product.as_built);
  dict["under_load"] =
      product.under_load.rows.empty() ? py::object(py::none()) : py::object(to_dict(product.under_load));
  dict["checks"] = to_python(product.checks);
  dict["conditions"] = to_python(product.synthesis.made() ? product.pulley.conditions : product.synthesis.conditions);
  dict["advice"] = to_python(result->advice.alone);
  dict["advice_together"] = to_python(result->advice.together);
  dict["knots"] = knots_of(product.holding);
  dict["files"] = to_python(result->outputs);
  dict["warnings"] = to_python(product.file.warnings);
  dict["holding_warnings"] = to_python(product.holding.warnings);
  dict["notes"] = to_python(product.pulley.layout.notes);
  dict["published"] = result->published;
  return dict;
}

py::dict to_python(std::shared_ptr<const analysis::AnalysisResult> result) {
  const py::capsule owner = owner_of(result);
  const Rows<analysis::AnalysisRow> rows = rows_of(owner, result->rows);
  py::dict dict;
  dict["exists"] = result->exists;
  dict["declared"] = to_dict(rows.part(&analysis::AnalysisRow::declared));
  dict["paper"] = to_dict(rows.part(&analysis::AnalysisRow::paper));
  dict["rising"] = to_dict(rows.part(&analysis::AnalysisRow::rising));
  dict["falling"] = to_dict(rows.part(&analysis::AnalysisRow::falling));
  dict["conditions"] = to_python(result->obstacles);
  dict["advice"] = to_python(result->advice);
  dict["largest_tension"] = to_dict(result->largest_tension);
  dict["largest_at_joint_N"] = to_dict(result->largest_at_joint);
  dict["largest_paper_tension_N"] = to_dict(result->largest_paper_tension);
  dict["largest_torque_Nmm"] = to_dict(result->largest_torque);
  dict["hysteresis_rad"] = to_dict(result->hysteresis);
  dict["theta_error_rad"] = to_dict(result->theta_error);
  dict["slack1_rad"] = to_tuple(result->slack1);
  dict["slack2_rad"] = to_tuple(result->slack2);
  dict["untensioned_rad"] = to_tuple(result->untensioned);
  dict["taut_pretension_N"] = number_or_none(result->taut_pretension);
  dict["lost_at_rad"] = number_or_none(result->lost_at);
  dict["strength"] = to_object(result->strength);
  dict["breaks_at_rad"] = number_or_none(result->breaks_at);
  dict["safety_factor"] = number_or_none(result->safety_factor());
  dict["motor"] = to_object(result->motor);
  dict["sources"] = tuple_of(result->sources, [](const analysis::ErrorSource& source) { return to_dict(source); });
  dict["tolerances"] =
      tuple_of(result->tolerances, [](const analysis::ToleranceEffect& effect) { return to_dict(effect); });
  dict["warnings"] = to_python(result->warnings);
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::OptimizeResult> result) {
  // In the order of SearchMethod.
  constexpr std::array<std::string_view, 3> k_methods = {"certified", "genetic", "pareto"};
  py::list objectives;
  for (const optimize::Objective objective : result->problem.objectives)
    objectives.append(py::make_tuple(to_str(optimize::info(objective).name), to_str(optimize::info(objective).unit)));
  py::dict dict;
  dict["method"] = to_str(k_methods.at(static_cast<std::size_t>(result->method())));
  dict["objectives"] = py::tuple(objectives);
  dict["found"] = result->found;
  dict["stopped"] = result->stopped;
  dict["reason"] = to_str(result->reason);
  dict["numbers"] = result->found ? numbers_of(result->problem, result->design) : py::dict();
  dict["value"] = result->found ? py::object(py::float_(result->value)) : py::none();
  dict["before"] = result->before.possible ? py::object(py::float_(result->before.value)) : py::none();
  add_proof(*result, dict);
  dict["front"] = front_of(*result);
  dict["text"] = to_str(result->new_text);
  dict["warnings"] = to_python(result->warnings);
  return dict;
}

py::tuple notes_of(const measurement::Measurement& measurement) {
  std::vector<std::string> notes = measurement.sources;
  notes.insert(notes.end(), measurement.notes.begin(), measurement.notes.end());
  return to_python(notes);
}

py::dict to_python(std::shared_ptr<const pipeline::CalibrateResult> result) {
  py::dict dict;
  dict["document"] = to_str(formats::calibration_json(result->product));
  dict["residuals"] = residuals_of(owner_of(result), result->product);
  dict["notes"] = notes_of(result->product.measurement);
  dict["warnings"] = to_python(result->product.file.warnings);
  dict["summary"] = to_str(result->product.calibration.summary);
  dict["files"] = to_python(result->outputs);
  dict["published"] = result->published;
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::CompareResult> result) {
  py::dict dict;
  dict["document"] = to_str(formats::comparison_json(result->product));
  dict["notes"] = notes_of(result->product.measurement);
  dict["warnings"] = to_python(result->product.file.warnings);
  dict["files"] = to_python(result->outputs);
  dict["published"] = result->published;
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::PlanResult> result) {
  const plan::Plan& plan = result->product.plan;
  py::list steps;
  for (std::size_t i = 0; i < plan.steps.size(); ++i)
    steps.append(step_of(plan.steps[i], formats::run_file_name(plan, i)));
  py::dict dict;
  dict["exists"] = !result->without_law;
  dict["conditions"] = without_law_conditions(result->without_law);
  dict["advice"] = without_law_advice(result->without_law);
  dict["steps"] = py::tuple(steps);
  dict["beyond"] = tuple_of(plan.beyond, [](const plan::PlanStep& step) { return step_of(step, ""); });
  dict["minutes"] = plan.minutes;
  dict["groups"] = tuple_of(plan.groups, [](const std::vector<std::string>& group) { return to_python(group); });
  dict["document"] = to_str(result->without_law ? "" : formats::plan_json(result->product));
  dict["warnings"] = to_python(result->product.file.warnings);
  dict["files"] = to_python(result->outputs);
  dict["published"] = result->published;
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::SimulateResult> result) {
  const formats::Simulation& simulation = result->simulation;
  py::dict columns;
  py::list status;
  if (!result->without_law) {
    const auto table =
        std::make_shared<const std::vector<formats::SimulationColumn>>(formats::simulation_columns(simulation));
    const py::capsule owner = owner_of(table);
    for (const formats::SimulationColumn& column : *table) columns[to_str(column.name)] = numbers(owner, column.values);
    for (const joint::JointState& state : simulation.states) status.append(to_str(formats::word(state.status)));
  }
  py::dict dict;
  dict["exists"] = !result->without_law;
  dict["conditions"] = without_law_conditions(result->without_law);
  dict["advice"] = without_law_advice(result->without_law);
  dict["columns"] = columns;
  dict["status"] = py::tuple(status);
  dict["notes"] = notes_of(simulation.log);
  dict["warnings"] = to_python(simulation.file.warnings);
  dict["csv"] = to_str(result->without_law ? "" : formats::simulation_csv(simulation));
  return dict;
}

py::dict to_python(std::shared_ptr<const pipeline::KitResult> result) {
  // In the order of KitEnding.
  constexpr std::array<std::string_view, 4> k_status = {"done", "no_pulley", "no_kit", "check_failed"};
  const formats::Product& pulley = result->product.pulley;
  const std::vector<profile::Condition>& pulley_conditions =
      pulley.synthesis.made() ? pulley.pulley.conditions : pulley.synthesis.conditions;
  py::dict dict;
  dict["status"] = to_str(k_status.at(static_cast<std::size_t>(result->ending)));
  dict["conditions"] =
      to_python(result->ending == pipeline::KitEnding::no_pulley ? pulley_conditions : result->product.plan.conditions);
  dict["advice"] = to_python(result->advice.alone);
  dict["advice_together"] = to_python(result->advice.together);
  dict["checks"] = to_python(result->product.checks);
  dict["notes"] = to_python(result->product.plan.notes);
  dict["warnings"] = to_python(pulley.file.warnings);
  dict["files"] = to_python(result->outputs);
  dict["published"] = result->published;
  return dict;
}

}  // namespace fusee::python
