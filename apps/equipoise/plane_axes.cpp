// Reads the axes of a plane as they were typed.
#include "plane_axes.hpp"

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

SliceAxis axis_of(const Study& study, const std::string& text, const std::string& range, int pixels,
                  const std::string& option) {
  const std::string range_option = option + "-range";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos && range.empty() && !SliceAxis{text, 0.0, 1.0, pixels}.angle())
    throw InputError(
        option, text, "",
        fmt::format(words::axis_without_range, option, text, text.starts_with("speed") ? "1.5:6" : "0.01:0.5"));
  if (equals == std::string::npos) return slice_axis(study, text, range, pixels, range_option);
  if (!range.empty())
    throw InputError(range_option, "", display_text(range), fmt::format(words::range_given_twice, option));
  if (equals == 0 || equals + 1 == text.size()) throw InputError(option, "", display_text(text), words::axis_form);
  return slice_axis(study, text.substr(0, equals), text.substr(equals + 1), pixels, option);
}

}  // namespace

void add_plane_axes(CLI::App& app, PlaneAxes& axes, const char* x, const char* y, const char* size) {
  app.add_option("--x", axes.x, x)->type_name("KEY[=LOW:HIGH]");
  app.add_option("--y", axes.y, y)->type_name("KEY[=LOW:HIGH]");
  app.add_option("--x-range", axes.x_range, help::x_range)->type_name("LOW:HIGH");
  app.add_option("--y-range", axes.y_range, help::y_range)->type_name("LOW:HIGH");
  app.add_option("--size", axes.size, size)->type_name("WIDTHxHEIGHT");
}

ReadAxes read_axes(const Study& study, const PlaneAxes& axes) {
  const SliceSize size = map_size(axes.size, "--size");
  return {axis_of(study, axes.x, axes.x_range, size.width, "--x"),
          axis_of(study, axes.y, axes.y_range, size.height, "--y")};
}

}  // namespace equipoise::app
