// SVG text, and within it PNG with a palette, written by libpng. Colours are in style attributes: presentation
// attributes need not understand a page's variables.
#include "equipoise/report/drawing/svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <png.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/drawing/html_text.hpp"

namespace equipoise {

namespace {

// Bytes as text within a page (RFC 4648).
std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string style_of(const SvgPen& pen) {
  std::string style = fmt::format("fill:{}", pen.fill.empty() ? "none" : pen.fill);
  if (!pen.stroke.empty()) style += fmt::format(";stroke:{};stroke-width:{:.3g}", pen.stroke, pen.width);
  if (pen.opacity != 1.0) style += fmt::format(";{}opacity:{:.3g}", pen.stroke.empty() ? "fill-" : "", pen.opacity);
  if (pen.dashed) style += fmt::format(";stroke-dasharray:{}", pen.dashes);
  return style;
}

const char* name_of(SvgAnchor anchor) {
  return anchor == SvgAnchor::start ? "start" : anchor == SvgAnchor::middle ? "middle" : "end";
}

std::vector<double> decades(AxisExtent extent) {
  std::vector<double> ticks;
  constexpr double rounding = 1e-9;
  for (double k = std::ceil(std::log10(extent.low) - rounding); k <= std::log10(extent.high) + rounding; k += 1.0)
    ticks.push_back(std::pow(10.0, k));
  return ticks;
}

// Powers of ten that are long in digits are written as powers.
std::string tick_words(double value, bool log) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  constexpr double small = 0.005, large = 2e3;
  if (!log || (value > small && value < large)) return fmt::format("{:.6g}", value);
  std::string words = "10";
  for (const char c : fmt::format("{:.0f}", std::log10(value)))
    words += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return words;
}

}  // namespace

void Raster::add(const std::string& colour) {
  if (!squares.empty() && palette[squares.back()] == colour) return squares.push_back(squares.back());
  const auto at = std::find(palette.begin(), palette.end(), colour);
  squares.push_back(static_cast<std::uint8_t>(at - palette.begin()));
  if (at == palette.end()) palette.push_back(colour);
}

std::string png_bytes(const Raster& r) {
  constexpr std::size_t most_colours = 256;
  const bool fits = !r.palette.empty() && r.palette.size() <= most_colours && r.width * r.height == r.squares.size() &&
                    !r.squares.empty() && *std::max_element(r.squares.begin(), r.squares.end()) < r.palette.size();
  if (!fits) throw std::invalid_argument("a picture's squares, size and palette do not agree");
  std::vector<png_byte> colours;
  for (const std::string& colour : r.palette)
    for (const std::size_t at : {1, 3, 5})
      colours.push_back(static_cast<png_byte>(std::stoi(colour.substr(at, 2), nullptr, 16)));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(r.width);
  image.height = static_cast<png_uint_32>(r.height);
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(r.palette.size());
  std::string out;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  out.resize(size);
  if (!png_image_write_to_memory(&image, out.data(), &size, 0, r.squares.data(), 0, colours.data()))
    throw RunError(image.message);
  out.resize(size);
  return out;
}

std::string Svg::str() const {
  return fmt::format(
      "<svg viewBox=\"0 0 {0:.5g} {1:.5g}\" width=\"{0:.5g}\" height=\"{1:.5g}\" role=\"img\">"
      "<title>{2}</title>\n{3}</svg>\n",
      width_, height_, html_text(described_), out_);
}

void Svg::line(SvgPoint from, SvgPoint to, const SvgPen& pen) {
  out_ += fmt::format("<line x1=\"{:.5g}\" y1=\"{:.5g}\" x2=\"{:.5g}\" y2=\"{:.5g}\" style=\"{}\"/>\n", from.x, from.y,
                      to.x, to.y, style_of(pen));
}

void Svg::path(const std::vector<SvgPoint>& points, const SvgPen& pen, bool closed) {
  if (points.empty()) return;
  out_ += "<path d=\"M";
  for (const SvgPoint& p : points) out_ += fmt::format("{:.1f} {:.1f} ", p.x, p.y);
  out_ += fmt::format("{}\" style=\"{};stroke-linejoin:round\"/>\n", closed ? "Z" : "", style_of(pen));
}

