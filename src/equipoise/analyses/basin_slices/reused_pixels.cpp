// Centres compared, rows copied.
#include "equipoise/analyses/basin_slices/reused_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "equipoise/analyses/words/sweeps.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

// Centres are accurate to some roundings of the axes' ends.
std::vector<int> same_centres(const SliceAxis& axis, const SliceAxis& other) {
  const double largest =
      std::max({std::fabs(axis.low), std::fabs(axis.high), std::fabs(other.low), std::fabs(other.high)});
  const double near =
      1e-12 * std::min(axis.step(), other.step()) + 8.0 * std::numeric_limits<double>::epsilon() * largest;
  std::vector<int> result;
  for (int k = 0; k < axis.pixels; ++k) {
    const double place = (axis.centre(k) - other.low) / other.step() - 0.5;
    const int nearest = static_cast<int>(std::lround(std::clamp(place, 0.0, other.pixels - 1.0)));
    result.push_back(std::fabs(other.centre(nearest) - axis.centre(k)) <= near ? nearest : -1);
  }
  return result;
}

void reused_pixels(const std::string& from, const io::SliceFileHeader& header, const PixelPlan& plan,
                   const TakePixels& take) {
  const io::SliceReader there(from);
  if (const std::string how = io::difference(there.subject(), io::subject_of(header)); !how.empty())
    throw InputError(from, "", "", fmt::format(words::sweeps::other_pixels, how));
  std::map<short, MotionName> names;
  for (const OutcomeShare& c : there.codes()) names[c.id] = {c.name, c.alias, c.id < first_free_id ? c.id : 0};
  const std::vector<int> columns = same_centres(header.x, there.x()), rows = same_centres(header.y, there.y());
  std::vector<SlicePixel> row(static_cast<std::size_t>(there.x().pixels));
  for (int y = 0; y < header.y.pixels; ++y) {
    if (rows[static_cast<std::size_t>(y)] < 0) continue;
    there.read_rows(rows[static_cast<std::size_t>(y)], 1, row.data());
    DonePixels done;
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const std::uint32_t position = static_cast<std::uint32_t>(static_cast<std::size_t>(y) * columns.size() + x);
      if (columns[x] < 0 || !row[static_cast<std::size_t>(columns[x])].computed || plan.known(position)) continue;
      const SlicePixel& pixel = row[static_cast<std::size_t>(columns[x])];
      const auto name = names.find(pixel.code);
      done.positions.push_back(position);
      done.pixels.push_back(pixel);
      done.motions.push_back(name == names.end() ? nullptr : &name->second);
    }
    if (!done.positions.empty()) take(done);
  }
}

}  // namespace equipoise
