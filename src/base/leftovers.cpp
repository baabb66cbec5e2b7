#include "base/leftovers.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <regex>

#include "base/descriptor.h"
#include "base/json.h"
#include "base/staging.h"
#include "fusee/base.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

Descriptor open_folder(const fs::path& folder) {
  return Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(fs::symlink_status(path, ignored));
}

/// A staging folder whose run ended. It stays locked while this object lives.
struct Leftover {
  fs::path path;
  Descriptor lock;
};

/// True when the folder belongs to this user alone and its run has ended.
bool is_abandoned(const Descriptor& folder) {
  struct stat status {};
  return folder.ok() && ::fstat(folder.number(), &status) == 0 && status.st_uid == ::geteuid() &&
         (status.st_mode & 07777) == 0700 && ::flock(folder.number(), LOCK_EX | LOCK_NB) == 0;
}

std::vector<Leftover> leftovers_of(const fs::path& place, std::vector<Diagnostic>* notes) {
  static const std::regex staging_name(R"(\.fusee-([1-9]\d{0,8})-(?:([0-9a-f]{8})-\w{6})?.*)");
  std::vector<Leftover> all;
  for (const StagingSite site : {StagingSite::beside, StagingSite::inside}) {
    const fs::path parent = staging_parent(place, site);
    const std::string key = staging_key(place, site);
    for (const std::string& name : names_in(parent)) {
      std::smatch part;  // [1]: process, [2]: key of the place; without a key, the name is of an unknown form
      if (!std::regex_match(name, part, staging_name)) continue;
      if (part[2].matched && part[2] != key) continue;  // staging folder of another place
      const bool process_lives = ::kill(std::stoi(part[1]), 0) == 0 || errno != ESRCH;
      if (process_lives) continue;
      Leftover leftover{parent / name, open_folder(parent / name)};
      if (part[2].matched && is_abandoned(leftover.lock)) {
        all.push_back(std::move(leftover));
      } else if (notes != nullptr) {
        notes->push_back({Severity::note,
                          {},
                          leftover.path.string() + " is ignored: it is not a staging folder of yours",
                          "remove it if you do not need it"});
      }
    }
  }
  return all;
}

/// Undoes what the run began, or completes it when all earlier files were set aside. Returns as move_entries().
int recover(const fs::path& leftover, const fs::path& place) {
  const ReplacementLock lock(place);
  const fs::path staged = leftover / "new", old = leftover / "old", ready = leftover / "ready";
  WrittenFiles written;
  for (const fs::path& folder : {staged, old, ready, place}) add_written_files(folder, written);
  const Subfolders subfolders = subfolders_of(written);
  if (is_folder(ready)) return move_entries(ready, place, subfolders);
  // A run killed between the exchange and the next rename leaves the earlier folder as new/. The published folder has
  // hard links to the files in new/, so only the folders in new/ are moved.
  if (!is_folder(old)) {
    const auto is_file = [&staged](const std::string& name) { return !is_folder(staged / name); };
    return is_folder(place) ? move_entries(staged, place, subfolders, is_file) : 0;
  }
  // Killed between the two renames that replace an exchange: the whole earlier folder returns.
  if (move_if_free(old, place)) return 1;
  // Killed before all earlier files were set aside: they return.
  if (is_folder(staged)) return move_entries(old, place, subfolders);
  // The new folder was published. The outputs in old/ are obsolete, all other entries are kept.
  WrittenFiles earlier;
  add_written_files(old, earlier);
  return move_entries(old, place, subfolders,
                      [&](const std::string& name) { return is_unchanged(earlier, old, name); });
}

}  // namespace

// ---- files that fusee wrote -----------------------------------------------------------------------------------------

void add_written_files(const fs::path& folder, WrittenFiles& written) {
  constexpr std::size_t k_largest_manifest = 16 << 20;
  try {
    const std::string text = read_file(folder / k_manifest, k_largest_manifest);
    const Json manifest = parse_foreign_json(text);
    if (manifest.at("tool").get<std::string>().rfind("fusee", 0) != 0 || !manifest.at("outputs").is_array()) return;
    written.emplace(k_manifest, sha256(text));
    for (const Json& output : manifest["outputs"])
      written.emplace(output.at("file").get<std::string>(), output.at("sha256").get<std::string>());
  } catch (const InputError&) {
    // There is no readable manifest.
  } catch (const Json::exception&) {
    // A manifest of another form. Entries read before the error may stay, because is_unchanged() compares the bytes.
  }
}

