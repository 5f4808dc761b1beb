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
/// Highest ratio that deflate, the common compression filter, can reach.
constexpr hsize_t highest_compression = 1032;
/// Arrays below this size are read however little of them is stored (unwritten rows of a series take no
/// space).
constexpr hsize_t always_read = hsize_t{16} << 20;

template <class Number>
hid_t native_type() {
  if constexpr (std::is_same_v<Number, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<Number, std::int64_t>) return H5T_NATIVE_INT64;
  if constexpr (std::is_same_v<Number, std::uint32_t>) return H5T_NATIVE_UINT32;
}

template <class Number>
void write_array(hid_t group, const std::string& name, std::span<const Number> values, std::size_t columns,
                 const std::string& where) {
  const std::array<hsize_t, 2> size = {values.size() / columns, columns};
  const Handle space = own(H5Screate_simple(columns == 1 ? 1 : 2, size.data(), nullptr), H5Sclose, where,
                           "describe the array");
  const Handle dataset = own(H5Dcreate2(group, name.c_str(), native_type<Number>(), space.id(), H5P_DEFAULT,
                                        H5P_DEFAULT, H5P_DEFAULT),
                             H5Dclose, where, "create the array");
  if (values.empty()) return;  // HDF5 refuses the null pointer of an empty vector
  checked(H5Dwrite(dataset.id(), native_type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), where,
          "write the array");
}

Handle open_array(hid_t group, const std::string& name, const std::string& where) {
  return own(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, where, "open the array");
}

Extent array_extent(const Handle& dataset, const std::string& where) {
  const Handle space = own(H5Dget_space(dataset.id()), H5Sclose, where, "read the array's shape");
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::array<hsize_t, 2> size = {1, 1};
  if (rank < 0 || rank > 2)
    throw Hdf5Error(fmt::format("{}: is not an array of one or two dimensions", where));
  checked(H5Sget_simple_extent_dims(space.id(), size.data(), nullptr), where, "read the array's shape");
  return {static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1])};
}

/// Keeps a damaged or hostile file from asking for more memory than its data can fill.
void require_plausible(const Handle& dataset, Extent extent, std::size_t element, const std::string& where) {
  const Handle creation = own(H5Dget_create_plist(dataset.id()), H5Pclose, where, "read the array's layout");
  const Handle file = own(H5Iget_file_id(dataset.id()), H5Fclose, where, "find the array's file");
  hsize_t file_size = 0;
  checked(H5Fget_filesize(file.id(), &file_size), where, "find the file's size");
  hsize_t limit = std::min<hsize_t>(H5Dget_storage_size(dataset.id()), file_size);
  if (H5Pget_nfilters(creation.id()) > 0) limit *= highest_compression;
  limit = std::max(limit, always_read) / element;
  if (extent.columns > 0 && extent.rows > limit / extent.columns)
    throw Hdf5Error(fmt::format("{}: claims {} x {} elements, more than the file holds", where, extent.rows,
                                extent.columns));
}

template <class Number>
std::vector<Number> read_array(hid_t group, const std::string& name, H5T_class_t kind,
                               const std::string& where) {
  const Handle dataset = open_array(group, name, where);
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, where, "read the array's type");
  if (H5Tget_class(type.id()) != kind)
    throw Hdf5Error(fmt::format("{}: is not an array of the expected type", where));
  const Extent extent = array_extent(dataset, where);
  require_plausible(dataset, extent, sizeof(Number), where);
  std::vector<Number> values(extent.size());
  if (values.empty()) return values;
  checked(H5Dread(dataset.id(), native_type<Number>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), where,
          "read the array");
  return values;
}

void write_text_array(hid_t group, const std::string& name, const Handle& space,
                      std::span<const std::string> texts, const std::string& where) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Handle type = text_type(where);
  const Handle dataset =
      own(H5Dcreate2(group, name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
          H5Dclose, where, "create the text");
  if (texts.empty()) return;
  checked(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), where,
          "write the text");
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

