#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <new>

#include "output/hdf5_internal.hpp"

namespace vitrum::output {
namespace {

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (const std::bad_alloc&) {
    return -1;  // no exception may cross HDF5
  }
}

/// Attributes are read as they are stored: no conversion of what a foreign file may hold.
bool is_single(const Handle& attribute, std::array<hid_t, 2> stored, const std::string& where) {
  const Handle space = own(H5Aget_space(attribute.id()), H5Sclose, where, "read the attribute's shape");
  const Handle type = own(H5Aget_type(attribute.id()), H5Tclose, where, "read the attribute's type");
  return H5Sget_simple_extent_npoints(space.id()) == 1 &&
         std::any_of(stored.begin(), stored.end(), [&](hid_t t) { return H5Tequal(type.id(), t) > 0; });
}

}  // namespace

std::string Group::member(const std::string& name) const {
  if (name == ".") return label_;
  return label_.ends_with('/') ? label_ + name : label_ + '/' + name;
}

Group Group::create_group(const std::string& name) const {
  // Members up to so many stand in the group itself; an index of them costs more than it saves.
  constexpr unsigned most = 64, fewest = 48;
  const std::string where = member(name);
  const Handle creation = own(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, where, "describe the group");
  checked(H5Pset_link_phase_change(creation.id(), most, fewest), where, "describe the group");
  return Group(own(H5Gcreate2(handle_.id(), name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose,
                   where, "create the group"),
               where);
}

Group Group::open_group(const std::string& name) const {
  return Group(
      own(H5Gopen2(handle_.id(), name.c_str(), H5P_DEFAULT), H5Gclose, member(name), "open the group"),
      member(name));
}

void Group::link_to_file(const std::string& name, const std::string& file, const std::string& group) const {
  checked(
      H5Lcreate_external(file.c_str(), group.c_str(), handle_.id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
      member(name), "create the link");
}

void Group::remove(const std::string& name) const {
  checked(H5Ldelete(handle_.id(), name.c_str(), H5P_DEFAULT), member(name), "remove it");
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

void Group::write_attribute(const std::string& object, const std::string& name, hid_t type,
                            const void* value) const {
  const std::string where = member(object), action = fmt::format("write attribute '{}'", name);
  const Handle space = own(H5Screate(H5S_SCALAR), H5Sclose, where, action);
  const Handle attribute = own(H5Acreate_by_name(handle_.id(), object.c_str(), name.c_str(), type, space.id(),
                                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose, where, action);
  checked(H5Awrite(attribute.id(), type, value), where, action);
}

Handle Group::open_attribute(const std::string& object, const std::string& name) const {
  return own(H5Aopen_by_name(handle_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
             member(object), fmt::format("read attribute '{}'", name));
}

void Group::read_single(const std::string& object, const std::string& name, std::array<hid_t, 2> stored,
                        hid_t native, void* value) const {
  const Handle attribute = open_attribute(object, name);
  if (!is_single(attribute, stored, member(object)))
    throw Hdf5Error(fmt::format("{}: attribute '{}' is not of the expected type", member(object), name));
  checked(H5Aread(attribute.id(), native, value), member(object), fmt::format("read attribute '{}'", name));
}

void Group::set_attribute(const std::string& object, const std::string& name, double value) const {
  write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void Group::set_attribute(const std::string& object, const std::string& name, std::int64_t value) const {
  write_attribute(object, name, H5T_NATIVE_INT64, &value);
}

bool Group::has_attribute(const std::string& object, const std::string& name) const {
  return checked(H5Aexists_by_name(handle_.id(), object.c_str(), name.c_str(), H5P_DEFAULT), member(object),
                 "look for an attribute") > 0;
}

double Group::number_attribute(const std::string& object, const std::string& name) const {
  double value = 0.0;
  read_single(object, name, {H5T_IEEE_F64LE, H5T_IEEE_F64BE}, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::int64_t Group::integer_attribute(const std::string& object, const std::string& name) const {
  std::int64_t value = 0;
  read_single(object, name, {H5T_STD_I64LE, H5T_STD_I64BE}, H5T_NATIVE_INT64, &value);
  return value;
}

}  // namespace vitrum::output
