// Draws and corners of families.
#include "equipoise/classification/rotor_family/study_family.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

// A seed apart from the study's, on which the search then does not depend.
constexpr std::uint64_t family_warm_start = 0xd1b54a32d192ed03;
// For values without ends: this fraction at each side is decided without trapping regions.
constexpr double rare = 1e-4;

std::vector<StudyFamily::Quantile> quantiles_of(const Study& study) {
  std::vector<StudyFamily::Quantile> quantiles;
  for (const UncertainValue& value : study.uncertain.values) {
    StudyFamily::Quantile& q = quantiles.emplace_back();
    q.at = [value](double fraction) { return value.at(fraction); };
    if (value.kind == DistributionKind::normal && !value.between) {
      q.low = rare;
      q.high = 1.0 - rare;
    }
    const std::size_t count = value.kind == DistributionKind::values ? value.numbers.size() : 1;
    for (std::size_t i = 1; i < count; ++i) q.breaks.push_back(static_cast<double>(i) / static_cast<double>(count));
  }
  return quantiles;
}

}  // namespace

bool FamilyBox::holds(std::span<const double> fractions) const {
  for (std::size_t k = 0; k < low.size(); ++k)
    if (!(low[k] <= fractions[k] && (fractions[k] < high[k] || high[k] == 1.0))) return false;
  return true;
}

std::vector<double> FamilyBox::at(std::span<const double> of_cube) const {
  std::vector<double> result;
  for (std::size_t k = 0; k < low.size(); ++k) result.push_back(low[k] + (high[k] - low[k]) * of_cube[k]);
  return result;
}

std::vector<double> FamilyBox::centre() const { return at(std::vector<double>(low.size(), 0.5)); }

StudyFamily::StudyFamily(const Study& study)
    : StudyFamily(quantiles_of(study), [study](std::span<const double> values) { return drawn_study(study, values); }) {
}

std::vector<FamilyBox> StudyFamily::parts() const {
  std::vector<FamilyBox> parts{{}};
  for (const Quantile& value : values_) {
    std::vector<double> ends{value.low};
    ends.insert(ends.end(), value.breaks.begin(), value.breaks.end());
    ends.push_back(value.high);
    std::vector<FamilyBox> finer;
    for (const FamilyBox& part : parts)
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        finer.push_back(part);
        finer.back().low.push_back(ends[i]);
        finer.back().high.push_back(ends[i + 1]);
      }
    parts = std::move(finer);
  }
  return parts;
}

std::vector<double> StudyFamily::coordinates(const FamilyBox& box, std::span<const double> fractions) const {
  std::vector<double> result;
  for (std::size_t k = 0; k < size(); ++k) {
    // If a value jumps at the end of a box, the box ends before the jump.
    const double low = values_[k].at(box.low[k]), high = values_[k].at(std::nextafter(box.high[k], box.low[k]));
    result.push_back(high > low ? (values_[k].at(fractions[k]) - low) / (high - low) : 0.5);
  }
  return result;
}

std::vector<double> StudyFamily::values_at(std::span<const double> fractions) const {
  std::vector<double> values;
  for (std::size_t k = 0; k < size(); ++k) values.push_back(values_[k].at(fractions[k]));
  return values;
}

std::vector<double> StudyFamily::place(std::uint64_t index) const {
  std::vector<double> of_cube;
  for (std::size_t k = 0; k < size(); ++k)
    of_cube.push_back(start_fraction(family_warm_start, index, "value " + std::to_string(k)));
  return of_cube;
}

Study StudyFamily::draw(const FamilyBox& box, std::uint64_t index) const { return at(values_at(box.at(place(index)))); }

std::vector<StudyFamily::Placed> StudyFamily::ends(const FamilyBox& box) const {
  std::vector<std::vector<double>> places{std::vector<double>(size(), 0.5)};
  if (size() <= most_tried_together)
    for (std::size_t corner = 0; corner < std::size_t{1} << size(); ++corner) {
      places.emplace_back();
      for (std::size_t k = 0; k < size(); ++k) places.back().push_back((corner >> k) & 1 ? 1.0 : 0.0);
    }
  else
    for (std::size_t k = 0; k < 2 * size(); ++k) {
      places.emplace_back(size(), 0.5);
      places.back()[k / 2] = static_cast<double>(k % 2);
    }
  std::vector<Placed> studies;
  for (const std::vector<double>& place : places) try {
      std::vector<double> fractions = box.at(place);
      for (std::size_t k = 0; k < size(); ++k)
        if (place[k] == 1.0) fractions[k] = std::nextafter(fractions[k], 0.0);
      studies.push_back({coordinates(box, fractions), at(values_at(fractions))});
    } catch (const InputError&) {  // starts that draw such values have failed
    }
  return studies;
}

Study at_final_speed(const Study& study) {
  Study steady = study;
  steady.sampling = {};
  steady.limits = {};
  if (study.speed.driven()) return with_horizon(steady);
  steady.speed = {};
  steady.speed.speed = study.speed_profile().final_speed();
  steady.release = {};
  steady.initial = {};
  return with_horizon(steady);
}

}  // namespace equipoise
