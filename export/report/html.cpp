#include "export/report/html.h"

#include "export/report/svg.h"
#include "export/tool.h"
#include "fusee/base.h"
#include "mechanism/lengths.h"

namespace fusee::formats {

namespace {

/// The texts of the header cells of a table.
std::vector<std::string> titles_of(std::string_view table) {
  std::vector<std::string> titles;
  for (std::size_t at = table.find("<th"); at != std::string_view::npos; at = table.find("<th", at)) {
    at += 3;
    if (table.substr(at, 3) == "ead") continue;  // <thead>
    const std::size_t begin = table.find('>', at) + 1;
    titles.emplace_back(table.substr(begin, table.find("</th>", begin) - begin));
  }
  return titles;
}

/// The table with the title of its column in each cell, as with_labelled_cells() does for a page.
std::string with_labels(std::string_view table) {
  const std::vector<std::string> titles = titles_of(table);
  std::string html;
  std::size_t from = 0, column = 0;
  for (std::size_t at = table.find("<t"); at != std::string_view::npos; at = table.find("<t", at + 2)) {
    if (table.substr(at, 3) == "<tr") column = 0;
    if (table.substr(at, 3) != "<td") continue;
    if (column < titles.size() && !titles[column].empty()) {
      html.append(table.substr(from, at + 3 - from));
      html += " data-label=\"" + titles[column] + "\"";
      from = at + 3;
    }
    ++column;
  }
  return html.append(table.substr(from));
}

}  // namespace

std::string with_labelled_cells(const std::string& page) {
  std::string html;
  std::size_t from = 0;
  for (std::size_t at = page.find("<table>"); at != std::string::npos; at = page.find("<table>", at)) {
    const std::size_t end = page.find("</table>", at);
    html.append(page, from, at - from);
    html += with_labels(std::string_view(page).substr(at, end - at));
    from = at = end;
  }
  return html.append(page, from);
}

std::string filled_page(std::string_view page, const PageParts& parts) {
  std::string html;
  for (std::size_t at = 0;;) {
    const std::size_t open = page.find("{{", at);
    if (open == std::string_view::npos) return with_labelled_cells(html + std::string(page.substr(at)));
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto part = parts.find(name);
    demand(part != parts.end(), "report template asks for {{" + std::string(name) + "}}");
    html += page.substr(at, open - at);
    html += part->second;
    at = close + 2;
  }
}

std::string html_page(const Page& page) {
  const std::string name = page.name.empty() ? "unnamed" : safe_text(page.name);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"/>\n<meta name=\"color-scheme\" content=\"light dark\"/>\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'" +
      std::string(page.scripts.empty() ? "" : "; script-src 'unsafe-inline'") +
      "\"/>\n<meta name=\"generator\" content=\"" + std::string(k_tool) + "\"/>\n<title>" + name + " – " +
      safe_text(page.title) + "</title>\n<style>";
  for (const std::string_view style : page.styles) html += style;
  html += "</style>\n</head>\n<body>\n<header>\n<p class=\"kicker\">" + safe_text(page.kicker) + "</p>\n<h1>" + name +
          "</h1>\n<p class=\"source\">" + page.source + "</p>\n</header>\n<main>\n" + page.body +
          "</main>\n<footer><p>Made by " + std::string(k_tool) + ". " + safe_text(page.foot) + "</p></footer>\n";
  if (!page.scripts.empty()) {
    html += "<script>//<![CDATA[\n";
    for (const std::string_view script : page.scripts) html += script;
    html += "//]]></script>\n";
  }
  return with_labelled_cells(html + "</body>\n</html>\n");
}

std::string html_section(const std::string& id, const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section id=\"" + id + "\"><h2>" + safe_text(title) + "</h2>" + body + "</section>\n";
}

std::string html_table(const std::vector<std::string>& titles, const std::string& rows) {
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& title : titles) {
    const bool numbers = !title.empty() && title[0] == '#';
    html += (numbers ? "<th class=\"number\">" : "<th>") + safe_text(numbers ? title.substr(1) : title) + "</th>";
  }
  return html + "</tr></thead><tbody>" + rows + "</tbody></table></div>";
}

std::string html_cell(const std::string& words) { return "<td>" + safe_text(words) + "</td>"; }
std::string html_number_cell(const std::string& words) { return "<td class=\"number\">" + safe_text(words) + "</td>"; }

std::string html_list(const std::vector<std::string>& items, const std::string& tag, const std::string& style) {
  if (items.empty()) return "";
  std::string html = "<" + tag + (style.empty() ? ">" : " class=\"" + style + "\">");
  for (const std::string& item : items) html += "<li>" + safe_text(item) + "</li>";
  return html + "</" + tag + ">";
}

std::string KeyNumbers::html(LengthUnit units) const {
  return "<dl class=\"numbers\">" + lengths_in(units, html_) + "</dl>";
}

void KeyNumbers::add(const std::string& term, const std::string& value, const std::string& remark) {
  html_ += "<div><dt>" + safe_text(term) + "</dt><dd>" + safe_text(value);
  if (!remark.empty()) html_ += " <small>" + safe_text(remark) + "</small>";
  html_ += "</dd></div>";
}

}  // namespace fusee::formats
