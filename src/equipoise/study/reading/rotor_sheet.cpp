// [rotor] and [[place]] in SI units: each quantity in the one way in which the study states it.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/machine/datasheet/vibration_data.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/quantity_reader.hpp"
#include "equipoise/study/words/machine.hpp"
#include "equipoise/study/words/study.hpp"

namespace equipoise::study {

namespace {

const std::string each_direction = "direction (x, y)";

// "G 6.3", or the velocity that it means, "6.3 mm/s"; in m/s.
double grade_of(const QuantityReader& reader, const std::string& key, const StudyValue& value) {
  const std::string* text = value.string();
  const std::string wanted = words::machine::must_be_grade;
  if (!text) reader.fail(key, wanted);
  double grade = 0.0;
  if (text->starts_with('G')) {
    const std::size_t first = std::min(text->find_first_not_of(' ', 1), text->size());
    const char* end = text->data() + text->size();
    const auto [after, error] = read_number(text->data() + first, end, grade);
    if (error != std::errc() || after != end) reader.fail(key, wanted);
    grade *= 1e-3;
  } else {
    const Measured measured = measure(*text, {Dimension::velocity});
    if (!measured.problem.empty()) reader.fail(key, wanted);
    grade = measured.value;
  }
  if (!(grade > 0.0) || !(grade < largest_si)) reader.fail(key, wanted + ", greater than 0");
  return grade;
}

class GradeReader : public QuantityReader {
 public:
  explicit GradeReader(const StudyFile& file) : QuantityReader(file, "rotor.balance_grade") {}

  double eccentricity() {
    const double grade = grade_of(*this, "grade", require("grade", words::machine::grade));
    const double at = quantity("at");
    finish();
    return model::eccentricity_of_grade(grade, at);
  }
};

using Complex = std::complex<double>;

// Mass times radius at an angle, added over the shaft; and its moment about the centre of mass.
struct Unbalance {
  Complex force, couple;                       // kg m, kg m^2
  double all_forces = 0.0, all_couples = 0.0;  // their sizes added

  void add(Complex one, double at) {
    force += one;
    couple += at * one;
    all_forces += std::abs(one);
    all_couples += std::abs(at * one);
  }
};

// Of all places; and their mass.
struct Places : Unbalance {
  double mass = 0.0;
  bool any = false;
};

// How many tables the array of tables at `key` has; 0 if it is absent.
std::size_t tables_at(const StudyFile& file, const std::string& key, const char* wanted) {
  const StudyValue* value = file.root.find_path(key);
  if (!value) return 0;
  const StudyValue::Array* array = value->array();
  const auto is_table = [](const StudyValue& entry) { return entry.table() != nullptr; };
  if (!array || array->empty() || !std::all_of(array->begin(), array->end(), is_table))
    throw InputError(file.where(key, value), key, "", wanted);
  return array->size();
}

Places read_places(const StudyFile& file, bool tilts) {
  Places places;
  const std::size_t count = tables_at(file, "place", words::machine::array_of_places);
  places.any = count > 0;
  for (std::size_t i = 1; i <= count; ++i) {
    QuantityReader reader(file, fmt::format("place.{}", i));
    const double mass = reader.quantity("mass"), radius = reader.quantity("radius"), angle = reader.quantity("angle");
    if (!tilts && reader.has("at")) reader.fail("at", words::study::only_of_tilt);
    const double at = tilts ? reader.quantity("at") : 0.0;
    reader.text("name");
    reader.finish();
    places.add(std::polar(mass * radius, angle), at);
    places.mass += mass;
  }
  return places;
}

// What is smaller than this, relative to what it is a sum of, is rounding.
constexpr double nothing = 1e-12;

// One [k11, k12; k12, k22] of springs or dampers.
struct SupportSums {
  double centre = 0.0, across = 0.0, tilt = 0.0;

