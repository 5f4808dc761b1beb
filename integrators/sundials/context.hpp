#pragma once
#include <memory>
#include <type_traits>

#include "integrators/sundials/compatibility.hpp"

namespace vitrum::sundials {

/// Owns a SUNContext. One per thread and solver family; never shared between threads.
class Context {
 public:
  /// Throws std::runtime_error when SUNDIALS refuses.
  Context();
  SUNContext get() const { return context_.get(); }

 private:
  struct Free {
    void operator()(SUNContext context) const;
  };
  std::unique_ptr<std::remove_pointer_t<SUNContext>, Free> context_;
};

}  // namespace vitrum::sundials
