// Whose results a file holds: what it must share with a run for the run to add to it.
#pragma once

#include <string>

namespace equipoise {

struct BasinFileHeader;

namespace store {

/// All that decides what stands in a file for start i, a key a line as in a study.
std::string identity_of(const BasinFileHeader& header);

/// How two identities differ, in words: "balancer.drag is [0.05] there and [0.06] here"; empty if they do not.
std::string difference(const std::string& there, const std::string& here);

}  // namespace store
}  // namespace equipoise
