#include "fusee/base/text.h"
#include "fusee/export/plan.h"

namespace fusee {
namespace {

std::string joints(int count) { return std::to_string(count) + " simulated joints "; }

std::string list_of(const std::vector<std::string>& words, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) text += (i > 0 ? "; " : "") + words[i];
  return words.size() > most ? text + "; and " + std::to_string(words.size() - most) + " more" : text;
}

}  // namespace

std::vector<std::string> blame_words(const Plan& plan) {
  if (plan.one.worlds == 0) return {};
  return {"in " + joints(plan.nothing.worlds) + "as declared, these runs would have blamed something in " +
              std::to_string(plan.nothing.blamed),
          "in " + joints(plan.one.worlds) +
              "with one of these causes, of its usual sizes, they would have named it alone in " +
              std::to_string(plan.one.alone) + ", in a group in " + std::to_string(plan.one.group) +
              ", and blamed something else in " + std::to_string(plan.one.blamed),
          "in " + joints(plan.unknown.worlds) +
              "with a cause that the catalogue is without, they would have blamed something else in " +
              std::to_string(plan.unknown.blamed)};
}

std::vector<std::string> minute_words(const std::vector<PlanStep>& steps) {
  constexpr std::size_t k_most_pairs = 3;
  std::vector<std::string> words;
  for (const PlanStep& step : steps) {
    std::string text = "by minute " + rounded(step.by, 3) + ": " + step.words;
    if (!step.buys.empty()) text += "; it tells " + list_of(step.buys, k_most_pairs);
    words.push_back(std::move(text));
  }
  return words;
}

}  // namespace fusee
