#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

/// Rows of an extendible array that are allocated together.
constexpr hsize_t series_chunk = 128;
template <class Number>
struct Types;
template <>
struct Types<double> {
  static std::array<hid_t, 2> stored() { return {H5T_IEEE_F64LE, H5T_IEEE_F64BE}; }
  static hid_t native() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct Types<std::int64_t> {
  static std::array<hid_t, 2> stored() { return {H5T_STD_I64LE, H5T_STD_I64BE}; }
  static hid_t native() { return H5T_NATIVE_INT64; }
};
template <>
struct Types<std::uint32_t> {
  static std::array<hid_t, 2> stored() { return {H5T_STD_U32LE, H5T_STD_U32BE}; }
  static hid_t native() { return H5T_NATIVE_UINT32; }
};

template <class Number>
void write_array(hid_t group, const std::string& name, std::span<const Number> values, std::size_t columns,
                 const std::string& where) {
  const std::array<hsize_t, 2> size = {values.size() / columns, columns};
  const std::size_t rank = columns == 1 ? 1 : 2;
  const Handle space = own(H5Screate_simple(static_cast<int>(rank), size.data(), nullptr), H5Sclose, where,
                           "describe the array");
  const Handle layout = values.empty()
                            ? own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "describe the layout")
                            : checksummed_layout({size.data(), rank}, sizeof(Number), where);
  const Handle dataset = own(H5Dcreate2(group, name.c_str(), Types<Number>::native(), space.id(), H5P_DEFAULT,
                                        layout.id(), H5P_DEFAULT),
                             H5Dclose, where, "create the array");
  if (values.empty()) return;  // HDF5 refuses the null pointer of an empty vector
  checked(H5Dwrite(dataset.id(), Types<Number>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          where, "write the array");
}

/// Of an array that can be read as Numbers.
template <class Number>
Extent readable_extent(const Handle& dataset, const std::string& where) {
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, where, "read the array's type");
  const auto stored = Types<Number>::stored();
  if (std::none_of(stored.begin(), stored.end(), [&](hid_t t) { return H5Tequal(type.id(), t) > 0; }))
    throw Hdf5Error(fmt::format("{}: is not an array of the expected type", where));
  const Extent extent = array_extent(dataset, where);
  require_plausible(dataset, extent, sizeof(Number), where);
  return extent;
}

template <class Number>
std::vector<Number> read_array(hid_t group, const std::string& name, const std::string& where) {
  const Handle dataset = open_array(group, name, where);
  std::vector<Number> values(readable_extent<Number>(dataset, where).size());
  if (values.empty()) return values;
  checked(H5Dread(dataset.id(), Types<Number>::native(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), where,
          "read the array");
  return values;
}

}  // namespace

void Group::write(const std::string& name, std::span<const double> values, std::size_t columns) const {
  write_array(handle_.id(), name, values, columns, member(name));
}
void Group::write(const std::string& name, std::span<const std::int64_t> values, std::size_t columns) const {
  write_array(handle_.id(), name, values, columns, member(name));
}
void Group::write(const std::string& name, std::span<const std::uint32_t> values, std::size_t columns) const {
  write_array(handle_.id(), name, values, columns, member(name));
}

Extent Group::extent(const std::string& name) const {
  return readable_extent<double>(open_array(handle_.id(), name, member(name)), member(name));
}

std::vector<double> Group::read_doubles(const std::string& name) const {
  return read_array<double>(handle_.id(), name, member(name));
}
std::vector<std::uint32_t> Group::read_indices(const std::string& name) const {
  return read_array<std::uint32_t>(handle_.id(), name, member(name));
}

void Group::create_series(const std::string& name) const {
  const std::string where = member(name);
  const hsize_t size = 0, unlimited = H5S_UNLIMITED;
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const Handle space = own(H5Screate_simple(1, &size, &unlimited), H5Sclose, where, "describe the series");
  const Handle creation = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "describe the series");
  checked(H5Pset_chunk(creation.id(), 1, &series_chunk), where, "describe the series");
  checked(H5Pset_fletcher32(creation.id()), where, "switch checksums on");
  checked(H5Pset_fill_value(creation.id(), H5T_NATIVE_DOUBLE, &missing), where, "describe the series");
  own(H5Dcreate2(handle_.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, creation.id(),
                 H5P_DEFAULT),
      H5Dclose, where, "create the series");
}

void Group::write_rows(const std::string& name, std::size_t first, std::span<const double> values) const {
  const std::string where = member(name);
  const Handle dataset = open_array(handle_.id(), name, where);
  const hsize_t start = first, count = values.size(),
                size = std::max<hsize_t>(array_extent(dataset, where).rows, first + values.size());
  checked(H5Dset_extent(dataset.id(), &size), where, "extend the series");
  const Handle space = own(H5Dget_space(dataset.id()), H5Sclose, where, "read the series' shape");
  checked(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &start, nullptr, &count, nullptr), where,
          "select rows");
  const Handle rows = own(H5Screate_simple(1, &count, nullptr), H5Sclose, where, "describe rows");
  checked(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, rows.id(), space.id(), H5P_DEFAULT, values.data()), where,
          "write rows");
}

void Group::keep_rows(const std::string& name, std::size_t rows) const {
  const std::string where = member(name);
  const Handle dataset = open_array(handle_.id(), name, where);
  const hsize_t size = rows;
  if (const Extent stored = readable_extent<double>(dataset, where);
      stored.columns != 1 || stored.rows < rows)
    throw Hdf5Error(fmt::format("{}: has {} rows, expected {} at least", where, stored.rows, rows));
  checked(H5Dset_extent(dataset.id(), &size), where, "shorten the series");
}

}  // namespace vitrum::output
