#include "observe/archive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "scene/input_error.hpp"

namespace vitrum {
namespace {

template <class Map, class Value>
void enter(Map& map, const std::string& name, Value&& value) {
  if (name.empty() || name.find_first_of("/ \n") != std::string::npos || name == ".")
    throw std::invalid_argument(fmt::format("'{}' cannot name a part of a state", name));
  if (!map.emplace(name, std::forward<Value>(value)).second)
    throw std::logic_error(fmt::format("'{}' is entered twice", name));
}

}  // namespace

void Archive::put(const std::string& name, std::vector<double> values) {
  enter(numbers_, name, std::move(values));
}

void Archive::put_text(const std::string& name, std::string text) {
  enter(texts_, name, std::move(text));
}

std::int64_t Archive::count(const std::string& name) const {
  constexpr double most = 9007199254740992.0;
  const double value = number(name);
  if (!(value >= 0.0 && value <= most && value == std::floor(value)))
    throw FileError(fmt::format("checkpoint: '{}' holds {}, which is no count", name, value));
  return static_cast<std::int64_t>(value);
}

const std::vector<double>& Archive::numbers(const std::string& name) const {
  const auto entry = numbers_.find(name);
  if (entry == numbers_.end()) throw FileError(fmt::format("checkpoint: '{}' is missing", name));
  return entry->second;
}

const std::vector<double>& Archive::numbers(const std::string& name, std::size_t size) const {
  const std::vector<double>& values = numbers(name);
  if (values.size() != size)
    throw FileError(fmt::format("checkpoint: '{}' holds {} numbers, expected {}", name, values.size(), size));
  return values;
}

const std::string& Archive::text(const std::string& name) const {
  const auto entry = texts_.find(name);
  if (entry == texts_.end()) throw FileError(fmt::format("checkpoint: '{}' is missing", name));
  return entry->second;
}

}  // namespace vitrum
