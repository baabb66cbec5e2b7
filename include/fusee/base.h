/// \file
/// The vocabulary of all modules: failures, checks, points and polygons of the plane, units, and files read and
/// published whole.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fusee/base_elementary.h"

namespace fusee {

// ---- Failures -------------------------------------------------------------------------------------------------------
// Errors and diagnostics: what is wrong, where, and what to change.
//
// There are four kinds of failure:
//   bad input           InputError, with *all* its diagnostics
//   infeasible design   a value (fusee/profile.h, fusee/solid.h)
//   no place for output OutputError
//   a bug in fusee      Bug, thrown by demand(), with the values that broke it

/// Position in an input file. Lines and columns count from 1; 0 means "the whole file".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// Only an error makes input unusable.
enum class Severity { error, warning, note };

/// One error, warning or note about the input.
struct Diagnostic {
  Severity severity = Severity::error;
  Place place;
  std::string message;  ///< what is wrong, with the value and its unit
  std::string hint;     ///< what to change; may be empty
};

/// "joint.toml:3:5: error: …" and, on a second line, "  hint: …".
std::string to_text(const Diagnostic& diagnostic);

/// Unusable input. Exit code 3.
class InputError : public std::runtime_error {
 public:
  /// At least one diagnostic.
  explicit InputError(std::vector<Diagnostic> diagnostics);
  explicit InputError(Diagnostic diagnostic);
  /// An error about a whole file (line 0).
  InputError(std::string file, std::string message, std::string hint = {});

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// An output place exists and was not written by fusee, or cannot be written. Exit code 6.
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(const std::string& message, std::string hint = {});
  const std::string& hint() const { return hint_; }

 private:
  std::string hint_;
};

/// An error in fusee itself. Exit code 1.
class Bug : public std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws Bug(what) unless `holds`. `what` should name the values: demand(n > 2, "ring of " + std::to_string(n)).
void demand(bool holds, const std::string& what);

/// The candidate nearest to `word` by edit distance, or "" when none is near enough.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

// ---- Checks ---------------------------------------------------------------------------------------------------------
// A measured value and its limit. A failed check is a value, not an exception.

/// A measured value, its limit, and whether it holds.
struct Check {
  std::string name;  ///< snake_case, stable: stands in manifest.json
  double value = 0;  ///< the measured value
  double limit = 0;  ///< the limit that the value is compared with
  std::string unit;  ///< "mm", "deg", "1" (a count or a plain number) …
  bool ok = false;
  std::string where;  ///< location of the fault, for a person ("facet 812 at (3.1, 4.2, 0.0) mm"); empty when ok
};

/// A check that holds when value <= limit (false for NaN).
Check at_most(std::string name, double value, double limit, std::string unit, std::string where = {});
/// A check that holds when value >= limit (false for NaN).
Check at_least(std::string name, double value, double limit, std::string unit, std::string where = {});
/// A check that holds when value == limit exactly (counts, Euler numbers).
Check exactly(std::string name, double value, double limit, std::string unit, std::string where = {});

/// True if every check holds; also without checks.
bool all_ok(const std::vector<Check>& checks);

// ---- Units ----------------------------------------------------------------------------------------------------------
// Angles are radians in code and degrees in files and flags. Lengths are mm.

inline constexpr double k_pi = std::numbers::pi;
inline constexpr double k_two_pi = 2.0 * std::numbers::pi;

/// The angle of a file in the unit of the code.
constexpr double radians(double degrees) { return degrees * (k_pi / 180.0); }
/// The angle of the code in the unit of files.
constexpr double degrees(double radians) { return radians * (180.0 / k_pi); }
/// The number of degrees in a file that radians() turns into `radians`. For a value x that radians() returned,
/// radians(degrees_as_read(x)) == x to the last bit. radians(degrees(x)) == x for only 19 values in 20.
constexpr double degrees_as_read(double radians) { return radians / (k_pi / 180.0); }

// ---- Points and polygons of the plane -------------------------------------------------------------------------------
// Points, directions and closed polygons in the plane of the mechanism. mm.

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// A closed polygon; the last point joins the first and is not repeated. Outlines run counter-clockwise.
using Polygon = std::vector<Vec2>;

/// Unit vector at `angle` (rad, counter-clockwise from +x).
inline Vec2 unit(double angle) { return {elementary::cos(angle), elementary::sin(angle)}; }
/// `v` rotated counter-clockwise by `angle` (rad).
Vec2 turned(const Vec2& v, double angle);
/// `v` rotated by +90°.
inline Vec2 turned_left(const Vec2& v) { return {-v.y(), v.x()}; }
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Signed area: positive when counter-clockwise. mm².
double signed_area(const Polygon& polygon);
/// Length of the closed boundary. mm.
double perimeter(const Polygon& polygon);
/// Radius of the smallest circle about the origin that contains the polygon. mm.
double circumradius(const Polygon& polygon);
/// Distance from `point` to the segment ab. mm.
double distance_to_segment(const Vec2& point, const Vec2& a, const Vec2& b);
/// Distance from `point` to the nearest edge of a closed polygon; infinite when the polygon is empty. mm.
double distance_to_edges(const Polygon& polygon, const Vec2& point);
/// The convex hull, counter-clockwise, without collinear points.
Polygon convex_hull(Polygon points);

// ---- Access to files ------------------------------------------------------------------------------------------------
// A run reads its inputs and reports its outputs through a FileAccess, which can record or replay a bundle.

/// Receives the next bytes of a file, in order.
using TakeBlock = std::function<void(std::string_view block)>;

/// Request for the bytes of one file, in blocks. Reading throws InputError when the file is missing, a directory,
/// unreadable, larger than `limit` bytes, or not a regular file. With `pipes`, pipes are accepted, too.
struct ReadRequest {
  std::filesystem::path path;
  std::size_t limit = 0;
  bool pipes = false;
};

/// This class reads from the disk and ignores reports. One thread at a time uses an object of a derived class.
class FileAccess {
 public:
  FileAccess() = default;
  virtual ~FileAccess() = default;
  FileAccess(const FileAccess&) = delete;
  FileAccess& operator=(const FileAccess&) = delete;