void Svg::rectangle(SvgPoint corner, double width, double height, const SvgPen& pen) {
  out_ += fmt::format("<rect x=\"{:.5g}\" y=\"{:.5g}\" width=\"{:.5g}\" height=\"{:.5g}\" style=\"{}\"/>\n", corner.x,
                      corner.y, std::max(width, 0.0), std::max(height, 0.0), style_of(pen));
}

void Svg::circle(SvgPoint centre, double radius, const SvgPen& pen) {
  out_ += fmt::format("<circle cx=\"{:.5g}\" cy=\"{:.5g}\" r=\"{:.4g}\" style=\"{}\"/>\n", centre.x, centre.y, radius,
                      style_of(pen));
}

void Svg::arc(SvgPoint centre, double radius, double from, double to, const SvgPen& pen, bool arrow) {
  constexpr double step = 0.05;
  const int pieces = std::max(2, static_cast<int>(std::fabs(to - from) / step));
  std::vector<SvgPoint> points;
  const auto at = [&](double angle, double r) {
    return SvgPoint{centre.x + r * std::cos(angle), centre.y - r * std::sin(angle)};
  };
  for (int k = 0; k <= pieces; ++k) points.push_back(at(from + (to - from) * k / pieces, radius));
  path(points, pen);
  if (!arrow) return;
  const double length = 3.0 + 2.0 * pen.width, back = to - std::copysign(length / radius, to - from);
  path({at(back, radius + 0.5 * length), at(to, radius), at(back, radius - 0.5 * length)}, pen);
}

void Svg::text(SvgPoint at, const std::string& words, SvgAnchor anchor, const std::string& colour, double size) {
  out_ += fmt::format(
      "<text x=\"{:.5g}\" y=\"{:.5g}\" text-anchor=\"{}\" font-size=\"{:.3g}\" style=\"fill:{}\">{}"
      "</text>\n",
      at.x, at.y, name_of(anchor), size, colour.empty() ? ink : colour, html_text(display_text(words)));
}

void Svg::image(SvgPoint corner, double width, double height, const Raster& raster) {
  out_ += fmt::format(
      "<image x=\"{:.5g}\" y=\"{:.5g}\" width=\"{:.5g}\" height=\"{:.5g}\" preserveAspectRatio=\"none\" "
      "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n",
      corner.x, corner.y, width, height, base64(png_bytes(raster)));
}

void Svg::group(const std::string& name) { out_ += fmt::format("<g><title>{}</title>\n", html_text(name)); }

void Svg::text_upwards(SvgPoint at, const std::string& words) {
  out_ += fmt::format(
      "<text transform=\"translate({:.5g} {:.5g}) rotate(-90)\" text-anchor=\"middle\" font-size=\"11\" "
      "style=\"fill:{}\">{}</text>\n",
      at.x, at.y, quiet_ink, html_text(display_text(words)));
}

void Svg::picture(SvgPoint corner, const std::string& svg) {
  out_ += fmt::format("<g transform=\"translate({:.5g} {:.5g})\">\n{}</g>\n", corner.x, corner.y, svg);
}

std::string Svg::file() const {
  const std::string_view page = embedded::page_files.find("document.css");
  constexpr std::string_view variable = "var(--";
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.5g} {:.5g}\" width=\"{:.5g}\" height=\"{:.5g}\" "
      "role=\"img\" style=\"font-family:'DejaVu Sans',Verdana,sans-serif\"><title>{}</title>\n",
      width_, height_, 2.0 * width_, 2.0 * height_, html_text(described_));
  std::size_t done = 0;
  for (std::size_t at = 0; (at = out_.find(variable, at)) != std::string::npos; ++at) {
    if (out_[out_.find_last_of("<>", at)] == '>') continue;  // words
    const std::size_t end = out_.find(')', at);
    const std::string name = fmt::format("--{}: ", out_.substr(at + variable.size(), end - at - variable.size()));
    const std::size_t colour = page.find(name) + name.size();
    text.append(out_, done, at - done).append(page.substr(colour, page.find(';', colour) - colour));
    done = end + 1;
  }
  return text.append(out_, done) + "</svg>\n";
}

SvgPoint size_of(const std::string& svg) {
  constexpr std::string_view before = "viewBox=\"0 0 ";
  const std::size_t width = svg.find(before) + before.size(), height = svg.find(' ', width) + 1;
  return {number_in(svg.substr(width, height - width)), number_in(svg.substr(height, svg.find('"', height) - height))};
}

