#include "cli/bundle_names.h"

#include <algorithm>

#include "base/bundle.h"
#include "base/text.h"

namespace fusee::cli {
namespace {

namespace fs = std::filesystem;

/// The absolute path, normalised and without a trailing slash.
fs::path absolute_path(const fs::path& here, const fs::path& path) {
  fs::path absolute = (here / path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// Index at which a path begins in a word: after "--out=", "-o" and "pulley.table="; the word's size if it has none.
/// `is_setting`: the word is a value of --set.
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

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' ||
         static_cast<unsigned char>(c) >= 0x80;
}

void replace_name(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
    const char before = at == 0 ? ' ' : text[at - 1];
    const std::size_t end = at + from.size();
    const bool is_part_of_longer_name = is_name_character(before) || before == '/' || before == '.' ||
                                        (end < text.size() && is_name_character(text[end]));
    if (!is_part_of_longer_name) text.replace(at, from.size(), to);
    at += is_part_of_longer_name ? from.size() : to.size();
  }
}

}  // namespace

fs::path working_folder() {
  std::error_code error;
  return fs::current_path(error);
}

fs::path path_from(const fs::path& here, const fs::path& path) {
  return absolute_path(here, path).lexically_relative(here);
}

bool is_outside(const fs::path& relative) {
  return relative.empty() || relative.is_absolute() || *relative.begin() == "..";
}

std::string valid_inner_name(std::string_view name) {
  std::string valid_name = cleaned_line(name);
  for (std::size_t i = 0; i < valid_name.size(); ++i) {
    const bool makes_hidden_file = valid_name[i] == '.' && (i == 0 || valid_name[i - 1] == '/');
    if (makes_hidden_file || valid_name[i] == '\\' || valid_name[i] == ':') valid_name[i] = '_';
  }
  return is_inner_path(valid_name) ? valid_name : "file";
}

BundleNames::BundleNames(const fs::path& here) : here_(here) {
  if (!here.empty()) add_folder(here, ".");
}

void BundleNames::add(const std::string& from, const std::string& to) {
  if (from != to) renamed_[from] = to;
}

/// Names a folder, and its parents unless they are named: messages name them, too.
void BundleNames::add_folder(fs::path folder, std::string name) {
  add(folder.string(), name);
  for (folder = folder.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    name = (fs::path(name) / "..").lexically_normal().string();
    if (renamed_.count(folder.string()) == 0) add(folder.string(), name);
  }
}

std::string BundleNames::unused(const std::string& folder, const std::string& name) {
  std::string full = folder + name;
  for (int i = 2; !used_.insert(full).second; ++i) full = folder + std::to_string(i) + "/" + name;
  return full;
}

std::string BundleNames::outside(const fs::path& absolute) {
  const fs::path folder = absolute.parent_path();
  std::string& folder_name = named_[folder];
  if (folder_name.empty()) {
    folder_name = "outside";
    for (int i = 2; !used_.insert(folder_name).second; ++i) folder_name = "outside_" + std::to_string(i);
    add_folder(folder, folder_name);
  }
  return unused(folder_name + "/", valid_inner_name(absolute.filename().string()));
}

std::string BundleNames::inner(const fs::path& path) {
  const fs::path relative = path_from(here_, path), absolute = absolute_path(here_, path);
  if (relative == ".") return ".";
  auto known = named_.find(absolute);
  if (known == named_.end())
    known = named_
                .emplace(absolute,
                         is_outside(relative) ? outside(absolute) : unused("", valid_inner_name(relative.string())))
                .first;
  const std::string& name = known->second;
  add(path.string(), name);
  add(absolute.string(), name);
  std::error_code error;
  const fs::path real = fs::weakly_canonical(here_ / path, error);
  if (!error) add(real.string(), name);
  if (!is_outside(relative)) return name;
  if (const auto folder = named_.find(absolute.parent_path()); folder != named_.end()) {
    if (path.has_parent_path()) add_folder(path.parent_path(), folder->second);
    if (!error) add_folder(real.parent_path(), folder->second);
  }
  return name;
}

std::vector<std::string> BundleNames::inner_words(const std::vector<std::string>& words) {
  std::vector<std::string> renamed = words;
  bool only_paths = false;  // after "--"
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool is_setting = i > 0 && words[i - 1] == "--set";
    const std::size_t begin = only_paths ? 0 : path_begin(word, is_setting);
    const std::string value = word.substr(begin);
    // A value of --set is relative to the mechanism file's folder, where the replayed run looks for its name.
    if (!value.empty() && (fs::path(value).is_absolute() || is_outside(path_from(here_, value)) || !is_utf8(value)))
      renamed[i] = word.substr(0, begin) + inner(value);
    only_paths = only_paths || word == "--";
  }
  return renamed;
}

std::string BundleNames::text(std::string message) const {
  if (const auto exact = renamed_.find(message); exact != renamed_.end()) return exact->second;
  for (const auto& [from, to] : renamed_)
    if (from.find_first_not_of("./") != std::string::npos) replace_name(message, from, to);
  return message;
}

Json BundleNames::document(Json json) const {
  if (json.is_string()) return text(json.get<std::string>());
  if (json.is_structured())
    for (Json& each : json) each = document(std::move(each));
  return json;
}

}  // namespace fusee::cli
