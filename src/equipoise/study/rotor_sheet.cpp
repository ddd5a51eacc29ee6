// [rotor] and [[place]] in SI units: each quantity in the one way in which the study states it.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/read_number.hpp"
#include "equipoise/datasheet/vibration_data.hpp"
#include "equipoise/study/machine_sheet.hpp"
#include "equipoise/study/quantity_reader.hpp"
#include "equipoise/words/machine.hpp"

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
  explicit GradeReader(const Document& document) : QuantityReader(document, "rotor.balance_grade") {}

  double eccentricity() {
    const double grade = grade_of(*this, "grade", require("grade", words::machine::grade));
    const double at = quantity("at");
    finish();
    return model::eccentricity_of_grade(grade, at);
  }
};

// Mass times radius at an angle, of all places; and their mass.
struct Places {
  std::complex<double> unbalance;  // kg m
  double mass = 0.0;
  bool any = false;
};

Places read_places(const Document& document) {
  Places places;
  const StudyValue* value = document.root.find("place");
  if (!value) return places;
  const StudyValue::Array* array = value->array();
  const auto is_table = [](const StudyValue& entry) { return entry.table() != nullptr; };
  if (!array || array->empty() || !std::all_of(array->begin(), array->end(), is_table))
    throw InputError(document.where("place", value), "place", "", words::machine::array_of_places);
  places.any = true;
  for (std::size_t i = 0; i < array->size(); ++i) {
    QuantityReader reader(document, fmt::format("place.{}", i + 1));
    const double mass = reader.quantity("mass"), radius = reader.quantity("radius"), angle = reader.quantity("angle");
    reader.text("name");
    reader.finish();
    places.unbalance += std::polar(mass * radius, angle);
    places.mass += mass;
  }
  return places;
}

class RotorReader {
 public:
  explicit RotorReader(const Document& document) : document_(document), reader_(document, "rotor") {}

  RotorSheet read() {
    r_.mass = reader_.quantity("mass");
    read_stiffness();
    read_damping();
    read_unbalance();
    read_inertia();
    for (const auto& [key, values] : reader_.others(0)) put(key, key, values, find_quantity("rotor", key)->dimension);
    reader_.finish();
    return std::move(r_);
  }

 private:
  void put(const std::string& key, const std::string& from, std::vector<double> values,
           std::optional<Dimension> dimension = std::nullopt) {
    r_.derived.push_back({key, from, std::move(values), dimension});
  }

  void read_stiffness() {
    const std::string from = reader_.exactly_one({{"stiffness", words::machine::stiffness},
                                                  {"natural_frequency", words::machine::natural_frequency},
                                                  {"static_sag", words::machine::static_sag}});
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

  void read_damping() {
    const std::string from = reader_.exactly_one({{"damping", words::machine::damping},
                                                  {"damping_ratio", "a plain number or \"5 %\", c/(2 sqrt(k M))"},
                                                  {"logarithmic_decrement", words::machine::logarithmic_decrement},
                                                  {"quality_factor", words::machine::quality_factor}});
    if (from == "damping")
      return put("damping", from, reader_.one_or_each(from, 2, each_direction), Dimension::damping);
    const Range range = key_table("rotor").find(from, true)->range;
    std::vector<double> zeta = reader_.TableReader::one_or_each(from, range, 2, each_direction);
    for (std::size_t i = 0; i < 2; ++i) {
      if (from == "logarithmic_decrement") zeta[i] = model::ratio_of_decrement(zeta[i]);
      if (from == "quality_factor") zeta[i] = model::ratio_of_quality(zeta[i]);
      zeta[i] = 2.0 * zeta[i] * std::sqrt(kappa_[i]);
    }
    put("damping", from, zeta);
  }

  void read_unbalance() {
    const std::vector<QuantityReader::Alternative> ways{{"eccentricity", words::machine::eccentricity},
                                                        {"unbalance", words::machine::unbalance},
                                                        {"balance_grade", words::machine::balance_grade}};
    const Places places = read_places(document_);
    const std::string from = places.any ? reader_.at_most_one(ways) : reader_.exactly_one(ways);
    const bool graded = from == "balance_grade", product = from == "unbalance";
    const double own = from.empty() ? 0.0 : graded ? GradeReader(document_).eccentricity() : reader_.quantity(from);
    if (!places.any) return put("eccentricity", from, {own}, product ? Dimension::unbalance : Dimension::length);
    if (!(places.mass < r_.mass)) reader_.fail("mass", fmt::format(words::machine::mass_includes_places, places.mass));
    const std::complex<double> resultant = (product ? own : own * r_.mass) + places.unbalance;
    r_.turn = std::arg(resultant);
    put("eccentricity", from.empty() ? "place" : from, {std::abs(resultant)}, Dimension::unbalance);
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

  const Document& document_;
  QuantityReader reader_;
  RotorSheet r_;
  std::vector<double> kappa_;
};

}  // namespace

RotorSheet read_rotor_sheet(const Document& document) { return RotorReader(document).read(); }

}  // namespace equipoise::study
