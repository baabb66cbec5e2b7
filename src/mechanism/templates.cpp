#include "fusee/mechanism_file.h"
#include "mechanism/embedded.h"
#include "mechanism/field_text.h"

namespace fusee {

std::vector<Template> templates() {
  std::vector<Template> all;
  for (const EmbeddedFile& file : embedded_templates()) all.push_back({file.name, file.text});
  return all;
}

std::string first_comment(const Template& known) {
  std::string_view line = known.text.substr(0, known.text.find('\n'));
  if (line.empty() || line[0] != '#') return {};
  line.remove_prefix(std::min(line.find_first_not_of("# "), line.size()));
  return std::string(line);
}

std::string_view find_template(std::string_view name) {
  std::vector<std::string> names;
  std::string list;
  for (const EmbeddedFile& file : embedded_templates()) {
    if (file.name == name) return file.text;
    names.emplace_back(file.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  const std::string nearest = nearest_word(name, names);
  throw InputError("", "there is no template " + in_quotes(name),
                   (nearest.empty() ? "" : "did you mean " + nearest + "? ") + std::string("Known templates: ") + list);
}

}  // namespace fusee
