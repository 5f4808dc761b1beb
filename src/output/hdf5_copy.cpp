#include <fmt/format.h>

#include "output/hdf5_internal.hpp"

// H5Ocopy would read the texts of variable length (see hdf5_text.cpp): attributes are copied one by one,
// texts from their copies of a fixed length.

namespace vitrum::output {
namespace {

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::string> attribute_names(hid_t group, const std::string& object, const std::string& where) {
  std::vector<std::string> names;
  checked(H5Aiterate_by_name(group, object.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect_name,
                             &names, H5P_DEFAULT),
          where, "list the attributes");
  return names;
}

}  // namespace

void Group::copy_attributes(const std::string& object, const Group& target) const {
  for (const std::string& name : attribute_names(handle_.id(), object, member(object))) {
    if (name.starts_with('.')) {
      const std::string text = name.substr(1);
      target.set_attribute(object, text, text_attribute(object, text));
      continue;
    }
    const Handle attribute = open_attribute(object, name);
    const Handle type =
        own(H5Aget_type(attribute.id()), H5Tclose, member(object), "read the attribute's type");
    switch (H5Tget_class(type.id())) {
      case H5T_FLOAT:
        target.set_attribute(object, name, number_attribute(object, name));
        break;
      case H5T_INTEGER:
        target.set_attribute(object, name, integer_attribute(object, name));
        break;
      default:  // a text for other readers, whose copy makes it anew
        break;
    }
  }
}

void Group::copy(const std::string& name, const Group& target) const {
  const Handle object =
      own(H5Oopen(handle_.id(), name.c_str(), H5P_DEFAULT), H5Oclose, member(name), "open it");
  if (H5Iget_type(object.id()) == H5I_GROUP) {
    const Group from = open_group(name), to = target.create_group(name);
    for (const std::string& below : from.names()) from.copy(below, to);
  } else {
    const Handle bare = own(H5Pcreate(H5P_OBJECT_COPY), H5Pclose, member(name), "describe the copy");
    checked(H5Pset_copy_object(bare.id(), H5O_COPY_WITHOUT_ATTR_FLAG), member(name), "describe the copy");
    checked(H5Ocopy(handle_.id(), name.c_str(), target.handle_.id(), name.c_str(), bare.id(), H5P_DEFAULT),
            target.member(name), fmt::format("copy from {}", member(name)));
  }
  copy_attributes(name, target);
}

}  // namespace vitrum::output