void Group::write_text(const std::string& name, const std::string& text) const {
  const Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, member(name), "describe the text");
  write_text_array(handle_.id(), name, space, {&text, 1}, member(name));
}

void Group::write_texts(const std::string& name, std::span<const std::string> texts) const {
  const hsize_t size = texts.size();
  const Handle space = own(H5Screate_simple(1, &size, nullptr), H5Sclose, member(name), "describe the texts");
  write_text_array(handle_.id(), name, space, texts, member(name));
}

Extent Group::extent(const std::string& name) const {
  return array_extent(open_array(handle_.id(), name, member(name)), member(name));
}

std::vector<double> Group::read_doubles(const std::string& name) const {
  return read_array<double>(handle_.id(), name, H5T_FLOAT, member(name));
}
std::vector<std::int64_t> Group::read_integers(const std::string& name) const {
  return read_array<std::int64_t>(handle_.id(), name, H5T_INTEGER, member(name));
}
std::vector<std::uint32_t> Group::read_indices(const std::string& name) const {
  return read_array<std::uint32_t>(handle_.id(), name, H5T_INTEGER, member(name));
}

std::vector<std::string> Group::read_texts(const std::string& name) const {
  const std::string where = member(name);
  const Handle dataset = open_array(handle_.id(), name, where);
  const Handle stored = own(H5Dget_type(dataset.id()), H5Tclose, where, "read the text's type");
  if (H5Tis_variable_str(stored.id()) <= 0)
    throw Hdf5Error(fmt::format("{}: is not variable-length text", where));
  const Extent extent = array_extent(dataset, where);
  require_plausible(dataset, extent, sizeof(char*), where);
  std::vector<char*> pointers(extent.size(), nullptr);
  if (pointers.empty()) return {};
  checked(H5Dread(dataset.id(), text_type(where).id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), where,
          "read the text");
  std::vector<std::string> texts;
  for (char* text : pointers) {
    texts.emplace_back(text == nullptr ? "" : text);
    H5free_memory(text);
  }
  return texts;
}

std::string Group::read_text(const std::string& name) const {
  const std::vector<std::string> texts = read_texts(name);
  if (texts.size() != 1) throw Hdf5Error(fmt::format("{}: is not a single text", member(name)));
  return texts.front();
}

void Group::create_series(const std::string& name) const {
  const std::string where = member(name);
  const hsize_t size = 0, unlimited = H5S_UNLIMITED;
  const double missing = std::numeric_limits<double>::quiet_NaN();
  const Handle space = own(H5Screate_simple(1, &size, &unlimited), H5Sclose, where, "describe the series");
  const Handle creation = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "describe the series");
  checked(H5Pset_chunk(creation.id(), 1, &series_chunk), where, "describe the series");
  checked(H5Pset_fill_value(creation.id(), H5T_NATIVE_DOUBLE, &missing), where, "describe the series");
  own(H5Dcreate2(handle_.id(), name.c_str(), H5T_NATIVE_DOUBLE, space.id(), H5P_DEFAULT, creation.id(),
                 H5P_DEFAULT),
      H5Dclose, where, "create the series");
}

void Group::write_row(const std::string& name, std::size_t row, double value) const {
  const std::string where = member(name);
  const Handle dataset = open_array(handle_.id(), name, where);
  const hsize_t start = row, count = 1, size = std::max<hsize_t>(array_extent(dataset, where).rows, row + 1);
  checked(H5Dset_extent(dataset.id(), &size), where, "extend the series");
  const Handle space = own(H5Dget_space(dataset.id()), H5Sclose, where, "read the series' shape");
  checked(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, &start, nullptr, &count, nullptr), where,
          "select a row");
  const Handle single = own(H5Screate_simple(1, &count, nullptr), H5Sclose, where, "describe a row");
  checked(H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, single.id(), space.id(), H5P_DEFAULT, &value), where,
          "write a row");
}

}  // namespace vitrum::output
