// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// Numbers as the report writes them.
namespace relucent::report {

/// 0.123 as "12.3 %".
std::string percent(double share);
/// Digits in groups of three, with narrow spaces that no line breaks at.
std::string grouped(std::uint64_t number);
/// "1.23 s", "2 min 5 s".
std::string duration(double seconds);
/// "31.4 dB"; infinity is "exact".
std::string decibels(double value);

}  // namespace relucent::report
