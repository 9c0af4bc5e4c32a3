// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// Numbers as the report writes them.
namespace relucent::report {

/// 0.123 as "12.3 %"; what rounds to nothing has no sign.
std::string percent(double share);
/// Of what may be far below a percent, with two digits that count: 0.0032 %.
std::string smallPercent(double share);
/// As cameras say it: 1/180 s.
std::string exposureTime(double seconds);
/// Of a step: nobody wants fractions of seconds.
std::string stageDuration(double seconds);
/// Digits in groups of three, with narrow spaces that no line breaks at.
std::string grouped(std::uint64_t number);
/// "0.34 ms", "1.23 s", "2 min 5 s".
std::string duration(double seconds);
/// "2026-01-02T03:04:05Z" as "2 January 2026, 04:04" where the report is written; other texts as they are.
std::string localTime(const std::string& iso);
/// "31.4 dB"; infinity is "exact".
std::string decibels(double value);

}  // namespace relucent::report
