// Reads KEY=FROM:TO:STEP and KEY=A,B,C.
#include "equipoise/analyses/sweeps/sweep_axis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/base/stepped_values.hpp"

namespace equipoise {

namespace {

constexpr char axis_form[] =
    "must be KEY=FROM:TO:STEP or KEY=A,B,C in numbers, e.g. speed.final=1.5:6:0.1, or in quantities of one unit, e.g. "
    "\"speed.final=900 rpm:4000 rpm:100 rpm\"";

bool has_repeats(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return std::adjacent_find(values.begin(), values.end()) != values.end();
}

}  // namespace

SweepParameter sweep_parameter(const std::string& text, const std::string& option) {
  const auto reject = [&](const std::string& problem) { throw InputError(option, "", display_text(text), problem); };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) reject(axis_form);
  SweepParameter parameter;
  parameter.key = trimmed(std::string_view(text).substr(0, equals));
  const std::string list = text.substr(equals + 1);
  const bool range = list.find(':') != std::string::npos;
  std::vector<double> numbers;
  for (const std::string& given : parts_of(list, range ? ':' : ',')) {
    const std::string_view part = trimmed(given);
    double& value = numbers.emplace_back();
    const char* end = part.data() + part.size();
    const auto read = read_number(part.data(), end, value);
    if (read.error != std::errc() || !std::isfinite(value)) reject(axis_form);
    const std::string unit(trimmed({read.end, static_cast<std::size_t>(end - read.end)}));
    if (numbers.size() == 1) parameter.unit = unit;
    if (unit != parameter.unit)
      reject(fmt::format("mixes the units \"{}\" and \"{}\"; must be one", parameter.unit, unit));
  }
  if (range) {
    if (numbers.size() != 3) reject(axis_form);
    const std::string problem = stepped_values(numbers[0], numbers[1], numbers[2], most_sweep_cells, parameter.values);
    if (!problem.empty()) reject(problem);
  } else {
    parameter.values = numbers;
  }
  for (const double value : parameter.values)
    parameter.given.push_back(parameter.unit.empty() ? fmt::format("{}", value)
                                                     : fmt::format("{} {}", value, parameter.unit));
  return parameter;
}

std::vector<SweepAxis> sweep_axes(const std::vector<std::string>& texts, bool zip, const std::string& option) {
  std::vector<SweepAxis> axes;
  std::size_t cells = 1;
  std::vector<std::string> keys;
  for (const std::string& text : texts) {
    SweepParameter parameter = sweep_parameter(text, option);
    const auto reject = [&](const std::string& problem) {
      throw InputError(option, parameter.key, display_text(text.substr(text.find('=') + 1)), problem);
    };
    if (std::find(keys.begin(), keys.end(), parameter.key) != keys.end()) reject("is varied twice; must be named once");
    keys.push_back(parameter.key);
    const std::size_t size = parameter.values.size();
    const bool along_another = zip && !axes.empty();
    if (!along_another && has_repeats(parameter.values))
      reject(zip ? "has a value twice; the first of parameters that vary together is the axis, and must have different "
                   "ones"
                 : "has a value twice; must be different ones");
    if (along_another) {
      if (axes.front().size() != size)
        reject(fmt::format("has {} value{}, {} has {}; zipped parameters must have as many each", size, plural(size),
                           keys.front(), axes.front().size()));
      axes.front().parameters.push_back(std::move(parameter));
      continue;
    }
    if (size > most_sweep_cells / cells)
      reject(fmt::format("makes more than {} cells; must be fewer", most_sweep_cells));
    cells *= size;
    axes.push_back({{std::move(parameter)}});
  }
  if (axes.empty() || axes.size() > most_sweep_axes)
    throw InputError(option, "", fmt::format("{} parameters", axes.size()),
                     fmt::format("must be 1 to {} parameters, or more that vary together", most_sweep_axes));
  return axes;
}

}  // namespace equipoise
