#include "fusee/mechanism_file.h"
#include "mechanism/catalogue.h"
#include "mechanism/embedded.h"
#include "mechanism/field_text.h"

namespace fusee {

std::vector<Template> templates() {
  std::vector<Template> all;
  for (const TemplateType& type : template_types())
    all.push_back({type.name, find_template(type.name), type.group, type.description});
  return all;
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

std::vector<TemplateTable> template_tables() {
  std::vector<TemplateTable> all;
  for (const EmbeddedFile& table : embedded_tables()) {
    const std::string file = std::string(table.name) + ".csv";
    for (const EmbeddedFile& known : embedded_templates())
      if (known.text.find('"' + file + '"') != std::string_view::npos)
        all.push_back({std::string(known.name), file, table.text});
  }
  return all;
}

}  // namespace fusee
