// PNG and PDF by librsvg and cairo. Their functions are declared here as in their C interfaces (librsvg 2.46, cairo 1.2
// and later), because neither library is required to build.

#include "export/report/picture.h"

#include <map>

#include "base/module.h"
#include "export/report/report_parts.h"
#include "fusee/base.h"

namespace fusee::formats {
namespace {

struct RsvgRectangle {
  double x, y, width, height;
};
using WriteBytes = int (*)(void* closure, const unsigned char* bytes, unsigned int size);

int append_bytes(void* closure, const unsigned char* bytes, unsigned int size) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(bytes), size);
  return 0;  // CAIRO_STATUS_SUCCESS
}

template <class Function>
Function* required(const SystemLibrary& library, const char* name) {
  Function* found = library.function<Function>(name);
  if (found != nullptr) return found;
  throw InputError("", "no PNG or PDF can be drawn: librsvg-2.so.2 or libcairo.so.2 is not installed",
                   "install librsvg2-2 (Debian, Ubuntu), or write .svg");
}

class Renderer {
 public:
  /// Draws on a cairo surface, which the caller destroys. Width and height are those of the surface, in its units.
  void draw(const std::string& svg, void* surface, double width, double height, bool on_white) const {
    void* const context = create_(surface);
    if (on_white) {
      set_colour_(context, 1, 1, 1);
      paint_(context);
    }
    void* const picture = read_(reinterpret_cast<const unsigned char*>(svg.data()), svg.size(), nullptr);
    const RsvgRectangle all{0, 0, width, height};
    const bool is_drawn = picture != nullptr && render_(picture, context, &all, nullptr) != 0;
    if (picture != nullptr) unref_(picture);
    destroy_context_(context);
    if (!is_drawn) throw InputError("", "librsvg cannot draw this picture", "write .svg in place of it");
  }

  std::string png(const std::string& svg, double width, double height) const {
    void* const surface = image_(0, static_cast<int>(width), static_cast<int>(height));  // CAIRO_FORMAT_ARGB32
    draw(svg, surface, width, height, true);
    std::string bytes;
    write_png_(surface, append_bytes, &bytes);
    destroy_surface_(surface);
    return bytes;
  }

  std::string pdf(const std::string& svg, double width, double height) const {
    std::string bytes;
    void* const surface = pdf_(append_bytes, &bytes, width, height);
    draw(svg, surface, width, height, false);
    finish_(surface);
    destroy_surface_(surface);
    return bytes;
  }

 private:
  SystemLibrary rsvg_{"librsvg-2.so.2"}, cairo_{"libcairo.so.2"}, gobject_{"libgobject-2.0.so.0"};
  void* (*read_)(const unsigned char*, std::size_t,
                 void**) = required<void*(const unsigned char*, std::size_t, void**)>(rsvg_,
                                                                                      "rsvg_handle_new_from_data");
  int (*render_)(void*, void*, const RsvgRectangle*,
                 void**) = required<int(void*, void*, const RsvgRectangle*, void**)>(rsvg_,
                                                                                     "rsvg_handle_render_document");
  void (*unref_)(void*) = required<void(void*)>(gobject_, "g_object_unref");
  void* (*image_)(int, int, int) = required<void*(int, int, int)>(cairo_, "cairo_image_surface_create");
  void* (*pdf_)(WriteBytes, void*, double,
                double) = required<void*(WriteBytes, void*, double, double)>(cairo_,
                                                                             "cairo_pdf_surface_create_for_stream");
  int (*write_png_)(void*, WriteBytes,
                    void*) = required<int(void*, WriteBytes, void*)>(cairo_, "cairo_surface_write_to_png_stream");
  void* (*create_)(void*) = required<void*(void*)>(cairo_, "cairo_create");
  void (*set_colour_)(void*, double, double,
                      double) = required<void(void*, double, double, double)>(cairo_, "cairo_set_source_rgb");
  void (*paint_)(void*) = required<void(void*)>(cairo_, "cairo_paint");
  void (*finish_)(void*) = required<void(void*)>(cairo_, "cairo_surface_finish");
  void (*destroy_context_)(void*) = required<void(void*)>(cairo_, "cairo_destroy");
  void (*destroy_surface_)(void*) = required<void(void*)>(cairo_, "cairo_surface_destroy");
};

/// The colours of figure.css are CSS variables, which librsvg does not support. Each is replaced by its first value,
/// that of a light page.
std::string with_colours(std::string svg) {
  std::map<std::string, std::string> values;
  for (std::size_t at = svg.find("--"); at != std::string::npos; at = svg.find("--", at + 2)) {
    const std::size_t colon = svg.find_first_of(":;)}", at), end = svg.find_first_of(";}", at);
    if (colon != std::string::npos && svg[colon] == ':' && end != std::string::npos)
      values.emplace(svg.substr(at, colon - at), svg.substr(colon + 1, end - colon - 1));
  }
  for (const auto& [name, value] : values) {
    const std::string use = "var(" + name + ")";
    for (std::size_t at = svg.find(use); at != std::string::npos; at = svg.find(use, at + value.size()))
      svg.replace(at, use.size(), value);
  }
  return svg;
}

}  // namespace

std::string png_of(const std::string& svg, double width, double height) {
  constexpr double k_dots_per_pixel = 2;
  return Renderer().png(with_colours(svg), k_dots_per_pixel * width, k_dots_per_pixel * height);
}

std::string pdf_of(const std::string& svg, double width, double height) {
  constexpr double k_points_per_pixel = 72.0 / 96.0;
  return Renderer().pdf(with_colours(svg), k_points_per_pixel * width, k_points_per_pixel * height);
}

}  // namespace fusee::formats
