// Checked calls of the NetCDF C library.
#include "equipoise/store/netcdf.hpp"

#include <netcdf.h>

#include "equipoise/base/error.hpp"

namespace equipoise::store {

void NetcdfFile::check(int status, const std::string& what) const {
  if (status != NC_NOERR) throw RunError(path_ + ": " + what + ": " + nc_strerror(status));
}

NetcdfFile::NetcdfFile(const std::string& path, Mode mode) : path_(path) {
  if (mode == Mode::create)
    check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_), "cannot be created");
  else
    check(nc_open(path.c_str(), NC_WRITE, &id_), "cannot be opened for writing");
}

NetcdfFile::~NetcdfFile() {
  if (id_ >= 0) nc_close(id_);
}

int NetcdfFile::dimension(const std::string& name, std::size_t length) {
  int dimension = -1;
  check(nc_def_dim(id_, name.c_str(), length == unlimited ? NC_UNLIMITED : length, &dimension), "dimension " + name);
  return dimension;
}

std::size_t NetcdfFile::length(const std::string& dimension) const {
  int id = -1;
  std::size_t length = 0;
  check(nc_inq_dimid(id_, dimension.c_str(), &id), "dimension " + dimension);
  check(nc_inq_dimlen(id_, id, &length), "dimension " + dimension);
  return length;
}

int NetcdfFile::variable(const std::string& name, int type, const std::vector<int>& dimensions,
                         const std::string& units, const std::string& long_name) {
  int variable = -1;
  check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable),
        "variable " + name);
  attribute(variable, "units", units);
  attribute(variable, "long_name", long_name);
  return variable;
}

int NetcdfFile::variable(const std::string& name) const {
  int variable = -1;
  check(nc_inq_varid(id_, name.c_str(), &variable), "variable " + name);
  return variable;
}

void NetcdfFile::fill(int variable, const void* value) {
  check(nc_def_var_fill(id_, variable, NC_FILL, value), "fill value");
}

void NetcdfFile::chunk(int variable, const std::vector<std::size_t>& sizes) {
  check(nc_def_var_chunking(id_, variable, NC_CHUNKED, sizes.data()), "chunking");
}

// Shuffled bytes and the lowest level take most of what there is to gain at little cost.
void NetcdfFile::compress(int variable) { check(nc_def_var_deflate(id_, variable, 1, 1, 1), "compression"); }

void NetcdfFile::attribute(int variable, const std::string& name, const std::string& text) {
  check(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.c_str()), "attribute " + name);
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::vector<signed char>& values) {
  check(nc_put_att_schar(id_, variable, name.c_str(), NC_BYTE, values.size(), values.data()), "attribute " + name);
}

void NetcdfFile::attribute(int variable, const std::string& name, const std::vector<short>& values) {
  check(nc_put_att_short(id_, variable, name.c_str(), NC_SHORT, values.size(), values.data()), "attribute " + name);
}

std::string NetcdfFile::attribute(const std::string& name) const {
  std::size_t length = 0;
  if (nc_inq_attlen(id_, NC_GLOBAL, name.c_str(), &length) != NC_NOERR) return {};
  std::string text(length, '\0');
  check(nc_get_att_text(id_, NC_GLOBAL, name.c_str(), text.data()), "attribute " + name);
  return text;
}

void NetcdfFile::end_definitions() { check(nc_enddef(id_), "definitions"); }

void NetcdfFile::write(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
                       const void* data) {
  check(nc_put_vara(id_, variable, start.data(), count.data(), data), "writing");
}

void NetcdfFile::read(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
                      void* data) const {
  check(nc_get_vara(id_, variable, start.data(), count.data(), data), "reading");
}

std::string NetcdfFile::read_string(int variable, std::size_t index) const {
  char* text = nullptr;
  check(nc_get_var1_string(id_, variable, &index, &text), "reading");
  const std::string result = text ? text : "";
  nc_free_string(1, &text);
  return result;
}

void NetcdfFile::sync() { check(nc_sync(id_), "writing"); }

}  // namespace equipoise::store
