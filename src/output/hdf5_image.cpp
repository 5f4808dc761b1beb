#include "output/hdf5_image.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

/// Bytes by which a file in memory grows.
constexpr std::size_t growth = std::size_t{64} << 10;
/// Where the superblock (of version 3) tells the end of the file, behind the user block.
constexpr std::size_t end_of_file = 28;

void* allocate(std::size_t size, H5FD_file_image_op_t, void*) {
  return std::malloc(size);
}
void* copy(void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::memcpy(to, from, size);
}
void* resize(void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::realloc(memory, size);
}
herr_t release(void* memory, H5FD_file_image_op_t operation, void* image) {
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
    static_cast<FileImage*>(image)->keep(memory);
  else
    std::free(memory);
  return 0;
}
void* same(void* image) {
  return image;
}
herr_t leave(void*) {
  return 0;
}

}  // namespace

FileImage::~FileImage() {
  std::free(memory_);
}

Handle FileImage::properties(const std::string& where) {
  Handle access = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, where, "set file access");
  checked(H5Pset_fapl_core(access.id(), growth, false), where, "set file access");
  H5FD_file_image_callbacks_t callbacks = {allocate, copy, resize, release, same, leave, this};
  checked(H5Pset_file_image_callbacks(access.id(), &callbacks), where, "set file access");
  return access;
}

std::span<char> FileImage::bytes(std::size_t user_block) const {
  std::uint64_t size = 0;
  std::memcpy(&size, static_cast<char*>(memory_) + user_block + end_of_file, sizeof size);
  return {static_cast<char*>(memory_), static_cast<std::size_t>(size)};
}

}  // namespace vitrum::output
