/// \file
/// Pieces of a page: a template filled, lists, key numbers. What is handed in as words is escaped here.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace fusee {

using PageParts = std::map<std::string, std::string, std::less<>>;
/// Replaces every {{name}} of the template once; what is put in (HTML, not escaped) is not looked at again, so that no
/// text of a user can name a part.
std::string filled_page(std::string_view page, const PageParts& parts);

/// A page that needs nothing else, without a template. What is not called words is HTML.
struct Page {
  std::string title;   ///< words, in the browser's tab beside the name: "calibration"
  std::string kicker;  ///< words over the name: "Calibration report"
  std::string name;    ///< words; "" is unnamed
  std::string source;
  std::string body;
  std::string foot;  ///< words
  std::vector<std::string_view> styles;
  std::vector<std::string_view> scripts;  ///< none: the page may run none
};
std::string html_page(const Page& page);

/// "" where the body is empty.
std::string html_section(const std::string& id, const std::string& title, const std::string& body);

/// A title that begins with '#' stands over numbers. `rows`: HTML.
std::string html_table(const std::vector<std::string>& titles, const std::string& rows);
std::string html_cell(const std::string& words);
std::string html_number_cell(const std::string& words);

/// `tag`: "ul" or "ol"; `style`: a class of the page's. "" for no items.
std::string html_list(const std::vector<std::string>& items, const std::string& tag = "ul",
                      const std::string& style = "");

/// The numbers that a page begins with: term, value, and a remark in small print.
class KeyNumbers {
 public:
  void add(const std::string& term, const std::string& value, const std::string& remark = {});
  std::string html() const { return "<dl class=\"numbers\">" + html_ + "</dl>"; }

 private:
  std::string html_;
};

}  // namespace fusee
