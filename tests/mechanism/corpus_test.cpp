// Replays the fuzzing corpus: for any bytes, reading returns a mechanism or throws InputError; a mechanism whose
// numbers are written again stays the same.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"
#include "fuzz/edit_laws.h"

namespace fusee {
namespace {

/// The mechanism of a file; empty when it is rejected with a diagnostic.
std::optional<DeclaredMechanism> read_or_reject(const std::string& text, const std::filesystem::path& folder) {
  try {
    return parse_mechanism(text, "corpus", folder);
  } catch (const InputError& error) {
    EXPECT_FALSE(error.diagnostics().empty());
    return std::nullopt;
  }
}

TEST(Corpus, EveryFileIsReadOrRejected) {
  const std::filesystem::path corpus = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/fuzz/corpus/mechanism";
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    SCOPED_TRACE(entry.path());
    const std::string text = read_file(entry.path(), 16 << 20);
    const std::optional<DeclaredMechanism> mechanism = read_or_reject(text, corpus);
    ++(mechanism ? read : refused);
    if (!mechanism) continue;
    EXPECT_TRUE(parse_mechanism(write_mechanism(*mechanism), "written", corpus) == *mechanism);
    EXPECT_TRUE(edit_laws::keeps_mechanism(text, *mechanism, 0, 1));
  }
  EXPECT_GE(read, 3);
  EXPECT_GE(refused, 15);
}

}  // namespace
}  // namespace fusee