  void add(double size, double at) {
    centre += size;
    across += size * at;
    tilt += size * at * at;
  }
  // Springs at one place alone, or none, hold no tilt.
  bool holds() const { return centre * tilt - across * across > nothing * centre * tilt; }
};

struct Bearings {
  std::array<SupportSums, 2> stiffness, damping;  // in X and Y
  std::vector<double> at, each_stiffness, each_damping;
};

class TiltReader : public QuantityReader {
 public:
  explicit TiltReader(const StudyFile& file) : QuantityReader(file, "rotor.tilt"), file_(file) {}

  bool has_bearings() { return has("bearings"); }

  Bearings bearings() {
    for (const char* key : {"stiffness", "damping", "bearings_at", "bearings_stiffness", "bearings_damping"})
      if (has(key)) fail(key, words::machine::bearings_state_it);
    Bearings b;
    const std::size_t count = tables_at(file_, "rotor.tilt.bearings", words::machine::array_of_bearings);
    for (std::size_t i = 1; i <= count; ++i) {
      QuantityReader one(file_, fmt::format("rotor.tilt.bearings.{}", i));
      b.at.push_back(one.quantity("at"));
      for (const char* key : {"stiffness", "damping"}) {
        const std::vector<double> each = one.require_one_or_each(key, 2, each_direction);
        const bool springs = key == std::string_view("stiffness");
        std::vector<double>& list = springs ? b.each_stiffness : b.each_damping;
        list.insert(list.end(), each.begin(), each.end());
        for (std::size_t d = 0; d < 2; ++d) (springs ? b.stiffness : b.damping)[d].add(each[d], b.at.back());
      }
      one.finish();
    }
    for (const SupportSums& s : b.stiffness)
      if (!s.holds()) fail("bearings", words::machine::bearings_hold_no_tilt);
    return b;
  }

  // [k12, k22] or [c12, c22] of each direction.
  std::array<std::array<double, 2>, 2> matrix(const std::string& key, Dimension across, Dimension own) {
    require(key, fmt::format(words::machine::across_and_tilt, words(across).example, words(own).example));
    const StudyValue& value = *find(key);
    if (!value.table()) {
      const std::array<double, 2> both = entries(*this, key, value, across, own);
      return {both, both};
    }
    TiltReader each(file_, dotted(key));
    std::array<std::array<double, 2>, 2> result{};
    for (std::size_t d = 0; d < 2; ++d) {
      const std::string name = d == 0 ? "x" : "y";
      result[d] = entries(each, name, each.require(name, words::study::of_tilt), across, own);
    }
    each.finish();
    return result;
  }

  // Beside what [rotor] says of itself.
  Unbalance planes() {
    Unbalance sum;
    has("unbalance");
    const std::size_t count = tables_at(file_, "rotor.tilt.unbalance", words::machine::array_of_unbalances);
    for (std::size_t i = 1; i <= count; ++i) {
      QuantityReader one(file_, fmt::format("rotor.tilt.unbalance.{}", i));
      const double at = one.quantity("at"), size = one.quantity("size");
      sum.add(std::polar(size, one.quantity("angle")), at);
      one.finish();
    }
    return sum;
  }

 private:
  TiltReader(const StudyFile& file, std::string prefix) : QuantityReader(file, std::move(prefix)), file_(file) {}

  static std::array<double, 2> entries(const TiltReader& reader, const std::string& key, const StudyValue& value,
                                       Dimension across, Dimension own) {
    const StudyValue::Array* array = value.array();
    if (!array || array->size() != 2)
      reader.fail(key, fmt::format(words::machine::must_be_across_and_tilt, words(across).example, words(own).example));
    std::array<double, 2> result{};
    for (std::size_t k = 0; k < 2; ++k)
      result[k] = measure_value((*array)[k], {k == 0 ? across : own}, any_number, [&](const std::string& problem) {
                    reader.fail(key, fmt::format("entry {} {}", k + 1, problem));
                  }).value;
    return result;
  }

