#include "python/carried.h"

#include <algorithm>

#include "fusee/base.h"

namespace fusee::python {

void CarriedAccess::read(const ReadRequest& request, const TakeBlock& take) {
  const std::string name = request.path.string();
  if (const auto found = files_.find(name); found != files_.end()) {
    const std::string& bytes = found->second;
    if (bytes.size() > request.limit)
      throw InputError(name, "is larger than " + std::to_string(request.limit) + " bytes",
                       "check that it is the right file");
    if (!bytes.empty()) take(bytes);
    return;
  }
  std::string bytes;
  FileAccess::read(request, [&](std::string_view block) {
    if (read_from_disk_ != nullptr) bytes += block;
    take(block);
  });
  if (read_from_disk_ != nullptr) read_from_disk_->insert_or_assign(name, std::move(bytes));
}

CarriedMechanism CarriedMechanism::with(const std::vector<Setting>& more) const {
  std::vector<Setting> all = settings;
  for (const Setting& setting : more) {
    std::erase_if(all, [&setting](const Setting& earlier) { return earlier.key == setting.key; });
    all.push_back(setting);
  }
  return read_carried(file.path, std::move(all), files);
}

CarriedMechanism read_carried(const std::filesystem::path& path, std::vector<Setting> settings, CarriedFiles files) {
  CarriedMechanism carried;
  CarriedFiles read_from_disk;
  CarriedAccess access(files, &read_from_disk);
  carried.file = read_mechanism(path, settings, access);
  carried.settings = std::move(settings);
  carried.files = std::move(files);
  carried.files.merge(read_from_disk);
  return carried;
}

}  // namespace fusee::python
