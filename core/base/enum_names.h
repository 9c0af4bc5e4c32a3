// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "relucent/base/error.h"

namespace relucent {

/// One value of an enumeration: its name on command lines and in files, and what it means.
template <typename Enum>
struct EnumName {
  Enum value;
  std::string_view name;
  std::string_view description{};  // a clause of English without a full stop; empty where none is needed
};

/// The names of an enumeration, and what its values are called together: "method".
template <typename Enum>
struct EnumNames {
  std::string_view kind;
  std::span<const EnumName<Enum>> entries;
};

/// An enumeration with one table of names. Beside the enumeration stands
///   constexpr EnumNames<Enum> namesOf(Enum) { return {"kind", table}; }
/// which is found by its argument's type; the argument's value does not count.
template <typename Enum>
concept NamedEnum = std::is_enum_v<Enum> && requires(Enum value) {
  { namesOf(value) } -> std::same_as<EnumNames<Enum>>;
};

/// The whole table, in the order in which it is shown to people.
template <NamedEnum Enum>
constexpr std::span<const EnumName<Enum>> enumEntries() {
  return namesOf(Enum{}).entries;
}

/// Contract: the table has an entry for every value. Empty for one that it lacks.
template <NamedEnum Enum>
constexpr std::string_view nameOf(Enum value) {
  for (const EnumName<Enum>& entry : enumEntries<Enum>())
    if (entry.value == value) return entry.name;
  return {};
}

template <NamedEnum Enum>
constexpr std::string_view descriptionOf(Enum value) {
  for (const EnumName<Enum>& entry : enumEntries<Enum>())
    if (entry.value == value) return entry.description;
  return {};
}

/// For callers who can go on without; everybody else takes parsedName().
template <NamedEnum Enum>
constexpr std::optional<Enum> valueNamed(std::string_view name) {
  for (const EnumName<Enum>& entry : enumEntries<Enum>())
    if (entry.name == name) return entry.value;
  return std::nullopt;
}

/// All values, in the table's order.
template <NamedEnum Enum>
std::vector<Enum> allValues() {
  std::vector<Enum> values;
  for (const EnumName<Enum>& entry : enumEntries<Enum>()) values.push_back(entry.value);
  return values;
}

/// All names, in the table's order.
template <NamedEnum Enum>
std::vector<std::string> allNames() {
  std::vector<std::string> names;
  for (const EnumName<Enum>& entry : enumEntries<Enum>()) names.emplace_back(entry.name);
  return names;
}

namespace detail {
[[noreturn]] void failUnknownName(ErrorKind error, std::string_view kind, std::string_view name,
                                  const std::vector<std::string>& known);
}  // namespace detail

/// The value of that name. `error`: usage for what somebody typed, format for what a file says.
/// Throws: Error{error} that lists the names there are.
template <NamedEnum Enum>
Enum parsedName(std::string_view name, ErrorKind error) {
  if (std::optional<Enum> value = valueNamed<Enum>(name)) return *value;
  detail::failUnknownName(error, namesOf(Enum{}).kind, name, allNames<Enum>());
}

}  // namespace relucent
