#include "pins/runs.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/text.h"
#include "export/report/analysis.h"
#include "export/report/paper.h"
#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fusee/optimize.h"
#include "fusee/pipeline.h"

namespace fusee::pins {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_largest_spec = 1 << 20;
const fs::path k_root = FUSEE_SOURCE_DIR;

using Outputs = std::vector<OutputFile>;

std::vector<fs::path> paths_in(const fs::path& folder, const std::function<bool(const fs::path&)>& wanted) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (wanted(entry.path())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::vector<fs::path> files_in(const fs::path& folder, const std::string& beginning, const std::string& ending) {
  return paths_in(folder, [&](const fs::path& path) {
    return path.extension() == ending && path.filename().string().rfind(beginning, 0) == 0;
  });
}

// ---- one function per command ---------------------------------------------------------------------------------------

/// Only the part for CAD: the other files are pinned without it.
Outputs built_for_cad(const fs::path& spec) {
  pipeline::BuildOptions options;
  options.step = true;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  Outputs outputs = pipeline::build(read_mechanism(spec), options).outputs;
  std::erase_if(outputs, [](const OutputFile& file) { return file.name != "pulley.step"; });
  return outputs;
}

Outputs built(const MechanismFile& file, formats::DxfVersion dxf) {
  pipeline::BuildOptions options;
  options.dxf = dxf;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  return pipeline::build(file, options).outputs;
}

Outputs calibration_outputs(const fs::path& spec, const std::vector<fs::path>& measured) {
  pipeline::CalibrateOptions options;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  return pipeline::calibrate(read_mechanism(spec), measured, options).outputs;
}

/// The pulley of a calibration's corrected.toml.
Outputs built_corrected(const fs::path& spec, const std::vector<fs::path>& measured) {
  const Outputs outputs = calibration_outputs(spec, measured);
  const auto corrected = std::find_if(outputs.begin(), outputs.end(),
                                      [](const OutputFile& file) { return file.name == "corrected.toml"; });
  const fs::path folder = fs::temp_directory_path() / ("fusee-pins-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  MechanismFile file;
  file.path = (folder / corrected->name).string();
  file.sha256 = sha256(corrected->bytes);
  std::ofstream(file.path, std::ios::binary) << corrected->bytes;
  file.mechanism = parse_mechanism(corrected->bytes, file.path, k_root, {}, &file.warnings);
  Outputs part = built(file, formats::DxfVersion::ac1015);
  fs::remove_all(folder);
  return part;
}

/// The new file, and the figures of `fusee optimize` with a fixed number of digits.
Outputs optimum_outputs(const fs::path& spec) {
  const optimize::Problem problem = optimize::make_problem(read_mechanism(spec));
  const optimize::CertifiedResult result = optimize::certified_optimum(problem, problem.objectives.front());
  const std::string figures = "value " + rounded(result.value, 7) + "\ntheta_deg " + rounded(degrees(result.theta), 4) +
                              "\nlower_bound " + rounded(result.lower_bound, 8) + "\nboxes " +
                              std::to_string(result.boxes) + "\nevaluations " + std::to_string(result.evaluations) +
                              "\n";
  return {{"new.toml", edit_values(read_file(spec, k_largest_spec), optimize::edits_of(problem, result.best))},
          {"report.txt", figures}};
}

// ---- inputs ---------------------------------------------------------------------------------------------------------

void add_builds(std::vector<PinnedRun>& all) {
  for (const fs::path& spec : files_in(k_root / "profiles", "", ".toml")) {
    const std::string name = spec.stem().string();
    all.push_back({"build/" + name, [spec] { return built(read_mechanism(spec), formats::DxfVersion::ac1015); }});
    all.push_back({"build_r12/" + name, [spec] { return built(read_mechanism(spec), formats::DxfVersion::r12); }});
  }
}

// One part, two parts with dowels, a horn, several turns.
void add_steps(std::vector<PinnedRun>& all) {
  for (const std::string name : {"paper_optimum", "forearm", "wrist_exo", "elbow_capstan"})
    all.push_back({k_step_runs + name, [name] { return built_for_cad(k_root / "profiles" / (name + ".toml")); }});
}

void add_calibrations(std::vector<PinnedRun>& all) {
  const auto add = [&all](const std::string& name, const fs::path& spec, const std::vector<fs::path>& measured) {
    all.push_back({"calibrate/" + name, [spec, measured] { return calibration_outputs(spec, measured); }});
  };
  for (const fs::path& folder :
       paths_in(k_root / "tests/data/rig", [](const fs::path& path) { return fs::is_directory(path); }))
    add(folder.filename().string(), folder / "spec.toml", files_in(folder, "run_", ".csv"));
  add("forearm", k_root / "profiles/forearm.toml", files_in(k_root / "profiles/measured", "forearm_", ".csv"));
}

void add_analyses(std::vector<PinnedRun>& all) {
  for (const std::string name : {"forearm", "paper_optimum"})
    all.push_back({"analyze/" + name, [name]() -> Outputs {
                     const MechanismFile file = read_mechanism(k_root / "profiles" / (name + ".toml"));
                     const analysis::AnalysisResult result = pipeline::analyze(file);
                     return {{"page.html", formats::analysis_html(file, result, {}, result.warnings)},
                             {"plots.svg", formats::analysis_svg(file, result)}};
                   }});
}

Outputs planned(const fs::path& spec) {
  pipeline::PlanFilesOptions options;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  return pipeline::plan(read_mechanism(spec), options).outputs;
}

Outputs kits(const fs::path& spec, formats::DxfVersion dxf) {
  pipeline::KitOptions options;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  options.dxf = dxf;
  return pipeline::kit(read_mechanism(spec), options).outputs;
}

Outputs modelled(const MechanismFile& file, const model::MotorUnit& unit) {
  pipeline::ModelOptions options;
  options.folder = fs::temp_directory_path() / "fusee-pins";
  options.dry_run = true;
  options.unit = unit;
  return pipeline::model(file, options).outputs;
}

/// A measured run simulated with play, an eccentric encoder and noise; also with the corrected pulley.
Outputs simulated() {
  const fs::path log = k_root / "profiles/measured/forearm_2.csv";
  const MechanismFile file =
      read_mechanism(k_root / "profiles/forearm.toml", {{"identified.backlash_deg", "1"},
                                                        {"identified.pulley_scale_percent", "-1.2"},
                                                        {"identified.joint_eccentricity_sin_deg", "0.5"}});
  pipeline::SimulateOptions options;
  options.noise = radians(0.02);
  const std::string now = formats::simulation_csv(pipeline::simulate(file, log, options).simulation);
  options.corrected = true;
  return {{"now.csv", now},
          {"corrected.csv", formats::simulation_csv(pipeline::simulate(file, log, options).simulation)}};
}

void add_plans(std::vector<PinnedRun>& all) {
  for (const fs::path& spec : files_in(k_root / "profiles", "", ".toml"))
    all.push_back({"plan/" + spec.stem().string(), [spec] { return planned(spec); }});
  for (const fs::path& spec : files_in(k_root / "profiles", "", ".toml")) {
    // One drawing in the old format is enough.
    const formats::DxfVersion dxf =
        spec.stem() == "unsymmetric" ? formats::DxfVersion::r12 : formats::DxfVersion::ac1015;
    all.push_back({"kit/" + spec.stem().string(), [spec, dxf] { return kits(spec, dxf); }});
  }
  all.push_back({"simulate/forearm", simulated});
}

void add_models(std::vector<PinnedRun>& all) {
  for (const fs::path& spec : files_in(k_root / "profiles", "", ".toml"))
    all.push_back({"model/" + spec.stem().string(), [spec] { return modelled(read_mechanism(spec), {}); }});
  // An identified joint, in both directions, in counts.
  all.push_back({"model/identified", [] {
                   const MechanismFile file =
                       read_mechanism(k_root / "profiles/forearm.toml",
                                      {{"identified.backlash_deg", "1"}, {"identified.stretch", "0.2"}});
                   return modelled(file, {-4096, true, 2048});
                 }});
}

/// These calibrations identify a tendon, a pin, and several effects at once.
void add_corrected_builds(std::vector<PinnedRun>& all) {
  for (const std::string name : {"b_stretch", "d_guide_radius"}) {
    const fs::path folder = k_root / "tests/data/rig" / name;
    all.push_back({"build_corrected/" + name,
                   [folder] { return built_corrected(folder / "spec.toml", files_in(folder, "run_", ".csv")); }});
  }
  all.push_back({"build_corrected/forearm", [] {
                   return built_corrected(k_root / "profiles/forearm.toml",
                                          files_in(k_root / "profiles/measured", "forearm_", ".csv"));
                 }});
}

}  // namespace

std::vector<PinnedRun> runs() {
  std::vector<PinnedRun> all;
  add_builds(all);
  add_steps(all);
  add_analyses(all);
  add_calibrations(all);
  add_corrected_builds(all);
  add_plans(all);
  add_models(all);
  all.push_back({"reproduce/paper", [] { return formats::paper_files(paper::reproduce_paper()); }});
  all.push_back({"optimize/paper_optimum", [] { return optimum_outputs(k_root / "profiles/paper_optimum.toml"); }});
  return all;
}

}  // namespace fusee::pins