void add_files_aside(const fs::path& place, WrittenFiles& written) {
  for (const Leftover& leftover : leftovers_of(place, nullptr)) {
    for (const char* part : {"old", "ready"})
      if (is_folder(leftover.path / part)) add_written_files(leftover.path / part, written);
  }
}

bool is_unchanged(const WrittenFiles& written, const fs::path& folder, const std::string& name) {
  if (!fs::is_regular_file(fs::symlink_status(folder / name))) return false;
  try {
    return written.count({name, sha256(read_file(folder / name, k_largest_output))}) != 0;
  } catch (const InputError&) {
    return false;
  }
}

// ---- subfolders -----------------------------------------------------------------------------------------------------

void add_subfolder(const std::string& name, Subfolders& subfolders) {
  const auto slash = name.find('/');
  if (slash != std::string::npos && slash > 0 && name.front() != '.') subfolders.insert(name.substr(0, slash));
}

Subfolders subfolders_of(const WrittenFiles& written) {
  Subfolders subfolders;
  for (const auto& [name, hash] : written) add_subfolder(name, subfolders);
  return subfolders;
}

std::vector<std::string> entries_in(const fs::path& folder, const Subfolders& subfolders) {
  std::vector<std::string> entries;
  for (const std::string& name : names_in(folder)) {
    if (subfolders.count(name) == 0 || !is_folder(folder / name)) {
      entries.push_back(name);
      continue;
    }
    for (const std::string& inner : names_in(folder / name)) entries.push_back(name + "/" + inner);
  }
  return entries;
}

bool make_subfolder(const fs::path& folder, const std::string& name) {
  const fs::path subfolder = (folder / name).parent_path();
  return subfolder == folder || is_folder(subfolder) || ::mkdir(subfolder.c_str(), 0777) == 0;
}

// ---- leftovers of killed runs ---------------------------------------------------------------------------------------

int move_entries(const fs::path& from, const fs::path& to, const Subfolders& subfolders,
                 const std::function<bool(const std::string& name)>& is_skipped) {
  const Descriptor source = open_folder(from), target = open_folder(to);
  if (!source.ok()) return 0;
  std::vector<std::string> names = entries_in(from, subfolders);
  // The manifest is moved last: its presence marks a complete set.
  std::partition(names.begin(), names.end(), [](const std::string& name) { return name != k_manifest; });
  int moved = 0;
  bool stuck = false;
  for (const std::string& name : names) {
    if (is_skipped && is_skipped(name)) continue;
    const bool done = make_subfolder(to, name) && move_if_free(name, name, source.number(), target.number());
    moved += done ? 1 : 0;
    stuck = stuck || (!done && errno != EEXIST);
  }
  return stuck ? -1 : moved;
}

std::vector<Diagnostic> recover_leftovers(const fs::path& place) {
  std::vector<Diagnostic> notes;
  for (const Leftover& leftover : leftovers_of(place, &notes)) {
    const int moved = recover(leftover.path, place);
    if (moved < 0) {
      notes.push_back({Severity::note,
                       {},
                       leftover.path.string() + " holds files of " + place.string() +
                           " that a killed run set aside, and they cannot be moved back",
                       "move them by hand"});
      continue;
    }
    const char* done =
        moved > 0 ? ": what a killed run had set aside was put back" : ": what a killed run had staged was removed";
    notes.push_back({Severity::note, {}, place.string() + done, {}});
    std::error_code ignored;
    fs::remove_all(leftover.path, ignored);
  }
  return notes;
}

void remove_staged_leftovers(const fs::path& file) {
  std::error_code ignored;
  for (const Leftover& leftover : leftovers_of(file, nullptr))
    if (!entry_exists(leftover.path / "old")) fs::remove_all(leftover.path, ignored);
}

}  // namespace fusee
