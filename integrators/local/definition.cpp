#include "integrators/local/definition.hpp"

#include "schema/field.hpp"

namespace vitrum {
namespace {

using schema::Named;
using schema::Table;

constexpr std::array local_methods{Named{"closed-form", LocalMethod::closed_form},
                                   Named{"substep", LocalMethod::substep},
                                   Named{"cvode", LocalMethod::cvode}};
constexpr std::array cvode_families{Named{"bdf", CvodeFamily::bdf}, Named{"adams", CvodeFamily::adams}};

/// Below, the rounding of one step's sums exceeds what is asked for.
constexpr Bounds tolerance{1.0e-13, 1.0, false, true};

}  // namespace

const Table& constitutive_table() {
  using C = ConstitutiveDefinition;
  static const Table table = schema::table_of<C>(
      "[constitutive]", "The local equations. Keys of a method that is not chosen are validated and ignored.",
      {{"method", &C::method, local_methods, "return mappings, error-controlled substeps, or CVODE"},
       {"rtol", &C::rtol, "1", tolerance, "substep, cvode: relative tolerance"},
       {"atol",
        &C::atol,
        "1",
        {0.0, 1.0, true, true},
        "substep, cvode: absolute tolerance, times each state's own scale"},
       {"solver", &C::solver, cvode_families, "cvode: multistep family"}});
  return table;
}

std::string_view name_of(LocalMethod method) {
  return schema::name_of(local_methods, method);
}

}  // namespace vitrum
