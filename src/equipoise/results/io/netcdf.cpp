// Checked calls of the NetCDF C library, one at a time.
#include "equipoise/results/io/netcdf.hpp"

#include <array>
#include <cctype>
#include <filesystem>
#include <mutex>
#include <system_error>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise::io {

namespace {

constexpr char longer_than_file[] = "{}: {} is longer than the file";

// The library keeps a process-wide list of open files without a lock.
std::mutex library_mutex;

template <class Result, class... Parameters, class... Arguments>
Result call(Result (*function)(Parameters...), Arguments... arguments) {
  const std::lock_guard lock(library_mutex);
  return function(arguments...);
}

}  // namespace

int netcdf_type(DataColumn::Type type) {
  constexpr std::array types{NC_CHAR, NC_BYTE, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE};
  return types[static_cast<std::size_t>(type)];
}

void NetcdfFile::check(int status, const std::string& what) const {
  if (status != NC_NOERR) throw RunError(name_ + ": " + what + ": " + call(nc_strerror, status));
}

NetcdfFile::NetcdfFile(const std::string& path, Mode mode, const std::string& name)
    : name_(name.empty() ? path : name), defining_(mode != Mode::read) {
  if (mode == Mode::read) {
    // The library would take "http://..." and "s3:..." for places in the network.
    std::error_code error;
    bytes_ = std::filesystem::file_size(path, error);
    if (error) throw RunError(name_ + ": cannot be read");
    if (const std::string fault = netcdf_fault(path); !fault.empty())
      throw RunError(fmt::format("{}: cannot be read: {}", name_, fault));
    check(call(nc_open, std::filesystem::absolute(path).c_str(), NC_NOWRITE, &id_), "cannot be read");
  } else {
    check(call(nc_create, path.c_str(), NC_CLOBBER | (mode == Mode::create_large ? NC_64BIT_DATA : NC_64BIT_OFFSET),
               &id_),
          "cannot be written");
  }
}

// nc_abort() frees the descriptor of a file that cannot be closed. For a file with unwritten definitions, nc_close()
// would also free it, but the library would still know its number.
NetcdfFile::~NetcdfFile() {
  if (id_ >= 0 && (defining_ || call(nc_close, id_) != NC_NOERR)) call(nc_abort, id_);
}

int NetcdfFile::dimension(const std::string& name, std::size_t length) {
  int dimension = -1;
  check(call(nc_def_dim, id_, name.c_str(), length == 0 ? NC_UNLIMITED : length, &dimension), "dimension " + name);
  return dimension;
}

std::size_t NetcdfFile::length(const std::string& dimension) const {
  int id = -1;
  std::size_t length = 0;
  const int status = call(nc_inq_dimid, id_, dimension.c_str(), &id);
  if (status == NC_EBADDIM) return 0;
  check(status, "dimension " + dimension);
  check(call(nc_inq_dimlen, id_, id, &length), "dimension " + dimension);
  // Whatever has this length takes a byte each at least. A forged one would take all memory.
  if (bytes_ > 0 && length > bytes_) throw RunError(fmt::format(longer_than_file, name_, dimension));
  return length;
}

int NetcdfFile::variable(const std::string& name, int type, const std::vector<int>& dimensions,
                         const std::string& units, const std::string& long_name) {
  int variable = -1;
  check(call(nc_def_var, id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable),
        "variable " + name);
  if (!units.empty()) attribute(variable, "units", units);
  attribute(variable, "long_name", long_name);
  return variable;
}

int NetcdfFile::variable(const std::string& name) const {
  int variable = -1;
  check(call(nc_inq_varid, id_, name.c_str(), &variable), "variable " + name);
  return variable;
}

bool NetcdfFile::has_variable(const std::string& name) const {
  int variable = -1;
  return call(nc_inq_varid, id_, name.c_str(), &variable) == NC_NOERR;
}

