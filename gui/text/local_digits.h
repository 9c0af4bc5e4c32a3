// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <optional>

namespace relucent::gui {

/// Separates thousands, and a number from its unit.
constexpr QChar narrowSpace(0x202F);

/// Groups thousands, in every language by the same space. A sign precedes the digits.
QString grouped(QString number);
/// With a fixed number of decimals, by the locale.
QString digitsOf(double value, int decimals);
/// Three significant digits by the locale; very large and small numbers as 7.9 x 10^-4.
QString digitsOf(double value);
/// "10" and a raised exponent.
QString powerOfTen(int exponent);

/// A number written by core, in the locale's format: integers in full, others with their decimals but at most
/// three significant digits. None: not a number.
std::optional<QString> localDigits(const QString& written);

}  // namespace relucent::gui
