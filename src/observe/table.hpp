#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "observe/archive.hpp"

namespace vitrum {

/// When rows are due: at the first step that ends at or after a multiple of an interval, counted from an
/// origin; without an interval at every output. So rows never change the steps of a run.
class Cadence {
 public:
  /// At every output.
  Cadence() = default;
  /// The first multiple at or after `start`; all s.
  Cadence(double origin, double interval, double start);

  bool at_outputs() const { return !interval_; }
  /// Whether a row is due at `time`.
  bool is_due(double time) const { return interval_ && time >= next(); }
  /// Goes on to the first multiple after `time`.
  void pass(double time);

  /// Multiples gone so far: all that it remembers.
  std::int64_t count() const { return count_; }
  void restore(std::int64_t count) { count_ = count; }

 private:
  double next() const;

  double origin_ = 0.0;
  std::optional<double> interval_;
  double first_ = 0.0;  ///< number of the first multiple
  std::int64_t count_ = 0;
};

/// A column of a table. Where there is no unit it holds texts.
struct Column {
  std::string_view name, unit, description;
  bool of_whole = false;  ///< of the whole body in axisymmetric scenes, per metre in plane strain
};

/// What is known of a table before there is a run.
struct TableInfo {
  std::string_view name, description;
  std::span<const Column> columns;
};

/// The first line of its file.
std::string header(const TableInfo& kind);

/// A table of a run: rows on their way to NAME.csv. Numbers round-trip; what is not there is an empty cell.
class Table {
 public:
  explicit Table(const TableInfo& kind, const Cadence& when = {}) : cadence(when), kind_(kind) {}

  const TableInfo& kind() const { return kind_; }
  std::string name() const { return std::string(kind_.name); }

  template <class... Cells>
  void row(const Cells&... cells) {
    bool first = true;
    (append(cells, std::exchange(first, false)), ...);
    waiting_ += '\n';
  }
  /// Rows that have not reached the file, and when they have.
  const std::string& waiting() const { return waiting_; }
  bool is_due() const { return waiting_.size() > patience; }
  void written() { waiting_.clear(); }

  void save(Archive& archive) const;
  void restore(const Archive& archive);

  Cadence cadence;
  std::size_t patience = 0;     ///< bytes of rows that may wait for the file
  bool needs_particles = true;  ///< its rows look at particles, which must stand where the time is

 private:
  template <class Cell>
  void append(const Cell& cell, bool first) {
    if (!first) waiting_ += ',';
    if constexpr (std::is_convertible_v<Cell, std::string_view>)
      append_text(cell);
    else if constexpr (std::is_arithmetic_v<Cell>)
      fmt::format_to(std::back_inserter(waiting_), "{}", cell);
    else if (cell)
      fmt::format_to(std::back_inserter(waiting_), "{}", *cell);
  }
  /// Quoted where it holds what separates cells (RFC 4180).
  void append_text(std::string_view text);

  TableInfo kind_;
  std::string waiting_;
};

}  // namespace vitrum
