#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "base/bundle.h"
#include "base/folder_access.h"
#include "base/leftovers.h"
#include "base/staging.h"
#include "base/text.h"
#include "cli/bundle_names.h"
#include "cli/command.h"
#include "cli/recording.h"
#include "cli/run.h"
#include "fusee/base.h"

// A bundle runs again in this process, in its own folder. It reads only files of the bundle, whatever its command line
// names, and writes only into that folder. So a hostile bundle can do no more than fusee can do to its own files.

namespace fusee::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_differences = 8;  // in the printed text; the JSON document has all

// ---- run ------------------------------------------------------------------------------------------------------------

/// File access that reads from a bundle instead of the disk.
class BundleAccess : public FileAccess, public FolderAccess {
 public:
  explicit BundleAccess(const Bundle& bundle) : bundle_(bundle), here_(working_folder()), names_(here_) {}

  void read(const ReadRequest& request, const TakeBlock& take) override {
    const std::string name = request.path.string();
    const BundledFile* file = find(request.path);
    if (file == nullptr) throw InputError(name, "cannot be read: it is not in the bundle");
    names_.add(name, file->path);
    if (file->failure) throw InputError(name, file->failure->message, file->failure->hint);
    if (file->bytes.size() > request.limit)
      throw InputError(name, "is larger than " + std::to_string(request.limit) + " bytes",
                       "check that it is the right file");
    if (!file->bytes.empty()) take(file->bytes);
  }
  std::optional<std::vector<std::string>> files_in(const fs::path& path) const override {
    const fs::path folder = valid_inner_name(path_from(here_, path).string());
    std::vector<std::string> names;
    for (const BundledFile& file : bundle_.files) {
      const fs::path packed = file.path;
      if (packed.parent_path() == folder) names.push_back(packed.filename().string());
    }
    if (names.empty()) return std::nullopt;
    std::sort(names.begin(), names.end());
    return names;
  }
  void will_write(const fs::path& path) override {
    if (is_outside(path_from(here_, path)))
      throw OutputError(path.string() + " is outside of the folder in which the bundle is replayed");
  }
  void will_publish(const fs::path& name, const fs::path& bytes_at) override {
    outputs_.push_back(output_of(name, bytes_at));
  }
  bool is_bundled() const override { return true; }
  BundledOutcome outcome(const CommandOutcome& run_outcome) const { return outcome_of(run_outcome, outputs_, names_); }

 private:
  /// Finds a file by its path, else the first one of that name. The name alone is enough for a file that a packed file
  /// refers to, relative to itself or by a path of the original machine: it was read before later files of the
  /// command line.
  const BundledFile* find(const fs::path& path) const {
    const fs::path relative = path_from(here_, path);
    const std::string path_in_bundle = relative == "." ? "." : valid_inner_name(relative.string());
    const std::string name = valid_inner_name(path.filename().string());
    const BundledFile* same_name = nullptr;
    for (const BundledFile& file : bundle_.files) {
      if (file.path == path_in_bundle) return &file;
      if (same_name == nullptr && fs::path(file.path).filename() == name) same_name = &file;
    }
    return same_name;
  }

  const Bundle& bundle_;
  fs::path here_;
  BundleNames names_;
  std::vector<BundledOutput> outputs_;
};

/// Makes `folder` the working folder and the place of temporary files.
BundledOutcome replayed_in(const fs::path& folder, const Bundle& bundle, const std::stop_token& stop) {
  if (::chdir(folder.c_str()) != 0) fail_output("cannot work in", folder, errno);
  ::setenv("TMPDIR", folder.c_str(), 1);
  Console console;
  BundleAccess access(bundle);
  const CommandOutcome run_outcome = run_command(bundle.words, console, {.stop = stop, .files = &access});
  return access.outcome(run_outcome);
}

// ---- folders --------------------------------------------------------------------------------------------------------

/// Recreates existing files that the recorded run refused to overwrite.
void recreate_obstacles(const Bundle& bundle, const fs::path& folder) {
  std::error_code ignored;
  for (const std::string& path : bundle.in_the_way) {
    const bool is_folder = path.ends_with('/');
    const fs::path obstacle = folder / path;
    fs::create_directories(is_folder ? obstacle : obstacle.parent_path(), ignored);
    if (!is_folder && !entry_exists(obstacle)) write_file(obstacle, "", /*force=*/false);
  }
}

