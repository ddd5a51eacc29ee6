// Takes any state to the attractor that it comes to, after one attractor search.
// This room: any given state to its attractor.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/types/fate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct AttractorSearchCache;

/// Decides states as basin() decides starts, with the same bits. The constructor searches for the attractors.
/// Thread-safe.
///
/// A state may end in a motion that the search missed. It is then listed, as basin() lists it. Unless its identifier
/// is reserved, it gets the next free one (from first_free_id) in the order in which motions are met. Within one call
/// that is the order of the states, whatever the threads; between concurrent calls it is a matter of chance.
class Mapper {
 public:
  /// Searches for attractors with `options`. The study's [sampling] and [limits] are ignored, and so are values of
  /// [initial] that starts set themselves (BasinOptions::initial). Throws InputError for studies that basin() would not
  /// decide, and for uncertain values. Throws RunError if stopped.
  explicit Mapper(const Study& study, const RunOptions& options = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// The fate of a start in this state at t = 0, taken through the study's spin-up and release. Throws InputError for
  /// states that no start can have (BasinOptions::initial).
  Fate operator()(const InitialState& start) const;
  /// Many states, side by side on lanes and threads: at least ten times as fast as one by one. Progress counts starts.
  /// Once stopped, returns the fates of the first ones. Uses the current CPU target, or options.cpu_target.
  std::vector<Fate> operator()(const std::vector<InitialState>& starts, const RunOptions& options = {}) const;

  /// The search's result, empty if there was none, and the CPU target that found it (see mapped_search()).
  const AttractorSearchCache& search() const;
  const std::string& target() const;

  /// The study, with its horizon filled in.
  const Study& study() const;
  /// An attractor's name; empty if no attractor has this identifier.
  std::string name(int attractor) const;
  /// The name of a fate's attractor, or of its outcome, such as "undecided".
  std::string name(const Fate& fate) const;
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
