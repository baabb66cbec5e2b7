// next/ of a calibration: the measurements to make next, as a plan for the bench.

#include <algorithm>
#include <regex>

#include "fusee/export.h"

namespace fusee::formats {
namespace {

const char* const k_folder = "next/";
const char* const k_page = "next/bench.html";

std::vector<std::string> names_of(const std::vector<measurement::Run>& runs) {
  std::vector<std::string> names;
  for (const measurement::Run& run : runs) names.push_back(run.name);
  return names;
}

plan::PlanStep step_of(const plan::NextMeasurement& next, double minutes_before) {
  plan::PlanStep step;
  step.run = next.run;
  if (!next.readings.empty()) step.reading = next.readings.front();
  step.words = next.words;
  step.minutes = next.minutes;
  step.end_minute = minutes_before + next.minutes;
  if (!next.gain.empty()) step.resolves = {next.gain};
  return step;
}

PlanProduct next_plan(const CalibrationProduct& product) {
  PlanProduct next;
  next.file = product.file;
  next.plan.first_run = first_free_run(names_of(product.measurement.runs));
  next.plan.load_unit = product.file.mechanism.transmission ? product.measurement.load_unit : "N";
  for (const plan::NextMeasurement& one : product.calibration.next) {
    next.plan.steps.push_back(step_of(one, next.plan.minutes));
    next.plan.minutes = next.plan.steps.back().end_minute;
  }
  return next;
}

}  // namespace

int first_free_run(const std::vector<std::string>& names) {
  static const std::regex numbered(R"(run_(\d{1,6})\.csv)");
  int first = 1;
  for (const std::string& name : names) {
    std::smatch part;
    if (std::regex_match(name, part, numbered)) first = std::max(first, std::stoi(part[1]) + 1);
  }
  return first;
}

std::string next_file_name(const CalibrationProduct& product, std::size_t i) {
  const std::string name = run_file_name(next_plan(product).plan, i);
  return name.empty() ? "" : k_folder + name;
}

std::vector<std::string> next_file_names(int first_run, int runs) {
  std::vector<std::string> names = {k_page};
  for (int i = 0; i < runs; ++i) names.push_back(k_folder + ("run_" + std::to_string(first_run + i)) + ".csv");
  return names;
}

std::vector<OutputFile> next_files(const CalibrationProduct& product) {
  const PlanProduct next = next_plan(product);
  if (next.plan.steps.empty()) return {};
  std::vector<OutputFile> files = {{k_page, next_html(next, names_of(product.measurement.runs))}};
  for (std::size_t i = 0; i < next.plan.steps.size(); ++i) {
    if (next.plan.steps[i].run) files.push_back({k_folder + run_file_name(next.plan, i), run_csv(next, i)});
  }
  return files;
}

}  // namespace fusee::formats
