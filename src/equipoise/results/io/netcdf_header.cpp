// Reads a header as the library does, but checks every count before it is used.
#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <utility>
#include <vector>

#include "equipoise/results/io/disk_file.hpp"
#include "equipoise/results/io/netcdf.hpp"

namespace equipoise::io {

namespace {

constexpr char header_cut_off[] = "its header is cut off";
constexpr char header_count_too_large[] = "its header has a count that is too large";
constexpr char header_of_other_parts[] = "its header has parts that the format does not know";
constexpr char header_beyond_end[] = "a variable goes beyond its end";

// What is wrong; the caller adds the file.
struct Fault {
  const char* problem;
};

class HeaderReader {
 public:
  explicit HeaderReader(const std::string& path) : file_(path, std::ios::binary) {
    file_.seekg(0, std::ios::end);
    const std::streamoff length = file_.tellg();
    file_.seekg(0);
    length_ = length > 0 ? static_cast<std::uint64_t>(length) : 0;
  }

  void read() {
    char mark[4] = {};
    file_.read(mark, sizeof mark);
    version_ = mark[3];
    if (!file_ || std::string(mark, 3) != "CDF" || (version_ != 1 && version_ != 2 && version_ != 5))
      throw Fault{"it is not a classic NetCDF file"};
    wide_ = version_ == 5 ? 8 : 4;
    records_ = number(wide_);
    read_dimensions();
    read_attributes();
    read_variables();
    check_places();
  }

 private:
  struct Variable {
    std::uint64_t begin, bytes;  // of a record, if it has any
    bool has_records;
  };

  std::uint64_t left() {
    const std::streamoff at = file_.tellg();
    return at >= 0 && static_cast<std::uint64_t>(at) < length_ ? length_ - static_cast<std::uint64_t>(at) : 0;
  }

  // Big end first.
  std::uint64_t number(int bytes) {
    std::array<unsigned char, 8> text{};
    if (!file_.read(reinterpret_cast<char*>(text.data()), bytes)) throw Fault{header_cut_off};
    std::uint64_t value = 0;
    for (int k = 0; k < bytes; ++k) value = value << 8 | text[static_cast<std::size_t>(k)];
    return value;
  }

  void skip(std::uint64_t bytes) {
    const std::uint64_t padded = bytes + (4 - bytes % 4) % 4;
    if (bytes > length_ || padded > left()) throw Fault{header_cut_off};
    file_.seekg(static_cast<std::streamoff>(padded), std::ios::cur);
  }

  // Each of `count` takes at least this many bytes.
  std::uint64_t count_of(std::uint64_t bytes_each) {
    const std::uint64_t count = number(wide_);
    if (count > left() / bytes_each) throw Fault{header_count_too_large};
    return count;
  }

  std::uint64_t list(std::uint64_t tag) {
    const std::uint64_t there = number(4), count = count_of(8);
    if (there != tag && (there != 0 || count != 0)) throw Fault{header_of_other_parts};
    return count;
  }

  void name() {
    constexpr std::uint64_t longest = 256;  // NC_MAX_NAME
    const std::uint64_t size = count_of(1);
    if (size == 0 || size > longest) throw Fault{header_count_too_large};
    skip(size);
  }

  std::uint64_t type_size() {
    constexpr std::array<std::uint64_t, 12> sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::uint64_t type = number(4), types = version_ == 5 ? sizes.size() : 7;
    if (type == 0 || type >= types) throw Fault{header_of_other_parts};
    return sizes[type];
  }

  void read_dimensions() {
    constexpr std::uint64_t tag = 10;
    for (std::uint64_t left = list(tag); left > 0; --left) {
      name();
      dimensions_.push_back(number(wide_));
    }
    if (std::count(dimensions_.begin(), dimensions_.end(), 0u) > 1) throw Fault{header_of_other_parts};
  }

  void read_attributes() {
    constexpr std::uint64_t tag = 12;
    for (std::uint64_t left = list(tag); left > 0; --left) {
      name();
      const std::uint64_t each = type_size();
      skip(each * count_of(each));
    }
  }

  void read_variables() {
    constexpr std::uint64_t tag = 11, most_dimensions = 1024;  // NC_MAX_VAR_DIMS
    for (std::uint64_t left = list(tag); left > 0; --left) {
      name();
      const std::uint64_t rank = count_of(static_cast<std::uint64_t>(wide_));
      if (rank > most_dimensions) throw Fault{header_count_too_large};
      Variable variable{0, 1, false};
      for (std::uint64_t k = 0; k < rank; ++k) {
        const std::uint64_t id = number(wide_);
        if (id >= dimensions_.size()) throw Fault{header_of_other_parts};
        if (dimensions_[id] == 0 && k > 0) throw Fault{header_of_other_parts};
        variable.has_records |= dimensions_[id] == 0;
        if (dimensions_[id] > 0) multiply(variable.bytes, dimensions_[id]);
      }
      read_attributes();
      multiply(variable.bytes, type_size());
      number(wide_);  // its size once more, which the library computes for itself
      variable.begin = number(version_ == 1 ? 4 : 8);
      variables_.push_back(variable);
    }
  }

  void multiply(std::uint64_t& bytes, std::uint64_t by) const {
    if (by > length_ / bytes) throw Fault{header_beyond_end};
    bytes *= by;
  }

  void check_places() const {
    std::uint64_t record = 0, with_records = 0;
    for (const Variable& v : variables_)
      if (v.has_records) record += v.bytes + (4 - v.bytes % 4) % 4, ++with_records;
    if (with_records == 1)
      for (const Variable& v : variables_)
        if (v.has_records) record = v.bytes;
    if (with_records > 0 && record > 0 && records_ > length_ / record) throw Fault{header_beyond_end};
    for (const Variable& v : variables_) {
      const std::uint64_t before = v.has_records && records_ > 0 ? (records_ - 1) * record : 0;
      const std::uint64_t bytes = v.has_records && records_ == 0 ? 0 : before + v.bytes;
      if (v.begin > length_ || bytes > length_ - v.begin) throw Fault{header_beyond_end};
    }
  }

  std::ifstream file_;
  std::uint64_t length_ = 0, records_ = 0;
  int version_ = 0, wide_ = 4;
  std::vector<std::uint64_t> dimensions_;
  std::vector<Variable> variables_;
};

}  // namespace

bool is_netcdf(const std::string& path) {
  if (!existing(path).regular) return false;
  std::array<char, 3> begin{};
  std::ifstream(path, std::ios::binary).read(begin.data(), begin.size());
  return std::string(begin.data(), begin.size()) == "CDF";
}

std::string netcdf_fault(const std::string& path) {
  try {
    HeaderReader(path).read();
    return "";
  } catch (const Fault& fault) {
    return fault.problem;
  }
}

}  // namespace equipoise::io
