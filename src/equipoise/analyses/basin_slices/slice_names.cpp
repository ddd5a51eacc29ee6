// Usual names, and names of motions met.
#include "equipoise/analyses/basin_slices/slice_names.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "equipoise/attractors/motions/catalogue.hpp"

namespace equipoise {

namespace {

// Motions of two balls without a fixed identifier that slices are known to show. They have the same code, and thus
// colour, in every slice. Other motions come after them.
constexpr std::array usual_names{
    "both captured",       "both captured, chaotic", "both captured, quasi-periodic", "one captured, quasi-periodic",
    "pair drift, chaotic", "one captured, period 2"};
constexpr short first_other = static_cast<short>(first_free_id + usual_names.size());

}  // namespace

bool SliceNames::listed(short code) const {
  return std::any_of(codes_.begin(), codes_.end(), [&](const OutcomeShare& c) { return c.id == code; });
}

short SliceNames::code(const MotionName& m) {
  const auto known = std::find_if(codes_.begin(), codes_.end(), [&](const OutcomeShare& c) {
    return m.id != 0 ? c.id == m.id : c.id >= first_free_id && c.name == m.name;
  });
  if (known != codes_.end()) return static_cast<short>(known->id);
  const auto usual = std::find(usual_names.begin(), usual_names.end(), m.name);
  auto code = static_cast<short>(m.id != 0 ? m.id : first_free_id + (usual - usual_names.begin()));
  if (m.id == 0 && usual == usual_names.end()) {
    code = std::max(code, static_cast<short>(highest_ + 1));
    for (const OutcomeShare& c : codes_) code = std::max<short>(code, static_cast<short>(c.id + 1));
  }
  codes_.push_back({code, m.name, m.alias, {}});
  return code;
}

void SliceNames::know(const OutcomeShare& code) {
  if (!listed(static_cast<short>(code.id))) codes_.push_back(code);
}

// Pixels come in long rows of one code.
void SliceNames::see(short code, std::uint32_t position) {
  if (code <= 0 || (code == last_ && position >= last_first_)) return;
  const auto entry = first_.emplace(code, position).first;
  entry->second = std::min(entry->second, position);
  last_ = code;
  last_first_ = entry->second;
}

std::map<short, OutcomeShare> SliceNames::seen(bool whole) const {
  std::map<short, OutcomeShare> result;
  std::vector<std::pair<std::uint32_t, const OutcomeShare*>> others;
  for (const OutcomeShare& c : codes_) {
    const auto at = first_.find(c.id);
    if (at == first_.end()) continue;
    if (c.id < first_other || !whole)
      result.emplace(c.id, c);
    else
      others.emplace_back(at->second, &c);
  }
  std::sort(others.begin(), others.end());
  for (std::size_t k = 0; k < others.size(); ++k) {
    OutcomeShare c = *others[k].second;
    c.id = static_cast<short>(first_other + static_cast<short>(k));
    result.emplace(others[k].second->id, c);
  }
  return result;
}

}  // namespace equipoise
