// SPDX-License-Identifier: MIT
#include "text/local_digits.h"

#include <QLocale>
#include <QRegularExpression>
#include <algorithm>
#include <cmath>

namespace relucent::gui {
namespace {

QString raised(int exponent) {
  static const QString digits = QString::fromUtf8("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = exponent < 0 ? QString::fromUtf8("⁻") : QString();
  for (QChar digit : QString::number(std::abs(exponent))) text += digits[digit.digitValue()];
  return text;
}

/// Decimals that leave three significant digits.
int decimalsFor(double value) {
  if (value == 0.0) return 0;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 6);
}

}  // namespace

QString grouped(QString number) {
  auto isDigit = [](QChar letter) { return letter.isDigit(); };
  auto first = std::find_if(number.cbegin(), number.cend(), isDigit);
  auto end = std::find_if_not(first, number.cend(), isDigit);
  qsizetype from = first - number.cbegin();
  for (qsizetype at = end - number.cbegin() - 3; at > from; at -= 3) number.insert(at, narrowSpace);
  return number;
}

QString digitsOf(double value, int decimals) {
  QLocale locale;
  locale.setNumberOptions(QLocale::OmitGroupSeparator);
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;  // nothing is less than no digit
  return grouped(locale.toString(value, 'f', decimals));
}

QString digitsOf(double value) {
  double size = std::abs(value);
  if (size == 0.0 || (size >= 1e-3 && size < 1e6)) return digitsOf(value, decimalsFor(value));
  int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (std::round(10.0 * size / std::pow(10.0, exponent)) >= 100.0) ++exponent;  // 9.97 is written as 10
  return digitsOf(value / std::pow(10.0, exponent), 1) + QString::fromUtf8(" × ") + powerOfTen(exponent);
}

QString powerOfTen(int exponent) {
  if (exponent == 0) return "1";
  if (exponent == 1) return "10";
  return "10" + raised(exponent);
}

std::optional<QString> localDigits(const QString& written) {
  static const QRegularExpression number("^-?\\d+(?:\\.(\\d+))?(e[-+]\\d+)?$");
  QRegularExpressionMatch match = number.match(written);
  if (!match.hasMatch()) return std::nullopt;
  double value = written.toDouble();
  if (match.hasCaptured(2)) return digitsOf(value);
  int decimals = static_cast<int>(match.capturedLength(1));
  return digitsOf(value, std::min(decimals, decimalsFor(value)));
}

}  // namespace relucent::gui