std::vector<std::string> text_lines(const std::string& words, double width, double size) {
  const std::string text = display_text(words);
  constexpr double letter = 0.58;  // of the size, in a wide font
  const auto most = static_cast<std::size_t>(std::max(1.0, width / (letter * size)));
  std::vector<std::string> lines;
  std::string line;
  const auto add = [&](const std::string& word) {
    if (!line.empty() && display_width(line) + 1 + display_width(word) > most)
      lines.push_back(std::move(line)), line.clear();
    line += (line.empty() ? "" : " ") + word;
    while (display_width(line) > most) {  // one long word
      std::size_t end = 0;
      for (std::size_t k = 0; k < most; ++k) end += std::max<std::size_t>(1, character_length(line, end));
      lines.push_back(line.substr(0, end));
      line.erase(0, end);
    }
  };
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (end > begin) add(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

AxisExtent widened(AxisExtent extent, double share) {
  double room = share * (extent.high - extent.low);
  if (!(room > 0.0)) room = 0.1 * std::max(std::fabs(extent.high), 1e-300);
  return {extent.low - room, extent.high + room};
}

double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  constexpr double rounding = 1e-9;
  for (const double digit : {1.0, 2.0, 5.0})
    if (value <= digit * power * (1.0 + rounding)) return digit * power;
  return 10.0 * power;
}

std::vector<double> round_ticks(AxisExtent extent, int count) {
  std::vector<double> ticks;
  const double span = extent.high - extent.low;
  if (!(span > 0.0) || !std::isfinite(span)) return ticks;
  const double step = round_up(span / count);
  const double first = std::ceil(extent.low / step - 1e-9);
  for (double k = first; k * step <= extent.high + 1e-9 * span; k += 1.0) ticks.push_back(k == 0.0 ? 0.0 : k * step);
  return ticks;
}

namespace {

// Places along an axis of this many pixels, with their words; names that would touch the one before are left out.
std::vector<std::pair<double, std::string>> ticks_of(AxisExtent extent, const AxisWords& axis, double length,
                                                     bool across) {
  std::vector<std::pair<double, std::string>> ticks;
  std::size_t longest = 1;
  for (const std::string& name : axis.names) longest = std::max(longest, name.size());
  constexpr double letter = 6.4, line = 13.0, room_across = 70.0, room_up = 38.5;
  const double room = across ? letter * static_cast<double>(longest + 1) : line;
  const auto every =
      static_cast<std::size_t>(std::max(1.0, std::ceil(room * static_cast<double>(axis.names.size()) / length)));
  for (std::size_t k = 0; k < axis.names.size(); k += every)
    ticks.emplace_back(static_cast<double>(k) + 0.5, axis.names[k]);
  if (!ticks.empty()) return ticks;
  const AxisExtent shown{extent.low * axis.factor, extent.high * axis.factor};
  const double count = std::max(3.0, length / (across ? room_across : room_up));
  for (const double t : axis.log ? decades(shown) : round_ticks(shown, static_cast<int>(std::lround(count))))
    ticks.emplace_back(t / axis.factor, tick_words(t, axis.log));
  return ticks;
}

}  // namespace

SvgAxes::SvgAxes(Svg& svg, SvgPoint top_left, SvgPoint bottom_right, AxisExtent x, AxisExtent y,
                 const AxisWords& x_words, const AxisWords& y_words)
    : svg_(svg), top_left_(top_left), bottom_right_(bottom_right), x_(x), y_(y), log_(x_words.log) {
  for (const auto& [place, words] : ticks_of(x, x_words, bottom_right.x - top_left.x, true)) {
    const SvgPoint foot = {at(place, y.low).x, bottom_right.y};
    svg_.line(foot, {foot.x, foot.y + 4.0}, {quiet_ink, ""});
    svg_.text({foot.x, foot.y + 15.0}, words, SvgAnchor::middle, quiet_ink);
  }
  for (const auto& [place, words] : ticks_of(y, y_words, bottom_right.y - top_left.y, false)) {
    const SvgPoint foot = {top_left.x, at(x.low, place).y};
    svg_.line(foot, {bottom_right.x, foot.y}, {rule_colour, "", 0.7});
    svg_.text({foot.x - 5.0, foot.y + 4.0}, words, SvgAnchor::end, quiet_ink);
  }
  svg_.line({top_left.x, bottom_right.y}, bottom_right, {quiet_ink, ""});
  svg_.line(top_left, {top_left.x, bottom_right.y}, {quiet_ink, ""});
  if (!x_words.label.empty())
    svg_.text({0.5 * (top_left.x + bottom_right.x), bottom_right.y + 31.0}, x_words.label, SvgAnchor::middle,
              quiet_ink);
  if (!y_words.label.empty()) svg_.text_upwards({11.0, 0.5 * (top_left.y + bottom_right.y)}, y_words.label);
}

SvgPoint SvgAxes::at(double x, double y) const {
  const double across = log_ ? std::log(x / x_.low) / std::log(x_.high / x_.low) : (x - x_.low) / (x_.high - x_.low);
  const double up = (y - y_.low) / (y_.high - y_.low);
  return {top_left_.x + across * (bottom_right_.x - top_left_.x),
          bottom_right_.y + up * (top_left_.y - bottom_right_.y)};
}

SvgPoint SvgAxes::inside(double x, double y) const {
  return at(std::clamp(x, x_.low, x_.high), std::clamp(y, y_.low, y_.high));
}

std::vector<SvgPoint> SvgAxes::inside(const std::vector<double>& x, const std::vector<double>& y) const {
  std::vector<SvgPoint> points;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i] >= x_.low && x[i] <= x_.high) points.push_back(inside(x[i], y[i]));
  return points;
}

