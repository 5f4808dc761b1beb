#include "integrators/sundials/butcher_table.hpp"

#include <cmath>

#include "catch.hpp"

using namespace vitrum::sundials;

TEST_CASE("Every table on the list loads, and the tables that orders stand for have these orders",
          "[integrators]") {
  for (const TableKind kind : {TableKind::explicit_stages, TableKind::diagonally_implicit}) {
    for (const std::string& name : table_names(kind)) {
      CAPTURE(name);
      const auto table = find_table(kind, name);
      REQUIRE(table);
      double sum = 0.0;
      for (const double b : table->b) sum += b;
      CHECK(sum == Approx(1.0).epsilon(1e-9));  // some tables have ten digits
      CHECK(table->a.size() == table->b.size() * table->b.size());
    }
    for (int order = 2; order <= 5; ++order) {
      const auto table = find_table(kind, table_of_order(kind, order));
      REQUIRE(table);
      CHECK(table->order == order);
      CHECK(table->embedding > 0);
    }
  }
  CHECK_FALSE(find_table(TableKind::explicit_stages, "ARKODE_KVAERNO_4_2_3"));
  CHECK_FALSE(find_table(TableKind::diagonally_implicit, "nothing"));
}

TEST_CASE("The tables that implicit orders stand for end in the solution, and damp what is infinitely stiff",
          "[integrators]") {
  for (int order = 2; order <= 5; ++order) {
    const auto table =
        find_table(TableKind::diagonally_implicit, table_of_order(TableKind::diagonally_implicit, order));
    CAPTURE(table->name);
    CHECK(table->ends_in_solution());
    // All implicit stages have one diagonal entry: one factored matrix serves them all.
    const auto s = static_cast<std::size_t>(table->stages);
    for (std::size_t i = 1; i < s; ++i)
      CHECK(table->a[i * s + i] == Approx(table->a[(s - 1) * s + s - 1]).epsilon(1e-13));
  }
}

TEST_CASE("Growth and stability limit on the imaginary axis", "[integrators]") {
  const auto heun = *find_table(TableKind::explicit_stages, "ARKODE_HEUN_EULER_2_1_2"),
             bogacki = *find_table(TableKind::explicit_stages, "ARKODE_BOGACKI_SHAMPINE_4_2_3"),
             zonneveld = *find_table(TableKind::explicit_stages, "ARKODE_ZONNEVELD_5_3_4"),
             dormand = *find_table(TableKind::explicit_stages, "ARKODE_DORMAND_PRINCE_7_4_5");
  for (const double y : {0.1, 0.7, 1.5, 2.5}) {
    CHECK(heun.growth(y) == Approx(std::hypot(1.0 - y * y / 2.0, y)).epsilon(1e-14));
    CHECK(bogacki.growth(y) == Approx(std::hypot(1.0 - y * y / 2.0, y - y * y * y / 6.0)).epsilon(1e-13));
    CHECK(zonneveld.growth(y) ==
          Approx(std::hypot(1.0 - y * y / 2.0 + std::pow(y, 4) / 24.0, y - y * y * y / 6.0)).epsilon(1e-13));
  }
  CHECK(heun.oscillation_limit() == Approx(std::pow(8.0e-3, 0.25)).epsilon(0.02));
  CHECK(bogacki.oscillation_limit() == Approx(std::sqrt(3.0)).epsilon(0.01));
  CHECK(zonneveld.oscillation_limit() == Approx(std::sqrt(8.0)).epsilon(0.01));
  CHECK(bogacki.ends_in_solution());
  CHECK(dormand.ends_in_solution());
  CHECK_FALSE(heun.ends_in_solution());
  CHECK_FALSE(zonneveld.ends_in_solution());
}
