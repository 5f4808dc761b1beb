#pragma once
#include <hdf5.h>

#include <span>
#include <string>

#include "output/descriptor.hpp"
#include "output/hdf5.hpp"

namespace vitrum::output {

/// Throws Hdf5Error "WHERE: cannot ACTION: innermost reason on HDF5's error stack".
[[noreturn]] void throw_hdf5_error(const std::string& where, const std::string& action);

/// Returns `status` unless it is negative (HDF5's sign of failure).
template <class Status>
Status checked(Status status, const std::string& where, const std::string& action) {
  if (status < 0) throw_hdf5_error(where, action);
  return status;
}

/// A checked, owned identifier.
inline Handle own(hid_t id, Handle::Closer closer, const std::string& where, const std::string& action) {
  return Handle(checked(id, where, action), closer);
}

/// Creation properties of a dataset of that size (one or two dimensions) and bytes per element, with a
/// checksum for all that is stored.
Handle checksummed_layout(std::span<const hsize_t> size, std::size_t element, const std::string& where);

/// Name of the attribute with this program's own copy of a text attribute.
std::string own_copy(const std::string& attribute);

Handle open_array(hid_t group, const std::string& name, const std::string& where);

/// A single value counts as an array of one element; anything but values in one or two dimensions is an
/// error.
Extent array_extent(const Handle& dataset, const std::string& where);

/// Bytes of the file that an object belongs to.
hsize_t file_size_of(hid_t object, const std::string& where);

/// Keeps a damaged or hostile file from asking for more memory than its data can fill, and from naming other
/// files as the place of its data.
void require_plausible(const Handle& dataset, Extent extent, std::size_t element, const std::string& where);

}  // namespace vitrum::output