  /// Throws InputError. Exceptions of `take` pass through.
  virtual void read(const ReadRequest& request, const TakeBlock& take);
  /// Called before a file or a folder is written. An exception prevents the writing.
  virtual void will_write(const std::filesystem::path&) {}
  /// Called for an existing entry that must not be replaced. The run then ends with OutputError.
  virtual void in_the_way(const std::filesystem::path&) {}
  /// Called for each file of a complete set just before it is put in place. From then on a request to stop has no
  /// effect. `bytes_at`: the file that has the bytes at this moment.
  virtual void will_publish(const std::filesystem::path& /*name*/, const std::filesystem::path& /*bytes_at*/) {}
  /// True if the run is recorded or replayed: it must then depend on nothing but what it reads through this object.
  virtual bool is_bundled() const { return false; }
};

/// The files of the disk. The object has no state.
FileAccess& disk();

// ---- Progress and stopping ------------------------------------------------------------------------------------------
// The part of a run that its caller controls: progress, stop, and access to files.

/// Thrown by a verb that was asked to stop. No file was published.
class Stopped : public std::runtime_error {
 public:
  Stopped() : std::runtime_error("interrupted") {}
};

/// Last argument of every verb. The default reports nothing, never stops, and uses the disk.
struct RunContext {
  /// Called at the start of each step with its name and, if known, the share of the work that is done, 0 … 1. Called
  /// only by the thread that called the verb. An exception from it ends the verb and leaves no files.
  using Progress = std::function<void(std::string_view step, std::optional<double> share)>;

  Progress progress = {};
  /// After a request every OutputFolder removes its staged files at once, and the verb throws Stopped at its next step.
  std::stop_token stop = {};
  FileAccess* files = &disk();  ///< inputs are read through it and outputs reported to it; never null

