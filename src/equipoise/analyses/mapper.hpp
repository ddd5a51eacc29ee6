// Any state to the attractor that it comes to: one search, then as many states as one likes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

struct AttractorSearchCache;

/// Decides states as basin() decides its starts, with the same bits. The attractors are searched for once, when it is
/// made. Safe from several threads.
///
/// A state may come to a motion that the search had missed. That motion is then listed, as basin() lists it: where it
/// has no identifier of its own (first_free_id) it gets the next free one in the order in which motions are met: within
/// one call that of the states, whatever the threads; between calls that go on at the same time, as it happens.
class Mapper {
 public:
  /// Searches for attractors; `options` are for that. [sampling] and [limits] of the study play no part, and [initial]
  /// as far as starts have no say (BasinOptions::initial). Throws InputError for studies that basin() would not
  /// decide, and those with uncertain values; RunError if stopped.
  explicit Mapper(const Study& study, const RunOptions& options = {});
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// What becomes of a start from this state at t = 0, taken through the study's spin-up and release. Throws InputError
  /// for states that no start can have (BasinOptions::initial).
  Fate operator()(const InitialState& start) const;
  /// Of many, side by side on lanes and threads: ten times and more as fast as one by one. Progress is in starts. Once
  /// stopped, the fates of the first ones. On the CPU target in use, or options.cpu_target.
  std::vector<Fate> operator()(const std::vector<InitialState>& starts, const RunOptions& options = {}) const;

  /// What its search found, empty where there is none, and the CPU target that found it (see mapped_search()).
  const AttractorSearchCache& search() const;
  const std::string& target() const;

  /// The study, its horizon filled in.
  const Study& study() const;
  /// Of an attractor; empty if there is none of that identifier.
  std::string name(int attractor) const;
  /// Of what a start came to: an attractor's name, or "undecided" and its like.
  std::string name(const Fate& fate) const;
  /// Those known so far.
  Catalogue attractors() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
