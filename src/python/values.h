/// \file
/// Converts C++ values to dictionaries for the package's classes, with arrays as read-only views.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/pipeline.h"

namespace fusee::python {

namespace py = pybind11;

/// Text as str; invalid UTF-8 is replaced.
py::str to_str(std::string_view text);
/// A path as str, as by os.fsdecode().
py::str path_to_str(const std::string& path);

py::tuple to_python(const std::vector<std::string>& texts);
py::tuple to_python(const std::vector<Diagnostic>& diagnostics);
py::tuple to_python(const std::vector<profile::Condition>& conditions);
py::tuple to_python(const std::vector<Check>& checks);
py::tuple to_python(const std::vector<profile::Change>& changes);
/// File name → bytes.
py::dict to_python(const std::vector<OutputFile>& files);

/// Arrays of these dictionaries are views of the value, which lives as long as the last of them.
py::dict to_python(std::shared_ptr<const profile::SynthesisResult> result);
py::dict to_python(std::shared_ptr<const pipeline::RewoundPart> result);
py::dict to_python(std::shared_ptr<const pipeline::BuildResult> result);
py::dict to_python(std::shared_ptr<const analysis::AnalysisResult> result);
py::dict to_python(std::shared_ptr<const pipeline::OptimizeResult> result);
py::dict to_python(std::shared_ptr<const pipeline::CalibrateResult> result);
py::dict to_python(std::shared_ptr<const pipeline::CompareResult> result);
py::dict to_python(std::shared_ptr<const pipeline::PlanResult> result);
py::dict to_python(std::shared_ptr<const pipeline::SimulateResult> result);
py::dict to_python(std::shared_ptr<const pipeline::KitResult> result);

}  // namespace fusee::python
