// One identifier per branch, the same wherever the branch is met.
#include "equipoise/analyses/continuation/branch_follower.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

struct Naming {
  Branch* branch = nullptr;
  int id = 0;
  std::size_t votes = 0, stable = 0, first = 0;
};

std::size_t stable_points(const Branch& branch) {
  return static_cast<std::size_t>(std::count_if(branch.points.begin(), branch.points.end(),
                                                [](const BranchPoint& point) { return point.motion.stable; }));
}

Naming name_one(const std::vector<model::System>& systems, Branch& branch) {
  Naming naming{&branch, 0, 0, stable_points(branch), branch.points.front().at};
  std::map<std::string, std::pair<int, MotionName>> names;
  for (const BranchPoint& point : branch.points) {
    if (naming.stable > 0 && !point.motion.stable) continue;
    const model::Parameters& p = systems[point.at].parameters();
    auto& [count, name] = names[family_of(p, point.motion)];
    const MotionName here = motion_name(p, point.motion);
    if (count++ == 0 || (name.id == 0 && here.id != 0)) name = here;
  }
  const auto most = std::max_element(names.begin(), names.end(),
                                     [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
  branch.name = most->first;
  branch.alias = most->second.second.alias;
  naming.id = branch.name == "balanced" ? balanced_id : most->second.second.id;
  const auto first_kind = branch.points.front().motion.kind;
  const bool one_kind = std::all_of(branch.points.begin(), branch.points.end(),
                                    [&](const BranchPoint& point) { return point.motion.kind == first_kind; });
  if (one_kind) branch.name = most->second.second.name;  // with ", chaotic" if it is so throughout
  return naming;
}

}  // namespace

void name_branches(const std::vector<model::System>& systems, const std::vector<std::size_t>& votes,
                   std::vector<Branch>& branches) {
  std::vector<Naming> namings;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    namings.push_back(name_one(systems, branches[b]));
    namings.back().votes = votes[b];
  }
  std::stable_sort(namings.begin(), namings.end(), [](const Naming& a, const Naming& b) {
    return std::tuple(b.votes, b.stable, a.first) < std::tuple(a.votes, a.stable, b.first);
  });
  std::set<int> taken;
  for (Naming& n : namings)
    if (n.id != 0 && !taken.insert(n.id).second) n.id = 0;
  // Free identifiers and numbers are given in the order in which branches begin.
  std::stable_sort(namings.begin(), namings.end(), [](const Naming& a, const Naming& b) {
    return (a.id != 0) != (b.id != 0) ? a.id != 0 : a.first < b.first;
  });
  int free = first_free_id;
  std::map<std::string, int> named;
  for (Naming& n : namings) {
    n.branch->id = n.id != 0 ? n.id : free++;
    if (const int earlier = named[n.branch->name]++; earlier > 0) {
      n.branch->name += fmt::format(" ({})", earlier + 1);
      n.branch->alias.clear();  // the paper's name belongs to one motion
    }
  }
  for (Branch& branch : branches)
    for (BranchEvent& event : branch.events) event.id = branch.id;
  std::sort(branches.begin(), branches.end(), [](const Branch& a, const Branch& b) { return a.id < b.id; });
}

}  // namespace equipoise
