#include "integrators/sundials/butcher_table.hpp"

#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <algorithm>
#include <array>
#include <complex>
#include <stdexcept>

#include "integrators/sundials/owned.hpp"

namespace vitrum::sundials {
namespace {

using Loaded = Owned<ARKodeButcherTable, ARKodeButcherTable_Free>;

// Asking SUNDIALS for a name that it does not know prints to the terminal; so the names are kept here.
constexpr std::array explicit_names{
    "ARKODE_HEUN_EULER_2_1_2",     "ARKODE_BOGACKI_SHAMPINE_4_2_3", "ARKODE_ARK324L2SA_ERK_4_2_3",
    "ARKODE_ZONNEVELD_5_3_4",      "ARKODE_ARK436L2SA_ERK_6_3_4",   "ARKODE_SAYFY_ABURUB_6_3_4",
    "ARKODE_CASH_KARP_6_4_5",      "ARKODE_FEHLBERG_6_4_5",         "ARKODE_DORMAND_PRINCE_7_4_5",
    "ARKODE_ARK548L2SA_ERK_8_4_5", "ARKODE_VERNER_8_5_6",           "ARKODE_FEHLBERG_13_7_8",
    "ARKODE_KNOTH_WOLKE_3_3",      "ARKODE_ARK437L2SA_ERK_7_3_4",   "ARKODE_ARK548L2SAb_ERK_8_4_5",
};
constexpr std::array implicit_names{
    "ARKODE_SDIRK_2_1_2",
    "ARKODE_BILLINGTON_3_3_2",
    "ARKODE_TRBDF2_3_3_2",
    "ARKODE_KVAERNO_4_2_3",
    "ARKODE_ARK324L2SA_DIRK_4_2_3",
    "ARKODE_CASH_5_2_4",
    "ARKODE_CASH_5_3_4",
    "ARKODE_SDIRK_5_3_4",
    "ARKODE_KVAERNO_5_3_4",
    "ARKODE_ARK436L2SA_DIRK_6_3_4",
    "ARKODE_KVAERNO_7_4_5",
    "ARKODE_ARK548L2SA_DIRK_8_4_5",
    "ARKODE_ARK437L2SA_DIRK_7_3_4",
    "ARKODE_ARK548L2SAb_DIRK_8_4_5",
    "ARKODE_ESDIRK324L2SA_4_2_3",
    "ARKODE_ESDIRK325L2SA_5_2_3",
    "ARKODE_ESDIRK32I5L2SA_5_2_3",
    "ARKODE_ESDIRK436L2SA_6_3_4",
    "ARKODE_ESDIRK43I6L2SA_6_3_4",
    "ARKODE_QESDIRK436L2SA_6_3_4",
    "ARKODE_ESDIRK437L2SA_7_3_4",
    "ARKODE_ESDIRK547L2SA_7_4_5",
    "ARKODE_ESDIRK547L2SA2_7_4_5",
};

}  // namespace

std::vector<std::string> table_names(TableKind kind) {
  return kind == TableKind::explicit_stages
             ? std::vector<std::string>(explicit_names.begin(), explicit_names.end())
             : std::vector<std::string>(implicit_names.begin(), implicit_names.end());
}

std::optional<ButcherTable> find_table(TableKind kind, std::string_view name) {
  const std::vector<std::string> known = table_names(kind);
  const auto entry = std::find(known.begin(), known.end(), name);
  if (entry == known.end()) return std::nullopt;
  const Loaded loaded(kind == TableKind::explicit_stages ? ARKodeButcherTable_LoadERKByName(entry->c_str())
                                                         : ARKodeButcherTable_LoadDIRKByName(entry->c_str()));
  if (!loaded) throw std::runtime_error("SUNDIALS could not load the table " + *entry);
  ButcherTable table{*entry, kind, loaded->q, loaded->p, loaded->stages, {}, {}};
  const auto s = static_cast<std::size_t>(table.stages);
  for (std::size_t i = 0; i < s; ++i) table.a.insert(table.a.end(), loaded->A[i], loaded->A[i] + s);
  table.b.assign(loaded->b, loaded->b + s);
  return table;
}

std::string table_of_order(TableKind kind, int order) {
  // Explicit: the classical pairs. Implicit: stiffly accurate and L-stable, so that what is stiffer than the
  // step follows the slow motion.
  constexpr std::array explicit_tables{"ARKODE_HEUN_EULER_2_1_2", "ARKODE_BOGACKI_SHAMPINE_4_2_3",
                                       "ARKODE_ZONNEVELD_5_3_4", "ARKODE_DORMAND_PRINCE_7_4_5"};
  constexpr std::array implicit_tables{"ARKODE_TRBDF2_3_3_2", "ARKODE_ESDIRK324L2SA_4_2_3",
                                       "ARKODE_ESDIRK436L2SA_6_3_4", "ARKODE_ESDIRK547L2SA2_7_4_5"};
  const auto k = static_cast<std::size_t>(std::clamp(order, 2, 5) - 2);
  return kind == TableKind::explicit_stages ? explicit_tables[k] : implicit_tables[k];
}

bool ButcherTable::ends_in_solution() const {
  return std::equal(b.begin(), b.end(), a.end() - stages);
}

double ButcherTable::growth(double phase) const {
  // R(z) = 1 + z sum b_i k_i with k_i = 1 + z sum a_ij k_j.
  const std::complex<double> z(0.0, phase);
  const auto s = static_cast<std::size_t>(stages);
  std::vector<std::complex<double>> k(s);
  std::complex<double> result = 1.0;
  for (std::size_t i = 0; i < s; ++i) {
    k[i] = 1.0;
    for (std::size_t j = 0; j < i; ++j) k[i] += z * a[i * s + j] * k[j];
    result += z * b[i] * k[i];
  }
  return std::abs(result);
}

double ButcherTable::oscillation_limit() const {
  constexpr double most = 1.0 + 1e-3, step = 1e-3;
  double y = 0.0;
  while (growth(y + step) <= most) y += step;
  return y;
}

}  // namespace vitrum::sundials
