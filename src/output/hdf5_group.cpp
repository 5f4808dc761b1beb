#include <fmt/format.h>

#include <algorithm>

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

Handle scalar_space(const std::string& where) {
  return own(H5Screate(H5S_SCALAR), H5Sclose, where, "describe a single value");
}

void write_attribute(hid_t group, const std::string& object, const std::string& name, hid_t type,
                     const void* value, const std::string& where) {
  const std::string action = fmt::format("write attribute '{}'", name);
  const Handle space = scalar_space(where);
  const Handle attribute = own(H5Acreate_by_name(group, object.c_str(), name.c_str(), type, space.id(),
                                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, where, action);
  checked(H5Awrite(attribute.id(), type, value), where, action);
}

/// Opens a single-valued attribute of the given class; anything else is an error.
Handle open_attribute(hid_t group, const std::string& object, const std::string& name, H5T_class_t kind,
                      const std::string& where) {
  const std::string action = fmt::format("read attribute '{}'", name);
  Handle attribute = own(H5Aopen_by_name(group, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, where, action);
  const Handle space = own(H5Aget_space(attribute.id()), H5Sclose, where, action);
  const Handle type = own(H5Aget_type(attribute.id()), H5Tclose, where, action);
  const bool variable_text = kind != H5T_STRING || H5Tis_variable_str(type.id()) > 0;
  if (H5Sget_simple_extent_npoints(space.id()) != 1 || H5Tget_class(type.id()) != kind || !variable_text)
    throw Hdf5Error(fmt::format("{}: attribute '{}' is not of the expected type", where, name));
  return attribute;
}

}  // namespace

std::string Group::member(const std::string& name) const {
  if (name == ".") return label_;
  return label_.ends_with('/') ? label_ + name : label_ + '/' + name;
}

Group Group::create_group(const std::string& name) const {
  return Group(own(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                   member(name), "create the group"),
               member(name));
}

Group Group::open_group(const std::string& name) const {
  return Group(
      own(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose, member(name), "open the group"),
      member(name));
}

bool Group::has(const std::string& name) const {
  return checked(H5Lexists(handle_.id(), name.c_str(), H5P_DEFAULT), member(name), "look for the object") > 0;
}

std::vector<std::string> Group::names() const {
  std::vector<std::string> names;
  checked(H5Literate(handle_.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_name, &names), label_,
          "list the group");
  std::sort(names.begin(), names.end());
  return names;
}

void Group::set_attribute(const std::string& object, const std::string& name, const std::string& text) const {
  const char* value = text.c_str();
  write_attribute(handle_.id(), object, name, text_type(member(object)).id(), &value, member(object));
}

void Group::set_attribute(const std::string& object, const std::string& name, double value) const {
  write_attribute(handle_.id(), object, name, H5T_NATIVE_DOUBLE, &value, member(object));
}

void Group::set_attribute(const std::string& object, const std::string& name, std::int64_t value) const {
  write_attribute(handle_.id(), object, name, H5T_NATIVE_INT64, &value, member(object));
}

bool Group::has_attribute(const std::string& object, const std::string& name) const {
  return checked(H5Aexists_by_name(handle_.id(), object.c_str(), name.c_str(), H5P_DEFAULT), member(object),
                 "look for an attribute") > 0;
}

std::string Group::text_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(handle_.id(), object, name, H5T_STRING, member(object));
  char* text = nullptr;
  checked(H5Aread(attribute.id(), text_type(member(object)).id(), static_cast<void*>(&text)), member(object),
          fmt::format("read attribute '{}'", name));
  std::string result = text == nullptr ? "" : text;
  H5free_memory(text);
  return result;
}

double Group::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0.0;
  const Handle attribute = open_attribute(handle_.id(), object, name, H5T_FLOAT, member(object));
  checked(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), member(object),
          fmt::format("read attribute '{}'", name));
  return value;
}

std::int64_t Group::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  const Handle attribute = open_attribute(handle_.id(), object, name, H5T_INTEGER, member(object));
  checked(H5Aread(attribute.id(), H5T_NATIVE_INT64, &value), member(object),
          fmt::format("read attribute '{}'", name));
  return value;
}

void Group::copy(const std::string& name, const Group& target) const {
  checked(H5Ocopy(handle_.id(), name.c_str(), target.handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
          target.member(name), fmt::format("copy from {}", member(name)));
}

}  // namespace vitrum::output