  /// Reports a step. Throws Stopped.
  void begin_step(std::string_view step, std::optional<double> share = std::nullopt) const {
    throw_if_stopped();
    if (progress) progress(step, share);
  }
  /// Throws Stopped after a request to stop.
  void throw_if_stopped() const {
    if (stop.stop_requested()) throw Stopped();
  }
  /// A context for trial builds and other threads, which report no progress.
  RunContext without_progress() const { return {{}, stop, files}; }
};

// ---- Files ----------------------------------------------------------------------------------------------------------
// Reading of arbitrary files, and atomic publishing of outputs.

/// The bytes of a regular file. Throws InputError when it is missing, a directory, unreadable, or larger than `limit`
/// bytes. Inputs are read through the FileAccess of the run; files that fusee wrote, from the disk.
std::string read_file(const std::filesystem::path& path, std::size_t limit, FileAccess& files = disk());

/// The system's folder for temporary files. OutputError where TMPDIR names none.
std::filesystem::path temporary_folder();

/// SHA-256 of `bytes`, 64 lower-case hex digits.
std::string sha256(std::string_view bytes);

class Staging;

/// One output: its name inside the output folder, or "folder/name", and its bytes.
struct OutputFile {
  std::string name;
  std::string bytes;
};

/// A set of files that appears in `folder` whole or not at all.
///
/// stage() writes the files into a private folder next to the output folder. publish() flushes them to disk and
/// replaces the earlier folder by the private one, which also receives the unrelated entries of the earlier folder. The
/// destructor removes staged files that were not published, and the folders made for them.
///
/// A request to stop does the same, at once and in the thread that makes it. From then on stage() and publish() throw
/// Stopped. A request during publish() waits until the files are in place.
///
/// A kill at any moment leaves the old set or the new one. The next publish() into that folder restores or removes what
/// the killed run set aside. Some folders cannot be renamed: the current folder of the process, a mount point, a folder
/// of another owner. There, files are replaced one by one. manifest.json is removed first and written last, so a folder
/// without it after a kill holds no complete set.
///
/// Ownership: a folder that fusee wrote holds a manifest.json that lists its outputs with their SHA-256. claim() and
/// publish() throw OutputError when they would overwrite an unlisted file, or a listed file whose bytes were changed,
/// unless `force`. An unreadable manifest counts as foreign.
class OutputFolder {
 public:
  /// Changes nothing on the disk.
  OutputFolder(std::filesystem::path folder, bool force, const RunContext& context = {});
  /// A folder in the system's temporary folder, for files that are read back and never published. Throws OutputError.
  static OutputFolder temporary(const RunContext& context);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// True when the folder already holds a manifest of an earlier run of fusee.
  bool has_earlier_run() const { return !own_files_.empty(); }
  /// Throws OutputError, naming all of them, when some of `names` may not be overwritten (see above) or the folder
  /// cannot be written. Writes nothing.
  void claim(const std::vector<std::string>& names);
  /// Writes one file into the private folder. Throws OutputError, and Stopped after a request to stop.
  void stage(const OutputFile& file);
  /// Path of a staged file before it is published.
  std::filesystem::path staged_path(const std::string& name) const;
  /// Marks outputs of an earlier run for removal on publish(). Files that were changed since, or that this run writes,
  /// are kept. Stale outputs would be mistaken for outputs of this run.
  void withdraw(const std::vector<std::string>& names);
  /// Publishes the staged files. If a rename fails, earlier renames are undone. `notes` lists files of killed runs that
  /// were restored or ignored.
  void publish(std::vector<Diagnostic>& notes);

 private:
  /// Used by temporary().
  explicit OutputFolder(const RunContext& context);

  /// Removes staged files and the folders made for them from the disk. Paths stay valid, because other threads may
  /// still call staged_path().
  void discard() const;
  void report_obstacle(const std::filesystem::path& path) const { context_.files->in_the_way(path); }
  void demand_subfolder(const std::filesystem::path& folder) const;
  void find_own_files();
  void open_staging();
  bool is_obsolete(const std::filesystem::path& folder, const std::string& name) const;
  std::set<std::string> subfolders() const;
  void remove_empty_subfolders() const;
  bool link_others() const;
  bool publish_as_folder(std::vector<Diagnostic>& notes);
  void publish_one_by_one();

  std::filesystem::path folder_;  ///< as given by the caller
  std::filesystem::path place_;   ///< absolute, without links and dots
  bool force_;
  /// Name and SHA-256 of all files that earlier runs of fusee wrote here, manifests included.
  std::set<std::pair<std::string, std::string>> own_files_;
  std::vector<std::string> staged_;
  std::vector<std::string> withdrawn_;
  std::unique_ptr<Staging> staging_;
  RunContext context_;
  mutable std::mutex guard_;  ///< held while files are staged, published or discarded
  std::stop_callback<std::function<void()>> on_stop_;
};

/// Writes one file atomically, by a rename. Throws OutputError when the file exists (unless `force`) or cannot be
/// written. A symbolic link is followed. Only regular files are replaced.
void write_file(const std::filesystem::path& path, std::string_view bytes, bool force, FileAccess& files = disk());

}  // namespace fusee
