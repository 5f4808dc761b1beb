#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

/// Bytes that carry a checksum together; HDF5's cache holds one such chunk.
constexpr hsize_t chunk_bytes = hsize_t{1} << 20;
/// Highest ratio that deflate, with which others may have repacked a file, can reach.
constexpr hsize_t highest_compression = 1032;
/// Arrays below this size are read however little of them is stored (unwritten rows of a series take no
/// space).
constexpr hsize_t always_read = hsize_t{16} << 20;

bool is_compressed(const Handle& creation) {
  for (int filter = 0; filter < H5Pget_nfilters(creation.id()); ++filter) {
    unsigned flags = 0, configuration = 0;
    std::size_t values = 0;
    if (H5Pget_filter2(creation.id(), static_cast<unsigned>(filter), &flags, &values, nullptr, 0, nullptr,
                       &configuration) == H5Z_FILTER_DEFLATE)
      return true;
  }
  return false;
}

}  // namespace

Handle checksummed_layout(std::span<const hsize_t> size, std::size_t element, const std::string& where) {
  Handle creation = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "describe the layout");
  if (std::find(size.begin(), size.end(), hsize_t{0}) != size.end()) return creation;
  std::vector<hsize_t> chunk(size.begin(), size.end());
  const hsize_t row_bytes = element * (size.size() == 2 ? size[1] : 1);
  chunk[0] = std::clamp<hsize_t>(chunk_bytes / row_bytes, 1, size[0]);
  checked(H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data()), where, "set the chunks");
  checked(H5Pset_fletcher32(creation.id()), where, "switch checksums on");
  return creation;
}

Handle open_array(hid_t group, const std::string& name, const std::string& where) {
  return own(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, where, "open the array");
}

Extent array_extent(const Handle& dataset, const std::string& where) {
  const Handle space = own(H5Dget_space(dataset.id()), H5Sclose, where, "read the array's shape");
  const int rank = H5Sget_simple_extent_ndims(space.id());
  std::array<hsize_t, 2> size = {1, 1};
  if (rank < 0 || rank > 2 || H5Sget_simple_extent_type(space.id()) == H5S_NULL)
    throw Hdf5Error(fmt::format("{}: is not an array of one or two dimensions", where));
  checked(H5Sget_simple_extent_dims(space.id(), size.data(), nullptr), where, "read the array's shape");
  return {static_cast<std::size_t>(size[0]), static_cast<std::size_t>(size[1])};
}

hsize_t file_size_of(hid_t object, const std::string& where) {
  const Handle file = own(H5Iget_file_id(object), H5Fclose, where, "find the object's file");
  hsize_t size = 0;
  checked(H5Fget_filesize(file.id(), &size), where, "find the file's size");
  return size;
}

void require_plausible(const Handle& dataset, Extent extent, std::size_t element, const std::string& where) {
  const Handle creation = own(H5Dget_create_plist(dataset.id()), H5Pclose, where, "read the array's layout");
  if (H5Pget_layout(creation.id()) == H5D_VIRTUAL || H5Pget_external_count(creation.id()) > 0)
    throw Hdf5Error(fmt::format("{}: keeps its data in other files", where));
  hsize_t limit = std::min<hsize_t>(H5Dget_storage_size(dataset.id()), file_size_of(dataset.id(), where));
  if (is_compressed(creation)) limit *= highest_compression;
  limit = std::max(limit, always_read) / element;
  if (extent.columns > 0 && extent.rows > limit / extent.columns)
    throw Hdf5Error(fmt::format("{}: claims {} x {} elements, more than the file holds", where, extent.rows,
                                extent.columns));
}

}  // namespace vitrum::output