int NetcdfFile::variable(const std::string& name, int type, const std::vector<std::size_t>& shape) const {
  const int variable = this->variable(name);
  int dimensions = 0, there = 0;
  check(call(nc_inq_vartype, id_, variable, &there), "variable " + name);
  check(call(nc_inq_varndims, id_, variable, &dimensions), "variable " + name);
  bool same = there == type && static_cast<std::size_t>(dimensions) == shape.size();
  std::vector<int> ids(static_cast<std::size_t>(dimensions));
  if (same && dimensions > 0) check(call(nc_inq_vardimid, id_, variable, ids.data()), "variable " + name);
  for (std::size_t k = 0; same && k < shape.size(); ++k) {
    std::size_t length = 0;
    check(call(nc_inq_dimlen, id_, ids[k], &length), "variable " + name);
    same = length == shape[k];
  }
  if (!same) throw RunError(fmt::format("{}: variable {} has the wrong type or shape", name_, name));
  return variable;
}

void NetcdfFile::fill(int variable, const void* value) {
  check(call(nc_def_var_fill, id_, variable, NC_FILL, value), "fill value");
}

void NetcdfFile::leave_unfilled() {
  int before = 0;
  check(call(nc_set_fill, id_, NC_NOFILL, &before), "fill mode");
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::string& text) {
  check(call(nc_put_att_text, id_, variable, name.c_str(), text.size(), text.c_str()), "attribute " + name);
}

void NetcdfFile::attribute(const std::string& name, const std::string& text) { attribute(NC_GLOBAL, name, text); }

void NetcdfFile::attribute(int variable, const std::string& name, int type, const std::vector<int>& values) {
  check(call(nc_put_att_int, id_, variable, name.c_str(), type, values.size(), values.data()), "attribute " + name);
}

std::string NetcdfFile::attribute(const std::string& name) const { return display_text(global_text(name)); }

std::string NetcdfFile::lines(const std::string& name) const { return display_lines(global_text(name)); }

std::string NetcdfFile::global_text(const std::string& name) const {
  std::size_t length = 0;
  int type = NC_NAT;
  if (call(nc_inq_att, id_, NC_GLOBAL, name.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR) return {};
  std::string text(length, '\0');
  check(call(nc_get_att_text, id_, NC_GLOBAL, name.c_str(), text.data()), "attribute " + name);
  return text;
}

void NetcdfFile::end_definitions() {
  check(call(nc_enddef, id_), "cannot be written");
  defining_ = false;
}

void NetcdfFile::write(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
                       const void* data) {
  check(call(nc_put_vara, id_, variable, start.data(), count.data(), data), "cannot be written");
}

void NetcdfFile::read(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
                      void* data) const {
  check(call(nc_get_vara, id_, variable, start.data(), count.data(), data), "reading");
}

std::string NetcdfFile::read_text(const std::string& name, std::size_t index) const {
  const int variable = this->variable(name);
  int dimensions = 0, ids[NC_MAX_VAR_DIMS];
  std::size_t width = 0;
  check(call(nc_inq_varndims, id_, variable, &dimensions), "variable " + name);
  check(call(nc_inq_vardimid, id_, variable, ids), "variable " + name);
  if (dimensions != 2) throw RunError(name_ + ": variable " + name + " holds no texts");
  check(call(nc_inq_dimlen, id_, ids[1], &width), "variable " + name);
  if (width > bytes_) throw RunError(fmt::format(longer_than_file, name_, name));
  std::string text(width, '\0');
  read(variable, {index, 0}, {1, width}, text.data());
  return display_text(text.substr(0, text.find('\0')));
}

void NetcdfFile::close() {
  check(call(nc_close, id_), "cannot be written");
  id_ = -1;
}

std::string flag_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.';
    if (plain)
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  while (word.ends_with('_')) word.pop_back();
  return word.empty() ? "unnamed" : word;
}

}  // namespace equipoise::io
