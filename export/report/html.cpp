#include "export/report/html.h"

#include "export/report/svg.h"
#include "fusee/base/diagnostics.h"

namespace fusee {

std::string filled_page(std::string_view page, const PageParts& parts) {
  std::string html;
  for (std::size_t at = 0;;) {
    const std::size_t open = page.find("{{", at);
    if (open == std::string_view::npos) return html + std::string(page.substr(at));
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto part = parts.find(name);
    demand(part != parts.end(), "report template asks for {{" + std::string(name) + "}}");
    html += page.substr(at, open - at);
    html += part->second;
    at = close + 2;
  }
}

std::string html_list(const std::vector<std::string>& items, const std::string& tag, const std::string& style) {
  if (items.empty()) return "";
  std::string html = "<" + tag + (style.empty() ? ">" : " class=\"" + style + "\">");
  for (const std::string& item : items) html += "<li>" + safe_text(item) + "</li>";
  return html + "</" + tag + ">";
}

void KeyNumbers::add(const std::string& term, const std::string& value, const std::string& remark) {
  html_ += "<div><dt>" + safe_text(term) + "</dt><dd>" + safe_text(value);
  if (!remark.empty()) html_ += " <small>" + safe_text(remark) + "</small>";
  html_ += "</dd></div>";
}

}  // namespace fusee
