#pragma once
#include <filesystem>
#include <vector>

#include "observe/table.hpp"
#include "output/csv_file.hpp"

namespace vitrum::app {

/// The files NAME.csv of a run's tables. Everything throws FileError.
class TableFiles {
 public:
  /// tables: must outlive this.
  /// per_metre: what files tell of whole bodies (plane strain).
  TableFiles(std::filesystem::path directory, std::vector<Table*> tables, bool per_metre)
      : directory_(std::move(directory)), tables_(std::move(tables)), per_metre_(per_metre) {}

  void create();
  /// Cuts the files back to where they stood when `archive` was saved.
  void reopen(const Archive& archive);
  /// Writes what waits, of all tables, once one of them holds more than it may keep; or in any case.
  void write_due();
  void write_all();
  /// Lets tables.h5 hold what the files hold.
  void store() const;
  void save(Archive& archive) const;

 private:
  std::filesystem::path directory_;
  std::vector<Table*> tables_;
  bool per_metre_;
  std::vector<output::CsvFile> files_;  ///< by table
};

}  // namespace vitrum::app
