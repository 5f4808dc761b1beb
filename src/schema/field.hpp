#pragma once
#include <type_traits>

#include "schema/fields.hpp"
#include "schema/table.hpp"

namespace vitrum::schema {

/// A name in a file for a value in the program. Lists of them stand beside their enumerations.
template <class T>
struct Named {
  std::string_view name;
  T value;
};

template <class T, std::size_t n>
constexpr std::string_view name_of(const std::array<Named<T>, n>& names, T value) {
  return std::ranges::find(names, value, &Named<T>::value)->name;
}

template <class T, std::size_t n>
std::vector<std::string> texts_of(const std::array<Named<T>, n>& names) {
  std::vector<std::string> texts;
  for (const Named<T>& named : names) texts.emplace_back(named.name);
  return texts;
}

/// Integers that a key admits.
struct OneOf {
  std::vector<int> integers;
};

enum class Need { optional, required };
inline constexpr Need required = Need::required;

/// A row: one key of a table, for a member of the struct that the table is read into. A key that is not
/// required leaves the member as `Owner{}` has it, which is what the reference calls its default.
template <class Owner>
class Field : public Key {
 public:
  /// Numbers and lists of numbers: {"radius", &Disk::radius, "m", intervals::positive, "radius", required}.
  template <class T, class Base>
  Field(std::string_view key, T Base::*member, std::string_view unit_, const Bounds& bounds_,
        std::string_view meaning, Need need = Need::optional)
      : Field(key, member, meaning, need) {
    unit = unit_;
    bounds = bounds_;
  }
  /// Integers.
  template <class T, class Base>
  Field(std::string_view key, T Base::*member, const Bounds& bounds_, std::string_view meaning,
        Need need = Need::optional)
      : Field(key, member, "1", bounds_, meaning, need) {}
  template <class Base>
  Field(std::string_view key, int Base::*member, const OneOf& integers, std::string_view meaning)
      : Field(key, member, meaning) {
    admitted = integers.integers;
  }
  /// Texts, and true or false.
  template <class T, class Base>
  Field(std::string_view key, T Base::*member, std::string_view meaning, Need need = Need::optional)
      : Field(key, Codec<T>::shape(), meaning, need) {
    access([member](const Owner& owner) { return Codec<T>::value(owner.*member); },
           [member](Owner& owner, const Value& value) { Codec<T>::assign(owner.*member, value); });
  }
  /// One of several texts.
  template <class T, class Base, std::size_t n>
  Field(std::string_view key, T Base::*member, const std::array<Named<T>, n>& names, std::string_view meaning,
        Need need = Need::optional)
      : Field(key, Shape{Kind::text}, meaning, need) {
    choices = texts_of(names);
    access([member, names](const Owner& owner) { return Value(std::string(name_of(names, owner.*member))); },
           [member, names](Owner& owner, const Value& value) {
             owner.*member = std::ranges::find(names, std::get<std::string>(value), &Named<T>::name)->value;
           });
  }
  /// A list of some of several texts.
  template <class T, class Base>
  Field(std::string_view key, T Base::*member, std::vector<std::string> texts, std::string_view meaning,
        Need need = Need::optional)
      : Field(key, member, meaning, need) {
    choices = std::move(texts);
  }
  /// A table, read into a struct, an optional struct or, tables of them, a list of structs.
  template <class T, class Base>
  Field(std::string_view key, T Base::*member, const Table& table_, std::string_view meaning,
        Need need = Need::optional)
      : Field(key, Shape{Kind::table}, meaning, need) {
    table = &table_;
    tables_in([member](auto& owner) -> auto& { return owner.*member; });
  }
  /// A table of the keys of this same struct: a section.
  Field(std::string_view key, const Table& table_, std::string_view meaning, Need need = Need::optional)
      : Field(key, Shape{Kind::table}, meaning, need) {
    table = &table_;
    tables_in([](auto& owner) -> auto& { return owner; });
  }

  /// A row of a part of the owner whose keys stand in the same table.
  template <class Part>
  Field(const Field<Part>& row, Part Owner::*part) : Key(row) {
    const auto in = [part](const void* owner) { return &(static_cast<const Owner*>(owner)->*part); };
    const auto in_changing = [part](void* owner) { return &(static_cast<Owner*>(owner)->*part); };
    if (row.get) get = [in, of = row.get](const void* owner) { return of(in(owner)); };
    if (row.look) look = [in, of = row.look](const void* owner, std::size_t n) { return of(in(owner), n); };
    if (row.set)
      set = [in_changing, of = row.set](void* owner, const Value& value) { of(in_changing(owner), value); };
    if (row.open)
      open = [in_changing, of = row.open](void* owner, const std::string& its_name) {
        return of(in_changing(owner), its_name);
      };
  }

