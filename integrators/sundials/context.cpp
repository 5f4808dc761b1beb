#include "integrators/sundials/context.hpp"

#include <stdexcept>

namespace vitrum::sundials {

Context::Context() {
  SUNContext context = nullptr;
  if (create_context(&context) != 0) throw std::runtime_error("SUNDIALS could not create a context");
  context_.reset(context);
}

void Context::Free::operator()(SUNContext context) const {
  SUNContext_Free(&context);
}

}  // namespace vitrum::sundials
