#include "integrators/sundials/state_vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <type_traits>
#include <vector>

namespace vitrum::sundials {
namespace {

/// What a vector holds: what SUNDIALS' serial vector does, first, so that its operations and N_VDestroy take
/// it for one (and free it).
struct Content {
  std::remove_pointer_t<N_VectorContent_Serial> serial;
  const ArkSystem* system;
};

const ArkSystem& system_of(N_Vector v) {
  return *static_cast<const Content*>(v->content)->system;
}

/// Calls f(part, begin, end) for ranges that make up the vector, on several threads.
template <class F>
void for_ranges(N_Vector v, F&& f) {
  const ArkSystem& system = system_of(v);
  system.for_each_range(f);
  if (system.integrals() > 0) f(0, system.size(), system.size() + system.integrals());
}

/// z = a x + b y. All may be the same vector.
void linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z) {
  const double *from_x = N_VGetArrayPointer(x), *from_y = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(z);
  for_ranges(z, [=](std::size_t, std::size_t begin, std::size_t end) {
#pragma GCC ivdep
    for (std::size_t i = begin; i < end; ++i) to[i] = a * from_x[i] + b * from_y[i];
  });
}

/// z = c x.
void scale(sunrealtype c, N_Vector x, N_Vector z) {
  const double* from = N_VGetArrayPointer(x);
  double* to = N_VGetArrayPointer(z);
  if (c == 1.0 && from == to) return;
  for_ranges(z, [=](std::size_t, std::size_t begin, std::size_t end) {
#pragma GCC ivdep
    for (std::size_t i = begin; i < end; ++i) to[i] = c * from[i];
  });
}

void fill(sunrealtype c, N_Vector z) {
  double* to = N_VGetArrayPointer(z);
  for_ranges(z, [=](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to[i] = c;
  });
}

constexpr std::size_t most_terms = 8;
struct Terms {
  std::array<double, most_terms> factors{};
  std::array<const double*, most_terms> values{};
};

/// z = sum of the first count terms. z may be one of them.
template <std::size_t count>
void combine(const Terms& terms, double* z, std::size_t begin, std::size_t end) {
  const Terms t = terms;
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) {
    double sum = t.factors[0] * t.values[0][i];
    for (std::size_t k = 1; k < count; ++k) sum += t.factors[k] * t.values[k][i];
    z[i] = sum;
  }
}

using Combine = void (*)(const Terms&, double*, std::size_t, std::size_t);
constexpr std::array<Combine, most_terms> combine_by_count{combine<1>, combine<2>, combine<3>, combine<4>,
                                                           combine<5>, combine<6>, combine<7>, combine<8>};

int linear_combination(int count, sunrealtype* factors, N_Vector* vectors, N_Vector result) {
  double* z = N_VGetArrayPointer(result);
  // Eight terms at a time; from the second time on the sum so far is the first of them.
  for (int done = 0; done < count;) {
    Terms terms;
    std::size_t n = 0;
    if (done > 0) terms.values[n] = z, terms.factors[n++] = 1.0;
    for (; n < most_terms && done < count; ++n, ++done)
      terms.values[n] = N_VGetArrayPointer(vectors[done]), terms.factors[n] = factors[done];
    for_ranges(result, [&terms, z, add = combine_by_count[n - 1]](
                           std::size_t, std::size_t begin, std::size_t end) { add(terms, z, begin, end); });
  }
  return 0;
}

/// Sum of (x w)^2 over a range, with independent partial sums.
double weighted_squares(const double* x, const double* w, std::size_t begin, std::size_t end) {
  constexpr std::size_t side_by_side = 8;
  std::array<double, side_by_side> sums{};
  const std::size_t whole = begin + (end - begin) / side_by_side * side_by_side;
  for (std::size_t i = begin; i < whole; i += side_by_side)
    for (std::size_t k = 0; k < side_by_side; ++k) {
      const double product = x[i + k] * w[i + k];
      sums[k] += product * product;
    }
  double sum = 0.0;
  for (std::size_t i = whole; i < end; ++i) sum += x[i] * w[i] * x[i] * w[i];
  for (const double s : sums) sum += s;
  return sum;
}

/// Sums by part. Has its size before ARKODE, which knows no exceptions, asks for a norm.
thread_local std::vector<double> sums_of_parts;

sunrealtype weighted_norm(N_Vector values, N_Vector weights) {
  const double *x = N_VGetArrayPointer(values), *w = N_VGetArrayPointer(weights);
  const std::size_t parts = system_of(values).parts();
  double* sums = sums_of_parts.data();
  std::fill_n(sums, parts, 0.0);
  system_of(values).for_each_range([=](std::size_t part, std::size_t begin, std::size_t end) {
    sums[part] += weighted_squares(x, w, begin, end);
  });
  const double sum = std::accumulate(sums, sums + parts, 0.0);
  return std::sqrt(sum / static_cast<double>(N_VGetLength(values)));
}

/// Makes a serial vector one of a system. Null: out of memory, the vector is gone.
N_Vector of_system(N_Vector v, const ArkSystem* system);

N_Vector clone(N_Vector v) {
  return of_system(N_VClone_Serial(v), &system_of(v));
}
N_Vector clone_empty(N_Vector v) {
  return of_system(N_VCloneEmpty_Serial(v), &system_of(v));
}

N_Vector of_system(N_Vector v, const ArkSystem* system) {
  if (v == nullptr) return nullptr;
  void* content = std::realloc(v->content, sizeof(Content));
  if (content == nullptr) {
    N_VDestroy_Serial(v);
    return nullptr;
  }
  v->content = content;
  static_cast<Content*>(content)->system = system;
  // Integrals lie behind the length that SUNDIALS knows, which norms and products go by.
  if (double*& data = static_cast<Content*>(content)->serial.data;
      data != nullptr && system->integrals() > 0) {
    void* longer = std::realloc(data, (system->size() + system->integrals()) * sizeof(double));
    if (longer == nullptr) {
      N_VDestroy_Serial(v);
      return nullptr;
    }
    data = static_cast<double*>(longer);
  }
  v->ops->nvclone = clone;
  v->ops->nvcloneempty = clone_empty;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvscale = scale;
  v->ops->nvconst = fill;
  v->ops->nvlinearcombination = linear_combination;
  v->ops->nvwrmsnorm = weighted_norm;
  return v;
}

}  // namespace

StateVector make_state_vector(const ArkSystem& system, const Context& context) {
  N_Vector serial = N_VNew_Serial(static_cast<sunindextype>(system.size()), context.get());
  StateVector vector(allocated(of_system(serial, &system)));
  if (sums_of_parts.size() < system.parts()) sums_of_parts.resize(system.parts());
  N_VConst(0.0, vector.get());
  return vector;
}

}  // namespace vitrum::sundials
