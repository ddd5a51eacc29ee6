// The protocols searched for table 7.
#pragma once

#include <string>
#include <vector>

#include "table_7_protocol.hpp"

namespace equipoise::table_7 {

/// One protocol. Fields of its name: rise law, fall law, release, departures from the paper's words.
struct Variant {
  std::string name;
  Table7Protocol protocol;
};

/// Every variant of the search, each once.
std::vector<Variant> variants();

}  // namespace equipoise::table_7
