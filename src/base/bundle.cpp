#include "base/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/json.h"
#include "base/text.h"
#include "base/zip.h"
#include "fusee/base.h"

namespace fusee {

NLOHMANN_JSON_SERIALIZE_ENUM(Severity,
                             {{Severity::error, "error"}, {Severity::warning, "warning"}, {Severity::note, "note"}})

namespace {

constexpr const char* k_index = "bundle.json";
constexpr const char* k_result = "stdout.txt";
constexpr const char* k_files = "files/";
constexpr int k_schema = 1;
constexpr std::size_t k_longest_path = 1000, k_longest_name = 255;
/// Upper bound on bundle.json. Parsed JSON takes about sixteen times the memory of its text.
constexpr std::uint64_t k_largest_index = std::uint64_t{16} << 20;

// ---- writing --------------------------------------------------------------------------------------------------------

Json to_json(const Diagnostic& diagnostic) {
  return {{"severity", diagnostic.severity},   {"file", diagnostic.place.file}, {"line", diagnostic.place.line},
          {"column", diagnostic.place.column}, {"message", diagnostic.message}, {"hint", diagnostic.hint}};
}

Json to_json(const BundledFile& file) {
  Json json = {{"path", file.path}};
  if (file.failure) {
    json["failure"] = to_json(*file.failure);
  } else {
    json["bytes"] = file.bytes.size();
    json["sha256"] = sha256(file.bytes);
  }
  return json;
}

Json index_of(const Bundle& bundle) {
  Json json = {{"schema", k_schema},          {"tool", "fusee bundle"},
               {"version", bundle.version},   {"built_with", bundle.built_with},
               {"runs_on", bundle.runs_on},   {"command", bundle.words},
               {"exit", bundle.outcome.exit}, {"messages", Json::array()},
               {"files", Json::array()},      {"in_the_way", bundle.in_the_way},
               {"outputs", Json::array()}};
  for (const Diagnostic& message : bundle.outcome.messages) json["messages"].push_back(to_json(message));
  for (const BundledFile& file : bundle.files) json["files"].push_back(to_json(file));
  for (const BundledOutput& output : bundle.outcome.outputs)
    json["outputs"].push_back({{"path", output.path}, {"bytes", output.bytes}, {"sha256", output.sha256}});
  return json;
}

// ---- reading --------------------------------------------------------------------------------------------------------

[[noreturn]] void fail(const std::string& file, const std::string& entry, const std::string& message) {
  fail_in_entry(file, entry, -1, message);
}

/// The entries of an archive. Each occurs once and has a name inside the bundle.
std::map<std::string, std::string> entries_of(std::string_view bytes, const std::string& file) {
  const ZipArchive archive(bytes, file, "a bundle of fusee, which is a zip archive");
  constexpr std::size_t k_own_entries = 2;  // bundle.json and stdout.txt
  if (archive.size() > k_most_bundled_files + k_own_entries)
    throw InputError(file,
                     fmt::format("has {} entries; a bundle has {} at most", archive.size(), k_most_bundled_files));
  std::uint64_t budget = k_largest_bundle;
  const std::string limits = fmt::format("a bundle may have {} MiB", k_largest_bundle >> 20);
  std::map<std::string, std::string> entries;
  for (std::size_t i = 0; i < archive.size(); ++i) {
    const std::string name = archive.name_of(i);
    if (!is_inner_path(name)) fail(file, name, "the name leads out of the bundle, or is hidden");
    if (!archive.is_plain_file(i)) fail(file, name, "is not a regular file: a link, a folder or encrypted");
    if (entries.count(name) != 0) fail(file, name, "occurs twice in the bundle");
    std::uint64_t index_budget = k_largest_index;
    const bool is_index = name == k_index;
    entries[name] = archive.unpacked(i, is_index ? index_budget : budget, is_index ? "its list 16 MiB" : limits);
  }
  return entries;
}

/// Typed access to bundle.json. Errors name the offending place.
class Index {
 public:
  Index(const std::string& file, const Json& json, std::string place)
      : file_(file), json_(json), place_(std::move(place)) {
    if (!json_.is_object()) fail(file_, k_index, place_ + " is not a JSON object");
  }

  bool has(const char* key) const { return json_.contains(key); }
  std::string text(const char* key) const { return value(key, &Json::is_string, "a text").get<std::string>(); }
  std::int64_t integer(const char* key) const {
    return value(key, &Json::is_number_integer, "a whole number").get<std::int64_t>();
  }
  std::vector<std::string> texts(const char* key) const {
    const Json& list = value(key, &Json::is_array, "a list");
    if (!std::all_of(list.begin(), list.end(), [](const Json& each) { return each.is_string(); }))
      wrong(key, "a list of texts");
    return list.get<std::vector<std::string>>();
  }
  Index table(const char* key) const { return {file_, value(key, &Json::is_object, "a table"), place_ + "." + key}; }
  template <class Read>
  void for_each(const char* key, const Read& read) const {
    std::size_t count = 0;
    for (const Json& item : value(key, &Json::is_array, "a list"))
      read(Index(file_, item, fmt::format("{}.{}[{}]", place_, key, count++)));
  }
  [[noreturn]] void wrong(const char* key, const std::string& expected) const {
    fail(file_, k_index, fmt::format("{}.{} is not {}", place_, key, expected));
  }

 private:
  const Json& value(const char* key, bool (Json::*is_expected)() const noexcept, const char* expected) const {
    const auto found = json_.find(key);
    if (found == json_.end()) fail(file_, k_index, fmt::format("{} lacks {}", place_, key));
    if (!((*found).*is_expected)()) wrong(key, expected);
    return *found;
  }

