// Replays the fuzzing corpus: for any bytes, reading returns a mechanism or throws InputError.
#include <gtest/gtest.h>

#include <filesystem>

#include "fusee/base.h"
#include "fusee/mechanism_file.h"

namespace fusee {
namespace {

TEST(Corpus, EveryFileIsReadOrRejected) {
  const std::filesystem::path corpus = std::filesystem::path(FUSEE_SOURCE_DIR) / "tests/fuzz/corpus/mechanism";
  int read = 0, refused = 0;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    const std::string text = read_file(entry.path(), 16 << 20);
    try {
      const DeclaredMechanism mechanism = parse_mechanism(text, "corpus", corpus);
      EXPECT_TRUE(parse_mechanism(write_mechanism(mechanism), "written", corpus) == mechanism) << entry.path();
      ++read;
    } catch (const InputError& error) {
      EXPECT_FALSE(error.diagnostics().empty()) << entry.path();
      ++refused;
    }
  }
  EXPECT_GE(read, 3);
  EXPECT_GE(refused, 15);
}

}  // namespace
}  // namespace fusee
