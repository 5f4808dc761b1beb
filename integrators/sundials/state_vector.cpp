#include "integrators/sundials/state_vector.hpp"

#include <array>
#include <cmath>

namespace vitrum::sundials {
namespace {

/// z = sum of count terms c x.
template <int count>
void combine(const double* c, const std::array<const double*, 8>& x, double* z, sunindextype size) {
  std::array<double, 8> f{};
  for (int k = 0; k < count; ++k) f[static_cast<std::size_t>(k)] = c[k];
  for (sunindextype i = 0; i < size; ++i) {
    double sum = f[0] * x[0][i];
    for (std::size_t k = 1; k < static_cast<std::size_t>(count); ++k) sum += f[k] * x[k][i];
    z[i] = sum;
  }
}

int linear_combination(int count, sunrealtype* c, N_Vector* terms, N_Vector result) {
  const sunindextype size = N_VGetLength(result);
  double* z = N_VGetArrayPointer(result);
  std::array<const double*, 8> x{};
  // Seven terms at a time; from the second time on the sum so far is the first of them.
  std::array<double, 8> factors{};
  int done = 0;
  while (done < count) {
    int n = 0;
    if (done > 0) x[0] = z, factors[0] = 1.0, n = 1;
    for (; n < 8 && done < count; ++n, ++done)
      x[static_cast<std::size_t>(n)] = N_VGetArrayPointer(terms[done]),
      factors[static_cast<std::size_t>(n)] = c[done];
    switch (n) {
      case 1:
        combine<1>(factors.data(), x, z, size);
        break;
      case 2:
        combine<2>(factors.data(), x, z, size);
        break;
      case 3:
        combine<3>(factors.data(), x, z, size);
        break;
      case 4:
        combine<4>(factors.data(), x, z, size);
        break;
      case 5:
        combine<5>(factors.data(), x, z, size);
        break;
      case 6:
        combine<6>(factors.data(), x, z, size);
        break;
      case 7:
        combine<7>(factors.data(), x, z, size);
        break;
      default:
        combine<8>(factors.data(), x, z, size);
    }
  }
  return 0;
}

sunrealtype weighted_norm(N_Vector values, N_Vector weights) {
  const sunindextype size = N_VGetLength(values), whole = size - size % 8;
  const double *x = N_VGetArrayPointer(values), *w = N_VGetArrayPointer(weights);
  std::array<double, 8> sums{};
  for (sunindextype i = 0; i < whole; i += 8)
    for (std::size_t k = 0; k < 8; ++k) {
      const double product = x[static_cast<std::size_t>(i) + k] * w[static_cast<std::size_t>(i) + k];
      sums[k] += product * product;
    }
  double sum = 0.0;
  for (sunindextype i = whole; i < size; ++i) sum += x[i] * w[i] * x[i] * w[i];
  for (const double s : sums) sum += s;
  return std::sqrt(sum / static_cast<double>(size));
}

}  // namespace

StateVector make_state_vector(std::size_t size, const Context& context) {
  StateVector vector(allocated(N_VNew_Serial(static_cast<sunindextype>(size), context.get())));
  vector->ops->nvlinearcombination = linear_combination;
  vector->ops->nvwrmsnorm = weighted_norm;
  N_VConst(0.0, vector.get());
  return vector;
}

}  // namespace vitrum::sundials
