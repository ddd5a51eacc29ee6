// The protocols among which table 7 is sought.
#pragma once

#include <string>
#include <vector>

#include "table_7_protocol.hpp"

namespace equipoise::table_7 {

/// A reading of the protocol. Fields of the name: rise law, fall law, release, and what departs from the paper's words.
struct Variant {
  std::string name;
  Table7Protocol protocol;
};

/// Every variant of the search, each once.
std::vector<Variant> variants();

}  // namespace equipoise::table_7
