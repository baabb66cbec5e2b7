#include <gtest/gtest.h>
#include <zip.h>

#include <cstdlib>
#include <ctime>
#include <new>
#include <pugixml.hpp>
#include <utility>

#include "mesh_samples.h"

namespace fusee::formats {
namespace {

using testing::error_of;
using testing::facets;
using ::testing::HasSubstr;
using Parts = std::vector<std::pair<std::string, std::string>>;

std::string zip_of(const Parts& parts) {
  zip_source_t* bytes = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  zip_source_keep(bytes);
  zip_t* archive = zip_open_from_source(bytes, ZIP_TRUNCATE, nullptr);
  for (const auto& [path, text] : parts) {
    zip_file_add(archive, path.c_str(), zip_source_buffer(archive, text.data(), text.size(), 0), ZIP_FL_ENC_UTF_8);
  }
  zip_close(archive);
  zip_stat_t stat;
  zip_source_stat(bytes, &stat);
  std::string all(stat.size, '\0');
  zip_source_open(bytes);
  zip_source_read(bytes, all.data(), all.size());
  zip_source_close(bytes);
  zip_source_free(bytes);
  return all;
}

std::string part_of(const std::string& archive_bytes, const char* path) {
  zip_source_t* bytes = zip_source_buffer_create(archive_bytes.data(), archive_bytes.size(), 0, nullptr);
  zip_t* archive = zip_open_from_source(bytes, ZIP_RDONLY, nullptr);
  zip_stat_t stat;
  std::string text;
  if (zip_stat(archive, path, 0, &stat) == 0) {
    text.resize(stat.size);
    zip_file_t* file = zip_fopen(archive, path, 0);
    zip_fread(file, text.data(), text.size());
    zip_fclose(file);
  }
  zip_discard(archive);
  return text;
}

const std::string k_rels =
    R"(<Relationships><Relationship Target="/3D/part.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";

const std::string k_triangle =
    R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices>)"
    R"(<triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>)";

std::string package(const std::string& model) { return zip_of({{"_rels/.rels", k_rels}, {"3D/part.model", model}}); }

// Names of parts are percent-encoded in relationships.
TEST(Threemf, FindsPartWithBlankInItsName) {
  std::string rels = k_rels;
  rels.replace(rels.find("part.model"), 10, "my%20part.model");
  const std::string model = "<model><resources><object id=\"1\">" + k_triangle +
                            "</object></resources><build><item objectid=\"1\"/></build></model>";
  EXPECT_EQ(read_mesh(zip_of({{"_rels/.rels", rels}, {"3D/my part.model", model}}), "x.3mf").triangles.size(), 1U);
}

TEST(Threemf, ReportsGeometryOfExtensions) {
  const auto model = [](const std::string& object) {
    return package("<model xmlns:b=\"urn:b\"><resources><object id=\"1\">" + object +
                   "</object></resources><build><item objectid=\"1\"/></build></model>");
  };
  const std::string beams = "<b:beamlattice radius=\"1\"><b:beams/></b:beamlattice>";
  EXPECT_THAT(error_of(model("<mesh><vertices/><triangles/>" + beams + "</mesh>"), "x.3mf"),
              HasSubstr("an object has no triangles, but a 'beamlattice', which fusee does not read"));
  EXPECT_THAT(error_of(model("<metadatagroup/><b:booleanshape objectid=\"1\"/>"), "x.3mf"),
              HasSubstr("but a 'booleanshape'"));
  EXPECT_EQ(error_of(model("<mesh><vertices/><!-- none --><triangles/></mesh>"), "x.3mf"), "");
}

std::string model(const std::string& resources, const std::string& items, const std::string& attributes = "") {
  return "<model " + attributes + "><resources>" + resources + "</resources><build>" + items + "</build></model>";
}

Vec3 corner(const solid::TriangleMesh& mesh, std::size_t triangle, std::size_t k) {
  return mesh.vertices.at(mesh.triangles.at(triangle)[k]);
}

TEST(ThreemfWriter, WritesNamedObjectInMillimetres) {
  const std::string bytes = threemf_bytes(testing::tetrahedron(), "a <finger> & more");
  EXPECT_THAT(part_of(bytes, "[Content_Types].xml"), HasSubstr("3dmanufacturing-3dmodel+xml"));
  EXPECT_THAT(part_of(bytes, "_rels/.rels"), HasSubstr("/3D/3dmodel.model"));
  pugi::xml_document xml;
  const std::string text = part_of(bytes, "3D/3dmodel.model");
  ASSERT_TRUE(xml.load_string(text.c_str()));
  const pugi::xml_node root = xml.child("model");
  EXPECT_STREQ(root.attribute("unit").value(), "millimeter");
  EXPECT_STREQ(root.find_child_by_attribute("metadata", "name", "Title").text().get(), "a <finger> & more");
  EXPECT_THAT(root.find_child_by_attribute("metadata", "name", "Application").text().get(), HasSubstr("fusee "));
  const pugi::xml_node object = root.child("resources").child("object");
  EXPECT_STREQ(object.attribute("name").value(), "a <finger> & more");
  EXPECT_STREQ(root.child("build").child("item").attribute("objectid").value(), object.attribute("id").value());
  const auto vertices = object.child("mesh").child("vertices").children("vertex");
  EXPECT_EQ(std::distance(vertices.begin(), vertices.end()), 4);
}

TEST(Threemf, RoundTripIsExactInFloats) {
  const solid::TriangleMesh mesh = testing::torus();
  const solid::TriangleMesh read = solid::rounded_to_float(read_mesh(threemf_bytes(mesh, "torus"), "torus.3mf"));
  EXPECT_EQ(read.vertices, mesh.vertices);
  EXPECT_EQ(read.triangles, mesh.triangles);
}

const std::string k_kept_text = "name = \"a < b & c\"\r\n# 100 % of µ\n";
const std::string k_kept_table = std::string("alpha_deg,theta_deg # 5 % \xe4\r\n\0", 30);  // with one zero byte

TEST(Threemf, KeepsMechanismAndTableToTheByte) {
  const std::string bytes =
      threemf_bytes(testing::tetrahedron(), "x", {{"mechanism.toml", k_kept_text}, {"law.csv", k_kept_table}});
  const KeptMechanism kept = read_kept_mechanism(bytes, "x.3mf");
  EXPECT_EQ(kept.text, k_kept_text);
  EXPECT_EQ(kept.table, k_kept_table);
  EXPECT_EQ(read_mesh(bytes, "x.3mf").triangles.size(), 4U);
  EXPECT_EQ(read_kept_mechanism(threemf_bytes(testing::tetrahedron(), "x", {{"m", "a"}}), "x").table, std::nullopt);
}

std::string kept_error(const std::string& bytes) {
  try {
    read_kept_mechanism(bytes, "x.3mf");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Names are found by their namespace, whatever prefix another program gave it.
TEST(Threemf, FindsMechanismByNamespace) {
  const auto with = [](const std::string& attributes, const std::string& metadata) {
    return package("<model " + attributes + ">" + metadata + "<resources/><build/></model>");
  };
  const std::string ours = "xmlns:f='urn:fusee:mechanism:1'";
  EXPECT_EQ(read_kept_mechanism(with(ours, "<metadata name='f:mechanism'>a = 1</metadata>"), "x").text, "a = 1");
  EXPECT_THAT(kept_error(with("xmlns:f='urn:other'", "<metadata name='f:mechanism'>a = 1</metadata>")),
              HasSubstr("keeps no mechanism file"));
  EXPECT_THAT(kept_error(with("", "<metadata name='mechanism'>a = 1</metadata>")), HasSubstr("keeps no mechanism"));
  EXPECT_THAT(kept_error(threemf_bytes(testing::tetrahedron(), "x")), HasSubstr("keeps no mechanism file"));
  EXPECT_THAT(kept_error("solid x"), HasSubstr("zip archive"));
  EXPECT_THAT(
      kept_error(with(ours, "<metadata name='f:mechanism'>a</metadata><metadata name='f:table'>5%4</metadata>")),
      HasSubstr("two hexadecimal digits"));
}

TEST(Threemf, IsIndependentOfTimeZone) {
  const std::string before = threemf_bytes(testing::tetrahedron(), "x");
  setenv("TZ", "Pacific/Auckland", 1);
  tzset();
  const std::string after = threemf_bytes(testing::tetrahedron(), "x");
  unsetenv("TZ");
  tzset();
  EXPECT_EQ(before, after);
}

TEST(ThreemfReader, ConvertsEveryUnit) {
  const std::string object = "<object id='1'>" + k_triangle + "</object>";
  for (const auto& [unit, size] : {std::pair{"micron", 0.001},
                                   {"millimeter", 1.0},
                                   {"centimeter", 10.0},
                                   {"inch", 25.4},
                                   {"foot", 304.8},
                                   {"meter", 1000.0}}) {
    const solid::TriangleMesh mesh =
        read_mesh(package(model(object, "<item objectid='1'/>", "unit='" + std::string(unit) + "'")), "x");
    EXPECT_EQ(corner(mesh, 0, 1), Vec3(size, 0, 0)) << unit;
  }
  EXPECT_THAT(error_of(package(model(object, "<item objectid='1'/>", "unit='parsec'")), "x.3mf"),
              HasSubstr("found 'parsec'"));
}

TEST(ThreemfReader, LackOfMemoryIsNoFaultOfFile) {
  const std::string bytes = threemf_bytes(testing::torus(), "torus");
  const auto allocate = pugi::get_memory_allocation_function();
  const auto release = pugi::get_memory_deallocation_function();
  pugi::set_memory_management_functions([](std::size_t) -> void* { return nullptr; }, release);
  EXPECT_THROW(read_mesh(bytes, "torus.3mf"), std::bad_alloc);
  pugi::set_memory_management_functions(allocate, release);
}

TEST(ThreemfReader, PlacesItemsAndComponents) {
  const std::string resources =
      "<object id='1'>" + k_triangle +
      "</object><object id='2'><components><component objectid='1' transform='1 0 0 0 1 0 0 0 1 10 0 0'/>"
      "<component objectid='1'/></components></object>";
  // A quarter turn about z carries x to y; then up by 5.
  const std::string items =
      "<item objectid='2' transform='0 1 0 -1 0 0 0 0 1 0 0 5'/><item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 "
      "0'/>";
  const solid::TriangleMesh mesh = read_mesh(package(model(resources, items)), "x.3mf");
  ASSERT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(corner(mesh, 0, 0), Vec3(0, 10, 5));
  EXPECT_EQ(corner(mesh, 0, 1), Vec3(0, 11, 5));
  EXPECT_EQ(corner(mesh, 0, 2), Vec3(-1, 10, 5));
  EXPECT_EQ(corner(mesh, 1, 1), Vec3(0, 1, 5));
  // The mirrored one still faces up.
  const Vec3 up = (corner(mesh, 2, 1) - corner(mesh, 2, 0)).cross(corner(mesh, 2, 2) - corner(mesh, 2, 0));
  EXPECT_EQ(up, Vec3(0, 0, 1));
}

TEST(ThreemfReader, FollowsPathsToOtherParts) {
  const std::string other = model("<object id='7'>" + k_triangle + "</object>", "", "unit='centimeter'");
  const std::string root =
      model("<object id='1'><components><component p:path='/3D/other.model' objectid='7'/></components></object>",
            "<item objectid='1'/>");
  const solid::TriangleMesh mesh =
      read_mesh(zip_of({{"_rels/.rels", k_rels}, {"3D/part.model", root}, {"3D/other.model", other}}), "x.3mf");
  EXPECT_EQ(corner(mesh, 0, 1), Vec3(10, 0, 0));
}

// "unit" holds for the numbers of its own part: vertices, and the transforms of the items and components there.
TEST(ThreemfReader, ShiftsInUnitOfTheTransformsPart) {
  const auto shifted = [](int x) { return " transform='1 0 0 0 1 0 0 0 1 " + std::to_string(x) + " 0 0'"; };
  const std::string other = model("<object id='7'>" + k_triangle + "</object><object id='8'><components>" +
                                      "<component objectid='7'" + shifted(2) + "/></components></object>",
                                  "", "unit='centimeter'");
  const auto corners = [&](const std::string& unit) {
    const std::string root = model("<object id='1'><components><component p:path='/3D/other.model' objectid='8'" +
                                       shifted(5) + "/></components></object>",
                                   "<item objectid='1'" + shifted(3) + "/>", "unit='" + unit + "'");
    const solid::TriangleMesh mesh =
        read_mesh(zip_of({{"_rels/.rels", k_rels}, {"3D/part.model", root}, {"3D/other.model", other}}), "x.3mf");
    return std::pair(corner(mesh, 0, 0), corner(mesh, 0, 1));
  };
  EXPECT_EQ(corners("millimeter"), std::pair(Vec3(3 + 5 + 20, 0, 0), Vec3(3 + 5 + 20 + 10, 0, 0)));
  EXPECT_EQ(corners("meter"), std::pair(Vec3(3000 + 5000 + 20, 0, 0), Vec3(3000 + 5000 + 20 + 10, 0, 0)));
}

TEST(ThreemfReader, ReadsPrefixedNames) {
  const std::string text =
      R"(<m:model xmlns:m="core"><m:resources><m:object id="1"><m:mesh><m:vertices><m:vertex x="+1" y="0" z="inf"/></m:vertices>)"
      R"(<m:triangles><m:triangle v1="0" v2="0" v3="0"/></m:triangles></m:mesh></m:object>)"
      R"(</m:resources><m:build><m:item objectid="1"/></m:build></m:model>)";
  const solid::TriangleMesh mesh = read_mesh(package(text), "x.3mf");
  ASSERT_EQ(mesh.vertices.size(), 1U);
  EXPECT_TRUE(std::isinf(mesh.vertices[0].z()));
}

// Without an extension that the file requires the part would be incomplete, as a lattice of beams without its beams.
TEST(ThreemfReader, RejectsUnknownRequiredExtension) {
  const std::string object = "<object id='1'>" + k_triangle + "</object>", item = "<item objectid='1'/>";
  const std::string beams = "xmlns:b='http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02'";
  EXPECT_THAT(error_of(package(model(object, item, beams + " requiredextensions='b'")), "x.3mf"),
              HasSubstr("requires the extension 'http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02'"));
  EXPECT_THAT(error_of(package(model(object, item, "requiredextensions='q'")), "x.3mf"),
              HasSubstr("undeclared prefix 'q'"));
  // Accepted: extensions that are not required, that fusee reads, or that only add colour.
  EXPECT_EQ(error_of(package(model(object, item, beams)), "x.3mf"), "");
  EXPECT_EQ(error_of(package(model(object, item,
                                   "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06' "
                                   "xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02' "
                                   "requiredextensions=' p  m '")),
                     "x.3mf"),
            "");
}

TEST(ThreemfReader, OmitsSupports) {
  const auto object = [](int id, const std::string& type) {
    return "<object id='" + std::to_string(id) + "' type='" + type + "'>" + k_triangle + "</object>";
  };
  const std::string objects = object(1, "model") + object(2, "support") + object(3, "solidsupport") +
                              object(4, "other") + object(5, "surface") +
                              "<object id='6'><components><component objectid='1'/><component objectid='2'/>"
                              "</components></object>";
  const auto triangles = [&](const std::string& items) {
    return read_mesh(package(model(objects, items)), "x.3mf").triangles.size();
  };
  EXPECT_EQ(triangles("<item objectid='1'/><item objectid='2'/><item objectid='3'/><item objectid='4'/>"), 1U);
  EXPECT_EQ(triangles("<item objectid='5'/>"), 1U);
  EXPECT_EQ(triangles("<item objectid='6'/>"), 1U);
  EXPECT_THAT(error_of(package(model(objects, "<item objectid='2'/>")), "x.3mf"), HasSubstr("supports"));
  EXPECT_THAT(error_of(package(model(object(1, "ghost"), "<item objectid='1'/>")), "x.3mf"),
              HasSubstr("found 'ghost'"));
}

TEST(ThreemfReader, OmitsUnprintableItems) {
  const std::string object = "<object id='1'>" + k_triangle + "</object>";
  const auto triangles = [&](const std::string& items) {
    return read_mesh(package(model(object, items)), "x.3mf").triangles.size();
  };
  EXPECT_EQ(triangles("<item objectid='1' printable='1'/><item objectid='1' printable=' 0 '/>"), 1U);
  EXPECT_THAT(error_of(package(model(object, "<item objectid='1' printable='0'/>")), "x.3mf"),
              HasSubstr("no part of the build is marked as printable"));
}

TEST(ThreemfReader, ReportsEmptyBuild) {
  EXPECT_THAT(error_of(package(model("<object id='1'>" + k_triangle + "</object>", "")), "x.3mf"),
              HasSubstr("the build is empty"));
}

TEST(ThreemfReader, AcceptsBlanksAroundNumbers) {
  std::string object = "<object id=' 1 '>" + k_triangle + "</object>";
  object.replace(object.find("x=\"1\""), 5, "x=\"\n 1\t\"");
  object.replace(object.find("v2=\"1\""), 6, "v2=\" 1 \"");
  const solid::TriangleMesh mesh = read_mesh(package(model(object, "<item objectid='1 '/>")), "x.3mf");
  EXPECT_EQ(corner(mesh, 0, 1), Vec3(1, 0, 0));
  object.replace(object.find("v2=\" 1 \""), 8, "v2=\"1 1\"");
  EXPECT_THAT(error_of(package(model(object, "<item objectid='1'/>")), "x.3mf"), HasSubstr("found '1 1'"));
}

TEST(ThreemfReader, ErrorsNameThePlace) {
  EXPECT_THAT(error_of("PK\x03\x04 not a zip", "x.3mf"),
              HasSubstr("x.3mf: error: expected a zip archive with a 3MF model"));
  EXPECT_THAT(error_of(zip_of({{"a", "b"}}), "x.3mf"), HasSubstr("_rels/.rels: expected this part in the archive"));
  EXPECT_THAT(error_of(zip_of({{"_rels/.rels", "<Relationships/>"}}), "x.3mf"),
              HasSubstr("expected a relationship of type …/3dmodel"));
  EXPECT_THAT(error_of(zip_of({{"_rels/.rels", k_rels}}), "x.3mf"), HasSubstr("3D/part.model: expected this part"));
  EXPECT_THAT(error_of(package("<model><resources></model>"), "x.3mf"),
              HasSubstr("3D/part.model at byte 20: expected XML"));
  EXPECT_THAT(error_of(package("<robot/>"), "x.3mf"), HasSubstr("expected the element 'model'"));
  const std::string object = "<object id='1'>" + k_triangle + "</object>";
  EXPECT_THAT(error_of(package(model(object, "<item objectid='2'/>")), "x.3mf"),
              HasSubstr("expected an object of the id 2"));
  EXPECT_THAT(error_of(package(model(object, "<item objectid='1' transform='1 0 0'/>")), "x.3mf"),
              HasSubstr("expected 12 numbers"));
  std::string wrong = object;
  wrong.replace(wrong.find("v3=\"2\""), 6, "v3=\"3\"");
  EXPECT_THAT(error_of(package(model(wrong, "<item objectid='1'/>")), "x.3mf"),
              HasSubstr("expected v3 from 0 to 2, found 3"));
  wrong = object;
  wrong.replace(wrong.find("x=\"1\""), 5, "x=\"l\"");
  EXPECT_THAT(error_of(package(model(wrong, "<item objectid='1'/>")), "x.3mf"),
              HasSubstr("expected a number x, found 'l'"));
}

TEST(ThreemfReader, RejectsZipBombs) {
  // 100 MB of blanks in 100 kB.
  EXPECT_THAT(error_of(package("<model>" + std::string(100'000'000, ' ') + "</model>"), "x.3mf"),
              HasSubstr("unpacks to too much"));
  // An object that contains itself, and objects of ten objects of ten objects …
  const std::string snake = "<object id='1'><components><component objectid='1'/></components></object>";
  EXPECT_THAT(error_of(package(model(snake, "<item objectid='1'/>")), "x.3mf"), HasSubstr("deeper than 32"));
  std::string tree = "<object id='0'>" + k_triangle + "</object>";
  for (int level = 1; level <= 12; ++level) {
    tree += "<object id='" + std::to_string(level) + "'><components>";
    for (int i = 0; i < 10; ++i) tree += "<component objectid='" + std::to_string(level - 1) + "'/>";
    tree += "</components></object>";
  }
  EXPECT_THAT(error_of(package(model(tree, "<item objectid='12'/>")), "x.3mf"),
              HasSubstr("places its objects too often"));
}

TEST(ThreemfReader, RejectsTruncations) {
  EXPECT_EQ(testing::meshes_among_truncations(threemf_bytes(testing::tetrahedron(), "x"), "x.3mf"), 0);
}

}  // namespace
}  // namespace fusee::formats
