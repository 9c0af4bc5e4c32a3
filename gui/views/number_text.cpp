// SPDX-License-Identifier: MIT
#include "views/number_text.h"

#include <QGuiApplication>
#include <QLocale>
#include <algorithm>
#include <cmath>

namespace relucent {
namespace {

constexpr QChar narrowSpace(0x202F), isolate(0x2068), endOfIsolate(0x2069);

QString raised(int exponent) {
  static const QString digits = QString::fromUtf8("⁰¹²³⁴⁵⁶⁷⁸⁹");
  QString text = exponent < 0 ? QString::fromUtf8("⁻") : QString();
  for (QChar digit : QString::number(std::abs(exponent))) text += digits[digit.digitValue()];
  return text;
}

/// Thousands apart, in every language by the same space. A sign stands before the digits.
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
  return grouped(locale.toString(value, 'f', decimals));
}

/// Decimals that leave three significant digits.
int decimalsFor(double value) {
  if (value == 0.0) return 0;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 6);
}

}  // namespace

QString isolated(const QString& text) {
  // By its first letter: a unit may be a word of the language.
  return QGuiApplication::isRightToLeft() ? isolate + text + endOfIsolate : text;
}

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
    return isolated(digitsOf(value / std::pow(10.0, exponent), 1) + QString::fromUtf8(" × ") +
                    powerOfTen(exponent));
  }
  return decimalText(value, decimalsFor(value));
}

QString decimalText(double value, int decimals) {
  return isolated(digitsOf(value, decimals));
}

QString percentText(double share) {
  if (!std::isfinite(share)) return QString::fromUtf8("–");
  double percent = 100.0 * share;
  int decimals = std::abs(percent) >= 99.95 || percent == 0.0 ? 0 : std::abs(percent) < 0.095 ? 2 : 1;
  return isolated(digitsOf(percent, decimals) + narrowSpace + '%');
}

QString countText(std::uint64_t count) {
  return isolated(grouped(QString::number(count)));
}

QString bytesText(std::uint64_t bytes) {
  double shown = static_cast<double>(bytes);
  while (shown >= 999.5) shown /= 1000.0;
  const int decimals = shown >= 99.95 ? 0 : 1;  // three digits are enough
  return isolated(
      QLocale().formattedDataSize(static_cast<qint64>(bytes), decimals, QLocale::DataSizeSIFormat));
}

QString exposureText(double seconds) {
  QString number = seconds < 0.3 && seconds > 0.0 ? "1/" + QString::number(std::lround(1.0 / seconds))
                                                  : QLocale().toString(seconds, 'g', 2);
  return isolated(number + narrowSpace + 's');
}

QString sizeText(int width, int height) {
  return isolated(QString::fromUtf8("%1 × %2").arg(width).arg(height));
}

QString placeText(int x, int y) {
  return isolated(QString("%1, %2").arg(x).arg(y));
}

QString groupedText(QString sentence, int count) {
  constexpr int thousand = 1000;
  return count < thousand
             ? sentence
             : sentence.replace(QString::number(count), countText(static_cast<std::uint64_t>(count)));
}

}  // namespace relucent
