// Pairs of states whose difference is known: compares them, prints the rates on standard output and a line for each
// pair on standard error.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "fusee/base/text.h"
#include "rig/judge.h"
#include "rig/state_pairs.h"

namespace fusee::rig {
namespace {

constexpr const char* k_usage =
    "usage: compare_states [--nulls N] [--changes N] [--first N] [--only CAUSE] [--jobs N] ...\n"
    "  --nulls N        pairs of one state (10)\n"
    "  --changes N      pairs with one change, the causes in turn (16)\n"
    "  --first N        seed of the first of each (1)\n"
    "  --only CAUSE     this cause alone\n"
    "  --jobs N         pairs at work at once (2)\n"
    "  --most-false P   exit code 4 when changes are reported of more than P % of the pairs of one state\n"
    "  --most-missed P  exit code 4 when more than P % of the changes are in no group\n";

struct PairRequest {
  std::size_t nulls = 10;
  std::size_t changes = 16;
  std::uint64_t first = 1;
  std::size_t jobs = 2;
  std::string only;
  double most_false = 100;
  double most_missed = 100;
};

/// A comparison of a pair, judged.
struct PairAnswer {
  bool is_null = false;   ///< the pair is of one state
  bool is_right = false;  ///< nothing of one state; the true cause in a group
  bool is_alone = false;  ///< … of one
  bool is_false = false;  ///< … and a group without the true cause
  std::string words;
};

std::optional<PairRequest> read_request(const std::vector<std::string>& words) {
  PairRequest request;
  if (words.size() % 2 != 0) return std::nullopt;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::string &option = words[i], &value = words[i + 1];
    const auto is_read = [&](auto& number) {
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
      return error == std::errc() && end == value.data() + value.size();
    };
    bool known = true;
    if (option == "--only") {
      request.only = value;
    } else {
      known = option == "--nulls"         ? is_read(request.nulls)
              : option == "--changes"     ? is_read(request.changes)
              : option == "--first"       ? is_read(request.first)
              : option == "--jobs"        ? is_read(request.jobs)
              : option == "--most-false"  ? is_read(request.most_false)
              : option == "--most-missed" ? is_read(request.most_missed)
                                          : false;
    }
    if (!known) return std::nullopt;
  }
  return request;
}

std::string words_of(const StatePair& pair, const Comparison& comparison) {
  std::string text = pair.change + (pair.common.empty() ? "" : " beside " + pair.common) + ", seen " +
                     rounded(pair.seen, 2) + " times the noise: " + std::string(word(comparison.verdict));
  for (const StateChange& change : comparison.found) {
    text += " | by runs " + rounded(change.by_runs, 2) + ":";
    for (const std::string& name : change.group) text += " " + name;
    for (const ChangedParameter& number : change.parameters)
      text += " " + number.name + " " + rounded(number.change(), 3) + " (" + rounded(number.low, 3) + " ... " +
              rounded(number.high, 3) + ")";
  }
  for (const FoundEffect& effect : comparison.changes.effects) {
    const auto is_this = [&](const StateChange& change) { return change.name == effect.name; };
    if (std::any_of(comparison.found.begin(), comparison.found.end(), is_this)) continue;
    text += " | not reported: " + effect.name + ", by runs " + rounded(effect.by_runs, 2) + ", held out " +
            rounded(degrees(effect.rms_drop), 2) + " deg less";
  }
  return text + " | held out " + rounded(degrees(comparison.changes.before.held_out_rms), 4) + ", with the changes " +
         rounded(degrees(comparison.changes.after.held_out_rms), 4) + " deg";
}

PairAnswer judge(const StatePair& pair, const Comparison& comparison) {
  PairAnswer answer;
  answer.words = words_of(pair, comparison);
  answer.is_null = pair.change == "nothing";
  answer.is_right = answer.is_null && comparison.verdict == ComparisonVerdict::no_change;
  for (const StateChange& change : comparison.found) {
    const bool holds = std::find(change.group.begin(), change.group.end(), pair.effect) != change.group.end();
    answer.is_right = answer.is_right || (holds && !answer.is_null);
    answer.is_alone = answer.is_alone || (holds && change.group.size() == 1);
    answer.is_false = answer.is_false || !holds;
  }
  return answer;
}

/// A change and its seed.
struct PairJob {
  std::string change;
  std::uint64_t seed = 0;
};

std::vector<PairJob> pairs_to_do(const PairRequest& request) {
  const std::vector<std::string> causes =
      request.only.empty() ? changes_drawn() : std::vector<std::string>{request.only};
  std::vector<PairJob> jobs;
  for (std::size_t i = 0; i < request.nulls; ++i) jobs.push_back({"nothing", request.first + i});
  for (std::size_t i = 0; i < request.changes; ++i)
    jobs.push_back({causes[i % causes.size()], request.first + request.nulls + i});
  return jobs;
}

/// Pairs that cannot be drawn are left out.
std::vector<PairAnswer> work(const std::vector<PairJob>& jobs, std::size_t at_once,
                             const std::filesystem::path& folder) {
  std::vector<PairAnswer> answers;
  std::atomic<std::size_t> next = 0;
  std::mutex guard;
  const auto one = [&](std::size_t i) {
    std::optional<PairAnswer> answer;
    std::string words;
    try {
      const StatePair pair = make_pair(jobs[i].change, jobs[i].seed, folder / std::to_string(i));
      answer = judge(pair, compare_states(pair.joint.declared, pair.runs));
      words = (!answer->is_right ? "MISSED " : answer->is_false ? "FALSE " : "") + answer->words;
    } catch (const std::exception& error) {
      words = jobs[i].change + ": left out: " + error.what();
    }
    const std::lock_guard lock(guard);
    if (answer) answers.push_back(*answer);
    std::fprintf(stderr, "%llu %s\n", static_cast<unsigned long long>(jobs[i].seed), words.c_str());
  };
  const auto worker = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) one(i);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < at_once; ++i) others.emplace_back(worker);
  worker();
  for (std::thread& other : others) other.join();
  return answers;
}

Rate rate_of(const std::vector<PairAnswer>& answers, bool null, bool PairAnswer::*is) {
  Rate rate;
  for (const PairAnswer& answer : answers) {
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
  const std::optional<PairRequest> request = read_request(words);
  if (!request) {
    std::fputs(k_usage, stderr);
    return 2;
  }
  std::string folder = (std::filesystem::temp_directory_path() / "compare_states_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return 1;
  const std::vector<PairAnswer> answers = work(pairs_to_do(*request), request->jobs, folder);
  std::filesystem::remove_all(folder);
  const Rate nulls = rate_of(answers, true, &PairAnswer::is_right);
  const Rate held = rate_of(answers, false, &PairAnswer::is_right);
  print("one state, nothing reported", nulls);
  print("one change, in a reported group", held);
  print("one change, alone in its group", rate_of(answers, false, &PairAnswer::is_alone));
  print("one change, and a group without it", rate_of(answers, false, &PairAnswer::is_false));
  const bool fine = (nulls.all == 0 || 100 * (1 - nulls.share()) <= request->most_false) &&
                    (held.all == 0 || 100 * (1 - held.share()) <= request->most_missed);
  return answers.empty() ? 1 : fine ? 0 : 4;
}

}  // namespace
}  // namespace fusee::rig

int main(int count, char** words) { return fusee::rig::run({words + 1, words + count}); }
