/// \file
/// A mechanism that goes from one process to another with all the files that it was read from.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "fusee/mechanism/file.h"

namespace fusee::python {

/// Path, as it is asked for, → bytes.
using CarriedFiles = std::map<std::string, std::string>;

/// While one lives, this thread reads these files in place of the disk's.
class Carrying {
 public:
  /// What is read from the disk all the same is kept in `seen`, where there is one.
  explicit Carrying(const CarriedFiles& files, CarriedFiles* seen = nullptr);
  ~Carrying();
  Carrying(const Carrying&) = delete;
  Carrying& operator=(const Carrying&) = delete;
};

/// Once in the life of the module: from here on all reading asks for what is carried.
void read_carried_files_first();

/// A mechanism as it was read, and what it takes to read it anew anywhere.
struct CarriedMechanism {
  MechanismFile file;
  std::vector<Setting> settings;
  CarriedFiles files;

  /// The same file with more settings, the last of a key first in its say. InputError.
  CarriedMechanism with(const std::vector<Setting>& more) const;
};

/// As read_mechanism(), `files` before the disk. InputError.
CarriedMechanism read_carried(const std::filesystem::path& path, std::vector<Setting> settings, CarriedFiles files);

}  // namespace fusee::python
