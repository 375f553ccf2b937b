// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/drawing/canvas.h"

#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <cmath>
#include <stdexcept>

#include "poise/robot/output_file.h"

namespace poise {
namespace {

constexpr double kFullTurn = 2 * 3.14159265358979323846;

// Appends what cairo writes to a string.
cairo_status_t Append(void* file, const unsigned char* bytes, unsigned count) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes),
                                          count);
  return CAIRO_STATUS_SUCCESS;
}

// Throws std::runtime_error if cairo could not draw.
void Check(cairo_status_t status, const std::filesystem::path& file) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(
      file.string() + ": cannot be drawn: " + cairo_status_to_string(status));
}

void DrawOn(cairo_t* cairo, const std::function<void(Canvas*)>& draw) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  Canvas canvas(cairo);
  draw(&canvas);
  cairo_show_page(cairo);
}

}  // namespace

Color HexColor(unsigned rgb) {
  return {(rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0,
          (rgb & 255) / 255.0, 1};
}

void Canvas::Path(const std::vector<Eigen::Vector2d>& points) {
  cairo_new_path(cairo_);
  for (const Eigen::Vector2d& point : points) {
    cairo_line_to(cairo_, point.x(), point.y());
  }
}

void Canvas::SetColor(const Color& color) {
  cairo_set_source_rgba(cairo_, color[0], color[1], color[2], color[3]);
}

void Canvas::Polygon(const std::vector<Eigen::Vector2d>& corners,
                     const Color& fill) {
  Path(corners);
  cairo_close_path(cairo_);
  SetColor(fill);
  cairo_fill(cairo_);
}

void Canvas::Line(const std::vector<Eigen::Vector2d>& points,
                  const Color& color, double width, bool dashed) {
  Path(points);
  SetColor(color);
  cairo_set_line_width(cairo_, width);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  const double dashes[] = {4, 3};
  cairo_set_dash(cairo_, dashes, dashed ? 2 : 0, 0);
  cairo_stroke(cairo_);
}

void Canvas::Disk(const Eigen::Vector2d& center, double radius,
                  const Color& fill) {
  cairo_new_path(cairo_);
  cairo_arc(cairo_, center.x(), center.y(), radius, 0, kFullTurn);
  SetColor(fill);
  cairo_fill(cairo_);
}

double Canvas::TextWidth(const std::string& text, double size, bool bold) {
  cairo_select_font_face(
      cairo_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
      bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo_, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::Text(const Eigen::Vector2d& at, const std::string& text,
                  double size, const Color& color, Anchor anchor, bool bold) {
  const double width = TextWidth(text, size, bold);
  double x = at.x();
  if (anchor == Anchor::kMiddle) x -= width / 2;
  if (anchor == Anchor::kRight) x -= width;
  cairo_move_to(cairo_, x, at.y());
  SetColor(color);
  cairo_show_text(cairo_, text.c_str());
}

void Canvas::Clipped(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                     const std::function<void()>& draw) {
  cairo_save(cairo_);
  cairo_rectangle(cairo_, corner.x(), corner.y(), size.x(), size.y());
  cairo_clip(cairo_);
  draw();
  cairo_restore(cairo_);
}

void Canvas::Image(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                   int width, int height, std::vector<std::uint32_t> pixels) {
  // Rows of 32-bit pixels need no padding, so the stride is 4 * width.
  cairo_surface_t* image = cairo_image_surface_create_for_data(
      reinterpret_cast<unsigned char*>(pixels.data()), CAIRO_FORMAT_ARGB32,
      width, height, 4 * width);
  cairo_save(cairo_);
  cairo_translate(cairo_, corner.x(), corner.y());
  cairo_scale(cairo_, size.x() / width, size.y() / height);
  cairo_set_source_surface(cairo_, image, 0, 0);
  cairo_paint(cairo_);
  cairo_restore(cairo_);
  // Cairo writes the SVG later, when `pixels` no longer exists. Finishing the
  // image now prevents cairo from reading `pixels` then.
  cairo_surface_finish(image);
  cairo_surface_destroy(image);
}

void WritePicture(const std::filesystem::path& stem,
                  const Eigen::Vector2d& size,
                  const std::function<void(Canvas*)>& draw) {
  const std::filesystem::path svg = stem.string() + ".svg";
  std::string content;
  cairo_surface_t* surface =
      cairo_svg_surface_create_for_stream(Append, &content, size.x(), size.y());
  cairo_t* cairo = cairo_create(surface);
  DrawOn(cairo, draw);
  cairo_destroy(cairo);
  cairo_surface_finish(surface);
  const cairo_status_t status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  Check(status, svg);
  WriteFile(svg, content);

  const std::filesystem::path png = stem.string() + ".png";
  surface = cairo_image_surface_create(
      CAIRO_FORMAT_RGB24,
      static_cast<int>(std::lround(kPixelsPerPoint * size.x())),
      static_cast<int>(std::lround(kPixelsPerPoint * size.y())));
  cairo = cairo_create(surface);
  cairo_scale(cairo, kPixelsPerPoint, kPixelsPerPoint);
  DrawOn(cairo, draw);
  cairo_destroy(cairo);
  content.clear();
  const cairo_status_t written =
      cairo_surface_write_to_png_stream(surface, Append, &content);
  cairo_surface_destroy(surface);
  Check(written, png);
  WriteFile(png, content);
}

}  // namespace poise
