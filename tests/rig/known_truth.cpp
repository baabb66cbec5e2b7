// The known-truth matrix: makes joints whose faults are known, calibrates them, prints what was said. On standard
// output Markdown, on standard error the progress.
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

#include "fusee/base/diagnostics.h"
#include "rig/judge.h"

namespace fusee::rig {
namespace {

constexpr const char* k_usage =
    "usage: known_truth [--seeds N] [--only NAME]... [--protocol full|single] [--csv DIR] ...\n"
    "  --seeds N           joints per truth (3)\n"
    "  --first N           seed of the first of them (1): joints that nobody has tuned anything on\n"
    "  --only NAME         this truth alone; \"nothing\", \"tendon_stretch\", \"backlash + sensor_lag\" ...\n"
    "  --protocol NAME     full: five runs; single: one unloaded run (full)\n"
    "  --csv DIR           leaves spec.toml, runs and truth.json of each joint there\n"
    "  --no-calibration    makes the data alone\n"
    "  --most-missed P     exit code 4 when more than P % of the named faults are missed\n"
    "  --most-blamed P     exit code 4 when more than P % of the joints, of either kind, are falsely blamed\n"
    "  --list              the truths\n";

constexpr const char* k_full_words =
    "Five runs a joint: no load, a load, no load and fast, half the load, the load reversed.\n";
constexpr const char* k_single_words = "One unloaded run of two cycles a joint.\n";
constexpr const char* k_size_words =
    "Each fault moves the reading by 3 to 15 times the sensor's noise of 0.02 deg, rms over all rows.\n"
    "Every fourth sensor's noise has a memory, every fourth is coarse (0.04 deg).\n";

struct Request {
  std::uint64_t seeds = 3;
  std::uint64_t first = 1;
  std::vector<std::string> only;
  Protocol protocol = Protocol::full;
  std::string csv;
  bool calibration = true;
  bool list = false;
  double most_missed = 100;  ///< %
  double most_blamed = 100;
};

std::optional<double> number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

/// Options that stand alone. False when it is none of them.
bool read_flag(const std::string& word, Request& request) {
  if (word == "--no-calibration") {
    request.calibration = false;
  } else if (word == "--list") {
    request.list = true;
  } else {
    return false;
  }
  return true;
}

/// Options with a value. False when it is none of them or the value is not fit for it.
bool read_option(const std::string& word, const std::string& text, Request& request) {
  if (word == "--only") {
    request.only.push_back(text);
    return true;
  }
  if (word == "--csv") {
    request.csv = text;
    return true;
  }
  if (word == "--protocol") {
    request.protocol = text == "single" ? Protocol::single : Protocol::full;
    return text == "single" || text == "full";
  }
  const std::optional<double> value = number(text);
  if (!value) return false;
  if (word == "--seeds") {
    request.seeds = static_cast<std::uint64_t>(*value);
    return request.seeds > 0;
  }
  if (word == "--first") {
    request.first = static_cast<std::uint64_t>(*value);
  } else if (word == "--most-missed") {
    request.most_missed = *value;
  } else if (word == "--most-blamed") {
    request.most_blamed = *value;
  } else {
    return false;
  }
  return true;
}

std::optional<Request> read_request(const std::vector<std::string>& words) {
  Request request;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (read_flag(words[i], request)) continue;
    if (i + 1 == words.size() || !read_option(words[i], words[i + 1], request)) return std::nullopt;
    ++i;
  }
  return request;
}

/// The truths asked for. InputError for one that there is not.
std::vector<Truth> truths_of(const Request& request) {
  const std::vector<Truth> all = all_truths();
  if (request.only.empty()) return all;
  std::vector<Truth> chosen;
  for (const std::string& name : request.only) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Truth& truth) { return truth.name == name; });
    if (found == all.end()) throw InputError("--only", "there is no truth '" + name + "'; --list shows them");
    chosen.push_back(*found);
  }
  return chosen;
}

/// A truth with its seed: one joint.
struct Job {
  Truth truth;
  std::uint64_t seed = 0;
};

std::vector<Job> jobs_of(const Request& request) {
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

/// Two at work; the answers in the order of the jobs.
std::vector<Judgement> work(const std::vector<Job>& jobs, const Request& request, const std::filesystem::path& folder) {
  std::vector<std::optional<Judgement>> answers(jobs.size());
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex console;
  const auto one = [&](std::size_t i) {
    std::string words;
    try {
      const Case made = make_case(jobs[i].truth, jobs[i].seed, request.protocol);
      if (request.calibration) {
        answers[i] = calibrate_case(made, folder / folder_name(jobs[i]));
        words = answers[i]->words;
      } else {
        write_case(made, folder / folder_name(jobs[i]));
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
  std::thread other(worker);
  worker();
  other.join();
  std::vector<Judgement> all;
  for (std::optional<Judgement>& answer : answers) {
    if (answer) all.push_back(std::move(*answer));
  }
  return all;
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

int list() {
  for (const Truth& truth : all_truths()) std::printf("%s\n", truth.name.c_str());
  return 0;
}

/// The matrix with what it is made of; whether it is as good as was asked for.
bool report(const std::vector<Judgement>& all, const Request& request) {
  std::fputs(matrix(all).c_str(), stdout);
  std::fputs(request.protocol == Protocol::full ? k_full_words : k_single_words, stdout);
  std::fputs(k_size_words, stdout);
  const Rates found = rates(all);
  const double blamed = std::max(found.false_blame, found.false_blame_outside);
  return 100 * found.miss <= request.most_missed && 100 * blamed <= request.most_blamed;
}

int run(const std::vector<std::string>& words) {
  const std::optional<Request> request = read_request(words);
  if (!request) {
    std::fputs(k_usage, stderr);
    return 2;
  }
  if (request->list) return list();
  const std::vector<Job> jobs = jobs_of(*request);
  std::optional<ScratchFolder> scratch;
  if (request->csv.empty()) scratch.emplace();
  const std::vector<Judgement> all =
      work(jobs, *request, scratch ? scratch->path() : std::filesystem::path(request->csv));
  if (!request->calibration) return 0;
  const bool fine = report(all, *request);
  // A single unloaded run does not show every fault: those are left out.
  if (all.empty() || (request->protocol == Protocol::full && all.size() < jobs.size())) return 1;
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
