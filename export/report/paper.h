/// \file
/// The reproduced paper as files: figures (SVG), numbers (CSV), and a page of the claims (Markdown).
#pragma once

#include <string>
#include <vector>

#include "fusee/base.h"
#include "paper/reproduction.h"

namespace fusee::formats {

/// paper.md, which is also docs/background/paper.md.
std::string paper_page(const paper::Reproduction& reproduction);

/// fig_04.svg and fig_04.csv …, table_4.csv, claims.csv, laws.csv, mu_windows.csv, paper.md, and manifest.json, which
/// lists them.
std::vector<OutputFile> paper_files(const paper::Reproduction& reproduction);

/// The range in which a claim holds, in words: "mu 0.132 to 0.249; r1 up to 21 mm".
std::string claim_windows_text(const paper::Claim& claim);

}  // namespace fusee::formats