  const StudyFile& file_;
};

// The ways to state the supports, of which a study has one each.
const std::vector<QuantityReader::Alternative> stiffness_ways{{"stiffness", words::machine::stiffness},
                                                              {"natural_frequency", words::machine::natural_frequency},
                                                              {"static_sag", words::machine::static_sag}};
const std::vector<QuantityReader::Alternative> damping_ways{
    {"damping", words::machine::damping},
    {"damping_ratio", "a plain number or \"5 %\", c/(2 sqrt(k M))"},
    {"logarithmic_decrement", words::machine::logarithmic_decrement},
    {"quality_factor", words::machine::quality_factor},
    {"loss_factor", words::machine::loss_factor}};

class RotorReader {
 public:
  explicit RotorReader(const StudyFile& file) : file_(file), reader_(file, "rotor"), tilt_(file) {}

  RotorSheet read() {
    r_.mass = reader_.quantity("mass");
    tilts_ = reader_.has("tilt");
    if (tilts_) read_tilt();
    if (!by_bearings_) {
      read_stiffness();
      read_damping();
    }
    read_unbalance();
    read_inertia();
    if (tilts_) tilt_.finish();
    for (const auto& [key, values] : reader_.others(0)) put(key, key, values, find_quantity("rotor", key)->dimension);
    reader_.finish();
    return std::move(r_);
  }

 private:
  void put(const std::string& key, const std::string& from, std::vector<double> values,
           std::optional<Dimension> dimension = std::nullopt) {
    r_.derived.push_back({key, from, std::move(values), dimension});
  }

  void put_tilt(const std::string& key, const std::string& from, double value, std::optional<Dimension> dimension) {
    r_.tilt.push_back({key, from, {value}, dimension});
  }

  void read_tilt() {
    transverse_ = tilt_.quantity("transverse_inertia");
    polar_ = tilt_.quantity("polar_inertia");
    put_tilt("transverse_inertia", "transverse_inertia", transverse_, Dimension::inertia);
    put_tilt("polar_inertia", "polar_inertia", polar_, Dimension::inertia);
    TiltSupports& s = r_.supports.emplace();
    by_bearings_ = tilt_.has_bearings();
    if (by_bearings_) return read_bearings(s);
    s.stiffness = tilt_.matrix("stiffness", Dimension::force, Dimension::torque);
    s.damping = tilt_.matrix("damping", Dimension::tilt_damping, Dimension::gain);
    s.stiffness_from = "stiffness";
    s.damping_from = "damping";
    for (const auto& [key, dimension] : bearing_lists)
      if (tilt_.has(key)) put_bearings(key, key, tilt_.list(key), dimension);
  }

  // What is stated of each bearing.
  static constexpr std::array bearing_lists{std::pair{"bearings_at", Dimension::length},
                                            std::pair{"bearings_stiffness", Dimension::stiffness},
                                            std::pair{"bearings_damping", Dimension::damping}};

  void put_bearings(const char* key, const char* from, const std::vector<double>& values, Dimension dimension) {
    r_.tilt.push_back({key, from, values, dimension, true});
  }

  void read_bearings(TiltSupports& s) {
    for (const auto* ways : {&stiffness_ways, &damping_ways})
      for (const QuantityReader::Alternative& way : *ways)
        if (reader_.has(way.key)) reader_.fail(way.key, words::machine::bearings_state_it);
    const auto gravity = reader_.optional_quantity("gravity");
    if (gravity) put("gravity", "gravity", {*gravity}, Dimension::acceleration);
    const Bearings b = tilt_.bearings();
    const double kx = b.stiffness[0].centre, ky = b.stiffness[1].centre;
    r_.mean_stiffness = kx + 0.5 * (ky - kx);
    put("stiffness", "tilt", {kx / r_.mean_stiffness, ky / r_.mean_stiffness});
    put("damping", "tilt", {b.damping[0].centre, b.damping[1].centre}, Dimension::damping);
    for (std::size_t d = 0; d < 2; ++d) {
      s.stiffness[d] = {b.stiffness[d].across, b.stiffness[d].tilt};
      s.damping[d] = {b.damping[d].across, b.damping[d].tilt};
    }
    s.stiffness_from = s.damping_from = "bearings";
    const std::vector<double>* const lists[] = {&b.at, &b.each_stiffness, &b.each_damping};
    // Of two, each follows from the supports.
    const std::size_t told = b.at.size() > 2 && b.at.size() <= model::most_bearings ? bearing_lists.size() : 1;
    for (std::size_t k = 0; k < told; ++k)
      put_bearings(bearing_lists[k].first, "bearings", *lists[k], bearing_lists[k].second);
  }

