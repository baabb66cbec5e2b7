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

}  // namespace fusee
