/// \file
/// What may stand at the end of a command line that is being typed, for the shells that ask with the Tab key.
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
  bool files = false;    ///< names of files may stand there too …
  std::string ending;    ///< … that end so (".toml"); "": of any
  bool goes_on = false;  ///< no blank behind the word: "pulley.r1_mm="
};

/// `line` as it is typed up to the cursor, with the program's name: "fusee build arm.toml --se".
Candidates candidates(std::string_view line);

}  // namespace fusee::cli