void SvgAxes::line(const std::vector<double>& x, const std::vector<double>& y, const SvgPen& pen) {
  svg_.path(inside(x, y), pen);
}

void SvgAxes::band(const std::vector<double>& x, const std::vector<double>& low, const std::vector<double>& high,
                   const SvgPen& pen) {
  std::vector<SvgPoint> points = inside(x, high), below = inside(x, low);
  points.insert(points.end(), below.rbegin(), below.rend());
  svg_.path(points, pen, true);
}

void SvgAxes::bar(double from, double to, double low, double high, const SvgPen& pen) {
  const SvgPoint a = inside(from, high), b = inside(to, low);
  svg_.rectangle(a, b.x - a.x, b.y - a.y, pen);
}

void SvgAxes::limit_across(double y, const std::string& name) {
  const bool above = y > y_.high;
  const double height = above ? top_left_.y : at(x_.low, y).y;
  if (!above) svg_.line({top_left_.x, height}, {bottom_right_.x, height}, {limit_colour, "", 1.4, 1.0, true});
  svg_.text({bottom_right_.x, height - 3.0}, above ? name + " (above)" : name, SvgAnchor::end, limit_colour);
}

void SvgAxes::scale_above(const std::vector<double>& x, const std::vector<std::string>& words,
                          const std::string& label) {
  constexpr double letter = 7.0, apart = 10.0;
  svg_.line(top_left_, {bottom_right_.x, top_left_.y}, {quiet_ink, "", 0.7});
  double free = top_left_.x - apart;
  for (std::size_t k = 0; k < x.size() && k < words.size(); ++k) {
    const double place = at(x[k], y_.low).x, half = 0.5 * letter * static_cast<double>(words[k].size());
    if (place < top_left_.x || place > bottom_right_.x || place - half < free) continue;
    svg_.line({place, top_left_.y}, {place, top_left_.y - 4.0}, {quiet_ink, ""});
    svg_.text({place, top_left_.y - 7.0}, words[k], SvgAnchor::middle, quiet_ink);
    free = place + half + apart;
  }
  svg_.text({0.5 * (top_left_.x + bottom_right_.x), top_left_.y - 21.0}, label, SvgAnchor::middle, quiet_ink);
}

void SvgAxes::limit_up(double x, const std::string& name) {
  const bool beyond = x > x_.high;
  const double place = beyond ? bottom_right_.x : at(x, y_.low).x;
  if (!beyond) svg_.line({place, top_left_.y}, {place, bottom_right_.y}, {limit_colour, "", 1.4, 1.0, true});
  const bool left = place > 0.6 * (top_left_.x + bottom_right_.x);
  svg_.text({place + (left ? -4.0 : 4.0), top_left_.y + 9.0}, beyond ? name + " (beyond) →" : name,
            left ? SvgAnchor::end : SvgAnchor::start, limit_colour);
}

}  // namespace equipoise
