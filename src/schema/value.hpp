#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "tensor/symmetric.hpp"

namespace vitrum::schema {

using Numbers = std::vector<double>;
/// Numbers by names that the file gives them, in its order.
using NamedNumbers = std::vector<std::pair<std::string, double>>;
/// Texts by the dotted path of their key or item, in the order in which these are read.
using PlacedTexts = std::vector<std::pair<std::string, std::string>>;

/// What stands in place of a number that may vary.
struct Function {
  std::string formula;  ///< "=...", of t, and r, z or x, y; empty: piecewise linear, constant outside
  std::vector<std::array<double, 2>> table{};  ///< (s, value), by rising time
};
/// Functions by the dotted path of their key or item.
using Functions = std::map<std::string, Function>;

using ValueVariant = std::variant<double, int, bool, std::string, Numbers, std::vector<Numbers>,
                                  std::vector<std::string>, NamedNumbers>;

/// What a key that is no table holds.
struct Value : ValueVariant {
  using ValueVariant::ValueVariant;
  Value() = default;
  Value(Value&&) = default;
  Value& operator=(Value&&) = default;
  /// By way of a value: where memory runs out in the variant's own copy, libstdc++ 12 destroys a text or list
  /// that was never made.
  Value(const Value& other)
      : ValueVariant(std::visit(
            [](const auto& held) {
              return ValueVariant(std::in_place_type<std::decay_t<decltype(held)>>, held);
            },
            static_cast<const ValueVariant&>(other))) {}
  Value& operator=(const Value& other) { return *this = Value(other); }
  ~Value() = default;
};

/// The kinds of values, in the order of Value, and of tables: one, a list of them, and a table of tables
/// whose keys are names.
enum class Kind {
  number,
  integer,
  flag,
  text,
  numbers,
  rows,
  texts,
  named_numbers,
  table,
  tables,
  named_tables
};

struct Shape {
  Kind kind;
  std::size_t length = 0;  ///< of a list; 0: any
  std::size_t width = 0;   ///< of rows
};

/// A type that stands in a file as a list of so many numbers.
template <class T>
struct Components;

template <std::size_t n>
struct Components<std::array<double, n>> {
  static constexpr std::size_t count = n;
  static Numbers list(const std::array<double, n>& a) { return {a.begin(), a.end()}; }
  static std::array<double, n> from(const Numbers& numbers) {
    std::array<double, n> a{};
    std::copy_n(numbers.begin(), n, a.begin());
    return a;
  }
};

template <>
struct Components<SymmetricTensor> {
  static constexpr std::size_t count = 4;
  static Numbers list(const SymmetricTensor& a) { return {a.rr, a.zz, a.tt, a.rz}; }
  static SymmetricTensor from(const Numbers& n) { return {n[0], n[1], n[2], n[3]}; }
};

template <class T>
concept OfComponents = requires {
  Components<T>::count;
};

/// How a member of type T becomes a Value, or stays absent, and the other way round.
template <class T>
struct Codec {
  static Shape shape() { return {static_cast<Kind>(Value(T{}).index())}; }
  static std::optional<Value> value(const T& member) { return member; }
  static void assign(T& member, const Value& value) { member = std::get<T>(value); }
};

template <class T>
struct Codec<std::optional<T>> {
  static Shape shape() { return Codec<T>::shape(); }
  static std::optional<Value> value(const std::optional<T>& member) {
    return member ? Codec<T>::value(*member) : std::nullopt;
  }
  static void assign(std::optional<T>& member, const Value& value) {
    Codec<T>::assign(member.emplace(), value);
  }
};

template <OfComponents T>
struct Codec<T> {
  static Shape shape() { return {Kind::numbers, Components<T>::count}; }
  static std::optional<Value> value(const T& member) { return Components<T>::list(member); }
  static void assign(T& member, const Value& value) {
    member = Components<T>::from(std::get<Numbers>(value));
  }
};

/// Any number of rows.
template <OfComponents T>
struct Codec<std::vector<T>> {
  static Shape shape() { return {Kind::rows, 0, Components<T>::count}; }
  static std::optional<Value> value(const std::vector<T>& member) {
    std::vector<Numbers> rows;
    for (const T& row : member) rows.push_back(Components<T>::list(row));
    return rows;
  }
  static void assign(std::vector<T>& member, const Value& value) {
    member.clear();
    for (const Numbers& row : std::get<std::vector<Numbers>>(value))
      member.push_back(Components<T>::from(row));
  }
};

/// `n` rows.
template <OfComponents T, std::size_t n>
struct Codec<std::array<T, n>> {
  static Shape shape() { return {Kind::rows, n, Components<T>::count}; }
  static std::optional<Value> value(const std::array<T, n>& member) {
    return Codec<std::vector<T>>::value({member.begin(), member.end()});
  }
  static void assign(std::array<T, n>& member, const Value& value) {
    std::vector<T> rows;
    Codec<std::vector<T>>::assign(rows, value);
    std::copy_n(rows.begin(), n, member.begin());
  }
};

/// None is absence.
template <>
struct Codec<NamedNumbers> {
  static Shape shape() { return {Kind::named_numbers}; }
  static std::optional<Value> value(const NamedNumbers& member) {
    return member.empty() ? std::nullopt : std::optional<Value>(member);
  }
  static void assign(NamedNumbers& member, const Value& value) { member = std::get<NamedNumbers>(value); }
};

/// `n` texts.
template <std::size_t n>
struct Codec<std::array<std::string, n>> {
  static Shape shape() { return {Kind::texts, n}; }
  static std::optional<Value> value(const std::array<std::string, n>& member) {
    return std::vector<std::string>(member.begin(), member.end());
  }
  static void assign(std::array<std::string, n>& member, const Value& value) {
    std::copy_n(std::get<std::vector<std::string>>(value).begin(), n, member.begin());
  }
};

}  // namespace vitrum::schema
