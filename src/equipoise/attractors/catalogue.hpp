// The attractors of one study: a list that gives every motion its identifier and its name.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/types/attractor.hpp"

namespace equipoise {

class Catalogue {
 public:
  Catalogue() = default;
  /// `by_name`: motions of one name are one, as those of rotors that differ.
  explicit Catalogue(bool by_name) : by_name_(by_name) {}

  const std::vector<Attractor>& attractors() const { return attractors_; }
  const Attractor* find(int id) const;
  /// What `earlier`, a state that this list once had, did not hold. The list is kept by identifier: what is new in it
  /// need not stand at its end.
  std::vector<Attractor> listed_since(const Catalogue& earlier) const;
  /// Identifier of the same motion, 0 if it is not listed. All balanced states are one motion.
  int find(const model::Parameters& p, const Motion& motion) const;
  /// Lists a motion unless it is listed, and returns its identifier. A second motion of the same name gets a free
  /// identifier and a number behind its name.
  int add(const model::Parameters& p, const Motion& motion, const std::optional<ContinuumPart>& continuum = {});
  /// The same of rotors that each have a motion of their own: all that have a name are one.
  int add(const MotionName& name, const Motion& motion, const std::optional<ContinuumPart>& continuum = {});
  /// Lists an attractor under the identifier that it brings, which must be free.
  void add(Attractor attractor);

 private:
  std::vector<Attractor> attractors_;  // by identifier
  bool by_name_ = false;
};

}  // namespace equipoise
