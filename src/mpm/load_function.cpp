#include "mpm/load_function.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum::mpm {
namespace {

/// Gauss' rule of three points.
double gauss(const LoadFunction& load, double from, double to) {
  const double half = 0.5 * (to - from), middle = 0.5 * (from + to), out = std::sqrt(0.6) * half;
  return half / 9.0 * (5.0 * (load.at(middle - out) + load.at(middle + out)) + 8.0 * load.at(middle));
}

/// Halves intervals until both halves agree with the whole; a jump is cornered within 2^-40 of the interval.
double halved(const LoadFunction& load, double from, double to, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (from + to), left = gauss(load, from, middle), right = gauss(load, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= tolerance) return left + right;
  return halved(load, from, middle, left, tolerance, depth - 1) +
         halved(load, middle, to, right, tolerance, depth - 1);
}

}  // namespace

double integral(const LoadFunction& load, double from, double to) {
  double sum = 0.0;
  while (from < to) {
    const double end = std::min(to, load.next_kink(from));
    const double whole = gauss(load, from, end);
    const double size =
        std::max({std::abs(load.at(from)), std::abs(load.at(end)), std::abs(load.at(0.5 * (from + end)))});
    sum += halved(load, from, end, whole, 1e-13 * size * (end - from), 40);
    from = end;
  }
  return sum;
}

}  // namespace vitrum::mpm
