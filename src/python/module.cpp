// The module fusee._core: the verbs with C++ values, without the interpreter's lock while they run. The user interface
// (names, ranges of arguments, classes) is in the package, src/python/fusee.
#include <pybind11/stl.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <map>
#include <stop_token>
#include <tuple>

#include "base/text.h"
#include "fusee/joint.h"
#include "fusee/mechanism_file.h"
#include "fusee/pipeline.h"
#include "python/carried.h"
#include "python/values.h"

namespace fusee::python {
namespace {

// ---- interruption ---------------------------------------------------------------------------------------------------

/// A request to stop a verb, made by the thread that waits for it.
class Stop {
 public:
  void set() { source_.request_stop(); }
  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
};

/// The result of `compute`, without the interpreter's lock. `compute` receives a context with the mechanism's files.
/// `stop` is an unused Stop() for verbs that take too little time to be stopped.
template <typename Compute>
auto computed_unlocked(const CarriedFiles& files, const Stop& stop, Compute compute) {
  using Result = decltype(compute(RunContext()));
  const py::gil_scoped_release released;
  CarriedAccess access(files);
  return std::make_shared<const Result>(compute(RunContext{.stop = stop.token(), .files = &access}));
}

/// Throws InputError for a joint without tendons. `verb`: what would be done with them, such as "wind".
void demand_tendons(const MechanismFile& file, const std::string& verb) {
  if (!file.mechanism.transmission) return;
  throw InputError(file.path, "a joint with [transmission] has no tendons to " + verb,
                   "[transmission] is for calibrate()");
}

// ---- mechanisms -----------------------------------------------------------------------------------------------------

std::vector<Setting> settings_from(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<Setting> settings;
  for (const auto& [key, value] : pairs) settings.push_back({key, value});
  return settings;
}

CarriedMechanism read(const std::string& path, const std::vector<std::pair<std::string, std::string>>& settings,
                      const CarriedFiles& files) {
  const py::gil_scoped_release released;
  return read_carried(path, settings_from(settings), files);
}

/// The number as in the file, without rounding errors of radians.
py::object number(const Field& field, const DeclaredMechanism& mechanism, int end) {
  const double value = fusee::number_of(number_text(field, mechanism, end));
  if (field.whole) return py::int_(static_cast<long long>(value));
  return py::float_(value);
}

/// True for a key that is not written and has no default, or whose optional table is missing.
bool is_undefined(const Field& field, const DeclaredMechanism& mechanism) {
  if (field.is_set == nullptr || field.is_set(mechanism)) return false;
  const auto makes_table_optional = [&field](const Field& other) {
    return other.table == field.table && other.needed_in_table;
  };
  return field.fallback.empty() || std::any_of(fields().begin(), fields().end(), makes_table_optional);
}

/// The value of a key, by its row of the field table.
py::object value_of(const CarriedMechanism& carried, const Field& field) {
  // Access to lists needs a mutable mechanism, so a copy is read.
  DeclaredMechanism mechanism = carried.file.mechanism;
  if (is_undefined(field, mechanism)) return py::none();
  switch (field.kind) {
    case FieldKind::number:
      return number(field, mechanism, 0);
    case FieldKind::point:
    case FieldKind::range:
      return py::make_tuple(number(field, mechanism, 0), number(field, mechanism, 1));
    case FieldKind::choice:
    case FieldKind::text:
      return to_str(field.get_text(mechanism));
    case FieldKind::boolean:
      return py::bool_(field.get_text(mechanism) == "true");
    case FieldKind::numbers:
      return py::tuple(py::cast(field.numbers(mechanism)));
    case FieldKind::texts:
      return to_python(field.texts(mechanism));
  }
  return py::none();
}

py::object value_at(const CarriedMechanism& carried, const std::string& key) {
  const Field* field = find_field(key);
  if (field == nullptr) throw py::key_error(key);
  if (field->table == "transmission" && !carried.file.mechanism.transmission) return py::none();
  return value_of(carried, *field);
}

std::vector<std::string> keys() {
  std::vector<std::string> names;
  for (const Field& field : fields()) names.push_back(field.name());
  return names;
}

py::list settings_of(const CarriedMechanism& carried) {
  py::list list;
  for (const Setting& setting : carried.settings)
    list.append(py::make_tuple(py::bytes(setting.key), py::bytes(setting.value)));
  return list;
}

py::dict files_of(const CarriedMechanism& carried) {
  py::dict dict;
  for (const auto& [path, bytes] : carried.files) dict[py::bytes(path)] = py::bytes(bytes);
  return dict;
}

bool is_same(const CarriedMechanism& a, const CarriedMechanism& b) { return a.file.mechanism == b.file.mechanism; }

// ---- verbs ----------------------------------------------------------------------------------------------------------

py::dict synthesise_joint(const CarriedMechanism& carried, double tolerance, bool advice, int steps) {
  return to_python(computed_unlocked(carried.files, Stop(), [&](const RunContext&) {
    demand_tendons(carried.file, "synthesise for");
    profile::SynthesisOptions options;
    options.chord_error_mm = tolerance;
    options.advice = advice;
    options.stroke_steps = steps;
    return profile::synthesise(joint::identified_joint(carried.file.mechanism).mechanism, options);
  }));
}

pipeline::AsBuiltLimits limits_of(double max_theta_error, double max_excess) { return {max_theta_error, max_excess}; }

/// Rewinds a part. Errors name its file.
pipeline::RewoundPart rewound_part(const joint::IdentifiedJoint& joint, const std::string& path, bool as_is,
                                   FileAccess& files) {
  const pipeline::Part part = pipeline::read_part(path, files);
  try {
    return as_is ? pipeline::RewoundPart{pipeline::rewind_part(joint, part), pipeline::PartPlace::as_made, {}}
                 : pipeline::rewind_moved_part(joint, part);
  } catch (const InputError& error) {
    std::vector<Diagnostic> diagnostics = error.diagnostics();
    for (Diagnostic& diagnostic : diagnostics) diagnostic.place.file = path;
    throw InputError(std::move(diagnostics));
  }
}

py::dict with_checks(const CarriedMechanism& carried, const std::shared_ptr<const pipeline::RewoundPart>& part,
                     const pipeline::AsBuiltLimits& limits) {
  py::dict dict = to_python(part);
  std::vector<Check> checks =
      pipeline::as_built_checks(joint::identified_joint(carried.file.mechanism).mechanism, part->as_built, limits);
  // The first check is that of θ; the others are of the excess length, which is unknown with only one tendon.
  constexpr int k_theta_checks = 1;
  if (part->alone) checks.erase(checks.begin() + k_theta_checks, checks.end());
  dict["checks"] = to_python(checks);
  return dict;
}

py::dict rewind_file(const CarriedMechanism& carried, const std::string& path, bool as_is, double max_theta_error,
                     double max_excess) {
  const auto part = computed_unlocked(carried.files, Stop(), [&](const RunContext& context) {
    demand_tendons(carried.file, "wind");
    return rewound_part(joint::identified_joint(carried.file.mechanism), path, as_is, *context.files);
  });
  return with_checks(carried, part, limits_of(max_theta_error, max_excess));
}

using Floor = py::array_t<double, py::array::c_style | py::array::forcecast>;

Polygon polygon_of(const Floor& floor) {
  Polygon polygon;
  const auto rows = floor.unchecked<2>();
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) polygon.push_back({rows(i, 0), rows(i, 1)});
  return polygon;
}

py::dict rewind_floors(const CarriedMechanism& carried, const Floor& floor1, const Floor& floor2,
                       double max_theta_error, double max_excess) {
  const Polygon p1 = polygon_of(floor1), p2 = polygon_of(floor2);
  const auto part = computed_unlocked(carried.files, Stop(), [&](const RunContext&) {
    demand_tendons(carried.file, "wind");
    return pipeline::RewoundPart{profile::rewind(joint::identified_joint(carried.file.mechanism).mechanism, p1, p2),
                                 pipeline::PartPlace::as_made,
                                 {}};
  });
  return with_checks(carried, part, limits_of(max_theta_error, max_excess));
}

py::dict check_file(const std::string& path) {
  const auto checks = computed_unlocked({}, Stop(), [&](const RunContext& context) {
    return pipeline::check_part(pipeline::read_part(path, *context.files));
  });
  py::dict dict;
  dict["checks"] = to_python(*checks);
  return dict;
}

/// Output folder of the verbs that write files.
struct Target {
  std::string folder;
  bool force = false;
  bool dry_run = false;
};

template <typename Options>
void set_target(Options& options, const Target& target) {
  options.folder = target.folder;
  options.force = target.force;
  options.dry_run = target.dry_run;
}

formats::DxfVersion dxf_version(const std::string& name) {
  return name == "r12" ? formats::DxfVersion::r12 : formats::DxfVersion::ac1015;
}

py::dict build_pulley(const CarriedMechanism& carried, const Target& target, double tolerance, const std::string& dxf,
                      bool step, double max_theta_error, double max_excess, const Stop& stop) {
  return to_python(computed_unlocked(carried.files, stop, [&](const RunContext& context) {
    demand_tendons(carried.file, "build a pulley for");
    pipeline::BuildOptions options;
    set_target(options, target);
    options.chord_error_mm = tolerance;
    options.limits = limits_of(max_theta_error, max_excess);
    options.dxf = dxf_version(dxf);
    options.step = step;
    return pipeline::build(carried.file, options, context);
  }));
}

py::dict analyze_joint(const CarriedMechanism& carried, int steps, double tolerance, int samples, std::uint64_t seed,
                       const Stop& stop) {
  return to_python(computed_unlocked(carried.files, stop, [&](const RunContext& context) {
    analysis::AnalysisOptions options;
    options.steps = steps;
    options.dimension_tolerance = tolerance;
    options.samples = samples;
    options.seed = seed;
    return pipeline::analyze(carried.file, options, context);
  }));
}

py::tuple objective_names() {
  std::vector<std::string> names;
  for (const optimize::ObjectiveInfo& known : optimize::objectives()) names.emplace_back(known.name);
  return to_python(names);
}

/// A second objective requires a search that reports ties: throws InputError for another method.
void require_certified_for_then(const MechanismFile& file, const pipeline::OptimizeOptions& options) {
  if (!options.then || options.method.value_or(pipeline::strongest_method(file)) == pipeline::SearchMethod::certified)
    return;
  throw InputError("then", "requires method \"certified\"");
}

std::optional<pipeline::SearchMethod> search_method(const std::string& name) {
  if (name == "certified") return pipeline::SearchMethod::certified;
  if (name == "genetic") return pipeline::SearchMethod::genetic;
  if (name == "pareto") return pipeline::SearchMethod::pareto;
  return std::nullopt;
}

py::dict optimize_joint(const CarriedMechanism& carried, const std::string& method, const std::string& then,
                        unsigned population, unsigned generations, unsigned seed, unsigned threads, const Stop& stop) {
  return to_python(computed_unlocked(carried.files, stop, [&](const RunContext& context) {
    pipeline::OptimizeOptions options;
    options.method = search_method(method);
    if (!then.empty()) options.then = optimize::find_objective(then);
    options.genetic.population = population;
    options.genetic.generations = generations;
    options.genetic.seed = seed;
    options.genetic.threads = threads;
    // Settings that are not numbers cannot be written into the text: the package applies them to it.
    std::copy_if(carried.settings.begin(), carried.settings.end(), std::back_inserter(options.settings),
                 [](const Setting& setting) { return find_number_key(setting.key).has_value(); });
    options.new_file = carried.file.path;  // not written: only the text is used
    options.dry_run = true;
    require_certified_for_then(carried.file, options);
    pipeline::OptimizeResult result = pipeline::optimize(carried.file, options, context);
    context.throw_if_stopped();
    return result;
  }));
}

std::vector<std::filesystem::path> paths_of(const std::vector<std::string>& names) {
  return {names.begin(), names.end()};
}

/// Options for reading logs by role: columns, units, counts per turn, counts at home, readings at
/// home.
using ReadingOptions =
    std::tuple<std::map<std::string, std::string>, std::map<std::string, std::string>, std::map<std::string, double>,
               std::map<std::string, double>, std::map<std::string, double>>;

measurement::MeasurementOptions measurement_options(const ReadingOptions& reading) {
  measurement::MeasurementOptions options;
  std::tie(options.columns, options.units, options.ticks_per_turn, options.zero_ticks, options.home_readings) = reading;
  return options;
}

py::dict calibrate_joint(const CarriedMechanism& carried, const std::vector<std::string>& runs,
                         const std::vector<std::string>& hold_out, const CarriedFiles& logs,
                         const ReadingOptions& reading, const Target& target, bool audit, const Stop& stop) {
  CarriedFiles files = carried.files;
  files.insert(logs.begin(), logs.end());
  return to_python(computed_unlocked(files, stop, [&](const RunContext& context) {
    pipeline::CalibrateOptions options;
    set_target(options, target);
    options.columns = measurement_options(reading);
    options.hold_out = paths_of(hold_out);
    options.audit = audit;
    return pipeline::calibrate(carried.file, paths_of(runs), options, context);
  }));
}

py::dict compare_joint(const CarriedMechanism& carried, const std::vector<std::string>& before,
                       const std::vector<std::string>& after, const CarriedFiles& logs, const ReadingOptions& reading,
                       const Target& target, const Stop& stop) {
  CarriedFiles files = carried.files;
  files.insert(logs.begin(), logs.end());
  return to_python(computed_unlocked(files, stop, [&](const RunContext& context) {
    pipeline::CompareOptions options;
    set_target(options, target);
    options.columns = measurement_options(reading);
    return pipeline::compare(carried.file, paths_of(before), paths_of(after), options, context);
  }));
}

py::dict plan_bench(const CarriedMechanism& carried, const Target& target, double noise, double minutes,
                    const std::vector<double>& loads, const std::vector<double>& speeds,
                    const std::optional<std::pair<double, double>>& range, std::uint64_t seed, const Stop& stop) {
  return to_python(computed_unlocked(carried.files, stop, [&](const RunContext& context) {
    pipeline::PlanFilesOptions options;
    set_target(options, target);
    options.plan.noise = noise;
    options.plan.minutes = minutes;
    options.plan.loads = loads;
    options.plan.speeds = speeds;
    options.plan.range = range;
    options.plan.seed = seed;
    return pipeline::plan(carried.file, options, context);
  }));
}

py::dict simulate_joint(const CarriedMechanism& carried, const std::string& log, const CarriedFiles& logs,
                        const ReadingOptions& reading, bool corrected, double noise, std::uint64_t seed) {
  CarriedFiles files = carried.files;
  files.insert(logs.begin(), logs.end());
  return to_python(computed_unlocked(files, Stop(), [&](const RunContext& context) {
    pipeline::SimulateOptions options;
    options.columns = measurement_options(reading);
    options.corrected = corrected;
    options.noise = noise;
    options.seed = seed;
    return pipeline::simulate(carried.file, log, options, context);
  }));
}

py::dict kit_parts(const CarriedMechanism& carried, const Target& target, double tolerance, const std::string& dxf,
                   const Stop& stop) {
  return to_python(computed_unlocked(carried.files, stop, [&](const RunContext& context) {
    demand_tendons(carried.file, "make a kit for");
    pipeline::KitOptions options;
    set_target(options, target);
    options.chord_error_mm = tolerance;
    options.dxf = dxf_version(dxf);
    return pipeline::kit(carried.file, options, context);
  }));
}

// ---- failures -------------------------------------------------------------------------------------------------------

void raise(const char* name, const py::tuple& arguments) {
  const py::object type = py::module_::import("fusee._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

void raise_in_python(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    const py::object from = py::module_::import("fusee._errors").attr("diagnostics_from");
    raise("InputError", py::make_tuple(from(to_python(error.diagnostics()))));
  } catch (const OutputError& error) {
    raise("OutputError", py::make_tuple(to_str(error.what()), to_str(error.hint())));
  } catch (const Bug& error) {
    raise("Bug", py::make_tuple(to_str(error.what())));
  } catch (const Stopped&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

template <typename Class>
Class& add_mechanism_methods(Class& type) {
  return type.def("get", value_at)
      .def("settings", settings_of)
      .def("files", files_of)
      .def("same", is_same)
      .def("path", [](const CarriedMechanism& carried) { return path_to_str(carried.file.path); })
      .def("path_bytes", [](const CarriedMechanism& carried) { return py::bytes(carried.file.path); })
      .def("text", [](const CarriedMechanism& carried) { return to_str(carried.files.at(carried.file.path)); })
      .def("every_key", [](const CarriedMechanism& carried) { return to_str(write_mechanism(carried.file.mechanism)); })
      .def("warnings", [](const CarriedMechanism& carried) { return to_python(carried.file.warnings); })
      .def("with_", [](const CarriedMechanism& carried, const std::vector<std::pair<std::string, std::string>>& more) {
        const py::gil_scoped_release released;
        return carried.with(settings_from(more));
      });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  py::register_exception_translator(raise_in_python);
  py::class_<Stop>(module, "Stop").def(py::init<>()).def("set", &Stop::set);
  py::class_<Target>(module, "Target").def(py::init([](std::string folder, bool force, bool dry_run) {
    return Target{std::move(folder), force, dry_run};
  }));
  py::class_<CarriedMechanism> mechanism(module, "CarriedMechanism");
  add_mechanism_methods(mechanism);
  module.attr("version") = FUSEE_VERSION;
  module.def("read", read);
  module.def("keys", keys);
  module.def("new", [](const std::string& name) { return to_str(find_template(name)); });
  module.def("templates", [] {
    std::vector<std::string> names;
    for (const Template& known : templates()) names.emplace_back(known.name);
    return to_python(names);
  });
  module.def("explain", [](const std::string& key) { return to_str(explain_json(key)); });
  module.def("objectives", objective_names);
  module.def("synthesise", synthesise_joint);
  module.def("rewind_file", rewind_file);
  module.def("rewind_floors", rewind_floors);
  module.def("check", check_file);
  module.def("build", build_pulley);
  module.def("analyze", analyze_joint);
  module.def("optimize", optimize_joint);
  module.def("calibrate", calibrate_joint);
  module.def("compare", compare_joint);
  module.def("plan", plan_bench);
  module.def("simulate", simulate_joint);
  module.def("kit", kit_parts);
}

}  // namespace fusee::python
