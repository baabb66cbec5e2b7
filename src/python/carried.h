/// \file
/// Mechanisms that are sent to another process together with the files that they were read from.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee::python {

/// Requested path → content.
using CarriedFiles = std::map<std::string, std::string>;

/// Reads these files instead of those on the disk.
class CarriedAccess : public FileAccess {
 public:
  /// Files that are still read from the disk are added to `read_from_disk`, if given.
  explicit CarriedAccess(const CarriedFiles& files, CarriedFiles* read_from_disk = nullptr)
      : files_(files), read_from_disk_(read_from_disk) {}
  void read(const ReadRequest& request, const TakeBlock& take) override;

 private:
  const CarriedFiles& files_;
  CarriedFiles* read_from_disk_;
};

/// A mechanism as it was read, and everything that reading it again requires.
struct CarriedMechanism {
  MechanismFile file;
  std::vector<Setting> settings;
  CarriedFiles files;

  /// The mechanism with further settings; the last value of a key applies. Throws InputError.
  CarriedMechanism with(const std::vector<Setting>& more) const;
};

/// As read_mechanism(), with `files` in preference to the disk. Throws InputError.
CarriedMechanism read_carried(const std::filesystem::path& path, std::vector<Setting> settings, CarriedFiles files);

}  // namespace fusee::python
