/// \file
/// What files of this machine are called in a bundle. A path within the folder of the run keeps its name from there;
/// any other is outside/NAME, those of another folder outside_2/NAME …: no absolute path, and so no person, stands in
/// the bundle that was not in a file that it packs.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fusee::cli {

class BundleNames {
 public:
  explicit BundleNames(std::filesystem::path here) : here_(std::move(here)) {}

  /// The path as the bundle has it; what the run says of it later is renamed alike.
  std::string inner(const std::filesystem::path& path);
  /// `from` is another name of `to` in what the run says.
  void add(const std::string& from, const std::string& to);
  /// A command line with its paths renamed.
  std::vector<std::string> inner_words(const std::vector<std::string>& words);
  /// How a run of inner_words() may ask for what this one asked for: see BundledFile::asked.
  std::vector<std::string> asked(const std::filesystem::path& path) const;
  /// Without names of this machine.
  std::string text(std::string words) const;

 private:
  std::optional<std::string> home_of(const std::filesystem::path& whole) const;

  std::filesystem::path here_;
  std::map<std::filesystem::path, std::string> named_;    ///< from the root
  std::map<std::filesystem::path, std::string> outside_;  ///< a folder, and its name in the bundle
  std::map<std::string, std::string> renamed_;
  std::vector<std::string> set_paths_;  ///< absolute ones of --set, which are taken from the mechanism file's folder
  std::string spec_folder_;             ///< of the renamed one
};

/// From `here`, without dots: what is read or written under one name has one. Leads upwards ("../x") where it is
/// outside.
std::filesystem::path seen_from(const std::filesystem::path& here, const std::filesystem::path& path);
/// "sha256:…" of an absolute path.
std::string hidden_path(const std::filesystem::path& path);

}  // namespace fusee::cli
