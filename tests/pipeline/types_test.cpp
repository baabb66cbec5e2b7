// No two types of one namespace share a name: the linker would merge them silently. Tests link with the modules, so
// they count, too.
#include <gmock/gmock.h>

#include <algorithm>

#include "pipeline/type_names.h"

namespace fusee::house {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> names(const std::string& text) {
  std::vector<std::string> all;
  for (const TypeName& type : types_of({"a.h", text}))
    all.push_back(type.scope + "::" + type.name + (type.one_file ? " here" : ""));
  return all;
}

std::vector<std::string> shared(const std::vector<Source>& sources) {
  std::vector<TypeName> types;
  for (const Source& source : sources) {
    for (TypeName& type : types_of(source)) types.push_back(std::move(type));
  }
  return shared_names(types);
}

TEST(Types, AreUniqueInNamespace) {
  EXPECT_THAT(shared(sources_under({"include", "src", "export", "tests"})), IsEmpty());
}

TEST(Types, AreFoundInSources) {
  std::vector<TypeName> types = types_of({"mechanism.h", text_of("include/fusee/mechanism.h")});
  EXPECT_TRUE(std::any_of(types.begin(), types.end(), [](const TypeName& type) {
    return type.scope == "fusee" && type.name == "Mechanism" && !type.one_file;
  }));
}

TEST(Types, SharedNamesAreDetected) {
  const Source struct_box = {"bound.h", "namespace fusee {\n/// of designs\nstruct Box { double low; };\n}"};
  const Source class_box = {"writer.h", "namespace fusee {\nclass Box final : Base {};\n}"};
  const Source alias = {"interval.h", "namespace fusee { using Box = Other<int>; }"};
  EXPECT_THAT(shared({struct_box, class_box}), ElementsAre("fusee::Box: bound.h:3, writer.h:2"));
  EXPECT_THAT(shared({struct_box, alias}), ElementsAre("fusee::Box: bound.h:3, interval.h:1"));
  EXPECT_THAT(shared({struct_box, {"enum.h", "namespace fusee { enum class Box : int { a, b }; }"}}),
              ElementsAre("fusee::Box: bound.h:3, enum.h:1"));
}

TEST(Types, SeparateScopesMayShareNames) {
  const Source box = {"bound.h", "namespace fusee { struct Box { int a; }; }"};
  EXPECT_THAT(shared({box, {"other.h", "namespace fusee::cli { struct Box {}; }"}}), IsEmpty());
  EXPECT_THAT(shared({box, {"one.cpp", "namespace fusee { namespace { struct Box {}; } }"}}), IsEmpty());
  EXPECT_THAT(shared({box, {"member.h", "namespace fusee { struct Shape { struct Box {}; using Box2 = int; }; }"}}),
              IsEmpty());
  EXPECT_THAT(shared({box, {"forward.h", "namespace fusee { struct Box; class Box; }"}}), IsEmpty());
}

TEST(Types, AreReadFromText) {
  EXPECT_THAT(
      names("namespace a { namespace b { template <typename T = int> struct [[nodiscard]] X : Y<T> { int i; }; } }"),
      ElementsAre("a::b::X"));
  EXPECT_THAT(names("namespace a::b { namespace { enum class X { one }; } using Y = int; }"),
              ElementsAre("a::b::X here", "a::b::Y"));
  EXPECT_THAT(names("namespace a { typedef unsigned long Z; template <> struct hash<Z> {}; struct Z::Inner {}; }"),
              ElementsAre("a::Z"));
}

TEST(Types, IgnoreTextThatIsNoType) {
  EXPECT_THAT(names("namespace a { // struct X {}\n/* struct Y {} */ const char* s = \"struct Z { };\"; }"), IsEmpty());
  EXPECT_THAT(names("namespace a { auto r = R\"(struct Z { )\"; char c = '{'; int n = 1'000; struct sig act = {}; }"),
              IsEmpty());
  EXPECT_THAT(names("#define X \\\n  struct Y {\nnamespace a { struct S f() { struct T {}; return {}; } }"), IsEmpty());
  EXPECT_THAT(names("namespace a { using namespace b; using b::C; enum { one }; }"), IsEmpty());
}

}  // namespace
}  // namespace fusee::house
