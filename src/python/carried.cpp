#include "python/carried.h"

#include <algorithm>

#include "fusee/base/file_access.h"

namespace fusee::python {
namespace {

thread_local const CarriedFiles* served = nullptr;
thread_local CarriedFiles* kept = nullptr;

class CarriedFirst : public FileAccess {
 public:
  void read(const ReadRequest& request, const TakeBlock& take) override {
    const std::string name = request.path.string();
    if (const std::string* bytes = carried(name)) {
      if (bytes->size() > request.limit)
        throw InputError(name, "is larger than " + std::to_string(request.limit) + " bytes",
                         "check that it is the right file");
      if (!bytes->empty()) take(*bytes);
      return;
    }
    std::string seen;
    read_from_disk(request, [&](std::string_view block) {
      if (kept != nullptr) seen += block;
      take(block);
    });
    if (kept != nullptr) kept->insert_or_assign(name, std::move(seen));
  }
  void will_write(const std::filesystem::path&) override {}
  void wrote(const std::filesystem::path&, std::string_view) override {}

 private:
  static const std::string* carried(const std::string& name) {
    if (served == nullptr) return nullptr;
    const auto found = served->find(name);
    return found == served->end() ? nullptr : &found->second;
  }
};

}  // namespace

Carrying::Carrying(const CarriedFiles& files, CarriedFiles* seen) {
  served = &files;
  kept = seen;
}
Carrying::~Carrying() {
  served = nullptr;
  kept = nullptr;
}

void read_carried_files_first() {
  // Never removed: threads may still read after the interpreter has ended.
  static const auto* const access = new CarriedFirst();
  static_cast<void>(access);
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
  CarriedFiles seen;
  {
    const Carrying carrying(files, &seen);
    carried.file = read_mechanism(path, settings);
  }
  carried.settings = std::move(settings);
  carried.files = std::move(files);
  carried.files.merge(seen);
  return carried;
}

}  // namespace fusee::python
