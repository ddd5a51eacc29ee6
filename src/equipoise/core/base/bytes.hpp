// Values as bytes and back, for use on the same machine.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace equipoise {

/// A struct lists its members once, for writing and reading: `template <class Bytes, Like<S> T> void members(Bytes& b,
/// T& s) { b(s.first, s.second); }`.
template <class T, class S>
concept Like = std::same_as<std::remove_const_t<T>, S>;

/// An array of numbers, written without its trailing zeros.
template <class Array>
struct Trimmed {
  Array& numbers;
};
template <class Array>
Trimmed(Array&) -> Trimmed<Array>;

namespace bytes_detail {

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <>
inline constexpr bool is_list<std::string> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t n>
inline constexpr bool is_array<std::array<T, n>> = true;
template <class T>
inline constexpr bool is_trimmed = false;
template <class T>
inline constexpr bool is_trimmed<Trimmed<T>> = true;
// Eigen's matrices.
template <class T>
concept Matrix = requires(T& m) {
  m.resize(m.rows(), m.cols());
  *m.data();
};

}  // namespace bytes_detail

class BytesOut {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  std::vector<char> take() { return std::move(bytes_); }

 private:
  void raw(const void* from, std::size_t size) {
    const char* const begin = static_cast<const char*>(from);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  void size(std::size_t value) {
    const std::uint64_t count = value;
    raw(&count, sizeof count);
  }

  template <class T>
  void put(const T& value) {
    if constexpr (bytes_detail::is_list<T>) {
      size(value.size());
      for (const auto& item : value) put(item);
    } else if constexpr (bytes_detail::is_array<T>) {
      for (const auto& item : value) put(item);
    } else if constexpr (bytes_detail::is_optional<T>) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (bytes_detail::is_trimmed<T>) {
      std::uint8_t used = static_cast<std::uint8_t>(value.numbers.size());
      while (used > 0 && value.numbers[used - 1u] == 0) --used;
      put(used);
      for (std::size_t i = 0; i < used; ++i) put(value.numbers[i]);
    } else if constexpr (bytes_detail::Matrix<T>) {
      size(static_cast<std::size_t>(value.rows()));
      size(static_cast<std::size_t>(value.cols()));
      raw(value.data(), sizeof(*value.data()) * static_cast<std::size_t>(value.size()));
    } else if constexpr (requires { members(*this, value); }) {
      members(*this, value);
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      raw(&value, sizeof value);
    }
  }

  std::vector<char> bytes_;
};

/// Bytes may come from a file: lengths, truth values and enumerations are checked, the latter where last_of() names the
/// last value. What a value must be beyond that, its reader checks.
class BytesIn {
 public:
  explicit BytesIn(const std::vector<char>& bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(T&&... values) {
    (get(values), ...);
  }
  /// All bytes were read, and none beyond them.
  bool whole() const { return good_ && at_ == bytes_.size(); }

 private:
  void raw(void* to, std::size_t size) {
    good_ = good_ && size <= bytes_.size() - at_;
    if (!good_) return;
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  // The length of a list whose elements take at least one byte each.
  std::size_t size() {
    std::uint64_t count = 0;
    raw(&count, sizeof count);
    good_ = good_ && count <= bytes_.size();
    return good_ ? count : 0;
  }

  template <class T>
  void get(T& value) {
    if constexpr (bytes_detail::is_list<T>) {
      value.resize(size());
      for (auto& item : value) get(item);
    } else if constexpr (bytes_detail::is_array<T>) {
      for (auto& item : value) get(item);
    } else if constexpr (bytes_detail::is_optional<T>) {
      bool there = false;
      get(there);
      value.reset();
      if (there && good_) get(value.emplace());
    } else if constexpr (bytes_detail::is_trimmed<T>) {
      std::uint8_t used = 0;
      get(used);
      good_ = good_ && used <= value.numbers.size();
      value.numbers.fill(0);
      for (std::size_t i = 0; good_ && i < used; ++i) get(value.numbers[i]);
    } else if constexpr (bytes_detail::Matrix<T>) {
      const auto rows = static_cast<decltype(value.rows())>(size()), columns = static_cast<decltype(rows)>(size());
      good_ = good_ &&
              (columns == 0 || static_cast<std::size_t>(rows) <= bytes_.size() / static_cast<std::size_t>(columns));
      value.resize(good_ ? rows : 0, T::ColsAtCompileTime == 1 ? 1 : good_ ? columns : 0);
      raw(value.data(), sizeof(*value.data()) * static_cast<std::size_t>(value.size()));
    } else if constexpr (requires { members(*this, value); }) {
      members(*this, value);
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      raw(&byte, sizeof byte);
      good_ = good_ && byte <= 1;
      value = byte == 1;
    } else if constexpr (requires { last_of(value); }) {
      std::underlying_type_t<T> number{};
      raw(&number, sizeof number);
      good_ = good_ && std::in_range<std::uint32_t>(number) && number <= std::underlying_type_t<T>(last_of(value));
      value = good_ ? static_cast<T>(number) : T{};
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      raw(&value, sizeof value);
    }
  }

  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
  bool good_ = true;
};

template <class... T>
std::vector<char> bytes_of(const T&... values) {
  BytesOut out;
  out(values...);
  return out.take();
}

}  // namespace equipoise
