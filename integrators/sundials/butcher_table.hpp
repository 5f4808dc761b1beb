#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vitrum::sundials {

enum class TableKind { explicit_stages, diagonally_implicit };

/// The coefficients of a Runge-Kutta method that SUNDIALS ships, by name.
struct ButcherTable {
  std::string name;  ///< as SUNDIALS spells it
  TableKind kind;
  int order, embedding;  ///< of the solution and of the error estimate's; 0: the table has no embedding
  int stages;
  std::vector<double> a;  ///< stages x stages, by rows
  std::vector<double> b;

  /// Whether the last stage is the solution, so that its rate is that of the next step's start.
  bool ends_in_solution() const;
  /// |R(iy)|: growth per step of an undamped oscillation with phase y = frequency x step (explicit tables).
  double growth(double phase) const;
  /// The largest y up to which |R(iy)| <= 1 + 1e-3 (explicit tables): what a mode may gain in a step; tables
  /// of orders 2 and 5 gain a little at any y.
  double oscillation_limit() const;
};

/// Null when SUNDIALS has no such table of this kind.
std::optional<ButcherTable> find_table(TableKind kind, std::string_view name);
/// The tables of a kind, as SUNDIALS spells them.
std::vector<std::string> table_names(TableKind kind);
/// The table that an order stands for, 2 to 5.
std::string table_of_order(TableKind kind, int order);

}  // namespace vitrum::sundials
