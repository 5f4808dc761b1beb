#include "scene/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <tuple>

#include "scene/input_error.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

bool is_at_or_below(std::string_view path, std::string_view ancestor) {
  return path.starts_with(ancestor) && (path.size() == ancestor.size() || path[ancestor.size()] == '.');
}

/// Of what has been noted, the entry of `path` or of its nearest ancestor: the latest word on it.
template <class Notes>
auto nearest(const Notes& notes, std::string_view path) {
  auto found = notes.end();
  for (auto entry = notes.begin(); entry != notes.end(); ++entry)
    if (is_at_or_below(path, entry->first) &&
        (found == notes.end() || entry->first.size() >= found->first.size()))
      found = entry;
  return found;
}

std::string sentence(std::string_view key, std::string_view fact) {
  return single_line(key.empty() ? std::string(fact) : fmt::format("key '{}': {}", key, fact));
}

}  // namespace

void Diagnostics::note_override(const std::string& path, std::size_t number) {
  std::erase_if(overrides_, [&](const auto& entry) { return is_at_or_below(entry.first, path); });
  if (number != 0) overrides_[path] = number;
}

void Diagnostics::note_removal(const std::string& path, std::size_t index) {
  std::map<std::string, std::size_t, std::less<>> moved;
  const std::string prefix = path + '.';
  for (const auto& [key, number] : overrides_) {
    std::string_view rest = key;
    std::size_t item = 0;
    const char* end = key.data() + key.size();
    if (rest.starts_with(prefix)) {
      const auto [behind, error] = std::from_chars(key.data() + prefix.size(), end, item);
      if (error == std::errc{} && item == index) continue;
      if (error == std::errc{} && item > index) {
        moved[fmt::format("{}{}{}", prefix, item - 1, std::string_view(behind, end))] = number;
        continue;
      }
    }
    moved[key] = number;
  }
  overrides_ = std::move(moved);
}

std::size_t Diagnostics::override_at(std::string_view path) const {
  const auto noted = nearest(overrides_, path);
  return noted != overrides_.end() ? noted->second : 0;
}

/// The key that stands in the input for what is at `path`.
Diagnostics::Origin Diagnostics::origin_of(std::string_view path, const toml::source_position& where) const {
  const auto preset = nearest(origins_, path);
  const auto given = nearest(overrides_, path);
  const bool overridden =
      preset != origins_.end() && given != overrides_.end() && given->first.size() >= preset->first.size();
  return preset == origins_.end() || overridden ? Origin{std::string(path), where} : preset->second;
}

std::string Diagnostics::place(std::string_view path, const toml::source_position& where) const {
  const Origin origin = origin_of(path, where);
  const std::size_t number = override_at(origin.key);
  return number != 0 ? fmt::format("--set {}", number)
                     : fmt::format("{}:{}:{}", file_, origin.where.line, origin.where.column);
}

Diagnostics::Message Diagnostics::message(const std::string& origin, const toml::source_position& where,
                                          std::string_view key, std::string_view fact) const {
  const Origin named = origin_of(origin, where);
  const std::size_t number = override_at(named.key);
  return {number, number != 0 ? toml::source_position{} : named.where, std::string(key),
          fmt::format("{}: {}", place(origin, where), sentence(key, fact))};
}

void Diagnostics::add(const std::string& origin, const toml::source_position& where, std::string_view key,
                      std::string_view fact) {
  faults_.push_back(message(origin, where, key, fact));
}

void Diagnostics::add_override(std::size_t number, std::string_view key, std::string_view fact) {
  faults_.push_back({number, {}, std::string(key), fmt::format("--set {}: {}", number, sentence(key, fact))});
}

void Diagnostics::warn(const std::string& origin, const toml::source_position& where, std::string_view key,
                       std::string_view fact) {
  warnings_.push_back(message(origin, where, key, fact));
}

bool Diagnostics::sound(std::string_view path) const {
  return std::ranges::none_of(faults_, [&](const Message& m) { return is_at_or_below(m.key, path); });
}

void Diagnostics::throw_if_any() const {
  if (!faults_.empty()) throw InputError(in_order(faults_));
}

std::vector<std::string> Diagnostics::warnings() const {
  return in_order(warnings_);
}

std::vector<std::string> Diagnostics::in_order(std::vector<Message> messages) {
  std::ranges::stable_sort(messages, {}, [](const Message& m) {
    return std::tuple(m.override_number, m.where.line, m.where.column);
  });
  std::vector<std::string> texts;
  texts.reserve(messages.size());
  for (Message& m : messages) texts.push_back(std::move(m.text));
  return texts;
}

}  // namespace vitrum::scene
