#pragma once
#include <vector>

// For headers that only declare the rows of a struct; field.hpp defines them.

namespace vitrum::schema {

template <class Owner>
class Field;

template <class Owner>
using Fields = std::vector<Field<Owner>>;

}  // namespace vitrum::schema
