// Rules of rotors that tilt which keys.cpp cannot express.
#include "equipoise/study/reading/tilt_reader.hpp"

#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

// Stiffness or damping of a rotor that tilts, in one direction: [k11, k12; k12, k22].
struct SupportMatrix {
  double centre, across, tilt;

  double determinant() const { return centre * tilt - across * across; }
  // Supports at a single place, whose sums and moments are rounded, have a determinant of zero.
  double rounding() const { return 1e-12 * centre * tilt; }
};

void check_supports(const TableReader& table, const model::Parameters& p) {
  const model::Tilt& t = p.tilt;
  for (const std::size_t d : {0, 1}) {
    const SupportMatrix springs{p.stiffness[d], t.stiffness[d][0], t.stiffness[d][1]},
        dampers{p.damping[d], t.damping[d][0], t.damping[d][1]};
    if (!(springs.tilt > 0.0) || !(springs.determinant() > springs.rounding()))
      table.fail("stiffness", fmt::format(words::study::stiffness_not_definite, springs.centre));
    if (dampers.tilt < 0.0 || dampers.determinant() < -dampers.rounding())
      table.fail("damping", fmt::format(words::study::damping_not_definite, dampers.centre));
  }
}

// Where stiffness and damping of each bearing are stated, they are those of the supports.
void check_bearings(TableReader& table, const Study& study) {
  const std::vector<double>* const lists[] = {&study.bearings_stiffness, &study.bearings_damping};
  constexpr const char* keys[] = {"bearings_stiffness", "bearings_damping"};
  const std::size_t count = study.bearings.size();
  for (const std::size_t k : {0, 1}) {
    if (lists[k]->empty() && lists[1 - k]->empty()) continue;
    if (count > model::most_bearings)
      table.fail("bearings_at", fmt::format(words::study::most_bearings, model::most_bearings));
    if (lists[k]->size() != count && lists[k]->size() != 2 * count)
      table.fail(keys[k], fmt::format(words::study::one_or_two_a_bearing, count, 2 * count));
  }
  if (study.bearings_stiffness.empty()) return;
  const std::vector<model::Bearing> each = study.each_bearing();
  if (!model::make_stiffness(each, study.parameters))
    table.fail(keys[0], fmt::format(words::study::not_the_supports, "stiffness"));
  if (!model::make_damping(each, study.parameters))
    table.fail(keys[1], fmt::format(words::study::not_the_supports, "damping"));
}

}  // namespace

void read_tilt(const StudyFile& file, Study& study) {
  TableReader rotor(file, "rotor");
  model::Parameters& p = study.parameters;
  if (!rotor.has("tilt")) {
    if (rotor.has("eccentricity_angle")) rotor.fail("eccentricity_angle", words::study::only_of_tilt);
    return;
  }
  TableReader table(file, "rotor.tilt");
  read_keys(table, "rotor.tilt", all_variants, study);
  table.finish();
  if (!at_most(p.tilt.polar_inertia, 2.0 * p.tilt.transverse_inertia))
    table.fail("polar_inertia", words::study::no_such_body);
  check_supports(table, p);
  check_bearings(table, study);
  if (!rotor.has("inertia")) p.inertia = model::axial_inertia(p.tilt);
}

void check_tilting_balls(const StudyFile& file, const model::Parameters& p) {
  TableReader reader(file, "balancer");
  if (!p.tilts()) {
    if (reader.has("plane")) reader.fail("plane", words::study::only_of_tilt);
    return;
  }
  if (!reader.has("plane")) reader.fail("plane", words::study::tilt_needs_planes);
  const auto refuse = [&](const char* key, bool set, const char* physical_key = nullptr) {
    if (set && physical_key && file.scales)
      reader.fail(physical_key, fmt::format(words::study::not_with_tilt_unless, physical_key));
    if (set) reader.fail(key, words::study::not_with_tilt);
  };
  refuse("race_offset", !p.race_is_centred());
  refuse("rolls", p.rolls, "rolls");
  refuse("contact_angle", p.balls_collide(), "contact");
  refuse(reader.has("rolling") ? "rolling" : "stiction", p.balls_stick());
}

void check_force_limit(const StudyFile& file, const Study& study) {
  if (study.bearings.size() < 2) return;
  TableReader limits(file, "limits");
  for (const char* key : {"force", "dynamic_force"}) {
    if (!limits.has(key)) continue;
    if (study.bearings.size() > 2 && study.bearings_stiffness.empty())
      limits.fail(key, words::study::force_of_more_bearings);
    if (study.standards.standing_mass) limits.fail(key, words::study::force_of_one_or_all);
  }
}

void check_unbalance_limits(const StudyFile& file, const Study& study) {
  if (!study.parameters.tilts() || model::tolerance_planes(study.bearings)) return;
  TableReader limits(file, "limits");
  for (const char* key : {"residual", "grade"})
    if (limits.has(key)) limits.fail(key, words::study::unbalance_without_planes);
}

}  // namespace equipoise::study
