// Reads the quantities of a study in physical units: TableReader's checks for strings with units.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/study/contents/keys.hpp"

namespace equipoise::study {

/// Every SI value of a machine lies well within these bounds: results computed from them stay finite and nonzero.
inline constexpr double largest_si = 1e30, smallest_si = 1e-30;

/// One table of a physical study, or one entry of an array of tables; each key has a dimension. Values are in SI units;
/// a plain number is an error.
class QuantityReader : public TableReader {
 public:
  using TableReader::TableReader;

  double quantity(const std::string& key, std::optional<Dimension> other = std::nullopt, Dimension* measured = nullptr);
  std::optional<double> optional_quantity(const std::string& key);
  /// One quantity, or an array with one per `each`: always `count` values, or none if the key is absent. All have the
  /// key's dimension, or all have `other`; `measured` returns which.
  std::vector<double> one_or_each(const std::string& key, int count, const std::string& each,
                                  std::optional<Dimension> other = std::nullopt, Dimension* measured = nullptr);
  using TableReader::one_or_each;
  /// The same of a key that must be there.
  std::vector<double> require_one_or_each(const std::string& key, int count, const std::string& each);
  /// An array of quantities that must be there.
  std::vector<double> list(const std::string& key);
  /// The quantities not asked for so far that are all read alike; plain numbers stay unread.
  std::map<std::string, std::vector<double>> others(int balls);
  /// A key that states a quantity, and in words what it would be: "a length of 0 or more, such as "0.2 mm"".
  struct Alternative {
    std::string key, words;
  };
  /// The one key of these that is there. Throws if none is, naming all with their words, or if there are several.
  std::string exactly_one(const std::vector<Alternative>& alternatives);
  /// The same for a quantity that may be left out: empty if none is there.
  std::string at_most_one(const std::vector<Alternative>& alternatives);

 private:
  const Key& line(const std::string& key) const;
  std::function<void(const std::string&)> refusal(const std::string& key, const StudyValue& value) const;

  std::map<std::string, std::string> alternatives_;  // by key: what may be given instead
};

/// "a length of 0 or more, such as "0.2 mm"".
std::string wanted_quantity(const std::vector<Dimension>& dimensions, const Range& range);

/// The SI value of a value (a string or an array's entry), checked; `reject` throws. Angles may be plain numbers.
Measured measure_value(const StudyValue& value, const std::vector<Dimension>& dimensions, const Range& range,
                       const std::function<void(const std::string&)>& reject);

}  // namespace equipoise::study
