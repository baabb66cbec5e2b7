#include "cli/bundle_names.h"

#include <algorithm>

#include "base/bundle.h"
#include "base/text.h"

namespace fusee::cli {
namespace {

namespace fs = std::filesystem;

/// The absolute path, normalised and without a trailing slash.
fs::path whole_of(const fs::path& here, const fs::path& path) {
  fs::path whole = (here / path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Index at which a path begins in a word: after "--out=", "-o" and "pulley.table=".
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

fs::path working_folder() {
  std::error_code error;
  return fs::current_path(error);
}

fs::path seen_from(const fs::path& here, const fs::path& path) { return whole_of(here, path).lexically_relative(here); }

bool leads_out(const fs::path& seen) { return seen.empty() || seen.is_absolute() || *seen.begin() == ".."; }

std::string tame(std::string_view name) {
  std::string tamed = cleaned_line(name);
  for (std::size_t i = 0; i < tamed.size(); ++i) {
    const bool hides = tamed[i] == '.' && (i == 0 || tamed[i - 1] == '/');
    if (hides || tamed[i] == '\\' || tamed[i] == ':') tamed[i] = '_';
  }
  return is_inner_path(tamed) ? tamed : "file";
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

std::string BundleNames::outside(const fs::path& whole) {
  const fs::path folder = whole.parent_path();
  std::string& home = named_[folder];
  if (home.empty()) {
    home = "outside";
    for (int i = 2; !used_.insert(home).second; ++i) home = "outside_" + std::to_string(i);
    add_folder(folder, home);
  }
  return unused(home + "/", tame(whole.filename().string()));
}

std::string BundleNames::inner(const fs::path& path) {
  const fs::path near = seen_from(here_, path), whole = whole_of(here_, path);
  if (near == ".") return ".";
  auto known = named_.find(whole);
  if (known == named_.end())
    known = named_.emplace(whole, leads_out(near) ? outside(whole) : unused("", tame(near.string()))).first;
  const std::string& name = known->second;
  add(path.string(), name);
  add(whole.string(), name);
  std::error_code error;
  const fs::path real = fs::weakly_canonical(here_ / path, error);
  if (!error) add(real.string(), name);
  if (!leads_out(near)) return name;
  if (const auto home = named_.find(whole.parent_path()); home != named_.end()) {
    if (path.has_parent_path()) add_folder(path.parent_path(), home->second);
    if (!error) add_folder(real.parent_path(), home->second);
  }
  return name;
}

std::vector<std::string> BundleNames::inner_words(const std::vector<std::string>& words) {
  std::vector<std::string> renamed = words;
  bool only_paths = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const std::string flag = i == 0 || only_paths ? "" : words[i - 1];
    const std::size_t begin = only_paths ? 0 : path_begin(word, flag == "--set");
    const std::string value = word.substr(begin);
    // A value of --set is relative to the mechanism file's folder, where the replayed run looks for its name.
    if (!value.empty() && (fs::path(value).is_absolute() || leads_out(seen_from(here_, value)) || !is_utf8(value)))
      renamed[i] = word.substr(0, begin) + inner(value);
    only_paths = only_paths || word == "--";
  }
  return renamed;
}

std::string BundleNames::text(std::string words) const {
  if (const auto exact = renamed_.find(words); exact != renamed_.end()) return exact->second;
  for (const auto& [from, to] : renamed_)
    if (from.find_first_not_of("./") != std::string::npos) replace_name(words, from, to);
  return words;
}

Json BundleNames::document(Json json) const {
  if (json.is_string()) return text(json.get<std::string>());
  if (json.is_structured())
    for (Json& each : json) each = document(std::move(each));
  return json;
}

}  // namespace fusee::cli
