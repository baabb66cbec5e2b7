/// \file
/// Internal: code that is loaded when it is asked for. What few runs need and every start would pay for is a module: a
/// file in lib/…/fusee/modules beside bin/fusee, with one thing in it that is found by its name.
#pragma once

#include <string>

namespace fusee {

struct LoadedModule {
  const void* found = nullptr;
  std::string why_not;  ///< where nothing was: "its module fusee-step is not installed beside it"
};

/// Loaded for good: libraries keep what they have registered. `name` is the file's without its end, `symbol` has the
/// interface's version in it.
LoadedModule load_module(const std::string& name, const char* symbol);

/// A library of the system that is loaded when it is asked for, in place of one that every start would pay for. It is
/// found as the linker finds it, and stays loaded.
class SystemLibrary {
 public:
  explicit SystemLibrary(const char* soname);
  bool is_there() const { return handle_ != nullptr; }
  /// A function of its C interface; null where the library is absent or has none of this name.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }

 private:
  void* symbol(const char* name) const;
  void* handle_ = nullptr;
};

}  // namespace fusee
