#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace vitrum {

/// State by name: what a checkpoint keeps of everything but particles. Names read "part.quantity"; each may
/// be entered once (std::logic_error). What is asked for and missing, or of another size, is a FileError.
class Archive {
 public:
  void put(const std::string& name, double value) { put(name, std::vector<double>{value}); }
  void put(const std::string& name, std::vector<double> values);
  void put_text(const std::string& name, std::string text);

  bool has(const std::string& name) const { return numbers_.contains(name); }
  double number(const std::string& name) const { return numbers(name, 1).front(); }
  /// A number that counts something; below 2^53 a double holds it exactly.
  std::int64_t count(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name, std::size_t size) const;
  const std::string& text(const std::string& name) const;

  /// For who stores or compares all of it.
  const std::map<std::string, std::vector<double>>& all_numbers() const { return numbers_; }
  const std::map<std::string, std::string>& all_texts() const { return texts_; }

 private:
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::string> texts_;
};

}  // namespace vitrum
