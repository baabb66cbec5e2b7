// Compares pairs of simulated states whose difference is known. Prints the rates on standard output and one line for
// each pair on standard error.
#include <algorithm>
#include <cstdio>
#include <mutex>

#include "base/text.h"
#include "base/thread_pool.h"
#include "rig/command.h"
#include "rig/judge.h"
#include "rig/state_pairs.h"

namespace fusee::rig {
namespace {

constexpr const char* k_usage =
    "usage: compare_states [--nulls N] [--changes N] [--first N] [--only CAUSE] [--jobs N] ...\n"
    "  --nulls N        pairs of one state (10)\n"
    "  --changes N      pairs with one change, the causes in turn (16)\n"
    "  --first N        seed of the first pair (1)\n"
    "  --only CAUSE     only this cause\n"
    "  --jobs N         pairs at the same time (2)\n"
    "  --most-false P   exit code 4 if a change is reported in more than P % of the pairs of one state\n"
    "  --most-missed P  exit code 4 if more than P % of the changes are in no group\n";

struct PairRequest {
  std::size_t nulls = 10;
  std::size_t changes = 16;
  std::uint64_t first = 1;
  unsigned jobs = 2;
  std::string only;
  double most_false = 100;
  double most_missed = 100;
};

const std::map<std::string, Reader<PairRequest>> k_options = {
    {"--nulls", number_into(&PairRequest::nulls)},
    {"--changes", number_into(&PairRequest::changes)},
    {"--first", number_into(&PairRequest::first)},
    {"--jobs", number_into(&PairRequest::jobs, 1)},
    {"--only", text_into(&PairRequest::only)},
    {"--most-false", number_into(&PairRequest::most_false)},
    {"--most-missed", number_into(&PairRequest::most_missed)}};

struct PairJudgement {
  bool is_null = false;   ///< the pair is of one state
  bool is_right = false;  ///< one state: nothing reported; else: the true cause is in a group
  bool is_alone = false;  ///< the true cause is alone in its group
  bool is_false = false;  ///< a group lacks the true cause
  std::string words;
};

std::string words_of(const StatePair& pair, const calibration::Comparison& comparison) {
  std::string text = pair.change + (pair.common.empty() ? "" : " beside " + pair.common) + ", seen " +
                     rounded(pair.seen, 2) + " times the noise: " + std::string(calibration::word(comparison.verdict));
  for (const calibration::StateChange& change : comparison.found) {
    text += " | by runs " + rounded(change.by_runs, 2) + ":";
    for (const std::string& name : change.group) text += " " + name;
    for (const calibration::ChangedParameter& number : change.parameters)
      text += " " + number.name + " " + rounded(number.change(), 3) + " (" + rounded(number.low, 3) + " ... " +
              rounded(number.high, 3) + ")";
  }
  for (const calibration::FoundEffect& effect : comparison.changes.effects) {
    const auto is_this = [&](const calibration::StateChange& change) { return change.name == effect.name; };
    if (std::any_of(comparison.found.begin(), comparison.found.end(), is_this)) continue;
    text += " | not reported: " + effect.name + ", by runs " + rounded(effect.by_runs, 2) + ", held out " +
            rounded(degrees(effect.rms_drop), 2) + " deg less";
  }
  return text + " | held out " + rounded(degrees(comparison.changes.before.held_out_rms), 4) + ", with the changes " +
         rounded(degrees(comparison.changes.after.held_out_rms), 4) + " deg";
}

PairJudgement judge(const StatePair& pair, const calibration::Comparison& comparison) {
  PairJudgement answer;
  answer.words = words_of(pair, comparison);
  answer.is_null = pair.change == "nothing";
  answer.is_right = answer.is_null && comparison.verdict == calibration::ComparisonVerdict::no_change;
  for (const calibration::StateChange& change : comparison.found) {
    const bool holds = std::find(change.group.begin(), change.group.end(), pair.effect) != change.group.end();
    answer.is_right = answer.is_right || (holds && !answer.is_null);
    answer.is_alone = answer.is_alone || (holds && change.group.size() == 1);
    answer.is_false = answer.is_false || !holds;
  }
  return answer;
}

struct PairJob {
  std::string change;
  std::uint64_t seed = 0;
};

std::vector<PairJob> list_pairs(const PairRequest& request) {
  const std::vector<std::string> causes =
      request.only.empty() ? changes_to_draw() : std::vector<std::string>{request.only};
  std::vector<PairJob> jobs;
  for (std::size_t i = 0; i < request.nulls; ++i) jobs.push_back({"nothing", request.first + i});
  for (std::size_t i = 0; i < request.changes; ++i)
    jobs.push_back({causes[i % causes.size()], request.first + request.nulls + i});
  return jobs;
}

/// Pairs that cannot be drawn are omitted.
std::vector<PairJudgement> run_pairs(const std::vector<PairJob>& jobs, unsigned threads,
                                     const std::filesystem::path& folder) {
  std::vector<PairJudgement> answers;
  std::mutex guard;
  ThreadPool(threads).each(jobs.size(), [&](std::size_t i, std::size_t) {
    std::optional<PairJudgement> answer;
    std::string words;
    try {
      const StatePair pair = make_pair(jobs[i].change, jobs[i].seed, folder / std::to_string(i));
      answer = judge(pair, calibration::compare_states(pair.joint.declared, pair.runs));
      words = (!answer->is_right ? "MISSED " : answer->is_false ? "FALSE " : "") + answer->words;
    } catch (const std::exception& error) {
      words = jobs[i].change + ": left out: " + error.what();
    }
    const std::lock_guard lock(guard);
    if (answer) answers.push_back(*answer);
    std::fprintf(stderr, "%llu %s\n", static_cast<unsigned long long>(jobs[i].seed), words.c_str());
  });
  return answers;
}

Rate rate_of(const std::vector<PairJudgement>& answers, bool null, bool PairJudgement::*is) {
  Rate rate;
  for (const PairJudgement& answer : answers) {
    if (answer.is_null != null) continue;
    ++rate.all;
    rate.part += answer.*is ? 1 : 0;
  }
  return rate;
}

void print(const char* what, const Rate& rate) {
  const Bounds bounds = wilson(rate);
  std::printf("| %s | %zu of %zu | %.0f ... %.0f %% |\n", what, rate.part, rate.all, 100 * bounds.low,
              100 * bounds.high);
}

int run(const std::vector<std::string>& words) {
  const std::optional<PairRequest> request = read_options(words, k_options);
  if (!request) {
    std::fputs(k_usage, stderr);
    return 2;
  }
  const ScratchFolder scratch("compare_states");
  const std::vector<PairJudgement> answers = run_pairs(list_pairs(*request), request->jobs, scratch.path());
  const Rate nulls = rate_of(answers, true, &PairJudgement::is_right);
  const Rate held = rate_of(answers, false, &PairJudgement::is_right);
  print("one state, nothing reported", nulls);
  print("one change, its cause in a reported group", held);
  print("one change, its cause alone in a group", rate_of(answers, false, &PairJudgement::is_alone));
  print("one change, and a group without its cause", rate_of(answers, false, &PairJudgement::is_false));
  const bool is_good = (nulls.all == 0 || 100 * (1 - nulls.share()) <= request->most_false) &&
                       (held.all == 0 || 100 * (1 - held.share()) <= request->most_missed);
  return answers.empty() ? 1 : is_good ? 0 : 4;
}

}  // namespace
}  // namespace fusee::rig

int main(int count, char** words) { return fusee::rig::run_program("compare_states", fusee::rig::run, count, words); }
