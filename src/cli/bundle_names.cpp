#include "cli/bundle_names.h"

#include <algorithm>

#include "base/bundle.h"
#include "cli/command.h"
#include "fusee/base/files.h"

namespace fusee::cli {
namespace {

namespace fs = std::filesystem;

/// From the root, without dots and a slash at its end.
fs::path whole_of(const fs::path& here, const fs::path& path) {
  fs::path whole = (here / path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

bool leads_out(const fs::path& path) { return path.is_absolute() || path.empty() || *path.begin() == ".."; }

/// Any name as one that a bundle may hold.
std::string tame(std::string name) {
  for (char& c : name) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code >= 0x7f || c == '\\' || c == ':') c = '_';
  }
  return is_inner_path(name) ? name : "file";
}

/// Where in a word of the command line a path begins: after "--out=", "-o" and "pulley.table=".
std::size_t path_begin(const std::string& word, bool is_setting) {
  std::size_t begin = 0;
  if (word.rfind("--", 0) == 0) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) return word.size();
    begin = equals + 1;
    is_setting = word.rfind("--set=", 0) == 0;
  } else if (word.rfind("-o", 0) == 0) {
    begin = 2;
  }
  if (!is_setting) return begin;
  const std::size_t equals = word.find('=', begin);
  return equals == std::string::npos ? word.size() : equals + 1;
}

/// Options whose value is no path, whatever it looks like.
bool takes_plain_value(const std::string& flag) {
  for (const Command& command : commands()) {
    for (const Option& option : command.options)
      if (flag == option.name())
        return !option.value.starts_with("FILE") && option.value != "DIR" && !option.value.empty();
  }
  return false;
}

bool looks_like_path(const std::string& text) { return text == ".." || text.find('/') != std::string::npos; }

bool belongs_to_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
         static_cast<unsigned char>(c) >= 0x80;
}

void replace_name(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
    const char before = at == 0 ? ' ' : text[at - 1];
    const std::size_t end = at + from.size();
    const bool inside =
        belongs_to_name(before) || before == '/' || before == '.' || (end < text.size() && belongs_to_name(text[end]));
    if (!inside) text.replace(at, from.size(), to);
    at += inside ? from.size() : to.size();
  }
}

}  // namespace

fs::path seen_from(const fs::path& here, const fs::path& path) { return whole_of(here, path).lexically_relative(here); }

std::string hidden_path(const fs::path& path) { return "sha256:" + sha256(path.lexically_normal().string()); }

void BundleNames::add(const std::string& from, const std::string& to) {
  if (from != to) renamed_.emplace(from, to);
}

/// In a folder that was named: where outputs go.
std::optional<std::string> BundleNames::home_of(const fs::path& whole) const {
  for (fs::path folder = whole; folder.has_relative_path(); folder = folder.parent_path()) {
    const auto home = named_.find(folder);
    if (home != named_.end() && folder == whole) return home->second;
    if (home != named_.end())
      return (fs::path(home->second) / whole.lexically_relative(folder)).lexically_normal().string();
  }
  return std::nullopt;
}

std::string BundleNames::inner(const fs::path& path) {
  const fs::path near = seen_from(here_, path);
  std::string name;
  if (near == ".") return ".";
  if (!leads_out(near)) {
    name = tame(near.generic_string());
  } else {
    const fs::path whole = whole_of(here_, path), folder = whole.parent_path();
    if (const auto home = home_of(whole)) return *home;
    const std::string next = outside_.empty() ? "outside" : "outside_" + std::to_string(outside_.size() + 1);
    const std::string home = outside_.emplace(folder, next).first->second;
    name = home + "/" + tame(whole.filename().string());
    if (folder != whole) add(folder.string(), home);
    if (path.has_parent_path()) add(path.parent_path().string(), home);
  }
  named_[whole_of(here_, path)] = name;
  add(path.string(), name);
  add(whole_of(here_, path).string(), name);
  std::error_code error;
  if (const fs::path real = fs::weakly_canonical(here_ / path, error); !error) add(real.string(), name);
  return name;
}

std::vector<std::string> BundleNames::inner_words(const std::vector<std::string>& words) {
  std::vector<std::string> renamed;
  bool only_paths = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    std::string word = words[i];
    const std::string flag = i == 0 ? "" : words[i - 1];
    const bool is_setting = !only_paths && flag == "--set";
    const bool is_plain = !only_paths && takes_plain_value(flag);
    const std::size_t begin = only_paths ? 0 : path_begin(word, is_setting);
    const std::string value = word.substr(begin);
    const bool in_setting = is_setting || word.rfind("--set=", 0) == 0;
    // What --set gives is seen from the mechanism file: only an absolute path leads out of there.
    const bool is_path = in_setting ? value.rfind('/', 0) == 0 : !is_plain && looks_like_path(value);
    if (is_path) {
      word = word.substr(0, begin) + inner(value);
      if (in_setting) set_paths_.push_back(value);
    }
    only_paths = only_paths || words[i] == "--";
    renamed.push_back(word);
  }
  if (const auto at = find_command(renamed)) {
    // The first word that may be the mechanism file.
    const auto spec = std::find_if(renamed.begin() + static_cast<std::ptrdiff_t>(*at) + 1, renamed.end(),
                                   [](const std::string& word) { return word.rfind(".toml") != std::string::npos; });
    if (spec != renamed.end()) spec_folder_ = fs::path(*spec).parent_path().string();
  }
  return renamed;
}

std::vector<std::string> BundleNames::asked(const fs::path& path) const {
  const std::string raw = path.string();
  if (std::find(set_paths_.begin(), set_paths_.end(), raw) != set_paths_.end())
    return {(fs::path(spec_folder_) / renamed_.at(raw)).lexically_normal().string()};
  std::vector<std::string> all;
  if (path.is_absolute()) all.push_back(hidden_path(path));
  // What a file names beside itself: the file's folder has another name now.
  for (fs::path folder = path.parent_path(); !folder.empty() && folder != folder.root_path();
       folder = folder.parent_path()) {
    const auto home = renamed_.find(folder.string());
    if (home == renamed_.end()) continue;
    all.push_back((fs::path(home->second) / raw.substr(folder.string().size() + 1)).lexically_normal().string());
    return all;
  }
  if (!path.is_absolute()) all.push_back(seen_from(here_, path).string());
  return all;
}

std::string BundleNames::text(std::string words) const {
  if (const auto exact = renamed_.find(words); exact != renamed_.end()) return exact->second;
  std::vector<std::pair<std::string, std::string>> longest_first(renamed_.begin(), renamed_.end());
  longest_first.emplace_back(here_.string(), ".");
  std::stable_sort(longest_first.begin(), longest_first.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  for (const auto& [from, to] : longest_first)
    if (from.find_first_not_of("./") != std::string::npos) replace_name(words, from, to);
  return words;
}

}  // namespace fusee::cli