/// Throws OutputError unless the folder is empty or does not exist.
void refuse_occupied(const fs::path& folder) {
  std::error_code error;
  if (!entry_exists(folder) || (fs::is_directory(fs::symlink_status(folder)) && fs::is_empty(folder, error))) return;
  throw OutputError(folder.string() + " exists and is not an empty folder", "choose another one with -o");
}

/// Replays in a new folder next to `kept`, which is then renamed to it; without `kept` in the system's temporary
/// folder.
BundledOutcome replayed_in_own_folder(const Bundle& bundle, const std::optional<fs::path>& kept,
                                      const std::stop_token& stop) {
  const fs::path target = place_of(kept ? *kept : temporary_folder() / "fusee-replay");
  remove_staged_leftovers(target);
  const Staging staging(target, StagingSite::beside);
  const std::stop_callback on_stop(stop, [&staging] { staging.remove(); });
  const fs::path& folder = staging.path();
  for (const BundledFile& file : bundle.files)
    if (kept && !file.failure) write_file(folder / file.path, file.bytes, /*force=*/false);
  recreate_obstacles(bundle, folder);
  BundledOutcome outcome = replayed_in(folder, bundle, stop);
  if (!kept) return outcome;
  refuse_occupied(target);
  if (::rename(folder.c_str(), target.c_str()) != 0) fail_output("cannot write", target, errno);
  return outcome;
}

// ---- comparison -----------------------------------------------------------------------------------------------------

/// Splits by white space: widths of columns and lines depend on the names in them.
std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// `subject`: "exit code", "message 2". `then`: in the recorded run.
Json difference(const std::string& subject, const std::string& then, const std::string& now) {
  return {{"of", subject}, {"then", then}, {"now", now}};
}

/// Compares texts in order, and reports those that only one list has.
void compare(const std::string& subject, const std::vector<std::string>& then, const std::vector<std::string>& now,
             Json& differences) {
  const std::string none = "(none)";
  for (std::size_t i = 0; i < std::max(then.size(), now.size()); ++i) {
    const std::string& before = i < then.size() ? then[i] : none;
    const std::string& after = i < now.size() ? now[i] : none;
    if (words_of(before) != words_of(after))
      differences.push_back(difference(subject + " " + std::to_string(i + 1), before, after));
  }
}

std::vector<std::string> messages_of(const BundledOutcome& outcome) {
  std::vector<std::string> texts;
  for (const Diagnostic& message : outcome.messages) texts.push_back(to_text(message));
  return texts;
}

std::vector<std::string> outputs_of(const BundledOutcome& outcome) {
  std::vector<std::string> texts;
  for (const BundledOutput& output : outcome.outputs)
    texts.push_back(output.path + ", " + std::to_string(output.bytes) + " bytes, sha256 " +
                    output.sha256.substr(0, 12));
  return texts;
}

Json differences_of(const BundledOutcome& then, const BundledOutcome& now) {
  Json all = Json::array();
  if (then.exit != now.exit)
    all.push_back(difference("exit code", std::to_string(then.exit), std::to_string(now.exit)));
  compare("message", messages_of(then), messages_of(now), all);
  compare("output", outputs_of(then), outputs_of(now), all);
  if (words_of(then.result) != words_of(now.result)) compare("line", lines_of(then.result), lines_of(now.result), all);
  return all;
}

// ---- reply ----------------------------------------------------------------------------------------------------------

/// The command line, quoted for a shell.
std::string command_line(const Bundle& bundle) {
  std::string line = "fusee";
  for (const std::string& word : bundle.words) {
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    const bool needs_no_quotes =
        !word.empty() && word.find_first_of(" \t\n'\"\\$`()[]{}*?;&|<>#!~") == std::string::npos;
    line += needs_no_quotes ? " " + word : " '" + quoted + "'";
  }
  return cleaned_line(line);
}

std::string files_text(const Bundle& bundle) {
  std::string text;
  for (const BundledFile& file : bundle.files)
    text += (text.empty() ? "" : ", ") + file.path +
            (file.failure ? " (" + file.failure->message + ")" : " (" + std::to_string(file.bytes.size()) + " B)");
  return text.empty() ? "no file" : cleaned_line(text);
}

