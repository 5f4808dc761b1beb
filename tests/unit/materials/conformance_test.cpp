// What must hold of every law behind the door, whoever wrote it: what it stores, in any frame.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "catch.hpp"
#include "support/law_samples.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// One particle of 1 m^3 in columns.
class Particle {
 public:
  explicit Particle(const LawSample& law)
      : material_(*law.material), variables_(material_.columns().size()), mass_(material_.density()) {
    const PointState start = law.start();
    for (std::size_t k = 0; k < variables_.size(); ++k) variables_[k] = value_of(material_, start, k);
  }

  void advance(const SymmetricTensor& strain, double spin, double duration, BatchReport& report) {
    ParticleColumns c;
    for (std::size_t k = 0; k < 4; ++k)
      c.start_strain[k] = c.elastic_strain[k] = &strain_[k], c.stress[k] = &stress_[k];
    for (double& v : variables_) c.start_variables.push_back(&v), c.variables.push_back(&v);
    c.strain_increment = {&strain.rr, &strain.zz, &strain.tt, &strain.rz};
    c.spin_increment = &spin, c.mass = &mass_;
    material_.advance(c, 0, 1, duration, nullptr, report);
  }
  SymmetricTensor stress() const { return {stress_[0], stress_[1], stress_[2], stress_[3]}; }
  const std::vector<double>& variables() const { return variables_; }
  bool same_bits(const Particle& o) const {
    return std::memcmp(strain_, o.strain_, sizeof strain_) == 0 &&
           std::memcmp(stress_, o.stress_, sizeof stress_) == 0 &&
           (variables_.empty() ||
            std::memcmp(variables_.data(), o.variables_.data(), variables_.size() * sizeof(double)) == 0);
  }
  void reload(const Particle& stored) {
    std::copy(std::begin(stored.strain_), std::end(stored.strain_), strain_);
    variables_ = stored.variables_;
  }

 private:
  const Material& material_;
  double strain_[4] = {}, stress_[4] = {};
  std::vector<double> variables_;
  double mass_;
};

/// Increments of a wandering path, and how long each takes.
struct Wandering {
  std::vector<SymmetricTensor> increments;
  double duration;
};
Wandering wandering(Random& random, const LawSample& law, int pieces, int steps) {
  Wandering path{{}, law.strain / (law.rate * steps)};
  for (int piece = 0; piece < pieces; ++piece) {
    const SymmetricTensor increment = (law.strain * random.uniform(0.3, 1.0) / steps) * random.direction();
    path.increments.insert(path.increments.end(), static_cast<std::size_t>(steps), increment);
  }
  return path;
}

/// Variables as one turned or mirrored by the rules of their kinds.
std::vector<double> turned(const Material& material, const std::vector<double>& values, const Rotation& by) {
  std::vector<double> result = values;
  std::size_t k = 0;
  for (const Variable& v : material.variables()) {
    if (v.kind == Kind::vector) {
      const PlaneVector a = rotate(PlaneVector{values[k], values[k + 1]}, by);
      result[k] = a.r, result[k + 1] = a.z;
    } else if (v.kind == Kind::symmetric) {
      const SymmetricTensor a =
          rotate(SymmetricTensor{values[k], values[k + 1], values[k + 2], values[k + 3]}, by);
      result[k] = a.rr, result[k + 1] = a.zz, result[k + 2] = a.tt, result[k + 3] = a.rz;
    }
    k += component_count(v.kind);
  }
  return result;
}

void require_same_variables(const Material& material, const std::vector<double>& found,
                            const std::vector<double>& expected) {
  for (std::size_t k = 0; k < found.size(); ++k) {
    CAPTURE(material.columns()[k].name);
    REQUIRE(found[k] ==
            Approx(expected[k]).epsilon(1e-8).margin(1e-9 * std::abs(material.columns()[k].scale)));
  }
}

}  // namespace

TEST_CASE("every registered law has a sample", "[material][conformance]") {
  for (const RegisteredLaw& law : registered_laws()) {
    INFO("tests/support/law_samples.hpp lacks parameters of '" << law.table << "'");
    CHECK(registered_samples().contains(law.table));
  }
}

