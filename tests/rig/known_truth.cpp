// The known-truth matrix: makes joints whose faults are known, calibrates them, prints what was said. On standard
// output Markdown, on standard error the progress.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fusee/base/diagnostics.h"
#include "fusee/mechanism/file.h"
#include "rig/follow.h"
#include "rig/judge.h"
#include "rig/sharpness.h"

namespace fusee::rig {
namespace {

constexpr const char* k_usage =
    R"(usage: known_truth [--seeds N] [--only NAME]... [--protocol full|single|random] [--data-to DIR] ...
       known_truth --joints N [--split NAME] [--kinds NAME]... [--protocol full|single|random] ...
       known_truth --leave-out NAME|all [--seeds N] ...
  --seeds N         joints per truth (3)
  --first N         seed of the first of them (1): joints that nobody has tuned anything on
  --only NAME       this truth alone: "nothing", or faults: "tendon_stretch", "backlash + sensor_lag" ...
  --joints N        joints drawn at random instead: each of --kinds in turn
  --kinds NAME      only these: nothing one two three (faults with names) unknown (one without) beside (one of each)
  --split NAME      where faults without a name are drawn from: tuning (the default), regression, or a held-out set:
                    heldout_13
  --leave-out NAME  joints that have this effect, calibrated by a catalogue that does not; all: each in turn
  --protocol NAME   full: five runs; single: one unloaded run; random: any (full; random with --joints)
  --any-groove      the groove's friction is drawn from 0.05 to 0.5 while the file says 0.2 (always with --joints)
  --follow N        then makes what is asked for first, and calibrates again, up to N times: how many faults stand
                    alone before and after
  --data-to DIR     leaves each joint's files in a folder there: spec.toml, runs, case.json with truth and answer, and
                    slopes.csv, the catalogue's slopes (tests/bench/baselines.py reads them); not with --leave-out
  --no-calibration  makes the data alone
  --jobs N          joints at work at once (2)
  --most-missed P   exit code 4 when more than P % of the named faults are missed
  --most-lost P     exit code 4 when more than P % of the named faults beside one without a name are in no group
  --most-blamed P   exit code 4 when more than P % of the joints, of either kind, have a false positive
  --most-empty P    exit code 4 when of more than P % of the joints, of either kind, a group names nothing that is
                    there, though it may say that the cause may be unmodelled
  --joint FILE      this joint, without its [load], and none drawn at random: faults of its drum, attachments, idlers
  --list            the truths
)";

constexpr const char* k_full_words =
    "Five runs a joint: no load, a load, no load and fast, half the load, the load reversed.\n";
constexpr const char* k_single_words = "One unloaded run of two cycles a joint.\n";
constexpr const char* k_random_words =
    "Two to seven runs a joint: strokes, staircases of loads at held angles, points at both ends in turn, loads that "
    "change within a run;\nspeeds of 5 to 120 deg/s; noise of 0.005 to 0.05 deg.\n";
constexpr const char* k_size_words =
    "Each fault moves the reading by 3 to 15 times the sensor's noise, rms over all rows.\n";
constexpr const char* k_usual_words =
    "Noise 0.02 deg; every fourth sensor's has a memory, every fourth is coarse (0.04 deg).\n";

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
  std::size_t jobs = 2;
  double most_missed = 100;  ///< %
  double most_lost = 100;
  double most_blamed = 100;
  double most_empty = 100;
};

constexpr std::array<std::pair<const char*, Kind>, 6> k_kinds = {{{"nothing", Kind::nothing},
                                                                  {"one", Kind::one},
                                                                  {"two", Kind::two},
                                                                  {"three", Kind::three},
                                                                  {"unknown", Kind::unknown},
                                                                  {"beside", Kind::beside}}};

std::optional<Kind> kind_of(const std::string& name) {
  for (const auto& [known, kind] : k_kinds) {
    if (name == known) return kind;
  }
  return std::nullopt;
}

std::optional<Protocol> protocol_of(const std::string& name) {
  if (name == "full") return Protocol::full;
  if (name == "single") return Protocol::single;
  if (name == "random") return Protocol::random;
  return std::nullopt;
}

Protocol protocol_of(const Request& request) {
  return request.protocol.value_or(request.joints > 0 ? Protocol::random : Protocol::full);
}

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// Reads a word after an option. False when it is not fit for it.
using Reader = std::function<bool(Request&, const std::string&)>;

