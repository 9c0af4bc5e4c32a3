// SPDX-License-Identifier: MIT
#pragma once

#include <kainjow/mustache.hpp>
#include <string>

#include "relucent/image/image.h"

/// Pieces of what the template page.html asks for.
namespace relucent::report {

using PageData = kainjow::mustache::data;

PageData named(const std::string& name, const std::string& value);

/// An sRGB-encoded picture with its caption; `below`: a legend between both.
PageData figure(const image::Image& encoded, const std::string& name, const std::string& caption,
                const std::string& below = {});

}  // namespace relucent::report
