// SPDX-License-Identifier: MIT
#include "views/number_text.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

namespace relucent {
namespace {

constexpr QChar narrowSpace(0x202F);

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

QString powerOfTen(int exponent) {
  if (exponent == 0) return "1";
  if (exponent == 1) return "10";
  return "10" + raised(exponent);
}

QString numberText(double value) {
  if (!std::isfinite(value)) return QString::fromUtf8("–");
  double size = std::abs(value);
  if (size != 0.0 && (size < 1e-3 || size >= 1e6)) {
    int exponent = static_cast<int>(std::floor(std::log10(size)));
    return QLocale().toString(value / std::pow(10.0, exponent), 'f', 1) + QString::fromUtf8(" × ") +
           powerOfTen(exponent);
  }
  QString text = QLocale().toString(value, 'f', decimalsFor(value));
  return text;
}

QString percentText(double share) {
  if (!std::isfinite(share)) return QString::fromUtf8("–");
  double percent = 100.0 * share;
  int decimals = std::abs(percent) >= 99.95 || percent == 0.0 ? 0 : std::abs(percent) < 0.095 ? 2 : 1;
  return QLocale().toString(percent, 'f', decimals) + narrowSpace + '%';
}

QString countText(std::uint64_t count) {
  QString digits = QString::number(count);
  for (qsizetype at = digits.size() - 3; at > 0; at -= 3) digits.insert(at, narrowSpace);
  return digits;
}

QString bytesText(std::uint64_t bytes) {
  return QLocale().formattedDataSize(static_cast<qint64>(bytes), 1, QLocale::DataSizeSIFormat);
}

QString exposureText(double seconds) {
  QString number = seconds < 0.3 && seconds > 0.0 ? "1/" + QString::number(std::lround(1.0 / seconds))
                                                  : QLocale().toString(seconds, 'g', 2);
  return number + narrowSpace + 's';
}

}  // namespace relucent
