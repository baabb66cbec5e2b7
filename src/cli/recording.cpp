#include "cli/recording.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <algorithm>

#include "base/leftovers.h"
#include "base/staging.h"
#include "base/text.h"
#include "cli/interrupt.h"
#include "fusee/base.h"

namespace fusee::cli {
namespace {

namespace fs = std::filesystem;

/// True for an existing file that is not a bundle, or that cannot be read.
bool is_other_file(const fs::path& file) {
  try {
    return entry_exists(file) && !is_bundle(read_file(file, k_largest_bundle));
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

std::string take_bundle_option(std::vector<std::string>& words) {
  const auto end = std::find(words.begin(), words.end(), "--");
  for (auto word = words.begin(); word != end; ++word) {
    constexpr std::string_view k_joined = "--bundle=";
    const bool is_joined = word->starts_with(k_joined);
    const bool has_value = word + 1 != end && !(word + 1)->starts_with("--");
    if (!is_joined && (*word != "--bundle" || !has_value)) continue;
    const std::string file = is_joined ? word->substr(k_joined.size()) : *(word + 1);
    if (file.empty()) continue;
    words.erase(word, word + (is_joined ? 1 : 2));
    return file;
  }
  return "";
}

void add_build_info(Bundle& bundle) {
  bundle.version = FUSEE_VERSION;
#ifdef __clang__
  bundle.built_with = "clang " __clang_version__;
#else
  bundle.built_with = "gcc " __VERSION__;
#endif
  utsname system;
  bundle.runs_on =
      std::string(::uname(&system) == 0 ? system.machine : "a machine") + ", glibc " + gnu_get_libc_version();
}

BundledOutcome outcome_of(CommandOutcome run_outcome, std::vector<BundledOutput> outputs, const BundleNames& names) {
  BundledOutcome outcome;
  outcome.exit = static_cast<int>(run_outcome.reply.exit);
  outcome.outputs = std::move(outputs);
  for (Diagnostic& message : run_outcome.reply.diagnostics) {
    for (std::string* words : {&message.place.file, &message.message, &message.hint})
      *words = cleaned(names.text(*words));
  }
  outcome.messages = run_outcome.reply.diagnostics;
  run_outcome.reply.text = names.text(run_outcome.reply.text);
  run_outcome.reply.fields = names.document(std::move(run_outcome.reply.fields));
  outcome.result = cleaned(run_outcome.result());
  return outcome;
}

BundledOutput output_of(const fs::path& path, const fs::path& bytes_at) {
  const std::string bytes = read_file(bytes_at, k_largest_output);
  return {valid_inner_name(path.filename().string()), bytes.size(), sha256(bytes)};
}

Recording::Recording(fs::path file, const std::vector<std::string>& words, bool force)
    : file_(std::move(file)), force_(force), names_(working_folder()) {
  if (!force_ && is_other_file(file_))
    throw OutputError(file_.string() + " exists and is not a bundle of fusee",
                      "choose another name, or overwrite it with --force");
  add_build_info(bundle_);
  bundle_.words = names_.inner_words(words);
}

void Recording::read(const ReadRequest& request, const TakeBlock& take) {
  const std::string name = names_.inner(request.path);
  const bool known = std::any_of(bundle_.files.begin(), bundle_.files.end(),
                                 [&name](const BundledFile& file) { return file.path == name; });
  if (known) return FileAccess::read(request, take);  // a file that is read twice is packed once
  BundledFile& entry = bundle_.files.emplace_back(BundledFile{name, {}, {}});
  bool is_in_take = false;  // an exception of take() is no fault of the file
  try {
    FileAccess::read(request, [&](std::string_view block) {
      packed_bytes_ += block.size();
      if (packed_bytes_ <= k_largest_bundle) entry.bytes += block;
      is_in_take = true;
      take(block);
      is_in_take = false;
    });
  } catch (const InputError& error) {
    if (!is_in_take) entry.failure = error.diagnostics().front();
    if (entry.failure) entry.failure->place.file.clear();
    throw;
  }
}

void Recording::will_publish(const fs::path& name, const fs::path& bytes_at) {
  prevent_exit_by_signal();
  bundle_.outcome.outputs.push_back(output_of(name, bytes_at));
}

void Recording::in_the_way(const fs::path& path) {
  const std::string name = names_.inner(path);
  // A path that cannot exist inside a folder occurs only in the message.
  if (is_inner_path(name)) bundle_.in_the_way.push_back(name + (fs::is_directory(path) ? "/" : ""));
}

Diagnostic Recording::pack(const CommandOutcome& run_outcome) {
  if (packed_bytes_ > k_largest_bundle || bundle_.files.size() > k_most_bundled_files)
    throw OutputError("no bundle was written: the input files are too large for one");
  const std::string own = names_.inner(file_);
  for (const BundledFile& file : bundle_.files) {
    if (file.path == own && !file.failure)
      throw OutputError("no bundle was written: " + file_.string() + " is one of the input files",
                        "choose another name");
  }
  bundle_.outcome = outcome_of(run_outcome, bundle_.outcome.outputs, names_);
  // The constructor checked the existing file before the run.
  write_file(file_, bundle_bytes(bundle_), /*force=*/!is_other_file(file_) || force_);
  std::string list;
  for (const BundledFile& file : bundle_.files)
    if (!file.failure) list += (list.empty() ? "" : ", ") + file.path;
  return make_diagnostic(
      Severity::note,
      file_.string() + " contains the options of this run, its output" + (list.empty() ? "" : ", and " + list),
      "'fusee replay " + file_.string() + "' reruns it");
}

}  // namespace fusee::cli
