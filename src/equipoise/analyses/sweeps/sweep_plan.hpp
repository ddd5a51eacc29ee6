// The cells of a sweep: the study of each, and the order in which they are computed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/toml/study_value.hpp"

namespace equipoise {

struct BlockWorkers;

/// A study that can be read again with other values.
struct StudySource {
  std::string toml, name;
  std::vector<std::string> overrides;

  Study with(const std::vector<std::string>& more = {}) const;
  /// Whether it states this key ("rotor.unbalance").
  bool states(const std::string& key) const;
};

/// Cells form blocks along the axis with the most values. A search begins with what was found in the previous cell of
/// its block, so a block is one piece of work. Blocks are independent of each other and of their order.
class SweepPlan {
 public:
  static constexpr std::size_t block_length = 8;

  /// No axes: one cell. `request`: what is wanted of every cell, half-width, limit and transients. `option` names the
  /// axes in errors about a cell. Throws InputError if the study is invalid; cells are checked by check_cells().
  SweepPlan(StudySource source, std::vector<SweepAxis> axes, const BasinOptions& request, std::string option);

  const Study& study() const { return study_; }
  const StudySource& source() const { return source_; }
  const std::vector<SweepAxis>& axes() const { return axes_; }
  const BasinOptions& request() const { return request_; }
  /// Whether transients are gathered: in all cells or none.
  bool transients() const { return transients_; }

  std::size_t cells() const { return cells_; }
  /// `more`: further overrides.
  Study study_of(std::size_t cell, const std::vector<std::string>& more = {}) const;
  /// study_of() a cell that can be decided. Throws InputError, naming the option and the cell, for any other.
  Study checked_study_of(std::size_t cell) const;
  /// Does this for every cell; ends early once `stop` is set.
  void check_cells(const StopFlag* stop = nullptr) const;
  std::size_t blocks() const { return lines_ * blocks_in_line_; }
  /// In the order of computation.
  std::vector<std::size_t> cells_of(std::size_t block) const;
  /// Of a cell's ensemble, at work with these.
  BasinOptions ensemble(const BlockWorkers& workers) const;

  /// Everything that determines the results, as text.
  std::string identity() const;

 private:
  std::size_t chain_length() const { return axes_.empty() ? 1 : axes_[chain_].size(); }

  StudySource source_;
  std::vector<SweepAxis> axes_;
  BasinOptions request_;
  std::string option_;
  Study study_;
  StudyValue tree_;  ///< of the source's text, which is parsed once for all cells
  bool transients_ = false;
  std::size_t cells_ = 1, chain_ = 0, lines_ = 1, blocks_in_line_ = 1;
};

}  // namespace equipoise
