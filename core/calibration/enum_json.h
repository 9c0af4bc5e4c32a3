// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/base/enum_names.h"
#include "relucent/calibration/json.h"

/// Enumerations in files are their names (base/enum_names.h). A name that is unknown is an
/// Error{format} that lists the known ones: taking another value in its place would go unnoticed.
template <relucent::NamedEnum Enum>
struct nlohmann::adl_serializer<Enum> {
  template <typename AnyJson>
  static void to_json(AnyJson& json, Enum value) {
    json = relucent::nameOf(value);
  }
  template <typename AnyJson>
  static void from_json(const AnyJson& json, Enum& value) {
    value = relucent::parsedName<Enum>(json.template get<std::string>(), relucent::ErrorKind::format);
  }
};