TEST_CASE("a law starts within its bounds, at the stress that it is given", "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    const Material& material = *law.material;
    for (const Component& c : material.columns()) CHECK(c.bounds.contain(c.initial));
    const SymmetricTensor stress = 1e-2 * law.strain * material.density() * material.wave_speed() *
                                   material.wave_speed() * SymmetricTensor{-1.0, -0.8, -0.9, 0.1};
    const PointState s = material.start(stress);
    CHECK(norm(material.stress(s) - stress) <= 1e-9 * norm(stress));
    const PointState free = material.start({});
    for (std::size_t k = 0; k < material.columns().size(); ++k) {
      CHECK(value_of(material, free, k) == material.columns()[k].initial);
      CHECK(material.columns()[k].bounds.contain(value_of(material, s, k)));
    }
    CHECK(material.strain_scale() > 0.0);
  }
}

TEST_CASE("a law is objective: what it stores turns with the particle", "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    if (!law.turns) continue;
    CAPTURE(law.name);
    Random random(211);
    Particle still(law), turning(law);
    BatchReport a, b;
    double angle = 0.0;
    const Wandering path = wandering(random, law, 8, 10);
    for (const SymmetricTensor& increment : path.increments) {
      const double spin = random.uniform(-0.5, 0.5);
      still.advance(increment, 0.0, path.duration, a);
      turning.advance(rotate(increment, rotation_by(angle)), spin, path.duration, b);
      angle += spin;
      const Rotation now = rotation_by(angle);
      REQUIRE(norm(rotate(still.stress(), now) - turning.stress()) <= 1e-8 * (norm(still.stress()) + 1e3));
      require_same_variables(*law.material, turning.variables(),
                             turned(*law.material, still.variables(), now));
    }
    CHECK(a.elastic == Approx(b.elastic).epsilon(1e-8));
    CHECK(a.dissipated.total() == Approx(b.dissipated.total()).epsilon(1e-8));
  }
}

TEST_CASE("a mirror changes the signs that kinds and parities tell", "[material][conformance]") {
  for (const LawSample& law : law_samples()) {
    CAPTURE(law.name);
    Random random(212);
    Particle here(law), image(law);
    BatchReport report;
    const Wandering path = wandering(random, law, 8, 10);
    for (const SymmetricTensor& increment : path.increments) {
      SymmetricTensor mirrored = increment;
      mirrored.rz = -mirrored.rz;
      const double spin = random.uniform(-0.1, 0.1);
      here.advance(increment, spin, path.duration, report);
      image.advance(mirrored, -spin, path.duration, report);
      SymmetricTensor stress = here.stress();
      stress.rz = -stress.rz;
      REQUIRE(norm(stress - image.stress()) <= 1e-8 * (norm(stress) + 1e3));
      std::vector<double> expected = here.variables();
      for (std::size_t k = 0; k < expected.size(); ++k)
        if (law.material->columns()[k].flips) expected[k] = -expected[k];
      require_same_variables(*law.material, image.variables(), expected);
    }
  }
}

TEST_CASE("a law keeps nothing but its columns: it goes on to the bit from what was stored",
          "[material][conformance]") {
  const std::vector<LawSample> laws = law_samples(), others = law_samples();
  for (std::size_t n = 0; n < laws.size(); ++n) {
    CAPTURE(laws[n].name);
    Random random(217);
    Particle all(laws[n]), later(others[n]);
    BatchReport report;
    const Wandering path = wandering(random, laws[n], 4, 10);
    for (std::size_t i = 0; i < path.increments.size(); ++i) {
      const double spin = random.uniform(-0.1, 0.1);
      if (i == path.increments.size() / 2) later.reload(all);
      all.advance(path.increments[i], spin, path.duration, report);
      if (i >= path.increments.size() / 2) {
        later.advance(path.increments[i], spin, path.duration, report);
        REQUIRE(later.same_bits(all));
      }
    }
  }
}