  void read_stiffness() {
    const std::string from = reader_.exactly_one(stiffness_ways);
    const auto gravity = reader_.optional_quantity("gravity");
    if (gravity) put("gravity", "gravity", {*gravity}, Dimension::acceleration);
    const double g = gravity.value_or(0.0) > 0.0 ? *gravity : standard_gravity;
    std::vector<double> k = reader_.one_or_each(from, 2, each_direction);
    for (double& v : k) {
      if (from == "natural_frequency") v = model::stiffness_of_frequency(r_.mass, v);
      if (from == "static_sag") v = model::stiffness_of_sag(r_.mass, g, v);
      if (!(v >= smallest_si && v <= largest_si))
        reader_.fail(from, fmt::format(words::machine::stiffness_out_of_range, v, smallest_si, largest_si));
    }
    r_.mean_stiffness = k[0] + 0.5 * (k[1] - k[0]);  // exact for equal stiffnesses
    kappa_ = k;
    for (double& v : kappa_) v /= r_.mean_stiffness;
    put("stiffness", from, kappa_);
  }

  // 12 for "12 %". Stated as a percentage a ratio may be above 1.
  void refuse_percentage(const StudyValue& given) const {
    if (given.number() > 1.0)
      reader_.fail("damping_ratio", fmt::format(words::machine::ratio_is_percentage, given.number()));
    if (const auto* each = given.array()) {
      for (const auto& v : *each) refuse_percentage(v);
    }
  }

  void read_damping() {
    const std::string from = reader_.exactly_one(damping_ways);
    if (from == "damping")
      return put("damping", from, reader_.one_or_each(from, 2, each_direction), Dimension::damping);
    if (from == "damping_ratio") refuse_percentage(*file_.root.find_path("rotor.damping_ratio"));
    const Range range = key_table("rotor").find(from, true)->range;
    std::vector<double> zeta = reader_.TableReader::one_or_each(from, range, 2, each_direction);
    for (std::size_t i = 0; i < 2; ++i) {
      if (from == "logarithmic_decrement") zeta[i] = model::ratio_of_decrement(zeta[i]);
      if (from == "quality_factor") zeta[i] = model::ratio_of_quality(zeta[i]);
      if (from == "loss_factor") zeta[i] = model::ratio_of_loss(zeta[i]);
      zeta[i] = 2.0 * zeta[i] * std::sqrt(kappa_[i]);
    }
    put("damping", from, zeta);
  }

