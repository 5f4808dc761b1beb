#include "integrators/sundials/state_vector.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/random_states.hpp"

using namespace vitrum::sundials;
using vitrum::test::Random;

TEST_CASE("Linear combinations of any length, also onto their first term, and weighted norms",
          "[integrators][sundials]") {
  const Context context;
  Random random(41);
  for (const std::size_t size : {1U, 7U, 8U, 100U})
    for (int count = 1; count <= 20; ++count) {
      std::vector<StateVector> terms;
      std::vector<N_Vector> handles;
      std::vector<double> factors, expected(size, 0.0);
      for (int k = 0; k < count; ++k) {
        terms.push_back(make_state_vector(size, context));
        handles.push_back(terms.back().get());
        factors.push_back(random.uniform(-1.0, 1.0));
        double* x = N_VGetArrayPointer(handles.back());
        for (std::size_t i = 0; i < size; ++i)
          x[i] = random.uniform(-1.0, 1.0), expected[i] += factors.back() * x[i];
      }
      double sum = 0.0;
      const double *x = N_VGetArrayPointer(handles.front()), *w = N_VGetArrayPointer(handles.back());
      for (std::size_t i = 0; i < size; ++i) sum += std::pow(x[i] * w[i], 2);
      CAPTURE(size, count);
      CHECK(N_VWrmsNorm(handles.front(), handles.back()) ==
            Approx(std::sqrt(sum / static_cast<double>(size))).epsilon(1e-13));
      const StateVector apart(N_VClone(handles.front()));
      N_VLinearCombination(count, factors.data(), handles.data(), apart.get());
      N_VLinearCombination(count, factors.data(), handles.data(), handles.front());
      for (std::size_t i = 0; i < size; ++i) {
        CHECK(N_VGetArrayPointer(apart.get())[i] == Approx(expected[i]).margin(1e-13));
        CHECK(N_VGetArrayPointer(handles.front())[i] == N_VGetArrayPointer(apart.get())[i]);
      }
    }
}
