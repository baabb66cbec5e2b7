/// \file
/// Internal: elements of a page: filled template, lists, key numbers. Arguments called words are escaped here.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fusee/mechanism.h"

namespace fusee::formats {

/// The page with the title of its column in each table cell (data-label): a narrow window shows rows as blocks. Titles
/// are HTML without elements.
std::string with_labelled_cells(const std::string& page);

using PageParts = std::map<std::string, std::string, std::less<>>;
/// Replaces every {{name}} of the template once. Inserted text (HTML, not escaped) is not scanned again, so that no
/// text of a user can name a part.
std::string filled_page(std::string_view page, const PageParts& parts);

/// A self-contained page without a template. Members not called words are HTML.
struct Page {
  std::string title;   ///< words in the browser's tab beside the name: "calibration"
  std::string kicker;  ///< words above the name: "Calibration report"
  std::string name;    ///< words; "" for an unnamed joint
  std::string source;
  std::string body;
  std::string foot;  ///< words
  std::vector<std::string_view> styles;
  std::vector<std::string_view> scripts;  ///< empty: the page must not run scripts
};
std::string html_page(const Page& page);

/// "" if the body is empty.
std::string html_section(const std::string& id, const std::string& title, const std::string& body);

/// A title that begins with '#' heads a column of numbers. `rows`: HTML.
std::string html_table(const std::vector<std::string>& titles, const std::string& rows);
std::string html_cell(const std::string& words);
std::string html_number_cell(const std::string& words);

/// `tag`: "ul" or "ol"; `style`: a CSS class. "" for no items.
std::string html_list(const std::vector<std::string>& items, const std::string& tag = "ul",
                      const std::string& style = "");

/// The numbers at the top of a page: term, value, and a remark in small print.
class KeyNumbers {
 public:
  void add(const std::string& term, const std::string& value, const std::string& remark = {});
  /// Lengths are shown in `units`.
  std::string html(LengthUnit units = LengthUnit::mm) const;

 private:
  std::string html_;
};

}  // namespace fusee::formats
