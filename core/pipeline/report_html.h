// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "relucent/image/image.h"

/// What the sections of a report are made of. Texts are escaped here, `body` and `below` are HTML already.
namespace relucent::pipeline {

/// `lead`: one sentence below the heading, or empty.
std::string section(const std::string& heading, const std::string& lead, const std::string& body);

/// An sRGB-encoded picture with its caption; `below`: a legend between both.
std::string figure(const image::Image& encoded, const std::string& name, const std::string& caption,
                   const std::string& below = {});

std::string card(const std::string& name, const std::string& value);

/// 0.123 as "12.3 %".
std::string percent(double share);
/// Digits in groups of three, with narrow spaces that no line breaks at.
std::string grouped(std::uint64_t number);
/// "1.23 s", "2 min 5 s".
std::string duration(double seconds);
/// "31.4 dB"; infinity is "exact".
std::string decibels(double value);

}  // namespace relucent::pipeline
