// Bundle files: round trip, and rejection of hostile input.
#include "base/bundle.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "base/zip.h"
#include "fusee/base.h"

namespace fusee {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr std::size_t k_any_size = 1 << 26;

Bundle example() {
  Bundle bundle;
  bundle.version = "1.2.3";
  bundle.built_with = "a compiler";
  bundle.runs_on = "a machine";
  bundle.words = {"build", "arm.toml", "-o", "outside/made"};
  bundle.files.push_back({"arm.toml", std::string("a\0b\r\n", 5), {}});
  bundle.files.push_back({"outside/law.csv", "", {}});
  Diagnostic failure;
  failure.message = "cannot be read";
  failure.hint = "check the path";
  bundle.files.push_back({"none.csv", "", failure});
  bundle.in_the_way = {"made/pulley.stl", "made/"};
  bundle.outcome.exit = 4;
  Diagnostic warning = failure;
  warning.severity = Severity::warning;
  warning.place = {"arm.toml", 3, 7};
  bundle.outcome.messages = {warning, failure};
  bundle.outcome.result = "a line\n";
  bundle.outcome.outputs = {{"made/pulley.stl", 12, std::string(64, 'f')}};
  return bundle;
}

std::string refusal(const std::string& bytes) {
  try {
    read_bundle(bytes, "bug.zip");
  } catch (const InputError& error) {
    return to_text(error.diagnostics().front());
  }
  return "";
}

/// The entries of the example, to be corrupted.
struct Entries {
  std::string index, result = "a line\n", spec = std::string("a\0b\r\n", 5), law;
  std::vector<ZipEntry> all;
  Entries() {
    const std::string bytes = bundle_bytes(example());
    const ZipArchive archive(bytes, "bug.zip", "a zip");
    std::uint64_t budget = k_any_size;
    index = archive.unpacked(archive.find("bundle.json").value(), budget, "");
    all = {{"bundle.json", index}, {"stdout.txt", result}, {"files/arm.toml", spec}, {"files/outside/law.csv", law}};
  }
};

TEST(Bundles, RoundTrips) {
  const std::string bytes = bundle_bytes(example());
  const Bundle read = read_bundle(bytes, "bug.zip");
  EXPECT_TRUE(is_bundle(bytes));
  EXPECT_EQ(bundle_bytes(read), bytes);
  EXPECT_EQ(read.words, example().words);
  EXPECT_EQ(read.files[0].bytes, example().files[0].bytes);
  EXPECT_EQ(read.files[2].failure->hint, "check the path");
  EXPECT_EQ(read.in_the_way, example().in_the_way);
  EXPECT_EQ(read.outcome.outputs, example().outcome.outputs);
  EXPECT_EQ(read.outcome.messages[0].severity, Severity::warning);
  EXPECT_EQ(read.outcome.messages[0].place.column, 7);
}

TEST(Bundles, RejectEscapingNames) {
  for (const char* name :
       {"../evil", "/evil", "files/../evil", "files/./evil", "files//evil", "files\\evil", "c:evil"}) {
    Entries entries;
    entries.all.push_back({name, "x"});
    EXPECT_THAT(refusal(zip_bytes(entries.all)),
                HasSubstr(std::string("bug.zip: error: ") + name + ": the name leads out of the bundle, or is hidden"));
  }
}

TEST(Bundles, RejectUnlistedEntries) {
  Entries more;
  more.all.push_back({"files/more", "x"});
  EXPECT_THAT(refusal(zip_bytes(more.all)), HasSubstr("files/more: is not listed"));
  Entries less;
  less.all.pop_back();
  EXPECT_THAT(refusal(zip_bytes(less.all)), HasSubstr("the bundle.files[1].path is not in the bundle"));
  Entries changed;
  changed.all[2].bytes = "other";
  EXPECT_THAT(refusal(zip_bytes(changed.all)), HasSubstr("the bundle.files[0].sha256 is not that of files/arm.toml"));
}

TEST(Bundles, RejectMalformedIndex) {
  for (const std::string& index :
       {std::string("{}"), std::string("[]"), std::string(50000, '['), std::string("\0", 1)}) {
    Entries entries;
    entries.all[0].bytes = index;
    EXPECT_THAT(refusal(zip_bytes(entries.all)), HasSubstr("bug.zip: error: bundle.json: "));
  }
  EXPECT_THAT(refusal("PK"), HasSubstr("expected a bundle of fusee, which is a zip archive"));
  EXPECT_THAT(refusal(zip_bytes({{"a", "b"}})), HasSubstr("this is not a bundle of fusee"));
}

Bundle read_again(const Bundle& bundle) { return read_bundle(bundle_bytes(bundle), "bug.zip"); }

std::string refusal_of(const Bundle& bundle) { return refusal(bundle_bytes(bundle)); }

TEST(Bundles, RejectHiddenAndUnprintableNames) {
  for (const char* name : {".fusee-1-x/.publishing", ".hidden", "a/.b", "a/..", ".", "a\u0085b", "a\u202Eb", "a\nb",
                           "a\x1b[2J", "x\uFFFE"}) {
    EXPECT_FALSE(is_inner_path(name)) << name;
    Bundle bundle = example();
    bundle.in_the_way = {name};
    EXPECT_THAT(refusal_of(bundle), HasSubstr("in_the_way is not a list of paths")) << name;
  }
  for (const char* name : {".fusee-1-x/.publishing", ".hidden", "a/.b"}) {
    Bundle bundle = example();
    bundle.files.push_back({name, "x", {}});
    EXPECT_THAT(refusal_of(bundle), HasSubstr("leads out of the bundle, or is hidden")) << name;
  }
  EXPECT_FALSE(is_inner_path("\xff.csv"));
  EXPECT_FALSE(is_inner_path(std::string(256, 'a')));
  for (const char* name : {"a", "größe.csv", "a/b c.csv", "a.b/c..d", "\uFFFD.csv"})
    EXPECT_TRUE(is_inner_path(name)) << name;
}

TEST(Bundles, RejectTooManyFilesAndFolders) {
  Bundle bundle = example();
  for (std::size_t i = 0; i < k_most_bundled_files; ++i) bundle.in_the_way.push_back("made/" + std::to_string(i) + "/");
  EXPECT_THAT(refusal_of(bundle), HasSubstr("at most 2000 files and folders"));
  // Five paths of 450 folders each are too many, four are not.
  bundle = example();
  bundle.in_the_way = {};
  for (std::size_t i = 0; i < 5; ++i) {
    std::string deep = std::to_string(i);
    while (deep.size() < 900) deep += "/a";
    bundle.in_the_way.push_back(deep);
  }
  EXPECT_THAT(refusal_of(bundle), HasSubstr("at most 2000 files and folders"));
  bundle.in_the_way.pop_back();
  EXPECT_EQ(read_again(bundle).in_the_way, bundle.in_the_way);
}

TEST(Bundles, RejectFileThatIsAFolder) {
  Bundle bundle = example();
  bundle.in_the_way = {"arm.toml/"};
  EXPECT_THAT(refusal_of(bundle), HasSubstr("arm.toml is a file and a folder"));
}

TEST(Bundles, RejectTooLargeIndex) {
  Entries entries;
  const std::string index = "[" + std::string(std::size_t{17} << 20, ' ') + "]";
  entries.all[0].bytes = index;
  EXPECT_THAT(refusal(zip_bytes(entries.all)), HasSubstr("bundle.json: unpacks to too much"));
}

TEST(Bundles, RejectTooMuchContent) {
  const std::string zeros(1 << 20, '\0');
  const std::string bytes = zip_bytes({{"zeros", zeros}});
  const ZipArchive archive(bytes, "bomb.zip", "a zip");
  std::uint64_t budget = zeros.size() - 1;
  EXPECT_THROW(archive.unpacked(0, budget, "no more than that"), InputError);
}

TEST(Bundles, ReadFuzzingCorpus) {
  int read = 0;  // all other files of the corpus must be refused
  for (const auto& entry : fs::directory_iterator(fs::path(FUSEE_SOURCE_DIR) / "tests/fuzz/corpus/bundle"))
    read += refusal(read_file(entry.path(), k_any_size)).empty() ? 1 : 0;
  EXPECT_EQ(read, 4);
}

}  // namespace
}  // namespace fusee
