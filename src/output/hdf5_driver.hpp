#pragma once
#include <hdf5.h>

#include "output/hdf5.hpp"

namespace vitrum::output {

/// File access properties under which HDF5 never learns that a write has failed. HDF5 1.10 does not survive
/// such news: it crashes while it copies objects, and again when it closes the file. So the first failure is
/// stored in `failure` (an errno, 0 before), which must outlive the file; what could not be written is kept
/// in memory, so that HDF5 reads back what it wrote. The file is worthless then, and it is for the caller to
/// look at `failure` after closing. Failures to open and to read are HDF5's to tell, with the system's reason
/// as the innermost one; so is a lock that another process holds. Where a file system has no locks, files are
/// opened without (HDF5's own driver knows only one of the ways in which systems say so).
Handle file_properties(int& failure, const std::string& where);

}  // namespace vitrum::output