  /// One of the types of a variant as a table or, `Part` having a Codec, as a value.
  template <class Part, class Base, class... Parts>
  static Field alternative(std::string_view key, std::variant<Parts...> Base::*member, const Table& table_,
                           std::string_view meaning) {
    Field field(key, Shape{Kind::table}, meaning, Need::optional);
    field.table = &table_;
    field.open = [member](void* owner, const std::string&) -> void* {
      return &(static_cast<Owner*>(owner)->*member).template emplace<Part>();
    };
    field.look = [member](const void* owner, std::size_t n) -> const void* {
      return n == 0 ? std::get_if<Part>(&(static_cast<const Owner*>(owner)->*member)) : nullptr;
    };
    return field;
  }
  template <class Part, class Base, class... Parts>
  static Field alternative(std::string_view key, std::variant<Parts...> Base::*member, std::string_view unit_,
                           const Bounds& bounds_, std::string_view meaning) {
    Field field(key, Codec<Part>::shape(), meaning, Need::optional);
    field.access(
        [member](const Owner& owner) {
          const Part* part = std::get_if<Part>(&(owner.*member));
          return part != nullptr ? Codec<Part>::value(*part) : std::nullopt;
        },
        [member](Owner& owner, const Value& value) {
          Codec<Part>::assign((owner.*member).template emplace<Part>(), value);
        });
    field.unit = unit_;
    field.bounds = bounds_;
    return std::move(field).derived();
  }

  /// A table of tables with names, each read into a struct with a member `name`.
  template <class T>
  static Field named(std::string_view key, T Owner::*member, const Table& table_, std::string_view meaning,
                     Need need = Need::optional) {
    Field field(key, member, table_, meaning, need);
    field.shape = {Kind::named_tables};
    const auto open_one = field.open;
    field.open = [open_one](void* owner, const std::string& name) {
      void* opened = open_one(owner, name);
      static_cast<Element<T>*>(opened)->name = name;
      return opened;
    };
    field.table_name = [](const void* one) -> const std::string& {
      return static_cast<const Element<T>*>(one)->name;
    };
    return field;
  }

  /// Any other key with a value.
  template <class Get, class Set>
  static Field of(std::string_view key, const Shape& shape_, std::string_view meaning, Need need, Get get_,
                  Set set_) {
    Field field(key, shape_, meaning, need);
    field.access(get_, set_);
    return field;
  }

  /// What messages expect, where the row does not say it well enough.
  Field expecting(std::string_view what) && {
    phrase = what;
    return std::move(*this);
  }
  /// No fewer rows.
  Field at_least(std::size_t rows) && {
    fewest = rows;
    return std::move(*this);
  }
  /// Functions of time may stand in place of its numbers: formulas of t, tables.
  Field over_time() && {
    Key::over_time = true;
    return std::move(*this);
  }
  /// Formulas of place may.
  Field over_place() && {
    Key::over_place = true;
    return std::move(*this);
  }
  /// The value in effect when neither this key nor an alternative of it is given.
  Field otherwise(Value value) && {
    fallback = std::move(value);
    return std::move(*this);
  }
  /// What stands for an absent key follows from the rest of the file.
  Field derived() && {
    fallback.reset();
    return std::move(*this);
  }

 private:
  template <class T>
  struct ElementOf {
    using Type = T;
  };
  template <class T>
  struct ElementOf<std::vector<T>> {
    using Type = T;
  };
  template <class T>
  using Element = typename ElementOf<T>::Type;

  Field(std::string_view key, const Shape& shape_, std::string_view meaning, Need need) {
    name = key;
    shape = shape_;
    text = meaning;
    required = need == Need::required;
  }

  template <class Get, class Set>
  void access(Get get_, Set set_) {
    get = [get_](const void* owner) -> std::optional<Value> {
      return get_(*static_cast<const Owner*>(owner));
    };
    set = [set_](void* owner, const Value& value) { set_(*static_cast<Owner*>(owner), value); };
    if (!required) fallback = get_(Owner{});
  }

  /// `part`: from the owner to the member that holds the table or tables.
  template <class Part>
  void tables_in(Part part) {
    using Member = std::remove_cvref_t<decltype(part(std::declval<Owner&>()))>;
    const auto place = [part](void* owner) -> Member& { return part(*static_cast<Owner*>(owner)); };
    const auto view = [part](const void* owner) -> const Member& {
      return part(*static_cast<const Owner*>(owner));
    };
    if constexpr (requires(Member & m) { m.emplace_back(); }) {
      shape = {Kind::tables};
      open = [place](void* owner, const std::string&) -> void* { return &place(owner).emplace_back(); };
      look = [view](const void* owner, std::size_t n) -> const void* {
        return n < view(owner).size() ? &view(owner)[n] : nullptr;
      };
    } else if constexpr (requires(Member & m) { m.has_value(); }) {
      open = [place](void* owner, const std::string&) -> void* { return &place(owner).emplace(); };
      look = [view](const void* owner, std::size_t n) -> const void* {
        return n == 0 && view(owner).has_value() ? &*view(owner) : nullptr;
      };
    } else {
      open = [place](void* owner, const std::string&) -> void* { return &place(owner); };
      look = [view](const void* owner, std::size_t n) -> const void* {
        return n == 0 ? &view(owner) : nullptr;
      };
    }
  }
};

/// Rows, and behind them those of a part whose keys stand in the same table.
template <class Owner, class Part>
Fields<Owner> joined(Fields<Owner> rows, Part Owner::*part, const Fields<Part>& more) {
  for (const Field<Part>& row : more) rows.emplace_back(row, part);
  return rows;
}

/// A table of a struct.
template <class Owner>
Table table_of(std::string_view heading, std::string_view text, const Fields<Owner>& fields) {
  return {std::string(heading), std::string(text), {fields.begin(), fields.end()}};
}

/// The same table, written {like = this}.
inline Table in_one_line(Table table) {
  table.in_one_line = true;
  return table;
}

}  // namespace vitrum::schema
