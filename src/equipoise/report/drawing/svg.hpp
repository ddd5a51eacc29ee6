// SVG pictures within a page or as files: a few shapes, and axes to draw over.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace equipoise {

struct SvgPoint {
  double x = 0.0, y = 0.0;
};

/// Colours are the page's, light or dark ("var(--ink)"), or "#rrggbb"; empty: none.
struct SvgPen {
  std::string stroke, fill;
  double width = 1.0, opacity = 1.0;
  bool dashed = false;
  const char* dashes = "4 3";
};

/// The page's colours for things other than outcomes.
inline constexpr const char* ink = "var(--ink)";
inline constexpr const char* quiet_ink = "var(--quiet)";
inline constexpr const char* rule_colour = "var(--rule)";
inline constexpr const char* limit_colour = "var(--limit)";

enum class SvgAnchor { start, middle, end };

/// A picture of coloured squares: rows from the top, each of `width` indices into the palette; colours "#rrggbb", 1 to
/// 256 of them.
struct Raster {
  std::size_t width = 0, height = 0;
  std::vector<std::string> palette;
  std::vector<std::uint8_t> squares;

  /// The next square.
  void add(const std::string& colour);
};

/// The bytes of a PNG file (ISO/IEC 15948). Throws std::invalid_argument if the sizes disagree.
std::string png_bytes(const Raster& raster);

/// Lengths are in pixels at the picture's own size; y points down.
class Svg {
 public:
  /// `described`: what the picture shows, for those who cannot see it.
  Svg(double width, double height, std::string described)
      : width_(width), height_(height), described_(std::move(described)) {}

  void line(SvgPoint from, SvgPoint to, const SvgPen& pen);
  void path(const std::vector<SvgPoint>& points, const SvgPen& pen, bool closed = false);
  void rectangle(SvgPoint corner, double width, double height, const SvgPen& pen);
  void circle(SvgPoint centre, double radius, const SvgPen& pen);
  /// An arc; angles counterclockwise from the right; `arrow` puts a head on its end.
  void arc(SvgPoint centre, double radius, double from, double to, const SvgPen& pen, bool arrow = false);
  /// `at`: on the text's base line. `colour`: ink if empty.
  void text(SvgPoint at, const std::string& words, SvgAnchor anchor = SvgAnchor::start, const std::string& colour = {},
            double size = 11.0);
  /// Squares stretched over a rectangle, with sharp edges between them.
  void image(SvgPoint corner, double width, double height, const Raster& raster);
  /// What is drawn until end_group() is shown as `name` where the mouse rests on it.
  void group(const std::string& name);
  void end_group() { out_ += "</g>\n"; }
  /// Rotated, reading upwards.
  void text_upwards(SvgPoint at, const std::string& words);
  /// Another picture within this one, at its own size.
  void picture(SvgPoint corner, const std::string& svg);

  double width() const { return width_; }
  double height() const { return height_; }
  /// Makes room at the bottom.
  void grow(double height) { height_ += height; }
  std::string str() const;
  /// The same as a file of its own, in the colours of a light page: twice as large, with concrete colours, as not all
  /// programs understand a page's variables.
  std::string file() const;

 private:
  double width_, height_;
  std::string described_, out_;
};
/// Width and height of a picture.
SvgPoint size_of(const std::string& svg);

/// Lines no wider than `width` pixels, broken between words where possible. Text of `size` as wide as in common fonts.
std::vector<std::string> text_lines(const std::string& words, double width, double size = 11.0);

struct AxisExtent {
  double low = 0.0, high = 1.0;
};
/// Slightly wider, also for an empty extent.
AxisExtent widened(AxisExtent extent, double share);
/// About `count` round numbers within the extent.
std::vector<double> round_ticks(AxisExtent extent, int count);
/// The smallest of 1, 2, 5 times a power of ten that is at least `value` > 0.
double round_up(double value);

/// An axis label; ticks show values times `factor`, which are then in `unit`. `log`: a logarithmic axis, which x may
/// have.
struct AxisWords {
  std::string label;
  double factor = 1.0;
  bool log = false;
  std::string unit{};
  std::vector<std::string> names{};  ///< of the cells 0 to 1, 1 to 2 and so on, instead of ticks with numbers
};

/// A frame with axes inside a picture.
class SvgAxes {
 public:
  /// Draws ticks, grid and labels left of and below the frame with these corners.
  SvgAxes(Svg& svg, SvgPoint top_left, SvgPoint bottom_right, AxisExtent x, AxisExtent y, const AxisWords& x_words,
          const AxisWords& y_words);

  SvgPoint at(double x, double y) const;
  /// Parts outside the frame are cut off.
  void line(const std::vector<double>& x, const std::vector<double>& y, const SvgPen& pen);
  void band(const std::vector<double>& x, const std::vector<double>& low, const std::vector<double>& high,
            const SvgPen& pen);
  void bar(double from, double to, double low, double high, const SvgPen& pen);
  /// Across the frame, labelled at its end; a line outside the frame is labelled at the border.
  void limit_across(double y, const std::string& name);
  void limit_up(double x, const std::string& name);
  /// A second scale above the frame: words at places of x, in order; those that would touch the one before are left
  /// out.
  void scale_above(const std::vector<double>& x, const std::vector<std::string>& words, const std::string& label);

 private:
  SvgPoint inside(double x, double y) const;
  std::vector<SvgPoint> inside(const std::vector<double>& x, const std::vector<double>& y) const;

  Svg& svg_;
  SvgPoint top_left_, bottom_right_;
  AxisExtent x_, y_;
  bool log_;  // x
};

}  // namespace equipoise
