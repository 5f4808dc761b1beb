#pragma once
#include <toml++/toml.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vitrum::scene {

/// Collects the faults of one input, and what is possible but implausible in it, so that a user sees all of
/// them at once, and knows where each value came from.
///
/// A message reads `FILE:LINE:COLUMN: key 'a.b': FACT`, or `--set N: key 'a.b': FACT` for values given on the
/// command line (N counts the --set arguments from 1).
class Diagnostics {
 public:
  explicit Diagnostics(std::string file) : file_(std::move(file)) {}

  /// From now on everything at and below `path` comes from --set number `number`; 0: forget what was noted
  /// there.
  void note_override(const std::string& path, std::size_t number);

  /// A key, and where the file has it.
  struct Origin {
    std::string key;
    toml::source_position where;
  };
  /// What stands at and below `path` is not in the input: it comes from `origin`, a preset's name.
  void note_origin(const std::string& path, const Origin& origin) { origins_[path] = origin; }

  /// Item `index` of the list at `path` is no more: the ones behind it have moved up.
  void note_removal(const std::string& path, std::size_t index);

  /// Where the value or table at `origin` comes from: `FILE:LINE:COLUMN`, `where` when it is the file; or
  /// `--set N`.
  std::string place(std::string_view origin, const toml::source_position& where) const;

  /// Adds a fault of `key`. The position is that of the value or table at `origin`, `where` when it comes
  /// from the file.
  void add(const std::string& origin, const toml::source_position& where, std::string_view key,
           std::string_view fact);
  /// Adds a fault of --set number `number` itself; `key` may be empty.
  void add_override(std::size_t number, std::string_view key, std::string_view fact);
  /// Adds a warning of `key`, placed as a fault is: the input is read all the same.
  void warn(const std::string& origin, const toml::source_position& where, std::string_view key,
            std::string_view fact);

  /// Whether the value at `path` comes from a --set.
  bool overridden(std::string_view path) const { return override_at(path) != 0; }
  /// Whether there are no faults so far.
  bool empty() const { return faults_.empty(); }
  /// Whether no fault of the key at `path`, nor of one below it, has been added.
  bool sound(std::string_view path) const;

  /// Throws InputError with all faults in the order of the file, then of the command line; returns when there
  /// are none.
  void throw_if_any() const;
  /// All warnings in the same order.
  std::vector<std::string> warnings() const;

 private:
  struct Message {
    std::size_t override_number;
    toml::source_position where;
    std::string key, text;
  };

  Message message(const std::string& origin, const toml::source_position& where, std::string_view key,
                  std::string_view fact) const;
  static std::vector<std::string> in_order(std::vector<Message> messages);
  std::size_t override_at(std::string_view path) const;
  Origin origin_of(std::string_view path, const toml::source_position& where) const;

  std::string file_;
  std::map<std::string, std::size_t, std::less<>> overrides_;
  std::map<std::string, Origin, std::less<>> origins_;
  std::vector<Message> faults_, warnings_;
};

}  // namespace vitrum::scene
