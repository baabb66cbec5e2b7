// Duration of the steps of a build, and its growth with the number of triangles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "export/mesh_files/mesh_files.h"
#include "export/report/report.h"
#include "fusee/pipeline.h"

namespace {

using namespace fusee;

MechanismFile profile(const std::string& name) {
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (name + ".toml"));
}

const MechanismFile& paper() {
  static const MechanismFile file = profile("paper_optimum");
  return file;
}

const profile::SynthesisResult& paper_synthesis() {
  static const profile::SynthesisResult synthesis = profile::synthesise(paper().mechanism);
  return synthesis;
}

const solid::Pulley& paper_pulley() {
  static const solid::Pulley pulley = solid::make_pulley(paper().mechanism, paper_synthesis());
  return pulley;
}

/// A valid ring of about `triangles` faces, n by n quadrilaterals; coordinates are rounded to floats.
solid::TriangleMesh torus(std::int64_t triangles) {
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
  solid::TriangleMesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = k_two_pi * i / n, v = k_two_pi * j / n, r = 20 + 5 * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), 5 * std::sin(v));
      const std::uint32_t a = i * n + j, b = (i + 1) % n * n + j, c = (i + 1) % n * n + (j + 1) % n,
                          d = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return solid::rounded_to_float(std::move(mesh));
}

void synthesis(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(profile::synthesise(paper().mechanism));
}
BENCHMARK(synthesis)->Unit(benchmark::kMillisecond);

/// Synthesis for joints with drums, attachments, sheaths and a torque law.
void synthesis_of_wide_joint(benchmark::State& state, const char* profile) {
  const MechanismFile file =
      read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / (std::string(profile) + ".toml"));
  for (auto _ : state) benchmark::DoNotOptimize(profile::synthesise(file.mechanism));
}
BENCHMARK_CAPTURE(synthesis_of_wide_joint, finger_pip, "finger_pip")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis_of_wide_joint, ankle_exo, "ankle_exo")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis_of_wide_joint, elbow_idlers, "elbow_idlers")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis_of_wide_joint, wrist_sheath, "wrist_sheath")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(synthesis_of_wide_joint, gravity_arm, "gravity_arm")->Unit(benchmark::kMillisecond);

void body(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(solid::make_pulley(paper().mechanism, paper_synthesis()));
}
BENCHMARK(body)->Unit(benchmark::kMillisecond);

void checks(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        solid::check_pulley(paper_pulley().mesh, paper().mechanism, paper_synthesis(), paper_pulley(), 0.01));
  }
}
BENCHMARK(checks)->Unit(benchmark::kMillisecond);

void rewinding(benchmark::State& state) {
  const pipeline::Part part = paper_pulley().mesh;
  for (auto _ : state) benchmark::DoNotOptimize(pipeline::rewind_part({paper().mechanism, {}}, part));
}
BENCHMARK(rewinding)->Unit(benchmark::kMillisecond);

/// All formats and checks, with files on the disk.
void whole_build(benchmark::State& state) {
  const auto folder = std::filesystem::temp_directory_path() / "fusee-bench";
  pipeline::BuildOptions options;
  options.folder = folder;
  for (auto _ : state) benchmark::DoNotOptimize(pipeline::build(paper(), options));
  std::filesystem::remove_all(folder);
}
BENCHMARK(whole_build)->Unit(benchmark::kMillisecond);

// Joints of the wider class: drums with and without lift-off, idlers, sheaths, a torque law.
void synthesis_of(benchmark::State& state, const std::string& name) {
  const MechanismFile file = profile(name);
  for (auto _ : state) benchmark::DoNotOptimize(profile::synthesise(file.mechanism));
}
void build_of(benchmark::State& state, const std::string& name) {
  const MechanismFile file = profile(name);
  pipeline::BuildOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-bench";
  for (auto _ : state) benchmark::DoNotOptimize(pipeline::build(file, options));
  std::filesystem::remove_all(options.folder);
}

const bool wide_joints = [] {
  for (const char* name : {"finger_mcp", "finger_pip", "ankle_exo", "elbow_idlers", "wrist_sheath", "gravity_arm"}) {
    const auto of = [name](const char* what) { return std::string(what) + "/" + name; };
    benchmark::RegisterBenchmark(of("synthesis").c_str(), synthesis_of, name)->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(of("whole_build").c_str(), build_of, name)->Unit(benchmark::kMillisecond);
  }
  return true;
}();

