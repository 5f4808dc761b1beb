#include "integrators/sundials/state_vector.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "parallel/thread_team.hpp"
#include "support/random_states.hpp"

using namespace vitrum::sundials;
using vitrum::parallel::ThreadTeam;
using vitrum::test::Random;

namespace {

/// Unknowns in parts of two ranges each, one in either half, on a team of threads.
class Parted final : public ArkSystem {
 public:
  Parted(std::size_t half, std::size_t longest, ThreadTeam& team)
      : half_(half), longest_(longest), team_(team) {}

  std::size_t size() const override { return 2 * half_; }
  bool rates(double, const double*, double*) override { return false; }
  void error_weights(double*) const override {}
  std::size_t parts() const override { return (half_ + longest_ - 1) / longest_; }
  void for_ranges(RangeTask task, void* context) const override {
    team_.for_each_chunk(parts(), [&](std::size_t k) {
      const std::size_t begin = k * longest_, end = std::min(half_, begin + longest_);
      task(context, k, begin, end);
      task(context, k, half_ + begin, half_ + end);
    });
  }

 private:
  std::size_t half_, longest_;
  ThreadTeam& team_;
};

double* values(const StateVector& v) {
  return N_VGetArrayPointer(v.get());
}

StateVector random_vector(const ArkSystem& system, const Context& context, Random& random) {
  StateVector v = make_state_vector(system, context);
  for (std::size_t i = 0; i < system.size(); ++i) values(v)[i] = random.uniform(-1.0, 1.0);
  return v;
}

}  // namespace

TEST_CASE("Linear combinations of any length, also onto their first term, and weighted norms",
          "[integrators][sundials]") {
  const Context context;
  Random random(41);
  ThreadTeam team(3);
  for (const std::size_t half : {1U, 7U, 8U, 100U})
    for (int count = 1; count <= 20; ++count) {
      const Parted system(half, 9, team);
      const std::size_t size = system.size();
      std::vector<StateVector> terms;
      std::vector<N_Vector> handles;
      std::vector<double> factors, expected(size, 0.0);
      for (int k = 0; k < count; ++k) {
        terms.push_back(random_vector(system, context, random));
        handles.push_back(terms.back().get());
        factors.push_back(random.uniform(-1.0, 1.0));
        for (std::size_t i = 0; i < size; ++i) expected[i] += factors.back() * values(terms.back())[i];
      }
      double sum = 0.0;
      const double *x = values(terms.front()), *w = values(terms.back());
      for (std::size_t i = 0; i < size; ++i) sum += std::pow(x[i] * w[i], 2);
      CAPTURE(size, count);
      CHECK(N_VWrmsNorm(handles.front(), handles.back()) ==
            Approx(std::sqrt(sum / static_cast<double>(size))).epsilon(1e-13));
      const StateVector apart(N_VClone(handles.front()));
      N_VLinearCombination(count, factors.data(), handles.data(), apart.get());
      N_VLinearCombination(count, factors.data(), handles.data(), handles.front());
      for (std::size_t i = 0; i < size; ++i) {
        CHECK(values(apart)[i] == Approx(expected[i]).margin(1e-13));
        CHECK(values(terms.front())[i] == values(apart)[i]);
      }
    }
}

TEST_CASE("Sums of two, copies and fillings reach every unknown, onto an operand too, also in clones",
          "[integrators][sundials]") {
  const Context context;
  Random random(42);
  ThreadTeam team(2);
  const Parted system(150, 16, team);
  const StateVector x = random_vector(system, context, random), y = random_vector(system, context, random),
                    z(N_VClone(x.get())), onto(N_VClone(z.get()));
  N_VLinearSum(2.0, x.get(), -3.0, y.get(), z.get());
  N_VScale(1.0, x.get(), onto.get());
  for (std::size_t i = 0; i < system.size(); ++i) {
    CHECK(values(z)[i] == Approx(2.0 * values(x)[i] - 3.0 * values(y)[i]).margin(1e-15));
    CHECK(values(onto)[i] == values(x)[i]);
  }
  N_VLinearSum(2.0, onto.get(), -3.0, y.get(), onto.get());
  for (std::size_t i = 0; i < system.size(); ++i) CHECK(values(onto)[i] == values(z)[i]);
  N_VScale(-0.5, z.get(), z.get());
  N_VConst(7.0, x.get());
  for (std::size_t i = 0; i < system.size(); ++i) {
    CHECK(values(z)[i] == -0.5 * values(onto)[i]);
    CHECK(values(x)[i] == 7.0);
  }
  // A clone without memory of its own takes that of another one.
  const StateVector empty(N_VCloneEmpty(x.get()));
  N_VSetArrayPointer(values(y), empty.get());
  N_VConst(1.0, empty.get());
  CHECK(N_VWrmsNorm(x.get(), empty.get()) == 7.0);
  CHECK(values(y)[299] == 1.0);
}

TEST_CASE("Norms are the same to the bit for any number of threads", "[integrators][sundials][threads]") {
  const Context context;
  std::vector<double> norms;
  for (const int threads : {1, 2, 3, 5}) {
    Random random(43);
    ThreadTeam team(threads);
    const Parted system(10007, 64, team);
    const StateVector x = random_vector(system, context, random), w = random_vector(system, context, random);
    for (int repeated = 0; repeated < 20; ++repeated) norms.push_back(N_VWrmsNorm(x.get(), w.get()));
  }
  for (const double norm : norms) CHECK(norm == norms.front());
}
