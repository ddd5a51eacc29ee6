// Pages and questions by number.
#include "equipoise/base/notes.hpp"

namespace equipoise {

NotePage::NotePage(Notes* notes, const std::string& subject) : notes_(notes), page_(number_of(subject)) {}

// FNV-1a (Fowler, Noll, Vo): the same on every machine. Two of a run's hundred pages have one number by chance once in
// 10^15 runs.
std::uint64_t NotePage::number_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

}  // namespace equipoise
