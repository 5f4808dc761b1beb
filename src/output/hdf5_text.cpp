#include <fmt/format.h>

#include <algorithm>

#include "output/hdf5_internal.hpp"
#include "scene/sha256.hpp"

// HDF5 keeps texts of variable length in a heap of its own that carries no checksum: one flipped bit there
// makes HDF5 1.10 loop or read beyond its memory. Such texts are never read here. What this program reads has
// a fixed length; attributes are written both ways, because readers in other languages get text, not bytes,
// only from those of variable length.

namespace vitrum::output {
namespace {

constexpr const char* digest_name = "sha256";
/// What fits into the header of an object, which has a checksum, with room for attributes.
constexpr std::size_t fits_into_header = 60000;

/// HDF5 has no type of no bytes.
std::size_t stored_length(std::size_t length) {
  return std::max<std::size_t>(length, 1);
}

Handle text_type(std::size_t length, const std::string& where) {
  Handle type = own(H5Tcopy(H5T_C_S1), H5Tclose, where, "describe text");
  checked(H5Tset_size(type.id(), stored_length(length)), where, "describe text");
  checked(H5Tset_cset(type.id(), H5T_CSET_UTF8), where, "describe text");
  checked(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), where, "describe text");
  return type;
}

/// `count` texts of equal length, one after the other, filled up with zeros.
std::string packed(std::span<const std::string> texts, std::size_t length) {
  std::string bytes;
  for (const std::string& text : texts) {
    bytes += text;
    bytes.resize(bytes.size() + length - text.size(), '\0');
  }
  return bytes;
}

std::string unpadded(std::string_view text) {
  return std::string(text.substr(0, text.find_last_not_of('\0') + 1));
}

/// Bytes that a stored text takes; anything but text of a fixed length is an error.
std::size_t length_of(hid_t type, const std::string& where) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw Hdf5Error(fmt::format("{}: is not text of a fixed length", where));
  return H5Tget_size(type);
}

}  // namespace

void Group::write_text(const std::string& name, const std::string& text) const {
  const std::string where = member(name);
  const Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, where, "describe the text");
  const Handle type = text_type(text.size(), where);
  const Handle layout = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "describe the layout");
  checked(H5Pset_layout(layout.id(), text.size() <= fits_into_header ? H5D_COMPACT : H5D_CONTIGUOUS), where,
          "choose the layout");
  const Handle dataset = own(
      H5Dcreate2(handle_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
      H5Dclose, where, "create the text");
  checked(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                   packed({&text, 1}, stored_length(text.size())).data()),
          where, "write the text");
  set_attribute(name, digest_name, sha256(text));  // HDF5 has none for a single value that is longer
}

std::string Group::read_text(const std::string& name) const {
  const std::vector<std::string> texts = read_texts(name);
  if (texts.size() != 1) throw Hdf5Error(fmt::format("{}: is not a single text", member(name)));
  if (text_attribute(name, digest_name) != sha256(texts.front()))
    throw Hdf5Error(fmt::format("{}: is damaged: its content does not match its SHA-256", member(name)));
  return texts.front();
}

void Group::write_texts(const std::string& name, std::span<const std::string> texts) const {
  const std::string where = member(name);
  const hsize_t size = texts.size();
  std::size_t length = 0;
  for (const std::string& text : texts) length = std::max(length, text.size());
  const Handle space = own(H5Screate_simple(1, &size, nullptr), H5Sclose, where, "describe the texts");
  const Handle type = text_type(length, where);
  const Handle layout = checksummed_layout({&size, 1}, stored_length(length), where);
  const Handle dataset = own(
      H5Dcreate2(handle_.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, layout.id(), H5P_DEFAULT),
      H5Dclose, where, "create the texts");
  if (texts.empty()) return;
  checked(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                   packed(texts, stored_length(length)).data()),
          where, "write the texts");
}

std::vector<std::string> Group::read_texts(const std::string& name) const {
  const std::string where = member(name);
  const Handle dataset = open_array(handle_.id(), name, where);
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, where, "read the text's type");
  const std::size_t length = length_of(type.id(), where);
  const Extent extent = array_extent(dataset, where);
  require_plausible(dataset, extent, length, where);
  std::string bytes(extent.size() * length, '\0');
  if (bytes.empty()) return {};
  checked(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), where,
          "read the text");
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < extent.size(); ++k)
    texts.push_back(unpadded(std::string_view(bytes).substr(k * length, length)));
  return texts;
}

std::string own_copy(const std::string& attribute) {
  return "." + attribute;
}

void Group::set_attribute(const std::string& object, const std::string& name, const std::string& text) const {
  const std::string where = member(object);
  const Handle shown = own(H5Tcopy(H5T_C_S1), H5Tclose, where, "describe text");
  checked(H5Tset_size(shown.id(), H5T_VARIABLE), where, "describe text");
  checked(H5Tset_cset(shown.id(), H5T_CSET_UTF8), where, "describe text");
  const char* const characters = text.c_str();
  write_attribute(object, name, shown.id(), &characters);
  write_attribute(object, own_copy(name), text_type(text.size(), where).id(),
                  packed({&text, 1}, stored_length(text.size())).data());
}

std::string Group::text_attribute(const std::string& object, const std::string& name) const {
  const std::string where = fmt::format("{}: attribute '{}'", member(object), name);
  const Handle attribute = open_attribute(object, own_copy(name));
  const Handle type = own(H5Aget_type(attribute.id()), H5Tclose, where, "read the text's type");
  const std::size_t length = length_of(type.id(), where);
  if (length > file_size_of(attribute.id(), where))
    throw Hdf5Error(fmt::format("{}: claims {} bytes, more than the file holds", where, length));
  std::string bytes(length, '\0');
  checked(H5Aread(attribute.id(), type.id(), bytes.data()), where, "read the text");
  return unpadded(bytes);
}

}  // namespace vitrum::output
