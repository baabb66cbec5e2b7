/// \file
/// --bundle: records the files that a run reads and writes, and packs them at the end of the run, whatever its result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/bundle.h"
#include "cli/bundle_names.h"
#include "cli/run.h"
#include "fusee/base.h"

namespace fusee::cli {

/// Removes --bundle from `words` and returns its value, "" without one. Also for command lines that cannot be parsed.
std::string take_bundle_option(std::vector<std::string>& words);

/// The outcome of a run, with files named as in the bundle.
BundledOutcome outcome_of(CommandOutcome run_outcome, std::vector<BundledOutput> outputs, const BundleNames& names);
/// Name, size and hash of an output, whose bytes are in the file `bytes_at`. The name has no folder: if one was given,
/// the command line states it.
BundledOutput output_of(const std::filesystem::path& path, const std::filesystem::path& bytes_at);
/// Adds version and build of this program.
void add_build_info(Bundle& bundle);

/// Records the file access of a run. Once files are published, a signal has no effect.
class Recording : public FileAccess {
 public:
  /// Throws OutputError if `file` exists and is not a bundle, unless `force`.
  Recording(std::filesystem::path file, const std::vector<std::string>& words, bool force);

  void read(const ReadRequest& request, const TakeBlock& take) override;
  void in_the_way(const std::filesystem::path& path) override;
  void will_publish(const std::filesystem::path& name, const std::filesystem::path& bytes_at) override;
  bool is_bundled() const override { return true; }

  /// Writes the bundle and returns a message for the user. Throws OutputError.
  Diagnostic pack(const CommandOutcome& run_outcome);

 private:
  std::filesystem::path file_;
  bool force_;
  BundleNames names_;
  Bundle bundle_;
  std::uint64_t packed_bytes_ = 0;  ///< of all files in the bundle
};

}  // namespace fusee::cli
