/// \file
/// --bundle: what a run reads and leaves is watched, and packed when it has ended, however it did.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/bundle.h"
#include "cli/bundle_names.h"
#include "cli/run.h"
#include "fusee/base/file_access.h"

namespace fusee::cli {

/// The value of --bundle, "" without one; `words` without it. Also of a command line that cannot be understood.
std::string take_bundle_option(std::vector<std::string>& words);

/// What a run reported, with the names that a bundle has for files.
BundledOutcome outcome_of(Ending ending, std::vector<BundledOutput> outputs, const BundleNames& names);
/// Its folder is named by the command line, if at all.
BundledOutput output_of(const std::filesystem::path& path, std::string_view bytes);
/// This program, as a bundle names it.
void sign(Bundle& bundle);

/// Watches what the run does with files while it lives.
class Recording : public FileAccess {
 public:
  /// Throws OutputError when `file` stands there and is no bundle, unless `force`.
  Recording(std::filesystem::path file, const std::vector<std::string>& words, bool force);

  void read(const ReadRequest& request, const TakeBlock& take) override;
  void will_write(const std::filesystem::path&) override {}
  void in_the_way(const std::filesystem::path& path) override;
  void wrote(const std::filesystem::path& name, std::string_view bytes) override {
    bundle_.outcome.outputs.push_back(output_of(name, bytes));
  }

  /// Writes the bundle; what it says is for the person. Throws OutputError.
  Diagnostic pack(const Ending& ending);

 private:
  std::filesystem::path file_;
  bool force_;
  BundleNames names_;
  Bundle bundle_;
  std::uint64_t kept_ = 0;  ///< bytes of files
};

}  // namespace fusee::cli
