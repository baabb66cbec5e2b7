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
  std::string comment;
  for (std::string_view text = known.text; text.starts_with("# ") && !comment.ends_with('.');) {
    const std::string_view line = text.substr(2, text.find('\n') - 2);
    comment += (comment.empty() ? "" : " ") + std::string(line);
    text.remove_prefix(std::min(line.size() + 3, text.size()));
  }
  return comment;
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
