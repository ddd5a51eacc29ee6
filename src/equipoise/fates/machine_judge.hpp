// What a machine's trajectory has come to: shared by all starts of a study, what is known of its balance; of each
// start, what it does.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "equipoise/base/error.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/discovery/undecided.hpp"
#include "equipoise/fates/machine_balance.hpp"
#include "equipoise/fates/runner.hpp"
#include "equipoise/motions/steady_watch.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// What all starts of one machine share.
class MachineFacts {
 public:
  /// Both outlive this.
  MachineFacts(const Study& study, const model::Drive& drive, const StopFlag* stop);

  const Study& study() const { return study_; }
  const model::Parameters& parameters() const { return study_.parameters; }
  const MachineBalance& balance() const { return balance_; }
  const BalanceNote& note() const { return note_; }
  /// Neither gravity nor unequal supports, dry friction or contact: what rests is an equilibrium of smooth equations
  /// that do not know the rotor's angle.
  bool smooth_and_isotropic() const;
  /// The rotor is left without torque for good.
  bool coasts() const { return balance_.machine().coasts(); }
  bool below_stall(double speed) const;
  /// The motor's torque never vanishes, and the rotor is so fast that nothing it meets will hold it any more.
  bool runs_away(double speed) const;
  /// A driven rotor's release.speed.
  const std::optional<double>& release_speed() const { return release_speed_; }

  /// Whether balls that rest at state `z` do so in balance; nothing while they rest at nothing that is stable.
  std::optional<bool> rests_balanced(const double* z, const SteadyLook& look) const;

 private:
  std::optional<bool> equilibrium_balanced(const Eigen::VectorXd& at) const;
  bool fades(const double* z, const SteadyLook& look) const;
  BalanceNote make_note();
  BalanceNote exact_note() const;

  const Study& study_;
  const StopFlag* stop_;
  MachineBalance balance_;
  std::optional<double> release_speed_;
  double patience_;  // for balls to come to balance once imperfections are gone; no matter what horizon is asked for
  bool strobed_balance_unstable_ = false;  // known to be
  BalanceNote note_;
};

/// One start in the last piece of its drive.
class MachineJudge {
 public:
  /// `clamped`: its balls are held. `to_horizon`: it will be asked at the horizon only, and watches until then.
  MachineJudge(const MachineFacts& facts, double t, const double* z, bool clamped, bool to_horizon);

  bool clamped() const { return clamped_; }
  /// As SteadyWatch::step().
  bool step(double t, const double* z, const std::array<SteadySample, 3>& samples);
  /// To be asked whenever step() was true. Decided starts have their fate, but for its time; `undecided` is one that is
  /// given up.
  std::optional<Fate> look(double t, const double* z);
  /// After all that there was time for. By the rules of look(), at a time when it need not have been asked.
  Fate at_horizon(const double* z) const;
  /// Why it is undecided, if it is.
  UndecidedEnd end() const;
  double mean_speed() const { return watch_.mean_speed(); }

 private:
  void note_passing(const SteadyLook& look);
  // What look() and at_horizon() go by.
  bool stalls(const SteadyLook& look) const;
  bool held_for_good(const SteadyLook& look) const;
  std::optional<Fate> told(const SteadyLook& look, const double* z) const;
  Fate attracted(int id, DecidedBy by, double speed) const;
  Fate stalled() const;

  const MachineFacts& facts_;
  SteadyWatch watch_;
  BalanceApproach approach_;
  bool clamped_, to_horizon_, balanced_ = false;
  std::size_t next_look_ = 0;
  int passed_kind_ = 0;  // of the first of the looks in a row that found it steady
  double passed_at_ = 0.0, slow_since_ = -1.0;
  double nearest_speed_;  // to the one at which balls are let go, so far
};

}  // namespace equipoise
