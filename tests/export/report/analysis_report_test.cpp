// The page of `fusee analyze`: well-formed, self-contained, and consistent with the result.
#include <gmock/gmock.h>

#include <pugixml.hpp>

#include "export/report/analysis.h"
#include "export/report/tables.h"
#include "support/mechanisms.h"

namespace fusee::formats {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct AnalysisCase {
  MechanismFile file;
  analysis::AnalysisOptions options;
  analysis::AnalysisResult result;
};

AnalysisCase analysed() {
  AnalysisCase analysed;
  analysed.file.mechanism = testing::forearm();
  analysed.file.mechanism.name = "fore<arm>";
  analysed.file.path = "somewhere/forearm.toml";
  analysed.options.samples = 10;
  analysed.result = analysis::analyse(analysed.file.mechanism, analysed.options);
  return analysed;
}

TEST(AnalysisPage, AgreesWithResult) {
  const AnalysisCase a = analysed();
  Diagnostic warning;
  warning.message = "beware & see";
  warning.hint = "do <this>";
  const std::string html = analysis_html(a.file, a.result, a.options, {warning});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(html.c_str()));
  EXPECT_STREQ(document.select_node("//h1").node().text().as_string(), "fore<arm>");
  for (const char* id : {"numbers", "moving", "forces", "budget", "tolerances"})
    EXPECT_EQ(document.select_nodes(("//section[@id='" + std::string(id) + "']").c_str()).size(), 1u) << id;
  EXPECT_THAT(html, HasSubstr(with_unit(a.result.largest_tension.tension, "N")));
  EXPECT_THAT(html, HasSubstr("beware &amp; see – do &lt;this&gt;"));
  EXPECT_EQ(document.select_nodes("//section[@id='budget']//tbody/tr").size(), a.result.sources.size());
  EXPECT_EQ(document.select_nodes("//section[@id='tolerances']//tbody/tr").size(), a.result.tolerances.size());
}

TEST(AnalysisPage, IsSelfContainedAndDeterministic) {
  const AnalysisCase a = analysed();
  const std::string html = analysis_html(a.file, a.result, a.options, {});
  for (const char* reference : {"://", "src=", "href=", "url(", "@import", "fetch(", "somewhere"})
    EXPECT_THAT(html, Not(HasSubstr(reference)));
  EXPECT_EQ(html, analysis_html(a.file, a.result, a.options, {}));
}

TEST(AnalysisPage, HasOnlyForcesWithoutCurves) {
  AnalysisCase a = analysed();
  a.result.synthesis.p1.points.clear();
  const std::string html = analysis_html(a.file, a.result, a.options, {});
  EXPECT_THAT(html, Not(HasSubstr("id=\"moving\"")));
  EXPECT_THAT(html, HasSubstr("id=\"forces\""));
}

}  // namespace
}  // namespace fusee::formats
