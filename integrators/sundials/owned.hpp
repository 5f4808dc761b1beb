#pragma once
#include <memory>
#include <new>
#include <type_traits>

namespace vitrum::sundials {

/// Deletes a SUNDIALS object by its C function.
template <auto free>
struct Freed {
  template <class T>
  void operator()(T* p) const {
    free(p);
  }
};
/// Owns a SUNDIALS object, e.g. Owned<N_Vector, N_VDestroy>.
template <class Handle, auto free>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Freed<free>>;

/// What a SUNDIALS constructor returned. With valid arguments, null means that memory is short: throws
/// std::bad_alloc.
template <class Pointer>
Pointer allocated(Pointer made) {
  if (made == nullptr) throw std::bad_alloc();
  return made;
}

}  // namespace vitrum::sundials
