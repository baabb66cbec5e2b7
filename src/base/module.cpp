#include "base/module.h"

#include <dlfcn.h>
#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <system_error>

namespace fusee {
namespace {

namespace fs = std::filesystem;

/// Folder of the modules, relative to the installation or build folder.
constexpr const char* k_modules = FUSEE_MODULES;

/// A module is loaded only when the superuser or the owner of the program owns it.
bool is_trusted(const fs::path& module, const fs::path& program) {
  struct stat of_module {
  }, of_program{};
  if (::stat(module.c_str(), &of_module) != 0 || ::stat(program.c_str(), &of_program) != 0) return false;
  return of_module.st_uid == 0 || of_module.st_uid == of_program.st_uid;
}

/// The file that contains this function: the program, or a shared library.
fs::path own_file() {
  std::error_code ignored;
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&load_module), &info) != 0 && info.dli_fname != nullptr) {
    const fs::path path = fs::weakly_canonical(info.dli_fname, ignored);
    if (path.extension() == ".so") return path;
  }
  return fs::read_symlink("/proc/self/exe", ignored);
}

/// Searches upwards from the program: bin/ and lib/…/fusee/modules/ are siblings. Test programs and the Python module
/// (lib/python3/dist-packages/fusee) lie deeper.
std::optional<fs::path> module_file(const std::string& name) {
  constexpr int k_levels = 5;
  const fs::path program = own_file();
  fs::path folder = program.parent_path();
  for (int level = 0; level < k_levels && folder.has_relative_path(); ++level, folder = folder.parent_path()) {
    const fs::path module = folder / k_modules / (name + ".so");
    if (is_trusted(module, program)) return module;
  }
  return std::nullopt;
}

}  // namespace

SystemLibrary::SystemLibrary(const char* soname) : handle_(::dlopen(soname, RTLD_NOW | RTLD_LOCAL)) {}

void* SystemLibrary::symbol(const char* name) const { return handle_ == nullptr ? nullptr : ::dlsym(handle_, name); }

LoadedModule load_module(const std::string& name, const char* symbol) {
  const auto file = module_file(name);
  if (!file) return {nullptr, "its module " + name + " is not installed beside it"};
  void* module = ::dlopen(file->c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) return {nullptr, "its module " + name + " cannot be loaded: " + ::dlerror()};
  const void* found = ::dlsym(module, symbol);
  if (found == nullptr) return {nullptr, "its module " + name + " is of another version"};
  return {found, {}};
}

}  // namespace fusee
