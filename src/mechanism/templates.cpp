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
  std::string block;
  for (std::string_view text = known.text; text.starts_with("# ");) {
    const std::string_view line = text.substr(2, text.find('\n') - 2);
    block += (block.empty() ? "" : " ") + std::string(line);
    text.remove_prefix(std::min(text.find('\n') + 1, text.size()));
  }
  const std::size_t end = block.find(". ");
  return end == std::string::npos ? block : block.substr(0, end + 1);
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
