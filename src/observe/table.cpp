#include "observe/table.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum {
namespace {

/// Times closer than this part of an interval are one: what rounding makes of the same time.
constexpr double slack = 1e-9;

}  // namespace

Cadence::Cadence(double origin, double interval, double start)
    : origin_(origin), interval_(interval), first_(std::ceil((start - origin) / interval - slack)) {}

double Cadence::next() const {
  return origin_ + (first_ + static_cast<double>(count_) - slack) * *interval_;
}

void Cadence::pass(double time) {
  if (!interval_) return;
  const double gone = std::floor((time - origin_) / *interval_ + slack) - first_ + 1.0;
  count_ = std::max(count_, static_cast<std::int64_t>(gone));
  while (is_due(time)) ++count_;
}

std::string header(const TableInfo& kind) {
  std::string line;
  for (const Column& column : kind.columns) line += (line.empty() ? "" : ",") + std::string(column.name);
  return line;
}

void Table::save(Archive& archive) const {
  archive.put(name() + ".rows_gone", static_cast<double>(cadence.count()));
  archive.put_text(name() + ".waiting", waiting_);
}

void Table::restore(const Archive& archive) {
  cadence.restore(archive.count(name() + ".rows_gone"));
  waiting_ = archive.text(name() + ".waiting");
}

void Table::append_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    waiting_ += text;
    return;
  }
  waiting_ += '"';
  for (const char c : text) waiting_.append(c == '"' ? 2 : 1, c);
  waiting_ += '"';
}

}  // namespace vitrum
