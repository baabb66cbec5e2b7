/// \file
/// Completion of a command line, for shells that ask with the Tab key.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fusee::cli {

struct Candidate {
  std::string word;
  std::string meaning;  ///< one line, may be empty
};

struct Candidates {
  std::vector<Candidate> words;
  bool files = false;    ///< file names are possible, too
  std::string ending;    ///< required ending of file names (".toml"); "": any
  bool goes_on = false;  ///< no blank after the word: "pulley.r1_mm="
};

/// Candidates for the last word of `line`, which is typed up to the cursor and begins with the program's name.
Candidates candidates(std::string_view line);

}  // namespace fusee::cli
