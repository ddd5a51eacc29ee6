// What balls do in a motion, in an engineer's words.
#pragma once

#include <string>

namespace equipoise {

/// "balls circulate together" for "co-drifting", from a motion's name (docs/explanation/motions.md, "Names"). "" for a
/// name that has no such words: a report then shows the name.
std::string plain_name(const std::string& name);

/// "balls circulate together (V1)" in a study with physical units, "co-drifting (V1)" in any other. `named`: has `name`
/// and `alias`.
template <class Named>
std::string reader_title(const Named& named, bool physical) {
  const std::string plain = physical ? plain_name(named.name) : "";
  const std::string& words = plain.empty() ? named.name : plain;
  return named.alias.empty() ? words : words + " (" + named.alias + ")";
}

}  // namespace equipoise
