#pragma once
#include <hdf5.h>

#include <string>

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

/// Variable-length UTF-8, the only text type that is written.
Handle text_type(const std::string& where);

}  // namespace vitrum::output
