/// \file
/// The names that a bundle has for files of this machine. A path within the folder of the run keeps its name; any other
/// is outside/NAME, those of another folder outside_2/NAME …: no absolute path, and so no person, stands in the bundle
/// that was not in a file that it packs.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/json.h"

namespace fusee::cli {

class BundleNames {
 public:
  /// Of a run that stands in `here`; empty where that folder is gone.
  explicit BundleNames(const std::filesystem::path& here);

  /// The name of a path, an inner path of a bundle, or "." of the folder itself. No two files have one name.
  std::string inner(const std::filesystem::path& path);
  /// A command line with its paths renamed.
  std::vector<std::string> inner_words(const std::vector<std::string>& words);
  /// `from` is another name of `to` in what the run reports.
  void add(const std::string& from, const std::string& to);
  /// What a run reported, with the names of the bundle in place of all that were added or that inner() was asked for.
  std::string text(std::string words) const;
  /// The same for each text of a document.
  Json document(Json json) const;

 private:
  struct LongestFirst {
    bool operator()(const std::string& a, const std::string& b) const {
      return a.size() != b.size() ? a.size() > b.size() : a < b;
    }
  };

  std::string outside(const std::filesystem::path& path);
  std::string unused(const std::string& folder, const std::string& name);
  void add_folder(std::filesystem::path folder, std::string name);

  std::filesystem::path here_;
  std::map<std::filesystem::path, std::string> named_;  ///< files and folders, from the root
  std::set<std::string> used_;
  std::map<std::string, std::string, LongestFirst> renamed_;
};

/// From `here`, without dots: what is read or written under one name has one. Leads upwards ("../x") or is empty where
/// it is outside.
std::filesystem::path seen_from(const std::filesystem::path& here, const std::filesystem::path& path);
bool leads_out(const std::filesystem::path& seen);
/// Any name as one that a bundle may hold, and itself where it may.
std::string tame(std::string_view name);
/// The folder that the process stands in; empty where it is gone.
std::filesystem::path working_folder();

}  // namespace fusee::cli
