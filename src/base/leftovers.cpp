#include "base/leftovers.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <memory>

#include "base/descriptor.h"
#include "base/staging.h"

namespace fusee {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view k_prefix = ".fusee-";

Diagnostic note_on(std::string message, std::string hint = {}) {
  return {Severity::note, {}, std::move(message), std::move(hint)};
}

/// A staging folder whose run is gone; it stays locked while this lives.
struct Leftover {
  fs::path path;
  StagingSite site;
  std::unique_ptr<Descriptor> lock;
};

/// The process in `.fusee-<process>-…`; 0 in another name.
pid_t process_in(std::string_view name) {
  if (name.rfind(k_prefix, 0) != 0) return 0;
  pid_t process = 0;
  const char* end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + k_prefix.size(), end, process);
  return error == std::errc() && rest != end && *rest == '-' && process > 0 ? process : 0;
}

/// True for the name that a staging folder of another place has.
bool is_of_another_place(std::string_view name, const std::string& key) {
  const std::size_t at = name.find('-', k_prefix.size()) + 1;
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  const std::string_view own = name.substr(at, key.size());
  return name.size() == at + key.size() + 7 && name[at + key.size()] == '-' && own != key &&
         std::all_of(own.begin(), own.end(), is_hex);
}

/// Null where the folder is not this user's alone, or its run still lives.
std::unique_ptr<Descriptor> lock_of_dead_run(const fs::path& folder) {
  auto lock = std::make_unique<Descriptor>(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  const bool is_ours = lock->ok() && ::fstat(lock->number(), &status) == 0 && status.st_uid == ::geteuid() &&
                       (status.st_mode & 07777) == 0700;
  return is_ours && ::flock(lock->number(), LOCK_EX | LOCK_NB) == 0 ? std::move(lock) : nullptr;
}

std::vector<Leftover> leftovers_of(const fs::path& place, std::vector<Diagnostic>* notes) {
  std::vector<Leftover> all;
  for (const StagingSite site : {StagingSite::beside, StagingSite::inside}) {
    const fs::path ground = staging_ground(place, site);
    const std::string key = staging_key(place, site);
    for (const std::string& name : names_in(ground)) {
      const pid_t process = process_in(name);
      if (process == 0 || is_of_another_place(name, key)) continue;
      if (::kill(process, 0) == 0 || errno != ESRCH) continue;
      auto lock = name.find("-" + key + "-") == std::string::npos ? nullptr : lock_of_dead_run(ground / name);
      if (lock != nullptr) {
        all.push_back({ground / name, site, std::move(lock)});
      } else if (notes != nullptr) {
        notes->push_back(note_on((ground / name).string() + " is ignored: it is not a staging folder of yours",
                                 "remove it if you do not need it"));
      }
    }
  }
  return all;
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(fs::symlink_status(path, ignored));
}

/// What a run killed between the renames of whole folders left. Returns as move_entries().
int recover_folder(const Leftover& leftover, const fs::path& place) {
  const fs::path old = leftover.path / "old", made = leftover.path / "new";
  if (!is_folder(old)) {
    // After an exchange, before the earlier folder had its name: other files had second names in the new folder, and
    // what a run stages holds no folders.
    return is_folder(place) ? move_entries(made, place, [](const fs::path& entry) { return !is_folder(entry); }) : 0;
  }
  if (move_if_free({AT_FDCWD, old}, {AT_FDCWD, place})) return 1;
  WrittenFiles earlier;
  add_written_files(old, earlier);
  return move_entries(old, place, [&earlier](const fs::path& entry) {
    return entry.filename() == k_manifest || is_unchanged(earlier, entry);
  });
}

/// What a run killed between the renames of single files left: completed once all earlier files were aside, else
/// undone.
int recover_files(const Leftover& leftover, const fs::path& place) {
  const ReplacementLock lock(place);
  const fs::path ready = leftover.path / "ready";
  return move_entries(is_folder(ready) ? ready : leftover.path / "old", place, [](const fs::path&) { return false; });
}

}  // namespace

int move_entries(const fs::path& from, const fs::path& to, const std::function<bool(const fs::path&)>& is_obsolete) {
  const auto open_folder = [](const fs::path& folder) {
    return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  };
  const Descriptor source(open_folder(from)), target(open_folder(to));
  std::vector<std::string> names = names_in(from);
  // The manifest last: where it stands, the set is whole.
  std::partition(names.begin(), names.end(), [](const std::string& name) { return name != k_manifest; });
  int moved = 0;
  bool stuck = false;
  for (const std::string& name : names) {
    if (is_obsolete(from / name)) continue;
    const bool done = move_if_free({source.number(), name}, {target.number(), name});
    moved += done ? 1 : 0;
    stuck = stuck || (!done && errno != EEXIST);
  }
  return stuck ? -1 : moved;
}

bool add_files_aside(const fs::path& place, WrittenFiles& written) {
  bool found = false;
  for (const Leftover& leftover : leftovers_of(place, nullptr)) {
    for (const char* part : {"old", "ready"})
      found = (is_folder(leftover.path / part) && add_written_files(leftover.path / part, written)) || found;
  }
  return found;
}

std::vector<Diagnostic> recover_leftovers(const fs::path& place) {
  std::vector<Diagnostic> notes;
  int removed = 0;
  for (const Leftover& leftover : leftovers_of(place, &notes)) {
    const bool by_folder = leftover.site == StagingSite::beside;
    const int moved = by_folder ? recover_folder(leftover, place) : recover_files(leftover, place);
    if (moved < 0) {
      notes.push_back(note_on(leftover.path.string() + " holds files of " + place.string() +
                                  " that a killed run set aside, and they cannot be moved back",
                              "move them by hand"));
      continue;
    }
    if (moved > 0) notes.push_back(note_on(place.string() + ": what a killed run had set aside was put back"));
    removed += moved == 0 ? 1 : 0;
    std::error_code ignored;
    fs::remove_all(leftover.path, ignored);
  }
  if (removed > 0)
    notes.push_back(note_on(fmt::format("{}: what {} had staged was removed", place.string(),
                                        removed == 1 ? "a killed run" : fmt::format("{} killed runs", removed))));
  return notes;
}

void remove_staged_leftovers(const fs::path& file) {
  std::error_code ignored;
  for (const Leftover& leftover : leftovers_of(file, nullptr))
    if (!stands(leftover.path / "old")) fs::remove_all(leftover.path, ignored);
}

}  // namespace fusee
