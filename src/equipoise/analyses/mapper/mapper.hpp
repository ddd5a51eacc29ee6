// Decides states, and a study's own starts, in any order after one attractor search.
// This room: any given state to its attractor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct AttractorSearchCache;
struct BalanceNote;
struct Decided;

struct MapperOptions : RunOptions {
  bool transients = false;  ///< gather every start's transient
  SearchMode search = SearchMode::full;
  AttractorSearchCache* searches = nullptr;  ///< shared by consecutive mappers with the same final speed; null: its own
};

/// Decides states and starts as basin() decides starts, with the same bits. The constructor searches for the
/// attractors. Thread-safe. basin() counts, stores and resumes in addition.
///
/// A state may end in a motion that the search missed. It is then listed, as basin() lists it. Unless its identifier
/// is reserved, it gets the next free one (from first_free_id) in the order in which motions are met. Within one call
/// that is the order of the states, whatever the threads; between concurrent calls it is a matter of chance.
class Mapper {
 public:
  /// Searches for attractors with `options` and the progress of basin(). States do not need the study's [sampling], nor
  /// values of [initial] that they set themselves (BasinOptions::initial). Throws InputError for studies that basin()
  /// would not decide. Throws RunError if stopped.
  explicit Mapper(const Study& study, const MapperOptions& options = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// The outcome of a start in this state at t = 0, taken through the study's spin-up and release. Throws InputError
  /// for states that no start can have (BasinOptions::initial), and for a study with uncertain values.
  Outcome operator()(const InitialState& start) const;
  /// Many states, side by side on lanes and threads: at least ten times as fast as one by one. Progress counts starts.
  /// Once stopped, returns the outcomes of the first ones. Uses the current CPU target, or options.cpu_target.
  std::vector<Outcome> operator()(const std::vector<InitialState>& starts, const RunOptions& options = {}) const;
  /// Starts at the study's [initial], but with these ball angles, `balls` a start. A start with overlapping balls has
  /// failed. Throws InputError for uncertain values, or angles that are not finite.
  Decided at_angles(const std::vector<double>& phi) const;
  /// The study's own starts first .. first + count - 1, even beyond study().sampling.starts. Throws InputError beyond a
  /// grid.
  Decided starts(std::uint64_t first, std::size_t count) const;

  /// The search's result, empty if there was none or it is shared, and the CPU target that found it (see
  /// mapped_search()).
  const AttractorSearchCache& search() const;
  const std::string& target() const;
  BalanceNote balance() const;

  /// The study, with its horizon and sampling method filled in.
  const Study& study() const;
  /// An attractor's name; empty if no attractor has this identifier.
  std::string name(int attractor) const;
  /// The attractor's name, or the outcome's, such as "undecided".
  std::string name(const Outcome& outcome) const;
  /// The attractors known so far.
  Catalogue attractors() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What basin() of `study` on CPU target `target` can use instead of its own search (BasinOptions::searches), with
/// the same bits. The mapper's study must have the same search (attractor_search_subject()) and the same target;
/// otherwise throws InputError that names the difference. Also throws for studies that are decided without a search.
AttractorSearchCache mapped_search(const Mapper& mapper, const Study& study, const std::string& target);

}  // namespace equipoise
