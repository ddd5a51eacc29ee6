// A picture as SVG text that stands in a page: a few shapes, and axes to draw over.
#pragma once

#include <string>
#include <vector>

namespace equipoise {

struct SvgPoint {
  double x = 0.0, y = 0.0;
};

/// Colours are those of a page, which differ by day and by night ("var(--ink)"), or "#rrggbb"; empty: none.
struct SvgPen {
  std::string stroke, fill;
  double width = 1.0, opacity = 1.0;
  bool dashed = false;
};

/// Colours that a page has for what is no outcome.
inline constexpr const char* ink = "var(--ink)";
inline constexpr const char* quiet_ink = "var(--quiet)";
inline constexpr const char* rule_colour = "var(--rule)";
inline constexpr const char* limit_colour = "var(--limit)";

enum class SvgAnchor { start, middle, end };

/// Lengths are in pixels where the picture has its own size; y goes down.
class Svg {
 public:
  /// `described`: what is to be seen, for who cannot see it.
  Svg(double width, double height, const std::string& described);

  void line(SvgPoint from, SvgPoint to, const SvgPen& pen);
  void path(const std::vector<SvgPoint>& points, const SvgPen& pen, bool closed = false);
  void rectangle(SvgPoint corner, double width, double height, const SvgPen& pen);
  void circle(SvgPoint centre, double radius, const SvgPen& pen);
  /// A part of a circle, angles counted against the clock from the right; with `arrow` its end is a head.
  void arc(SvgPoint centre, double radius, double from, double to, const SvgPen& pen, bool arrow = false);
  /// `at`: of its base line. `colour`: ink if empty.
  void text(SvgPoint at, const std::string& words, SvgAnchor anchor = SvgAnchor::start, const std::string& colour = {},
            double size = 11.0);
  /// The bytes of a PNG file stretched over a rectangle, its squares with sharp edges.
  void image(SvgPoint corner, double width, double height, const std::string& png);
  /// Turned to be read from below.
  void text_upwards(SvgPoint at, const std::string& words);

  double width() const { return width_; }
  std::string str() const { return out_ + "</svg>\n"; }

 private:
  double width_;
  std::string out_;
};

struct AxisExtent {
  double low = 0.0, high = 1.0;
};
/// A little wider than given, for what has no extent too.
AxisExtent widened(AxisExtent extent, double share);
/// Round numbers within, some `count` of them.
std::vector<double> round_ticks(AxisExtent extent, int count);
/// The smallest of 1, 2, 5 times a power of ten that is not below `value` > 0.
double round_up(double value);

/// What an axis says: of values in some unit times `factor`.
struct AxisWords {
  std::string label;
  double factor = 1.0;
};

/// A frame with linear axes inside a picture.
class SvgAxes {
 public:
  /// Draws ticks, grid and labels below and left of the frame, whose corners are given.
  SvgAxes(Svg& svg, SvgPoint top_left, SvgPoint bottom_right, AxisExtent x, AxisExtent y, const AxisWords& x_words,
          const AxisWords& y_words);

  SvgPoint at(double x, double y) const;
  /// What lies outside is cut off.
  void line(const std::vector<double>& x, const std::vector<double>& y, const SvgPen& pen);
  void band(const std::vector<double>& x, const std::vector<double>& low, const std::vector<double>& high,
            const SvgPen& pen);
  void bar(double from, double to, double low, double high, const SvgPen& pen);
  /// Across the frame, named at its end; one outside the frame is named at its border.
  void limit_across(double y, const std::string& name);
  void limit_up(double x, const std::string& name);

 private:
  SvgPoint inside(double x, double y) const;

  Svg& svg_;
  SvgPoint top_left_, bottom_right_;
  AxisExtent x_, y_;
};

}  // namespace equipoise
