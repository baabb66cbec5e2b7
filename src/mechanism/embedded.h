/// \file
/// Internal: the files of profiles/, compiled in (embed_profiles.cmake).
#pragma once

#include <string_view>
#include <vector>

namespace fusee {

struct EmbeddedFile {
  std::string_view name;  ///< without the suffix
  std::string_view text;
};

const std::vector<EmbeddedFile>& embedded_templates();  ///< profiles/*.toml
const std::vector<EmbeddedFile>& embedded_catalogue();  ///< profiles/catalogue/*.toml

}  // namespace fusee
