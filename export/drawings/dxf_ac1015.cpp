// AutoCAD 2000, with every table, owner and dictionary that strict readers require.
#include <algorithm>

#include "export/drawings/dxf_versions.h"

namespace fusee::formats {
namespace {

// Every object of AC1015 has a handle, and refers to the handle of its owner. Handles that other objects refer to are
// fixed here. Table records and entities are numbered from k_first_free.
enum Handle : int {
  k_layer_table = 0x1,
  k_ltype_table = 0x2,
  k_appid_table = 0x3,
  k_dimstyle_table = 0x4,
  k_style_table = 0x5,
  k_ucs_table = 0x6,
  k_view_table = 0x7,
  k_vport_table = 0x8,
  k_block_record_table = 0x9,
  k_root_dictionary = 0xA,
  k_group_dictionary = 0xB,
  k_layout_dictionary = 0xC,
  k_mline_dictionary = 0xD,
  k_plot_settings_dictionary = 0xE,
  k_plot_style_dictionary = 0xF,
  k_plot_style = 0x10,
  k_mline_style = 0x11,
  k_model_record = 0x12,
  k_paper_record = 0x13,
  k_model_layout = 0x14,
  k_paper_layout = 0x15,
  k_first_free = 0x20,
};

class Ac1015Writer {
 public:
  explicit Ac1015Writer(const DxfDocument& document) : document_(document), box_(bounding_box(document.paths)) {}

  std::string write() {
    write_remarks(tags_, document_);
    write_header();
    tags_.begin_section("CLASSES");
    tags_.end_section();
    write_tables();
    write_blocks();
    tags_.begin_section("ENTITIES");
    for (const DxfPath& path : document_.paths) {
      if (path.circle)
        write_circle(path.layer, *path.circle);
      else if (!path.heights.empty())
        write_polyline_3d(path);
      else
        write_polyline(path);
    }
    tags_.end_section();
    write_objects();
    tags_.text(0, "EOF");
    return tags_.take();
  }

 private:
  /// Each vertex of a 3-D polyline and its SEQEND has a handle too.
  int entity_handles() const {
    std::size_t handles = document_.paths.size();
    for (const DxfPath& path : document_.paths) {
      const bool is_3d = !path.circle && !path.heights.empty();
      if (is_3d) handles += path.vertices.size() + 1;
    }
    return static_cast<int>(handles);
  }

  void write_header() {
    tags_.begin_section("HEADER");
    write_variables(tags_, "AC1015", box_);
    tags_.text(9, "$DWGCODEPAGE");
    tags_.text(3, "ANSI_1252");
    tags_.text(9, "$MEASUREMENT");
    tags_.integer(70, 1);  // metric
    tags_.text(9, "$HANDSEED");
    // Above all handles of table records, layers and entities.
    constexpr int k_most_records = 64;
    tags_.handle(5, k_first_free + k_most_records + static_cast<int>(document_.layers.size()) + entity_handles());
    tags_.end_section();
  }

  void begin_table(std::string_view name, int handle, int count) {
    tags_.text(0, "TABLE");
    tags_.text(2, name);
    tags_.handle(5, handle);
    tags_.handle(330, 0);
    tags_.text(100, "AcDbSymbolTable");
    tags_.integer(70, count);
  }
  void end_table() { tags_.text(0, "ENDTAB"); }

  /// `handle_code`: 5, except for DIMSTYLE, which uses 5 for another value.
  void begin_record(std::string_view type, std::string_view subclass, int owner, std::string_view name, int handle,
                    int handle_code = 5) {
    tags_.text(0, type);
    tags_.handle(handle_code, handle);
    tags_.handle(330, owner);
    tags_.text(100, "AcDbSymbolTableRecord");
    tags_.text(100, subclass);
    tags_.text(2, name);
  }

  void write_tables() {
    tags_.begin_section("TABLES");
    write_vport();
    write_ltypes();
    write_layers();
    write_styles();
    begin_table("VIEW", k_view_table, 0);
    end_table();
    begin_table("UCS", k_ucs_table, 0);
    end_table();
    begin_table("APPID", k_appid_table, 1);
    begin_record("APPID", "AcDbRegAppTableRecord", k_appid_table, "ACAD", next_handle_++);
    tags_.integer(70, 0);
    end_table();
    begin_table("DIMSTYLE", k_dimstyle_table, 1);
    tags_.text(100, "AcDbDimStyleTable");
    begin_record("DIMSTYLE", "AcDbDimStyleTableRecord", k_dimstyle_table, "Standard", next_handle_++, 105);
    tags_.integer(70, 0);
    end_table();
    begin_table("BLOCK_RECORD", k_block_record_table, 2);
    begin_record("BLOCK_RECORD", "AcDbBlockTableRecord", k_block_record_table, "*Model_Space", k_model_record);
    tags_.handle(340, k_model_layout);
    begin_record("BLOCK_RECORD", "AcDbBlockTableRecord", k_block_record_table, "*Paper_Space", k_paper_record);
    tags_.handle(340, k_paper_layout);
    end_table();
    tags_.end_section();
  }