  void read_unbalance() {
    const std::vector<QuantityReader::Alternative> ways{{"eccentricity", words::machine::eccentricity},
                                                        {"unbalance", words::machine::unbalance},
                                                        {"balance_grade", words::machine::balance_grade}};
    const Places places = read_places(file_, tilts_);
    const bool in_planes = tilts_ && tilt_.has("unbalance");
    const std::string from = places.any || in_planes ? reader_.at_most_one(ways) : reader_.exactly_one(ways);
    const bool graded = from == "balance_grade", product = from == "unbalance";
    const double own = from.empty() ? 0.0 : graded ? GradeReader(file_).eccentricity() : reader_.quantity(from);
    double misalignment = 0.0;
    if (tilts_ && tilt_.has("misalignment")) {
      misalignment = tilt_.quantity("misalignment");
      put_tilt("misalignment", "misalignment", misalignment, Dimension::angle);
    }
    if (!places.any && !in_planes)
      return put("eccentricity", from, {own}, product ? Dimension::unbalance : Dimension::length);
    if (!(places.mass < r_.mass)) reader_.fail("mass", fmt::format(words::machine::mass_includes_places, places.mass));
    const double own_force = product ? own : own * r_.mass;
    if (!tilts_) {
      const Complex resultant = own_force + places.force;
      r_.turn = std::arg(resultant);
      return put("eccentricity", from.empty() ? "place" : from, {std::abs(resultant)}, Dimension::unbalance);
    }
    Unbalance sum = tilt_.planes();
    sum.add(std::polar(own_force, reader_.optional_quantity("eccentricity_angle").value_or(0.0)), 0.0);
    sum.force += places.force;
    sum.couple += places.couple + misalignment * (transverse_ - polar_);
    sum.all_forces += places.all_forces;
    sum.all_couples += places.all_couples + std::abs(misalignment * (transverse_ - polar_));
    put_resultant(sum, from.empty() ? places.any ? "place" : "tilt" : from, in_planes ? "unbalance" : "misalignment");
  }

  // x of the model points along the couple unbalance, if there is any.
  void put_resultant(Unbalance sum, const std::string& from, const std::string& tilt_from) {
    if (std::abs(sum.force) <= nothing * sum.all_forces) sum.force = 0.0;
    if (std::abs(sum.couple) <= nothing * sum.all_couples) sum.couple = 0.0;
    const double couple = std::abs(sum.couple);
    r_.turn = couple > 0.0 ? std::arg(sum.couple) : 0.0;
    put("eccentricity", from, {std::abs(sum.force)}, Dimension::unbalance);
    put("eccentricity_angle", from, {std::abs(sum.force) > 0.0 ? wrapped(std::arg(sum.force) - r_.turn) : 0.0});
    // The model has the couple as an angle times this difference.
    const double misalignment = couple > 0.0 ? couple / (transverse_ - polar_) : 0.0;
    if (!(std::abs(misalignment) <= largest_misalignment))
      tilt_.fail("polar_inertia", fmt::format(words::machine::couple_needs_slender_rotor, couple));
    std::erase_if(r_.tilt, [](const Derived& d) { return d.key == "misalignment"; });
    put_tilt("misalignment", tilt_from, misalignment, Dimension::angle);
  }

  void read_inertia() {
    const std::string from = reader_.at_most_one({{"inertia", words::machine::inertia},
                                                  {"radius_of_gyration", "sqrt(J/M), such as \"60 mm\""},
                                                  {"gd2", "4 J, such as \"0.3 kgf m2\""}});
    if (from.empty()) return;
    Dimension measured = Dimension::inertia;
    double inertia =
        from == "gd2" ? reader_.quantity(from, Dimension::weight_inertia, &measured) : reader_.quantity(from);
    if (from == "radius_of_gyration") inertia = model::inertia_of_gyration(r_.mass, inertia);
    if (measured == Dimension::weight_inertia) inertia /= standard_gravity;
    if (from == "gd2") inertia = model::inertia_of_gd2(inertia);
    put("inertia", from, {inertia}, Dimension::inertia);
  }

  static constexpr double largest_misalignment = 0.5;  // rad: beyond, the linear model's angle means nothing

  const StudyFile& file_;
  QuantityReader reader_;
  TiltReader tilt_;
  RotorSheet r_;
  std::vector<double> kappa_;
  bool tilts_ = false, by_bearings_ = false;
  double transverse_ = 0.0, polar_ = 0.0;
};

}  // namespace

RotorSheet read_rotor_sheet(const StudyFile& file) { return RotorReader(file).read(); }

}  // namespace equipoise::study
