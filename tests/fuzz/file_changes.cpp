// Seeded changes: of bytes, of trees, of records.
#include "file_changes.hpp"

#include <cstring>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "equipoise/results/io/checksum.hpp"

namespace equipoise::fuzz {

namespace {

using Json = nlohmann::json;

class Random {
 public:
  void begin(std::uint64_t seed, std::uint64_t index) {
    std::seed_seq words{seed, seed >> 32, index, index >> 32};
    engine_.seed(words);
  }
  std::size_t below(std::size_t count) { return count == 0 ? 0 : engine_() % count; }
  bool one_in(std::size_t count) { return below(count) == 0; }
  /// Numbers at which readers go wrong.
  std::uint64_t word() {
    constexpr std::uint64_t edges[] = {0,
                                       1,
                                       2,
                                       0x7f,
                                       0x80,
                                       0xff,
                                       0x7fff,
                                       0xffff,
                                       0x7fffffff,
                                       0x80000000,
                                       0xffffffff,
                                       0x7fffffffffffffff,
                                       0x8000000000000000,
                                       0xffffffffffffffff};
    return one_in(3) ? engine_() >> below(64) : edges[below(std::size(edges))];
  }

 private:
  std::mt19937_64 engine_;
};

Random rng;

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
template <class T>
void put(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}
std::uint64_t checksum(const std::string& bytes, std::size_t begin, std::size_t size) {
  io::Checksum sum;
  sum.add(bytes.data() + begin, size);
  return sum.value();
}

// A few bytes somewhere: another bit, byte or word, some less, some twice.
void change_bytes(std::string& bytes, std::size_t begin) {
  if (bytes.size() <= begin) return;
  const std::size_t at = begin + rng.below(bytes.size() - begin);
  switch (rng.below(6)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(rng.word());
      break;
    case 2: {  // classic NetCDF has its numbers big end first, in fours
      const std::uint64_t word = rng.word();
      const std::size_t whole = at & ~std::size_t{3};
      for (std::size_t k = 0; k < 4 && whole >= begin && whole + k < bytes.size(); ++k)
        bytes[whole + k] = static_cast<char>(word >> (24 - 8 * k));
      break;
    }
    case 3:
      if (at + 8 <= bytes.size()) put(bytes, at, rng.word());
      break;
    case 4:
      bytes.erase(at, 1 + rng.below(16));
      break;
    default:
      bytes.insert(at, bytes.substr(begin + rng.below(bytes.size() - begin), 1 + rng.below(16)));
  }
}

// A member somewhere in the tree: gone, twice, of another type, another number.
void change_json(Json& root) {
  Json* at = &root;
  while (at->is_structured() && !at->empty() && !rng.one_in(5))
    at = &*std::next(at->begin(), static_cast<long>(rng.below(at->size())));
  switch (rng.below(8)) {
    case 0:
      *at = nullptr;
      break;
    case 1:
      *at = static_cast<std::int64_t>(rng.word());
      break;
    case 2:
      *at = rng.one_in(2) ? 1e308 : -0.5;
      break;
    case 3:
      *at = std::string("\x1b]0;x\n<b>").substr(rng.below(8));
      break;
    case 4:
      *at = Json::array();
      break;
    case 5:
      *at = rng.one_in(2);
      break;
    case 6:
      if (at->is_structured() && !at->empty())
        at->erase(std::next(at->begin(), static_cast<long>(rng.below(at->size()))));
      break;
    default:
      if (at->is_array() && !at->empty()) at->push_back(Json((*at)[rng.below(at->size())]));
  }
}

}  // namespace

void begin(std::uint64_t seed, std::uint64_t index) { rng.begin(seed, index); }

std::size_t below(std::size_t count) { return rng.below(count); }

std::string changed_cbor(const std::string& bytes) {
  Json json;
  try {  // other records are no CBOR, and some of them throw all the same
    json = Json::from_cbor(bytes);
  } catch (const Json::exception&) {
    return changed_raw(bytes);
  }
  if (rng.one_in(4)) return changed_raw(bytes);
  change_json(json);
  std::string out;
  Json::to_cbor(json, out);
  return out;
}

std::string changed_results(const std::string& sealed) {
  std::string bytes = sealed.substr(0, sealed.size() - 24);
  for (std::size_t left = 1 + rng.below(3); left > 0; --left) change_bytes(bytes, 4);
  const std::uint64_t seal[] = {0x314C414553505145, bytes.size(), checksum(bytes, 0, bytes.size())};
  return bytes.append(reinterpret_cast<const char*>(seal), sizeof seal);
}

// Header (mark, length, checksum; identity), then records (mark, kind, first, count, two times, length, checksum).
std::string changed_journal(const std::string& bytes) {
  constexpr std::size_t head = 24, record_head = 64;
  std::string identity = bytes.substr(head, number_at<std::uint64_t>(bytes, 8));
  std::vector<std::string> records;
  for (std::size_t at = head + identity.size(); at < bytes.size();) {
    records.push_back(bytes.substr(at, record_head + number_at<std::uint64_t>(bytes, at + 48)));
    at += records.back().size();
  }
  for (std::size_t left = 1 + rng.below(3); left > 0; --left) {
    std::string& record = records[rng.below(records.size())];
    switch (rng.below(6)) {
      case 0:
        put(record, 8 * (1 + rng.below(5)), rng.word());
        break;
      case 1:
        records.push_back(std::string(record));
        break;
      case 2:
        std::swap(record, records[rng.below(records.size())]);
        break;
      case 3:
        if (rng.one_in(8)) change_bytes(identity, 0);
        break;
      default: {
        std::string payload = record.substr(record_head);
        record.resize(record_head);
        if (rng.one_in(2))
          change_bytes(payload, 0);
        else
          payload = changed_cbor(payload);
        record += payload;
      }
    }
  }
  std::string out(bytes, 0, 8);
  const std::uint64_t of_identity[] = {identity.size(), checksum(identity, 0, identity.size())};
  out.append(reinterpret_cast<const char*>(of_identity), sizeof of_identity) += identity;
  for (std::string& record : records) {
    put(record, 48, static_cast<std::uint64_t>(record.size() - record_head));
    io::Checksum sum;
    sum.add(record.data(), record_head - 8);
    sum.add(record.data() + record_head, record.size() - record_head);
    put(record, 56, sum.value());
    out += record;
  }
  if (rng.one_in(8)) change_bytes(out, head + identity.size());  // and one that is not sealed again
  return out;
}

std::string changed_text(const std::string& text) {
  Json json = Json::parse(text);
  change_json(json);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string changed_raw(const std::string& bytes) {
  std::string other = bytes;
  for (std::size_t left = 1 + rng.below(3); left > 0; --left) change_bytes(other, 0);
  return other;
}

}  // namespace equipoise::fuzz
