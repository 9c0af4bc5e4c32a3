// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <optional>

namespace relucent {

/// Stands between thousands, and between a number and its unit.
constexpr QChar narrowSpace(0x202F);

/// Thousands apart, in every language by the same space. A sign stands before the digits.
QString grouped(QString number);
/// So many decimals by the locale.
QString digitsOf(double value, int decimals);
/// Three significant digits by the locale; very large and small numbers as 7.9 x 10^-4.
QString digitsOf(double value);
/// "10" and a raised exponent.
QString powerOfTen(int exponent);

/// A number that core has written, by the locale: whole ones in full, others with the decimals that they have
/// and three significant digits at most. None: it is no number.
std::optional<QString> localDigits(const QString& written);

}  // namespace relucent
