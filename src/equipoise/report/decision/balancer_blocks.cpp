// Gathers what is told of the rotor without balls, of limits and of standards, in the order in which it is shown.
#include "equipoise/report/decision/balancer_blocks.hpp"

#include <string>
#include <utility>

#include "equipoise/report/decision/standards_text.hpp"
#include "equipoise/report/reports/transient_report.hpp"

namespace equipoise {

std::vector<std::vector<Block>> balancer_blocks(const BasinResult& r) {
  std::vector<std::vector<Block>> groups;
  if (tells_without_balls(r)) {
    std::vector<Block>& group = groups.emplace_back();
    group.push_back(without_balls_table(r));
    for (const std::string& sentence : without_balls_words(r)) group.push_back(Paragraph{sentence});
  }
  if (!r.transients || r.transients->groups.empty() || r.transients->groups.front().starts == 0) return groups;
  const TransientGroup& all = r.transients->groups.front();
  if (DocumentTable limits = limits_table(all, r.study); !limits.rows.empty()) {
    std::vector<Block>& group = groups.emplace_back();
    group.push_back(std::move(limits));
    if (const std::string hits = clearance_words(all, r.study); !hits.empty()) group.push_back(Paragraph{hits});
  }
  if (std::vector<Block> standards = standards_blocks(r); !standards.empty()) groups.push_back(std::move(standards));
  return groups;
}

}  // namespace equipoise