Reader text_into(std::string Request::*member) {
  return [=](Request& request, const std::string& text) { return request.*member = text, true; };
}
Reader texts_into(std::vector<std::string> Request::*member) {
  return [=](Request& request, const std::string& text) { return (request.*member).push_back(text), true; };
}
template <typename Value>
Reader number_into(Value Request::*member, double least = 0) {
  return [=](Request& request, const std::string& text) {
    const std::optional<double> value = number(text);
    if (value) request.*member = static_cast<Value>(*value);
    return value && *value >= least;
  };
}

bool read_kind(Request& request, const std::string& text) {
  request.kinds.push_back(text);
  return kind_of(text).has_value();
}
bool read_protocol(Request& request, const std::string& text) {
  request.protocol = protocol_of(text);
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
const std::map<std::string, Reader> k_options = {{"--seeds", number_into(&Request::seeds, 1)},
                                                 {"--first", number_into(&Request::first)},
                                                 {"--joints", number_into(&Request::joints)},
                                                 {"--jobs", number_into(&Request::jobs, 1)},
                                                 {"--follow", number_into(&Request::follow)},
                                                 {"--most-missed", number_into(&Request::most_missed)},
                                                 {"--most-lost", number_into(&Request::most_lost)},
                                                 {"--most-blamed", number_into(&Request::most_blamed)},
                                                 {"--most-empty", number_into(&Request::most_empty)},
                                                 {"--only", texts_into(&Request::only)},
                                                 {"--split", text_into(&Request::split)},
                                                 {"--leave-out", text_into(&Request::leave_out)},
                                                 {"--data-to", text_into(&Request::data_to)},
                                                 {"--kinds", read_kind},
                                                 {"--protocol", read_protocol},
                                                 {"--joint", read_joint}};

std::optional<Request> read_request(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (const auto flag = k_flags.find(words[i]); flag != k_flags.end()) {
      request.*flag->second = true;
      continue;
    }
    const auto option = k_options.find(words[i]);
    if (option == k_options.end() || ++i == words.size() || !option->second(request, words[i])) return std::nullopt;
  }
  // Truth and slopes are those of the whole catalogue.
  if (!request.data_to.empty() && !request.leave_out.empty()) return std::nullopt;
  return request;
}

/// The truths asked for. InputError for a fault that there is not.
std::vector<Truth> truths_of(const Request& request) {
  if (request.only.empty()) return request.joint ? wide_truths(*request.joint) : all_truths();
  std::vector<Truth> chosen;
  for (const std::string& name : request.only) chosen.push_back(truth_of(name));
  return chosen;
}