  /// The initial view of a program: the whole drawing.
  void write_vport() {
    const Vec2 middle = 0.5 * (box_.low + box_.high);
    constexpr double k_aspect = 1.5, k_margin = 1.1;  // of the window
    const double height = std::max({box_.size().y(), box_.size().x() / k_aspect, 1.0}) * k_margin;
    begin_table("VPORT", k_vport_table, 1);
    begin_record("VPORT", "AcDbViewportTableRecord", k_vport_table, "*Active", next_handle_++);
    tags_.integer(70, 0);
    tags_.point(10, {0, 0});
    tags_.point(11, {1, 1});
    tags_.point(12, middle);
    // Snap, grid and direction of view, as in a new drawing.
    tags_.point(13, {0, 0});
    tags_.point(14, {10, 10});
    tags_.point(15, {10, 10});
    tags_.point3(16, 0, 0, 1);
    tags_.point3(17, 0, 0, 0);
    tags_.reals({{40, height}, {41, k_aspect}, {42, 50}, {43, 0}, {44, 0}, {50, 0}, {51, 0}});
    tags_.integers({{71, 0}, {72, 1000}, {73, 1}, {74, 3}, {75, 0}, {76, 0}, {77, 0}, {78, 0}, {281, 0}, {65, 0}});
    end_table();
  }

  void write_ltypes() {
    begin_table("LTYPE", k_ltype_table, 3);
    for (const std::string_view name : {"ByBlock", "ByLayer", "Continuous"}) {
      begin_record("LTYPE", "AcDbLinetypeTableRecord", k_ltype_table, name, next_handle_++);
      tags_.integer(70, 0);
      tags_.text(3, "");
      tags_.integers({{72, 65}, {73, 0}});  // alignment, which is always 'A'; number of dashes
      tags_.real(40, 0);
    }
    end_table();
  }

  void write_layer(const DxfLayer& layer) {
    begin_record("LAYER", "AcDbLayerTableRecord", k_layer_table, layer.name, next_handle_++);
    tags_.integers({{70, 0}, {62, layer.colour}});
    tags_.text(6, "Continuous");
    if (!layer.plotted) tags_.integer(290, 0);
    tags_.integer(370, -3);  // the default line weight
    tags_.handle(390, k_plot_style);
  }

  void write_layers() {
    begin_table("LAYER", k_layer_table, static_cast<int>(document_.layers.size()) + 1);
    write_layer({"0", 7, true});
    for (const DxfLayer& layer : document_.layers) write_layer(layer);
    end_table();
  }

  void write_styles() {
    begin_table("STYLE", k_style_table, 1);
    begin_record("STYLE", "AcDbTextStyleTableRecord", k_style_table, "Standard", next_handle_++);
    write_style_values(tags_);
    end_table();
  }

  void begin_entity(std::string_view type, std::string_view subclass, int owner, std::string_view layer) {
    tags_.text(0, type);
    tags_.handle(5, next_handle_++);
    tags_.handle(330, owner);
    tags_.text(100, "AcDbEntity");
    tags_.text(8, layer);
    tags_.text(100, subclass);
  }

  void write_block(std::string_view name, int record) {
    begin_entity("BLOCK", "AcDbBlockBegin", record, "0");
    tags_.text(2, name);
    tags_.integer(70, 0);
    tags_.point3(10, 0, 0, 0);
    tags_.text(3, name);
    tags_.text(1, "");
    begin_entity("ENDBLK", "AcDbBlockEnd", record, "0");
  }

  void write_blocks() {
    tags_.begin_section("BLOCKS");
    write_block("*Model_Space", k_model_record);
    write_block("*Paper_Space", k_paper_record);
    tags_.end_section();
  }

  void write_polyline(const DxfPath& path) {
    begin_entity("LWPOLYLINE", "AcDbPolyline", k_model_record, path.layer);
    tags_.integer(90, static_cast<int>(path.vertices.size()));
    tags_.integer(70, path.closed ? k_closed : 0);
    for (const BulgeVertex& vertex : path.vertices) {
      tags_.point(10, vertex.place);
      if (vertex.bulge != 0) tags_.real(42, vertex.bulge);
    }
  }

  /// A 3-D polyline has an entity for each vertex.
  void write_polyline_3d(const DxfPath& path) {
    const int polyline = next_handle_;
    begin_entity("POLYLINE", "AcDb3dPolyline", k_model_record, path.layer);
    tags_.integer(66, 1);
    tags_.point3(10, 0, 0, 0);
    tags_.integer(70, k_polyline_3d);
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
      begin_entity("VERTEX", "AcDbVertex", polyline, path.layer);
      tags_.text(100, "AcDb3dPolylineVertex");
      tags_.point3(10, path.vertices[i].place.x(), path.vertices[i].place.y(), path.heights[i]);
      tags_.integer(70, k_vertex_3d);
    }
    tags_.text(0, "SEQEND");
    tags_.handle(5, next_handle_++);
    tags_.handle(330, polyline);
    tags_.text(100, "AcDbEntity");
    tags_.text(8, path.layer);
  }