/// Round pulleys of radius 8 mm, so that only the number of turns varies; the joint's drum grows with it. Guides and ends
/// of the tendons are at the same shares of the drum's radius as in elbow_capstan.
MechanismFile with_turns(double turns) {
  constexpr double k_range_deg = 110, k_radius = 8;
  const double drum = turns * k_radius * 360.0 / k_range_deg;
  const std::string guide_offset = std::to_string(1.45 * drum), end_offset = std::to_string(0.7094 * drum);
  const std::string attachment = "[-" + end_offset + ", " + end_offset + "]";
  return read_mechanism(std::filesystem::path(FUSEE_SOURCE_DIR) / "profiles" / "elbow_capstan.toml",
                        {{"joint.drum_radius_mm", std::to_string(drum)},
                         {"joint.length_mm", std::to_string(drum + 0.3)},  // to the tendons' centre lines
                         {"joint.range_deg", "[-15, 95]"},
                         {"joint.attachment1_mm", attachment},
                         {"joint.attachment2_mm", attachment},
                         {"guides.EB_mm", guide_offset},
                         {"guides.ED_mm", guide_offset},
                         {"guides.OE_mm", guide_offset},
                         {"pulley.r1_mm", std::to_string(k_radius)}});
}

/// Peak memory of this process since the last reset (Linux), MB.
double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1000.0;
  return 0;
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

/// Chord error 0.01 mm, all formats and checks. The aim for ten turns is at most 1 s and 300 MB; nothing here enforces
/// it.
void whole_build_of_turns(benchmark::State& state) {
  const MechanismFile file = with_turns(static_cast<double>(state.range(0)));
  pipeline::BuildOptions options;
  options.folder = std::filesystem::temp_directory_path() / "fusee-bench";
  options.chord_error_mm = 0.01;
  std::size_t triangles = 0;
  forget_peak();
  for (auto _ : state) {
    const pipeline::BuildResult built = pipeline::build(file, options);
    if (built.status != pipeline::BuildStatus::done) state.SkipWithError("not made");
    triangles = built.product.pulley.mesh.triangles.size();
  }
  std::filesystem::remove_all(options.folder);
  state.counters["triangles"] = static_cast<double>(triangles);
  state.counters["peak_MB"] = peak_megabytes();
}
BENCHMARK(whole_build_of_turns)->DenseRange(2, 10, 2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

/// The report with the moving joint.
void page(benchmark::State& state) {
  pipeline::BuildOptions options;
  options.dry_run = true;
  options.folder = "unused";
  const pipeline::BuildResult built = pipeline::build(paper(), options);
  for (auto _ : state) benchmark::DoNotOptimize(formats::report_html(built.product));
}
BENCHMARK(page)->Unit(benchmark::kMillisecond);

// One part with ever smaller facets.
void build_by_tolerance(benchmark::State& state) {
  pipeline::BuildOptions options;
  options.chord_error_mm = 0.01 / static_cast<double>(state.range(0));
  options.dry_run = true;
  options.folder = "unused";
  std::size_t triangles = 0;
  for (auto _ : state) triangles = pipeline::build(paper(), options).product.pulley.mesh.triangles.size();
  state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK(build_by_tolerance)->Arg(1)->Arg(4)->Arg(16)->Unit(benchmark::kMillisecond);

// Growth up to a million triangles, compared with a linear one (RMS of the fit).
void sizes(benchmark::internal::Benchmark* bench) {
  bench->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMillisecond)->Complexity(benchmark::oN);
}

void write_stl(benchmark::State& state) {
  const solid::TriangleMesh mesh = torus(state.range(0));
  std::size_t bytes = 0;
  for (auto _ : state) bytes += formats::stl_bytes(mesh, "torus").size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(write_stl)->Apply(sizes);

/// Reference for the STL writer: a copy of the same bytes.
void copy_stl(benchmark::State& state) {
  const std::string stl = formats::stl_bytes(torus(state.range(0)), "torus");
  for (auto _ : state) {
    std::string copy(stl.size(), '\0');
    std::memcpy(copy.data(), stl.data(), stl.size());
    benchmark::DoNotOptimize(copy.data());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * stl.size()));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(copy_stl)->Apply(sizes);

void read_stl(benchmark::State& state) {
  const std::string stl = formats::stl_bytes(torus(state.range(0)), "torus");
  for (auto _ : state) benchmark::DoNotOptimize(formats::read_mesh(stl, "torus.stl"));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * stl.size()));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(read_stl)->Apply(sizes);

void check_a_mesh(benchmark::State& state) {
  const solid::TriangleMesh mesh = torus(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(solid::check_mesh(mesh));
  state.SetComplexityN(state.range(0));
}
BENCHMARK(check_a_mesh)->Apply(sizes);

}  // namespace