void report_versions(const Bundle& bundle, Reply& reply) {
  Bundle own;
  add_build_info(own);
  const auto report = [&](Severity severity, const std::string& noun, std::string Bundle::*member) {
    if (bundle.*member == own.*member) return;
    const std::string words = "the bundle was made by " + noun + bundle.*member + ", but this is " + noun + own.*member;
    reply.diagnostics.push_back(make_diagnostic(severity, cleaned_line(words)));
  };
  report(Severity::warning, "fusee ", &Bundle::version);
  report(Severity::note, "a fusee built with ", &Bundle::built_with);
  report(Severity::note, "a machine with ", &Bundle::runs_on);
}

std::string summary(const Bundle& bundle, const BundledOutcome& now, const Json& differences) {
  std::string text = command_line(bundle) + "\n  packed by  fusee " +
                     cleaned_line(bundle.version + ", " + bundle.built_with + ", " + bundle.runs_on) + "\n" +
                     wrapped(files_text(bundle), "  read       ", "             ");
  if (differences.empty())
    return text + "  the same   exit code " + std::to_string(now.exit) + ", " + std::to_string(now.messages.size()) +
           " messages, " + std::to_string(now.outputs.size()) + " outputs, " +
           std::to_string(lines_of(now.result).size()) + " lines on stdout\n";
  for (std::size_t i = 0; i < std::min(differences.size(), k_most_differences); ++i) {
    const auto part = [&](const char* key) { return differences[i][key].get<std::string>() + "\n"; };
    text += "  differs    " + part("of") + "    then     " + part("then") + "    now      " + part("now");
  }
  if (differences.size() > k_most_differences)
    text += "  and        " + std::to_string(differences.size() - k_most_differences) + " more differences\n";
  return text;
}

void add_findings(const Bundle& bundle, const Json& differences, Reply& reply) {
  if (differences.empty()) return;
  reply.exit = Exit::check_failed;
  std::string hint;
  if (bundle.outcome.exit == static_cast<int>(Exit::cannot_write))
    hint = "files that existed in its output folder are not in a bundle";
  if (bundle.outcome.exit == static_cast<int>(Exit::interrupted)) hint = "that run was interrupted";
  const std::string first = differences.front()["of"];
  reply.diagnostics.push_back(
      make_diagnostic(Severity::error, "the result differs from the recorded run: " + first, hint));
}

Reply run_replay(const Arguments& arguments, Console&, const RunContext& context) {
  const std::string& file = arguments.positionals().front();
  std::optional<fs::path> kept;
  if (const auto folder = arguments.text("--out"); folder && !arguments.has("--dry-run")) kept = *folder;
  const Bundle bundle = read_bundle(read_file(file, k_largest_bundle, *context.files), file);
  // A bundle of a replay could contain itself.
  if (const auto at = find_command(bundle.words); at && bundle.words[*at] == "replay")
    throw InputError(file, "contains a run of 'fusee replay'", "replay the bundle inside this zip instead");
  if (kept) refuse_occupied(*kept);
  context.begin_step("running " + command_line(bundle));
  Reply reply;
  report_versions(bundle, reply);
  const BundledOutcome now = replayed_in_own_folder(bundle, kept, context.stop);
  const Json differences = differences_of(bundle.outcome, now);
  add_findings(bundle, differences, reply);
  reply.text = summary(bundle, now, differences);
  if (kept) reply.text += "  in         " + kept->string() + "\n";
  reply.fields = {{"replayed", bundle.words},    {"version", bundle.version},        {"built_with", bundle.built_with},
                  {"runs_on", bundle.runs_on},   {"exit_then", bundle.outcome.exit}, {"exit_now", now.exit},
                  {"same", differences.empty()}, {"differences", differences},       {"messages", messages_of(now)}};
  if (kept) reply.fields["folder"] = kept->string();
  return reply;
}

}  // namespace

Command replay_command() {
  return {
      "replay",
      "FILE",
      "rerun a bundle",
      "Reruns the command that --bundle packed into FILE, with its files and options,\n"
      "and compares exit code, messages, output files and printed text with the\n"
      "recorded ones; differences give exit code 5. It reads only the bundle, and\n"
      "writes only into its own folder, which is removed afterwards unless -o names\n"
      "it.",
      {{"-o,--out", "DIR", "keep the files of the bundle and its outputs in DIR,\nwhich must be empty or not exist"}},
      {{"fusee build arm.toml --set pulley.r1_mm=15 --bundle bug.zip", "pack a run: attach bug.zip to a report"},
       {"fusee replay bug.zip", "compare with the recorded run"},
       {"fusee replay bug.zip -o bug", "keep all files in the folder bug"}},
      run_replay};
}

}  // namespace fusee::cli
