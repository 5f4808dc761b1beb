#include "app/table_files.hpp"

#include <algorithm>

#include "output/table_store.hpp"

namespace vitrum::app {

void TableFiles::create() {
  for (const Table* table : tables_)
    files_.push_back(output::CsvFile::create(directory_ / (table->name() + ".csv"), header(table->kind())));
}

void TableFiles::reopen(const Archive& archive) {
  for (const Table* table : tables_)
    files_.push_back(
        output::CsvFile::reopen(directory_ / (table->name() + ".csv"), header(table->kind()),
                                static_cast<std::uint64_t>(archive.count(table->name() + ".bytes"))));
}

void TableFiles::write_due() {
  if (std::ranges::any_of(tables_, &Table::is_due)) write_all();
}

void TableFiles::write_all() {
  for (std::size_t k = 0; k < tables_.size(); ++k) {
    if (tables_[k]->waiting().empty()) continue;
    files_[k].append(tables_[k]->waiting());
    tables_[k]->written();
  }
}

void TableFiles::store() const {
  std::vector<TableInfo> kinds;
  for (const Table* table : tables_) kinds.push_back(table->kind());
  output::store_tables(directory_, kinds, per_metre_);
}

void TableFiles::save(Archive& archive) const {
  for (std::size_t k = 0; k < tables_.size(); ++k)
    archive.put(tables_[k]->name() + ".bytes", static_cast<double>(files_[k].size()));
}

}  // namespace vitrum::app
