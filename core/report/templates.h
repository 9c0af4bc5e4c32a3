// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// The files of the same names beside this one, as Mustache templates.
namespace relucent::report::templates {

extern const std::string_view page;    // the report
extern const std::string_view figure;  // a picture and its caption, several times on it
extern const std::string_view style;   // its style sheet

}  // namespace relucent::report::templates