  const std::string& file_;
  const Json& json_;
  std::string place_;
};

Diagnostic read_diagnostic(const Index& index) {
  Diagnostic diagnostic;
  diagnostic.severity = Json(index.text("severity")).get<Severity>();
  diagnostic.place = {index.text("file"), static_cast<int>(index.integer("line")),
                      static_cast<int>(index.integer("column"))};
  diagnostic.message = index.text("message");
  diagnostic.hint = index.text("hint");
  return diagnostic;
}

/// Reads one listed file and moves its bytes out of `entries`.
BundledFile read_bundled(const Index& index, std::map<std::string, std::string>& entries) {
  BundledFile file;
  file.path = index.text("path");
  if (index.has("failure")) {
    file.failure = read_diagnostic(index.table("failure"));
    return file;
  }
  if (!is_inner_path(file.path)) index.wrong("path", "a path within the bundle");
  auto entry = entries.extract(k_files + file.path);
  if (entry.empty()) index.wrong("path", "in the bundle, or listed twice");
  file.bytes = std::move(entry.mapped());
  if (sha256(file.bytes) != index.text("sha256")) index.wrong("sha256", "that of " + (k_files + file.path));
  return file;
}

/// Rejects bundles from which a replay would create too many files and folders, or one name as both.
void demand_replayable(const Bundle& bundle, const Index& index) {
  std::set<std::string_view> folders, files;
  const auto add_path = [&](const char* key, std::string_view path) {
    const bool is_folder = path.ends_with('/');
    if (is_folder) path.remove_suffix(1);
    if (!is_inner_path(path)) index.wrong(key, "a list of paths within the bundle");
    (is_folder ? folders : files).insert(path);
    for (std::size_t end = path.find('/'); end != std::string_view::npos; end = path.find('/', end + 1))
      folders.insert(path.substr(0, end));
    if (folders.size() > k_most_bundled_files || files.size() > k_most_bundled_files)
      index.wrong(key, fmt::format("a list of at most {} files and folders", k_most_bundled_files));
  };
  for (const BundledFile& file : bundle.files)
    if (!file.failure) add_path("files", file.path);
  for (const std::string& path : bundle.in_the_way) add_path("in_the_way", path);
  for (const std::string_view file : files)
    if (folders.count(file) != 0) index.wrong("files", fmt::format("consistent: {} is a file and a folder", file));
}

}  // namespace

bool is_inner_path(std::string_view path) {
  const bool foreign = path.find_first_of("\\:") != std::string_view::npos || cleaned_line(path) != path;
  const std::string whole = fmt::format("/{}/", path);
  const bool hides = whole.find("//") != std::string::npos || whole.find("/.") != std::string::npos;
  const std::filesystem::path parts(path);
  return path.size() <= k_longest_path && !foreign && !hides &&
         std::all_of(parts.begin(), parts.end(),
                     [](const auto& part) { return part.native().size() <= k_longest_name; });
}

std::string bundle_bytes(const Bundle& bundle) {
  const std::string index = json_text(index_of(bundle), 1);
  std::vector<ZipEntry> entries = {{k_index, index}, {k_result, bundle.outcome.result}};
  for (const BundledFile& file : bundle.files)
    if (!file.failure) entries.push_back({k_files + file.path, file.bytes});
  return zip_bytes(entries);
}

bool is_bundle(std::string_view bytes) {
  // A zip archive begins with the local header of its first entry: a signature, and the name at byte 30.
  constexpr std::string_view k_signature("PK\3\4", 4);
  constexpr std::size_t k_name_offset = 30;
  return bytes.starts_with(k_signature) && bytes.size() > k_name_offset &&
         bytes.substr(k_name_offset).starts_with(k_index);
}

Bundle read_bundle(std::string_view bytes, const std::string& name) {
  std::map<std::string, std::string> entries = entries_of(bytes, name);
  auto index_entry = entries.extract(k_index), result_entry = entries.extract(k_result);
  if (index_entry.empty() || result_entry.empty())
    fail(name, index_entry.empty() ? k_index : k_result, "is missing: this is not a bundle of fusee");
  const Json json = parse_foreign_json(index_entry.mapped());
  const Index index(name, json, "the bundle");
  if (index.text("tool") != "fusee bundle") index.wrong("tool", "\"fusee bundle\"");
  if (index.integer("schema") != k_schema) index.wrong("schema", "1: it was written by a later version of fusee");
  Bundle bundle;
  bundle.outcome.result = std::move(result_entry.mapped());
  bundle.version = index.text("version");
  bundle.built_with = index.text("built_with");
  bundle.runs_on = index.text("runs_on");
  bundle.words = index.texts("command");
  bundle.outcome.exit = static_cast<int>(index.integer("exit"));
  index.for_each("messages", [&](const Index& each) { bundle.outcome.messages.push_back(read_diagnostic(each)); });
  index.for_each("files", [&](const Index& each) { bundle.files.push_back(read_bundled(each, entries)); });
  bundle.in_the_way = index.texts("in_the_way");
  demand_replayable(bundle, index);
  index.for_each("outputs", [&](const Index& each) {
    bundle.outcome.outputs.push_back(
        {each.text("path"), static_cast<std::uint64_t>(each.integer("bytes")), each.text("sha256")});
  });
  if (!entries.empty()) fail(name, entries.begin()->first, "is not listed in bundle.json");
  return bundle;
}

}  // namespace fusee
