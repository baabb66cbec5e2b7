/// \file
/// Internal: code loaded on demand. A module serves few runs and would slow every start: it is a shared library in
/// lib/…/fusee/modules next to bin/fusee, with one exported symbol.
#pragma once

#include <string>

namespace fusee {

struct LoadedModule {
  const void* found = nullptr;  ///< address of the symbol; null on failure
  std::string why_not;          ///< reason when nothing was found: "its module fusee-step is not installed beside it"
};

/// Loads a module and finds one symbol in it. The module is never unloaded, because libraries keep pointers into it.
/// `name` is the file's stem; `symbol` contains the interface version.
LoadedModule load_module(const std::string& name, const char* symbol);

/// A system library loaded on demand, so that only the runs that need it pay for it. It is searched like a linked
/// library and stays loaded.
class SystemLibrary {
 public:
  explicit SystemLibrary(const char* soname);
  bool is_there() const { return handle_ != nullptr; }
  /// A function of the library's C interface; null when the library or the function is missing.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;
  void* handle_ = nullptr;
};

}  // namespace fusee
