/// \file
/// Names of files inside a bundle. A path within the run's folder keeps its name. Others become outside/NAME, or
/// outside_2/NAME … for further folders. So a bundle contains no absolute path, and no user name, except in the files
/// that it packs.
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
  /// `here`: the run's working folder; empty if it no longer exists.
  explicit BundleNames(const std::filesystem::path& here);

  /// The name of a path inside the bundle; "." for the working folder. Names are unique.
  std::string inner(const std::filesystem::path& path);
  /// A command line with its paths renamed.
  std::vector<std::string> inner_words(const std::vector<std::string>& words);
  /// Replaces `from` by `to` in the run's messages.
  void add(const std::string& from, const std::string& to);
  /// Replaces all names from add() and inner() in a message by their names in the bundle.
  std::string text(std::string message) const;
  /// Replaces the names in every text of a document.
  Json document(Json json) const;

 private:
  struct LongestFirst {
    bool operator()(const std::string& a, const std::string& b) const {
      return a.size() != b.size() ? a.size() > b.size() : a < b;
    }
  };

  /// A new name outside/… for an absolute path.
  std::string outside(const std::filesystem::path& absolute);
  /// folder + name, with a number between them if that name is used.
  std::string unused(const std::string& folder, const std::string& name);
  void add_folder(std::filesystem::path folder, std::string name);

  std::filesystem::path here_;
  std::map<std::filesystem::path, std::string> named_;        ///< absolute path of a file or folder → its name
  std::set<std::string> used_;                                ///< names of the bundle, each given once
  std::map<std::string, std::string, LongestFirst> renamed_;  ///< name in messages → its replacement
};

/// The normalised path relative to `here`, so that equal files have equal names. Empty, or beginning with "..", for a
/// path outside.
std::filesystem::path path_from(const std::filesystem::path& here, const std::filesystem::path& path);
/// True for a path of path_from() that leads out of its folder.
bool is_outside(const std::filesystem::path& relative);
/// A valid bundle name for any name; unchanged if it is valid.
std::string valid_inner_name(std::string_view name);
/// The working folder of the process; empty if it no longer exists.
std::filesystem::path working_folder();

}  // namespace fusee::cli