  void write_circle(const std::string& layer, const solid::RoundHole& circle) {
    begin_entity("CIRCLE", "AcDbCircle", k_model_record, layer);
    write_circle_values(tags_, circle);
  }

  void write_dictionary(int handle, int owner, std::initializer_list<std::pair<std::string_view, int>> entries,
                        std::string_view type = "DICTIONARY") {
    tags_.text(0, type);
    tags_.handle(5, handle);
    tags_.handle(330, owner);
    tags_.text(100, "AcDbDictionary");
    tags_.integer(281, 1);
    for (const auto& [name, entry] : entries) {
      tags_.text(3, name);
      tags_.handle(350, entry);
    }
  }

  void write_plot_style() {
    write_dictionary(k_plot_style_dictionary, k_root_dictionary, {{"Normal", k_plot_style}}, "ACDBDICTIONARYWDFLT");
    tags_.text(100, "AcDbDictionaryWithDefault");
    tags_.handle(340, k_plot_style);
    tags_.text(0, "ACDBPLACEHOLDER");
    tags_.handle(5, k_plot_style);
    tags_.handle(330, k_plot_style_dictionary);
  }

  void write_mline_style() {
    tags_.text(0, "MLINESTYLE");
    tags_.handle(5, k_mline_style);
    tags_.handle(330, k_mline_dictionary);
    tags_.text(100, "AcDbMlineStyle");
    tags_.text(2, "Standard");
    tags_.integer(70, 0);
    tags_.text(3, "");
    constexpr int k_colour_by_layer = 256;
    tags_.integer(62, k_colour_by_layer);
    tags_.reals({{51, 90}, {52, 90}});
    tags_.integer(71, 2);
    for (const double offset : {0.5, -0.5}) {
      tags_.real(49, offset);
      tags_.integer(62, k_colour_by_layer);
      tags_.text(6, "BYLAYER");
    }
  }

  void write_layout(int handle, std::string_view name, int tab, int record) {
    tags_.text(0, "LAYOUT");
    tags_.handle(5, handle);
    tags_.handle(330, k_layout_dictionary);
    tags_.text(100, "AcDbPlotSettings");
    for (const int code : {1, 2, 4, 6}) tags_.text(code, "");
    for (int code = 40; code <= 49; ++code) tags_.real(code, 0);
    tags_.reals({{140, 0}, {141, 0}, {142, 1}, {143, 1}});
    constexpr int k_model_tab = 1024;
    tags_.integers({{70, tab == 0 ? k_model_tab : 0}, {72, 1}, {73, 0}, {74, 1}});
    tags_.text(7, "");
    tags_.integers({{75, 0}});
    tags_.reals({{147, 1}, {148, 0}, {149, 0}});
    tags_.text(100, "AcDbLayout");
    tags_.text(1, name);
    tags_.integers({{70, 1}, {71, tab}});
    tags_.point(10, box_.low);
    tags_.point(11, box_.high);
    tags_.point3(12, 0, 0, 0);
    tags_.point3(14, box_.low.x(), box_.low.y(), 0);
    tags_.point3(15, box_.high.x(), box_.high.y(), 0);
    tags_.real(146, 0);
    tags_.point3(13, 0, 0, 0);
    tags_.point3(16, 1, 0, 0);
    tags_.point3(17, 0, 1, 0);
    tags_.integer(76, 0);
    tags_.handle(330, record);
  }

  void write_objects() {
    tags_.begin_section("OBJECTS");
    write_dictionary(k_root_dictionary, 0,
                     {{"ACAD_GROUP", k_group_dictionary},
                      {"ACAD_LAYOUT", k_layout_dictionary},
                      {"ACAD_MLINESTYLE", k_mline_dictionary},
                      {"ACAD_PLOTSETTINGS", k_plot_settings_dictionary},
                      {"ACAD_PLOTSTYLENAME", k_plot_style_dictionary}});
    write_dictionary(k_group_dictionary, k_root_dictionary, {});
    write_dictionary(k_layout_dictionary, k_root_dictionary, {{"Model", k_model_layout}, {"Layout1", k_paper_layout}});
    write_dictionary(k_mline_dictionary, k_root_dictionary, {{"Standard", k_mline_style}});
    write_dictionary(k_plot_settings_dictionary, k_root_dictionary, {});
    write_plot_style();
    write_mline_style();
    write_layout(k_model_layout, "Model", 0, k_model_record);
    write_layout(k_paper_layout, "Layout1", 1, k_paper_record);
    tags_.end_section();
  }

  const DxfDocument& document_;
  Box2d box_;
  DxfTagWriter tags_;
  int next_handle_ = k_first_free;
};

}  // namespace

std::string ac1015_text(const DxfDocument& document) { return Ac1015Writer(document).write(); }

}  // namespace fusee::formats
