/// \file
/// fusee in five functions: the first thing to read.
///
///     MechanismFile   file      = read_mechanism("forearm.toml");             // mechanism/file.h    what the joint is
///     SynthesisResult synthesis = synthesise(file.mechanism);                 // profile/synthesis.h θ(α) → both pitch curves
///     Pulley          pulley    = make_pulley(file.mechanism, synthesis);     // solid/pulley.h      → one checked body
///     RewindResult    as_built  = rewind(file.mechanism, floor1, floor2);     // profile/rewind.h    what it will do
///     BuildResult     built     = build(file, options);                       // all of these, and every file
#pragma once

#include "fusee/export/export.h"

namespace fusee {

struct BuildOptions {
  double tolerance = 0.01;              ///< sagitta of curves, mm
  double theta_error_limit = 0.05;      ///< of the pulley as built, deg
  double slack_limit = 0.05;            ///< mm
  DxfVersion dxf = DxfVersion::ac1015;
  std::filesystem::path folder;         ///< where the files go
  bool force = false;
  bool dry_run = false;                 ///< everything but publishing
};

enum class BuildStatus { done, infeasible, check_failed };

struct BuildResult {
  BuildStatus status = BuildStatus::done;
  Product product;
  std::vector<OutputFile> outputs;  ///< manifest.json last
  bool published = false;
};

/// Mechanism → checked pulley in every format. Infeasible designs and failed checks are values; InputError and OutputError as their names say.
/// A build whose check failed is published only where there is no earlier run to lose, or with `force`.
BuildResult build(const MechanismFile& file, const BuildOptions& options);

/// Winds tendons on the grooves found in a mesh at the heights the mechanism gives them.
RewindResult rewind_mesh(const Mechanism& mechanism, const TriangleMesh& mesh);
/// The same on a drawing's P1_FLOOR and P2_FLOOR (or, without them, the P*_PITCH curves shrunk by d/2).
RewindResult rewind_drawing(const Mechanism& mechanism, const Drawing& drawing);

}  // namespace fusee
