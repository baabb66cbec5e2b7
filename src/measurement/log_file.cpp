#include "measurement/log_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "base/folder_access.h"
#include "base/text.h"
#include "measurement/ros_names.h"
#include "measurement/sqlite_bag.h"
#include "measurement/unpacking.h"

namespace fusee::measurement {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_any_size = std::numeric_limits<std::size_t>::max();
/// Bytes from which every format is known.
constexpr std::size_t k_format_bytes = 16;
constexpr std::size_t k_largest_metadata = std::size_t{1} << 20;  // bytes
constexpr std::string_view k_metadata = "metadata.yaml";
constexpr std::array<std::string_view, 4> k_endings = {".mcap", ".db3", ".mcap.zstd", ".db3.zstd"};

std::string_view without_quotes(std::string_view text) {
  const bool is_quoted =
      text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// Names in the list "relative_file_paths:" of a metadata.yaml. Older recorders wrote the bag's folder before each: it
/// is removed.
std::vector<std::string> listed_files(std::string_view yaml) {
  constexpr std::string_view k_list = "relative_file_paths:";
  std::vector<std::string> names;
  bool in_list = false;
  while (!yaml.empty()) {
    const std::size_t end = yaml.find_first_of("\r\n");
    std::string_view line = yaml.substr(0, end);
    yaml.remove_prefix(end == std::string_view::npos ? yaml.size() : end + 1);
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    while (line.ends_with(' ')) line.remove_suffix(1);
    if (line.starts_with(k_list)) {
      in_list = true;
    } else if (in_list && line.starts_with("- ")) {
      names.push_back(fs::path(without_quotes(line.substr(2))).filename().string());
    } else if (!line.empty()) {
      in_list = false;
    }
  }
  return names;
}

bool is_recording(const std::string& name) {
  return std::any_of(std::begin(k_endings), std::end(k_endings),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

/// Orders the parts of a recording by their numbers: bag_2 before bag_10, since its name is shorter.
bool is_before(const std::string& one, const std::string& other) {
  return one.size() != other.size() ? one.size() < other.size() : one < other;
}

/// The files of a bag in its folder, in order.
std::vector<std::string> parts_of(const fs::path& folder, const std::vector<std::string>& names, FileAccess& access,
                                  BagLog& bag) {
  std::vector<std::string> parts;
  if (std::find(names.begin(), names.end(), k_metadata) != names.end()) {
    for (const std::string& listed : listed_files(read_file(folder / k_metadata, k_largest_metadata, access))) {
      if (std::find(names.begin(), names.end(), listed) != names.end())
        parts.push_back(listed);
      else
        bag.add_note("metadata.yaml lists " + cleaned_line(listed) + ", which is missing");
    }
  }
  if (!parts.empty()) return parts;
  std::copy_if(names.begin(), names.end(), std::back_inserter(parts), is_recording);
  std::sort(parts.begin(), parts.end(), is_before);
  return parts;
}

void read_file_into(LogFile& file, const fs::path& path, FileAccess& access) {
  access.read({path, k_any_size, /*pipes=*/true}, [&file](std::string_view block) { file.add(block); });
  file.end([&]() -> std::string {
    try {
      return read_file(path.string() + "-wal", k_largest_database, access);
    } catch (const InputError&) {
      return {};  // without this file, the database is complete
    }
  });
}

/// The rows of the bag in a folder; empty for a folder without a bag.
std::optional<LoggedRows> read_folder(const fs::path& folder, const std::vector<std::string>& names,
                                      const std::string& name, const MeasurementOptions& options, FileAccess& access,
                                      std::size_t most_samples) {
  BagLog bag(name, options);
  const std::vector<std::string> parts = parts_of(folder, names, access, bag);
  if (parts.empty()) return std::nullopt;
  for (const std::string& part : parts) {
    const std::string part_name = (folder / part).string();
    LogFile file(part_name, options, most_samples, &bag);
    read_file_into(file, folder / part, access);
  }
  return bag.finish(most_samples);
}

}  // namespace

LogFormat format_of(std::string_view start) {
  if (start.starts_with(k_mcap_magic)) return LogFormat::mcap;
  if (start.starts_with(k_sqlite_magic)) return LogFormat::sqlite;
  if (is_zstd(start)) return LogFormat::zstd;
  return start.starts_with("#ROSBAG V") ? LogFormat::ros1 : LogFormat::csv;
}

LogFile::LogFile(const std::string& name, const MeasurementOptions& options, std::size_t most_samples, BagLog* bag)
    : name_(name), options_(options), most_samples_(most_samples), bag_(bag) {}

void LogFile::add(std::string_view block) {
  if (format_) return take(block);
  held_ += block;
  if (held_.size() >= k_format_bytes) begin(format_of(held_));
}

void LogFile::begin(LogFormat format) {
  format_ = format;
  if (format == LogFormat::ros1)
    throw InputError(name_, "is a bag of ROS 1", "convert it: rosbags-convert --src FILE.bag --dst FOLDER");
  if (format == LogFormat::csv && bag_ != nullptr)
    throw InputError(name_, "is no MCAP file and no SQLite file", "a bag's folder has nothing but its recording");
  if ((format == LogFormat::mcap || format == LogFormat::sqlite) && bag_ == nullptr)
    bag_ = &own_bag_.emplace(name_, options_);
  if (format == LogFormat::csv) csv_ = std::make_unique<CsvReader>(name_, options_, most_samples_);
  if (format == LogFormat::mcap) mcap_ = std::make_unique<McapReader>(*bag_);
  const std::string start = std::move(held_);
  held_.clear();
  take(start);
}

void LogFile::take(std::string_view block) {
  if (csv_) return csv_->add(block);
  if (mcap_) return mcap_->add(block);
  if (held_.size() + block.size() > k_largest_database)
    throw InputError(name_, "is larger than 2 GiB, which a database or a packed file must not be",
                     "record only the topics of motor and joint, or convert it: ros2 bag convert");
  held_ += block;
}

void LogFile::end(const std::function<std::string()>& write_ahead_log) {
  if (!format_) begin(format_of(held_));
  if (format_ == LogFormat::zstd) return unpack_held();
  if (mcap_) mcap_->finish();
  if (format_ != LogFormat::sqlite) return;
  const std::string log = has_write_ahead_log(held_) ? write_ahead_log() : std::string();
  read_sqlite_bag(std::move(held_), log, name_, *bag_);
}

/// A bag that was compressed as a file, FILE.db3.zstd.
void LogFile::unpack_held() {
  if (is_unpacked_) throw InputError(name_, "is packed twice", "unpack it: unzstd");
  UnpackingLimit limit;
  const UnpackedBytes unpacked =
      unpack(Packing::zstd, held_, std::min(limit.raise_for(held_.size()), k_largest_database));
  if (!unpacked.whole && unpacked.bytes.empty()) throw InputError(name_, "is a damaged zstd file", "copy it again");
  held_.clear();
  format_.reset();
  is_unpacked_ = true;
  add(unpacked.bytes);
  end([] { return std::string(); });
  if (!unpacked.whole && bag_ != nullptr) bag_->add_note("the packed file is cut off, damaged or too large");
}

LoggedRows LogFile::finish() { return csv_ ? csv_->finish() : own_bag_->finish(most_samples_); }

LoggedRows read_rows(std::string_view text, const std::string& name, const MeasurementOptions& options,
                     std::size_t most_samples) {
  LogFile file(name, options, most_samples);
  file.add(text);
  file.end([] { return std::string(); });
  return file.finish();
}

LoggedRows read_rows(const fs::path& path, const std::string& name, const MeasurementOptions& options,
                     FileAccess& access, std::size_t most_samples) {
  if (const auto names = files_in(path, access)) {
    if (auto rows = read_folder(path, *names, name, options, access, most_samples)) return std::move(*rows);
  }
  LogFile file(name, options, most_samples);
  read_file_into(file, path, access);
  return file.finish();
}

}  // namespace fusee::measurement
