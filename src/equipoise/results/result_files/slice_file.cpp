// Dimensions, variables and attributes of a basin slice.
#include "equipoise/results/result_files/slice_file.hpp"

#include <cstdint>
#include <limits>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise::io {

namespace {

// Of the pixels followed again (SliceFigures::flipped).
constexpr char flipped_name[] = "tolerance_flips", tried_name[] = "tolerance_pixels";

std::string links_text(const std::vector<AngleLink>& links) {
  std::string text;
  for (const AngleLink& link : links)
    text += fmt::format("{}phi_{} = phi_{} + {}", text.empty() ? "" : "; ", link.ball, link.of, link.offset);
  return text;
}

void add_pixels(Dataset& data, const std::vector<std::size_t>& plane, const SliceFileHeader& header,
                const std::vector<OutcomeShare>& codes, const std::function<DataValues(std::size_t)>& values) {
  const std::vector<StoredColumn> kept = pixel_columns(header.one_rotor);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    DataColumn& column = data.add(kept[k], plane, values(k), kept[k].type);
    column.fill = k == 0 ? not_computed_code : std::numeric_limits<double>::quiet_NaN();
    if (k == 0) add_outcome_flags(column, codes);
  }
  for (std::size_t k = kept.size() - 1; k < pixel_numbers.size(); ++k)
    data.add(
            pixel_numbers[k], {}, [&header, k](std::size_t) { return header.rotor.*pixel_numbers[k].value; },
            DataColumn::Type::single)
        .fill = std::numeric_limits<double>::quiet_NaN();
}

void add_flipped(Dataset& data, const Share& flipped) {
  const auto add = [&](const char* name, const std::string& meaning, std::uint64_t count) {
    data.add(
        name, "1", meaning, {}, [count](std::size_t) { return count; }, DataColumn::Type::integer);
  };
  add(tried_name, fmt::format("pixels followed again with {:g} of the tolerance", SliceFigures::finer), flipped.total);
  add(flipped_name, "those of them that end elsewhere", flipped.count);
}

void say_attributes(Dataset& data, const SliceFileHeader& header, bool complete) {
  data.say("identity", identity_of(header));
  say_axes(data, header.x, header.y);
  data.say("axes", axis_text(header.x) + "; " + axis_text(header.y));
  data.say("links", links_text(header.links));
  data.say("study", header.study);
  data.say("complete", complete ? "yes" : "no");
}

}  // namespace

std::string identity_of(const SliceFileHeader& h) {
  const auto range = [](const SliceAxis& a) { return fmt::format("{} to {} in {} pixels", a.low, a.high, a.pixels); };
  return fmt::format(
      "{}\n[file]\nversion = {}\narithmetic = {}\nx = {}\ny = {}\nties = {}\nx_range = {}\ny_range = {}\n", h.study,
      version_string, h.arithmetic, h.x.key, h.y.key, h.links.empty() ? "none" : links_text(h.links), range(h.x),
      range(h.y));
}

std::optional<Share> read_flipped(const NetcdfFile& file) {
  if (!file.has_variable(flipped_name)) return std::nullopt;
  const auto count = [&](const char* name) { return read_column(file, name, DataColumn::Type::integer, {}).front(); };
  const double flipped = count(flipped_name), tried = count(tried_name);
  if (flipped < 0.0 || flipped > tried)
    throw RunError(fmt::format("{}: {} is {} of {} pixels", file.name(), flipped_name, flipped, tried));
  return wilson_share(static_cast<std::uint64_t>(flipped), static_cast<std::uint64_t>(tried));
}

std::vector<StoredColumn> pixel_columns(bool one_rotor) {
  std::vector<StoredColumn> columns{{{"outcome", "what the pixel's start comes to"}, DataColumn::Type::small, 1, "x"}};
  visit_pixel_numbers(one_rotor, [&](std::size_t, const PixelNumber& n) {
    columns.push_back({n, DataColumn::Type::single, 1, "x"});
  });
  return columns;
}

Dataset slice_dataset(const SliceFileHeader& header, const std::vector<OutcomeShare>& codes,
                      const std::vector<std::vector<double>>& discoveries, bool complete,
                      const std::function<DataValues(std::size_t)>& values) {
  Dataset data("Where a rotor with an automatic ball balancer ends, over a plane");
  data.filled = false;
  add_pixels(data, add_axes(data, header.x, header.y), header, codes, values);
  const std::size_t kind = add_outcome_kinds(data, "", codes);
  data.add("share", "1", "share of the map's pixels", {kind}, [&codes](std::size_t k) { return codes[k].share.share; });
  if (header.flipped) add_flipped(data, *header.flipped);
  if (!discoveries.empty()) {
    const std::size_t met = data.dimension("discovery", discoveries.size()), width = discoveries.front().size();
    data.add("discovery_state", "1",
             "state on a motion first met at a pixel: x, y, u, v, phi, phi_dot, and of driven rotors what turns them",
             {met, data.dimension("component", width)},
             [&discoveries, width](std::size_t k) { return discoveries[k / width][k % width]; });
  }
  say_attributes(data, header, complete);
  return data;
}

}  // namespace equipoise::io

namespace equipoise {

void write_map_file(const std::string& path, const BasinSlice& map) {
  const std::size_t size = map.code.size();
  io::SliceFileHeader header{to_toml(map.study), map.x, map.y, map.links, "of " + map.cpu_target};
  header.flipped = map.figures.flipped;
  header.one_rotor = map.balance_margin.size() != size || size == 1;
  for (const PixelNumber& n : pixel_numbers)
    if (header.one_rotor && n.of_rotor) header.rotor.*n.value = (map.*n.all).front();
  const auto values = [&](std::size_t column) -> DataValues {
    return [&, column](std::size_t place) -> double {
      return column == 0 ? static_cast<double>(map.code[place]) : (map.*pixel_numbers[column - 1].all)[place];
    };
  };
  io::write_netcdf_file(path, io::slice_dataset(header, map.codes, {}, map.complete, values));
}

}  // namespace equipoise
