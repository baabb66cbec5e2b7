// Calibrates simulated joints whose faults are known and prints how often the faults were found. Tables go to standard
// output as Markdown, one line for each joint to standard error.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <utility>

#include "base/thread_pool.h"
#include "fusee/mechanism_file.h"
#include "rig/command.h"
#include "rig/judge.h"
#include "rig/sharpness.h"
#include "rig/truths.h"

namespace fusee::rig {
namespace {

constexpr const char* k_usage =
    R"(usage: known_truth [--seeds N] [--only NAME]... [--protocol full|single|random] [--data-to DIR] ...
       known_truth --joints N [--split NAME] [--kinds NAME]... [--protocol full|single|random] ...
       known_truth --leave-out NAME|all [--seeds N] ...
  --seeds N         joints per truth (3)
  --first N         seed of the first joint (1)
  --only NAME       only this truth: "nothing", or faults: "tendon_stretch", "backlash + sensor_lag" ...
  --joints N        random joints instead, each of --kinds in turn
  --kinds NAME      only these: nothing; one, two, three (named faults); unknown (an unmodelled fault); beside (a named
                    and an unmodelled fault)
  --split NAME      unmodelled faults are drawn from tuning (the default), regression, or a held-out set: heldout_13
  --leave-out NAME  joints with this effect, calibrated with a catalogue that lacks it; all: each effect in turn
  --protocol NAME   full: five runs; single: one unloaded run; random: any (full; random with --joints)
  --any-groove      friction of the groove is 0.05 to 0.5 while the file says 0.2 (always with --joints)
  --follow N        makes the first measurement that calibration asks for and calibrates again, up to N times
  --data-to DIR     keeps the files of each joint in a folder there: spec.toml, runs, case.json with truth and answer,
                    and slopes.csv, the derivatives of the catalogue (tests/bench/baselines.py); not with --leave-out
  --no-calibration  makes the data only
  --jobs N          joints at the same time (2)
  --most-missed P   exit code 4 if more than P % of the named faults are missed
  --most-lost P     exit code 4 if more than P % of the named faults beside an unmodelled one are in no group
  --most-false P    exit code 4 if more than P % of the joints, modelled or not, have a false positive
  --most-false-groups P  exit code 4 if more than P % of the joints, modelled or not, have a group without a true cause,
                    including groups with "unmodelled"
  --joint FILE      this joint without its [load] instead of a random one: faults of its drum, attachments, idlers
  --list            prints the truths
)";

constexpr const char* k_size_words =
    "Each fault changes the reading by 3 to 15 times the sensor's noise, rms over all rows.\n";
constexpr const char* k_usual_words =
    "Noise 0.02 deg. Every fourth sensor has correlated noise, every fourth a resolution of 0.04 deg.\n";

/// A protocol's name and its description below the tables.
struct ProtocolWords {
  Protocol protocol;
  const char* name;
  const char* text;
};
constexpr ProtocolWords k_protocols[] = {
    {Protocol::full, "full",
     "Five runs a joint: no load, a load, no load and fast, half the load, the load reversed.\n"},
    {Protocol::single, "single", "One unloaded run of two cycles a joint.\n"},
    {Protocol::random, "random",
     "Two to seven runs a joint: strokes, staircases of loads at dwells, points at both ends in turn, loads that "
     "change within a run.\nSpeeds of 5 to 120 deg/s, noise of 0.005 to 0.05 deg.\n"},
};
constexpr std::pair<const char*, Kind> k_kinds[] = {
    {"nothing", Kind::nothing}, {"one", Kind::one},         {"two", Kind::two},
    {"three", Kind::three},     {"unknown", Kind::unknown}, {"beside", Kind::beside},
};

struct Request {
  std::uint64_t seeds = 3;
  std::uint64_t first = 1;
  std::uint64_t joints = 0;  ///< drawn at random; 0: the truths in turn
  std::vector<std::string> only;
  std::vector<std::string> kinds;
  std::string split = "tuning";
  std::optional<MadeJoint> joint;
  std::string leave_out;
  std::optional<Protocol> protocol;
  bool any_groove = false;
  std::size_t follow = 0;
  std::string data_to;
  bool no_calibration = false;
  bool list = false;
  unsigned jobs = 2;
  double most_missed = 100;  ///< %
  double most_lost = 100;
  double most_false = 100;
  double most_false_groups = 100;
};

std::optional<Kind> kind_of(const std::string& name) {
  for (const auto& [known, kind] : k_kinds) {
    if (name == known) return kind;
  }
  return std::nullopt;
}

Protocol protocol_of(const Request& request) {
  return request.protocol.value_or(request.joints > 0 ? Protocol::random : Protocol::full);
}

bool read_kind(Request& request, const std::string& text) {
  request.kinds.push_back(text);
  return kind_of(text).has_value();
}
bool read_protocol(Request& request, const std::string& text) {
  for (const ProtocolWords& known : k_protocols) {
    if (text == known.name) request.protocol = known.protocol;
  }
  return request.protocol.has_value();
}
bool read_joint(Request& request, const std::string& text) {
  DeclaredMechanism declared = read_mechanism(text).mechanism;
  declared.load = {};
  request.joint = make_joint(declared);
  return true;
}

const std::map<std::string, bool Request::*> k_flags = {
    {"--any-groove", &Request::any_groove}, {"--no-calibration", &Request::no_calibration}, {"--list", &Request::list}};
// clang-format off
const std::map<std::string, Reader<Request>> k_options = {
    {"--seeds", number_into(&Request::seeds, 1)}, {"--first", number_into(&Request::first)},
    {"--joints", number_into(&Request::joints)}, {"--jobs", number_into(&Request::jobs, 1)},
    {"--follow", number_into(&Request::follow)}, {"--most-missed", number_into(&Request::most_missed)},
    {"--most-lost", number_into(&Request::most_lost)}, {"--most-false", number_into(&Request::most_false)},
    {"--most-false-groups", number_into(&Request::most_false_groups)}, {"--only", texts_into(&Request::only)},
    {"--split", text_into(&Request::split)}, {"--leave-out", text_into(&Request::leave_out)},
    {"--data-to", text_into(&Request::data_to)}, {"--kinds", read_kind}, {"--protocol", read_protocol}, {"--joint", read_joint}};
// clang-format on

/// InputError for an unknown fault.
std::vector<Truth> truths_of(const Request& request) {
  if (request.only.empty()) return request.joint ? wide_truths(*request.joint) : all_truths();
  std::vector<Truth> chosen;
  for (const std::string& name : request.only) chosen.push_back(truth_of(name));
  return chosen;
}

/// One joint to draw.
struct Job {
  Truth truth;
  std::uint64_t seed = 0;
  std::vector<std::string> without = {};
  std::string row = {};  ///< label in the matrix; empty: the truth's name
};

std::vector<Job> drawn_jobs(const Request& request) {
  std::vector<std::string> kinds = request.kinds;
  if (kinds.empty()) {
    for (const auto& [name, kind] : k_kinds) kinds.emplace_back(name);
  }
  std::vector<Job> jobs;
  for (std::uint64_t i = 0; i < request.joints; ++i) {
    const std::string& kind = kinds[i % kinds.size()];
    const std::uint64_t seed = request.first + i;
    jobs.push_back({random_truth(*kind_of(kind), request.split, seed), seed, {}, kind});
  }
  return jobs;
}

std::vector<Job> left_out_jobs(const Request& request) {
  const std::vector<std::string> effects =
      request.leave_out == "all" ? names_in("named") : std::vector<std::string>{find_fault(request.leave_out).name};
  std::vector<Job> jobs;
  for (const std::string& effect : effects) {
    for (std::uint64_t i = 0; i < request.seeds; ++i)
      jobs.push_back({{effect, {effect}}, request.first + i, {effect}, effect + ", left out"});
  }
  return jobs;
}

std::vector<Job> jobs_of(const Request& request) {
  if (request.joints > 0) return drawn_jobs(request);
  if (!request.leave_out.empty()) return left_out_jobs(request);
  std::vector<Job> jobs;
  for (const Truth& truth : truths_of(request)) {
    for (std::uint64_t i = 0; i < request.seeds; ++i) jobs.push_back({truth, request.first + i});
  }
  return jobs;
}

std::string folder_name(const Job& job) {
  std::string name = job.truth.name + "_" + std::to_string(job.seed);
  std::erase(name, ' ');
  return name;
}

/// Judgements of one joint: of the first calibration, and after each further measurement.
struct JudgementSequence {
  std::vector<Judgement> judgements;
  Sharpness sharpness;  ///< of the last answer
};

/// Calibrates the files in `folder`, judges the answer, and writes the files for other methods if requested.
Answer calibrate_and_judge(const Case& made, const Job& job, const Request& request,
                           const std::filesystem::path& folder, JudgementSequence& all) {
  const std::clock_t start = std::clock();
  Answer answer = calibrate_case(made, folder, job.without);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (!job.row.empty()) answer.judgement.truth = job.row;
  all.judgements.push_back(answer.judgement);
  all.sharpness = sharpness_of(made, read_case(made, folder), answer);
  if (!request.data_to.empty()) {
    const TimedAnswer timed{answer.found, seconds};
    write_case_data(made, answer.judgement.truth, &timed, folder);
  }
  return answer;
}

/// Makes the first measurement that the rig can make. False if it can make none.
bool perform_first(const std::vector<plan::NextMeasurement>& asked, Case& made, std::string& words) {
  for (const plan::NextMeasurement& next : asked) {
    if (!perform(next, made)) continue;
    words += "\n    " + std::string(next.kind()) + ": " + next.text();
    return true;
  }
  return false;
}

JudgementSequence calibrate_and_follow(Case made, const Job& job, const Request& request,
                                       const std::filesystem::path& folder, std::string& words) {
  JudgementSequence all;
  Answer answer = calibrate_and_judge(made, job, request, folder, all);
  words = all.judgements.back().words;
  while (all.judgements.size() <= request.follow && perform_first(answer.found.next, made, words)) {
    answer = calibrate_and_judge(made, job, request, folder, all);
    words += "\n    " + all.judgements.back().words;
  }
  return all;
}

/// Answers in the order of the jobs. Joints that cannot be drawn are omitted.
std::vector<JudgementSequence> run_jobs(const std::vector<Job>& jobs, const Request& request,
                                        const std::filesystem::path& folder) {
  std::vector<JudgementSequence> answers(jobs.size());
  std::size_t done = 0;
  std::mutex console;
  ThreadPool(request.jobs).each(jobs.size(), [&](std::size_t i, std::size_t) {
    std::string words = folder_name(jobs[i]);
    try {
      const CaseOptions options{protocol_of(request), request.any_groove || request.joints > 0,
                                request.joint ? &*request.joint : nullptr};
      const Case made = make_case(jobs[i].truth, jobs[i].seed, options);
      if (request.no_calibration) {
        write_case(made, folder / folder_name(jobs[i]));
        write_case_data(made, jobs[i].row.empty() ? jobs[i].truth.name : jobs[i].row, nullptr,
                        folder / folder_name(jobs[i]));
        words = folder_name(jobs[i]);
      } else {
        answers[i] = calibrate_and_follow(made, jobs[i], request, folder / folder_name(jobs[i]), words);
      }
    } catch (const std::exception& error) {
      words = folder_name(jobs[i]) + ": left out: " + error.what();
    }
    const std::lock_guard lock(console);
    std::fprintf(stderr, "[%zu/%zu] %s\n", ++done, jobs.size(), words.c_str());
  });
  std::erase_if(answers, [](const JudgementSequence& answer) { return answer.judgements.empty(); });
  return answers;
}

int print_truths(const Request& request) {
  for (const Truth& truth : request.joint ? wide_truths(*request.joint) : all_truths())
    std::printf("%s\n", truth.name.c_str());
  return 0;
}

/// Judgements after at most so many further measurements.
std::vector<Judgement> judgements_after(const std::vector<JudgementSequence>& all, std::size_t measurements) {
  std::vector<Judgement> judgements;
  for (const JudgementSequence& one : all)
    judgements.push_back(one.judgements[std::min(measurements, one.judgements.size() - 1)]);
  return judgements;
}

std::string follow_table(const std::vector<JudgementSequence>& all, std::size_t follow) {
  std::string text =
      "| further measurements | joints that made them | named faults alone | of | in a group | false and alone |\n"
      "|--:|--:|--:|--:|--:|--:|\n";
  for (std::size_t n = 0; n <= follow; ++n) {
    std::size_t made = 0, alone = 0, named = 0, held = 0, wrong = 0;
    for (const JudgementSequence& one : all) made += one.judgements.size() > n ? 1 : 0;
    for (const Judgement& one : judgements_after(all, n)) {
      alone += one.alone;
      named += one.named;
      held += one.held;
      wrong += one.wrong_alone > 0 ? 1 : 0;
    }
    for (const std::size_t count : {n, made, alone, named, held, wrong}) text += "| " + std::to_string(count) + " ";
    text += "|\n";
  }
  return text + "\n";
}

/// Prints the tables. False if a rate exceeds its limit.
bool print_report(const std::vector<Judgement>& all, const Request& request) {
  std::fputs(matrix(all).c_str(), stdout);
  const Protocol protocol = protocol_of(request);
  for (const ProtocolWords& known : k_protocols) {
    if (known.protocol == protocol) std::fputs(known.text, stdout);
  }
  std::fputs(k_size_words, stdout);
  if (protocol != Protocol::random) std::fputs(k_usual_words, stdout);
  const Rates found = rates(all);
  const double false_positives = std::max(found.false_names.share(), found.false_names_outside.share());
  const double false_groups = std::max(found.false_groups.share(), found.false_groups_outside.share());
  const double lost = found.kept.all > 0 ? 1 - found.kept.share() : 0.0;
  return 100 * found.miss.share() <= request.most_missed && 100 * lost <= request.most_lost &&
         100 * false_positives <= request.most_false && 100 * false_groups <= request.most_false_groups;
}

int run(const std::vector<std::string>& words) {
  const std::optional<Request> request = read_options(words, k_options, k_flags);
  // Truth and slopes are those of the whole catalogue.
  if (!request || (!request->data_to.empty() && !request->leave_out.empty())) {
    std::fputs(k_usage, stderr);
    return 2;
  }
  if (request->list) return print_truths(*request);
  const std::vector<Job> jobs = jobs_of(*request);
  std::optional<ScratchFolder> scratch;
  if (request->data_to.empty()) scratch.emplace("known_truth");
  const std::vector<JudgementSequence> answers =
      run_jobs(jobs, *request, scratch ? scratch->path() : std::filesystem::path(request->data_to));
  if (request->no_calibration) return 0;
  if (request->follow > 0) std::fputs(follow_table(answers, request->follow).c_str(), stdout);
  const std::vector<Judgement> all = judgements_after(answers, request->follow);
  const bool is_good = print_report(all, *request);
  std::vector<Sharpness> sharpness;
  for (const JudgementSequence& one : answers) sharpness.push_back(one.sharpness);
  std::fputs(sharpness_table(sharpness).c_str(), stdout);
  // Other protocols cannot show every fault: such joints are omitted.
  if (all.empty() || (protocol_of(*request) == Protocol::full && all.size() < jobs.size())) return 1;
  return is_good ? 0 : 4;
}

}  // namespace
}  // namespace fusee::rig

int main(int count, char** words) { return fusee::rig::run_program("known_truth", fusee::rig::run, count, words); }
