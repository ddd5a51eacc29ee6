// Files changed behind their checksums, and sealed again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace equipoise::fuzz {

/// The changes that follow depend on these two alone.
void begin(std::uint64_t seed, std::uint64_t index);
/// A number below `count`.
std::size_t below(std::size_t count);

/// Members of a record in CBOR.
std::string changed_cbor(const std::string& bytes);
/// Bytes of a finished file of results.
std::string changed_results(const std::string& sealed);
/// Records of a journal: what they hold, their headers, their order.
std::string changed_journal(const std::string& bytes);
/// Members of a JSON text.
std::string changed_text(const std::string& text);
/// Any bytes.
std::string changed_raw(const std::string& bytes);

}  // namespace equipoise::fuzz
