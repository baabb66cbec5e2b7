/// \file
/// Internal: the files of profiles/, compiled in (embed_profiles.cmake).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee {

struct EmbeddedFile {
  std::string_view name;  ///< without the suffix
  std::string_view text;
};

const std::vector<EmbeddedFile>& embedded_templates();  ///< profiles/*.toml
const std::vector<EmbeddedFile>& embedded_tables();     ///< profiles/*.csv, the tables of templates' laws
const std::vector<EmbeddedFile>& embedded_catalogue();  ///< profiles/catalogue/*.toml

/// The CSV of a template's law.
struct TemplateTable {
  std::string template_name;  ///< "gripper"
  std::string file;           ///< its name beside the mechanism file, "gripper_law.csv"
  std::string_view text;
};
/// The tables of all templates whose law has one.
std::vector<TemplateTable> template_tables();

}  // namespace fusee
