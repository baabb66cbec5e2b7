#include "base/text.h"
#include "fusee/export.h"

namespace fusee::formats {
namespace {

std::string joints(int count) { return std::to_string(count) + " simulated joints "; }

std::string list_of(const std::vector<std::string>& words, const std::string& between) {
  constexpr std::size_t k_most = 3;
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < k_most; ++i) text += (i > 0 ? between : "") + words[i];
  return words.size() > k_most ? text + between + "and " + std::to_string(words.size() - k_most) + " more" : text;
}

}  // namespace

std::vector<std::string> false_positive_words(const plan::Plan& plan) {
  if (plan.one.samples == 0) return {};
  return {"in " + joints(plan.nothing.samples) + "as declared, these runs would have reported a false cause in " +
              std::to_string(plan.nothing.wrong),
          "in " + joints(plan.one.samples) +
              "with one of these causes in its usual size, they would have identified that cause alone in " +
              std::to_string(plan.one.alone) + ", as one of several in " + std::to_string(plan.one.group) +
              ", and reported a false cause in " + std::to_string(plan.one.wrong),
          "in " + joints(plan.unmodelled.samples) +
              "with a cause outside the catalogue, they would have reported a false cause in " +
              std::to_string(plan.unmodelled.wrong)};
}

std::string gain_words(const plan::PlanStep& step) {
  std::string text;
  if (!step.detects.empty()) text = "detects " + list_of(step.detects, ", ");
  if (!step.resolves.empty())
    text += std::string(text.empty() ? "" : "; ") + "distinguishes " + list_of(step.resolves, "; ");
  return text.empty() ? "reduces the uncertainty of causes that are already distinguished" : text;
}

std::string minute_words(const plan::PlanStep& step, const std::string& gain) {
  return "by minute " + rounded(step.end_minute, 3) + ": " + step.words + "; " + gain;
}

std::vector<std::string> minute_words(const std::vector<plan::PlanStep>& steps) {
  std::vector<std::string> words;
  for (const plan::PlanStep& step : steps) words.push_back(minute_words(step, gain_words(step)));
  return words;
}

}  // namespace fusee::formats
