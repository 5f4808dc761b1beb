#pragma once
#include <string_view>

#include "integrators/local/cvode_family.hpp"
#include "schema/table.hpp"

namespace vitrum {

enum class LocalMethod { closed_form, substep, cvode };

/// The scene table [constitutive] as read.
struct ConstitutiveDefinition {
  LocalMethod method = LocalMethod::closed_form;
  double rtol = 1.0e-6;
  double atol = 1.0e-9;
  CvodeFamily solver = CvodeFamily::bdf;
};

/// What the table may hold.
const schema::Table& constitutive_table();
/// As scenes call it.
std::string_view name_of(LocalMethod method);

}  // namespace vitrum
