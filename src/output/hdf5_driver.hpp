#pragma once
#include <hdf5.h>

#include <string>
#include <vector>

#include "output/hdf5.hpp"

namespace vitrum::output {

/// What the driver notes while a file is open.
struct FileRecord {
  int failure = 0;                 ///< errno of the first write that failed, or 0
  std::vector<ByteRange> written;  ///< in the order of the writes
};

/// File access properties under which HDF5 never learns that a write has failed. HDF5 1.10 does not survive
/// such news: it crashes while it copies objects, and again when it closes the file. So the first failure is
/// noted in `record`, which must outlive the file; what could not be written is kept in memory, so that HDF5
/// reads back what it wrote. The file is worthless then, and it is for the caller to look at the record after
/// closing. Failures to open and to read are HDF5's to tell, with the system's reason
/// as the innermost one; so is a lock that another process holds. Where a file system has no locks, files are
/// opened without (HDF5's own driver knows only one of the ways in which systems say so).
Handle file_properties(FileRecord& record, const std::string& where);

}  // namespace vitrum::output
