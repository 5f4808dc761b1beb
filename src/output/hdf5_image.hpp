#pragma once
#include <hdf5.h>

#include <cstddef>
#include <span>
#include <string>

#include "output/hdf5.hpp"

namespace vitrum::output {

/// The memory of a file that HDF5 makes in memory; it outlives the file, so that the image can be taken when
/// HDF5 has brought it into its final form, by closing.
class FileImage {
 public:
  FileImage() = default;
  ~FileImage();
  FileImage(const FileImage&) = delete;
  FileImage& operator=(const FileImage&) = delete;

  /// Properties of a file in memory that leaves itself here.
  Handle properties(const std::string& where);
  /// The closed file's bytes. user_block: those in front of its content.
  std::span<char> bytes(std::size_t user_block) const;
  void keep(void* memory) { memory_ = memory; }

 private:
  void* memory_ = nullptr;
};

}  // namespace vitrum::output