/// A truth with its seed: one joint.
struct Job {
  Truth truth;
  std::uint64_t seed = 0;
  std::vector<std::string> without = {};
  std::string row = {};  ///< of the matrix; empty: the truth's own
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

/// A job's judgements: before anything that was asked for was made, and after each that was.
struct Followed {
  std::vector<Judgement> judgements;
  Sharpness sharpness;  ///< of the last answer
};

/// The answer about the files in `folder`, its judgement, and the files for other methods if they were requested.
Answer answered(const Case& made, const Job& job, const Request& request, const std::filesystem::path& folder,
                Followed& all) {
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

/// The first measurement that the rig can make, made. False where it can make none.
bool perform_first(const std::vector<NextMeasurement>& asked, Case& made, std::string& words) {
  for (const NextMeasurement& next : asked) {
    if (!perform(next, made)) continue;
    words += "\n    " + std::string(next.kind()) + ": " + next.text();
    return true;
  }
  return false;
}

Followed followed(Case made, const Job& job, const Request& request, const std::filesystem::path& folder,
                  std::string& words) {
  Followed all;
  Answer answer = answered(made, job, request, folder, all);
  words = all.judgements.back().words;
  while (all.judgements.size() <= request.follow && perform_first(answer.found.next, made, words)) {
    answer = answered(made, job, request, folder, all);
    words += "\n    " + all.judgements.back().words;
  }
  return all;
}

/// Request::jobs at work; the answers in the order of the jobs.
std::vector<Followed> work(const std::vector<Job>& jobs, const Request& request, const std::filesystem::path& folder) {
  std::vector<Followed> answers(jobs.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex console;
  const auto one = [&](std::size_t i) {
    std::string words;
    try {
      const CaseOptions options{protocol_of(request), request.any_groove || request.joints > 0,
                                request.joint ? &*request.joint : nullptr};
      const Case made = make_case(jobs[i].truth, jobs[i].seed, options);
      if (!request.no_calibration) {
        answers[i] = followed(made, jobs[i], request, folder / folder_name(jobs[i]), words);
      } else {
        write_case(made, folder / folder_name(jobs[i]));
        write_case_data(made, jobs[i].row.empty() ? jobs[i].truth.name : jobs[i].row, nullptr,
                        folder / folder_name(jobs[i]));
        words = folder_name(jobs[i]);
      }
    } catch (const std::exception& error) {
      words = folder_name(jobs[i]) + ": left out: " + error.what();
    }
    const std::lock_guard lock(console);
    std::fprintf(stderr, "[%zu/%zu] %s\n", ++done, jobs.size(), words.c_str());
  };
  const auto worker = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) one(i);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < request.jobs; ++i) others.emplace_back(worker);
  worker();
  for (std::thread& other : others) other.join();
  std::erase_if(answers, [](const Followed& answer) { return answer.judgements.empty(); });
  return answers;
}

/// Emptied and removed in the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "known_truth_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw OutputError("cannot make a folder like " + pattern, "set TMPDIR");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

int list(const Request& request) {
  for (const Truth& truth : request.joint ? wide_truths(*request.joint) : all_truths())
    std::printf("%s\n", truth.name.c_str());
  return 0;
}

/// As they were after so many measurements, or after their last.
std::vector<Judgement> judged_after(const std::vector<Followed>& all, std::size_t measurements) {
  std::vector<Judgement> judgements;
  for (const Followed& one : all)
    judgements.push_back(one.judgements[std::min(measurements, one.judgements.size() - 1)]);
  return judgements;
}

std::string followed_table(const std::vector<Followed>& all, std::size_t follow) {
  std::string text =
      "| measurements that were asked for | joints that made them | named faults alone | of | held | wrong alone |\n"
      "|--:|--:|--:|--:|--:|--:|\n";
  for (std::size_t n = 0; n <= follow; ++n) {
    std::size_t made = 0, alone = 0, named = 0, held = 0, wrong = 0;
    for (const Followed& one : all) made += one.judgements.size() > n ? 1 : 0;
    for (const Judgement& one : judged_after(all, n)) {
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

/// The matrix with what it is made of; whether it is as good as was asked for.
bool report(const std::vector<Judgement>& all, const Request& request) {
  std::fputs(matrix(all).c_str(), stdout);
  const Protocol protocol = protocol_of(request);
  std::fputs(protocol == Protocol::full     ? k_full_words
             : protocol == Protocol::single ? k_single_words
                                            : k_random_words,
             stdout);
  std::fputs(k_size_words, stdout);
  if (protocol != Protocol::random) std::fputs(k_usual_words, stdout);
  const Rates found = rates(all);
  const double blamed = std::max(found.false_names.share(), found.false_names_outside.share());
  const double empty = std::max(found.false_blame.share(), found.false_blame_outside.share());
  const double lost = found.kept.all > 0 ? 1 - found.kept.share() : 0.0;
  return 100 * found.miss.share() <= request.most_missed && 100 * lost <= request.most_lost &&
         100 * blamed <= request.most_blamed && 100 * empty <= request.most_empty;
}

int run(const std::vector<std::string>& words) {
  const std::optional<Request> request = read_request(words);
  if (!request) {
    std::fputs(k_usage, stderr);
    return 2;
  }
  if (request->list) return list(*request);
  const std::vector<Job> jobs = jobs_of(*request);
  std::optional<ScratchFolder> scratch;
  if (request->data_to.empty()) scratch.emplace();
  const std::vector<Followed> answers =
      work(jobs, *request, scratch ? scratch->path() : std::filesystem::path(request->data_to));
  if (request->no_calibration) return 0;
  if (request->follow > 0) std::fputs(followed_table(answers, request->follow).c_str(), stdout);
  const std::vector<Judgement> all = judged_after(answers, request->follow);
  const bool fine = report(all, *request);
  std::vector<Sharpness> sharpness;
  for (const Followed& one : answers) sharpness.push_back(one.sharpness);
  std::fputs(sharpness_table(sharpness).c_str(), stdout);
  // Not every protocol shows every fault: those are left out.
  if (all.empty() || (protocol_of(*request) == Protocol::full && all.size() < jobs.size())) return 1;
  return fine ? 0 : 4;
}

}  // namespace
}  // namespace fusee::rig

int main(int count, char** words) {
  try {
    return fusee::rig::run({words + 1, words + count});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "known_truth: %s\n", error.what());
    return 1;
  }
}
