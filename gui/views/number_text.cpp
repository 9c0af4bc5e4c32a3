// SPDX-License-Identifier: MIT
#include "views/number_text.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QLocale>
#include <cmath>

#include "text/local_digits.h"

namespace relucent::gui {
namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(NumberText)
};

constexpr QChar isolate(0x2068), endOfIsolate(0x2069);

}  // namespace

QString isolated(const QString& text) {
  // By its first letter: a unit may be a word of the language.
  return QGuiApplication::isRightToLeft() ? isolate + text + endOfIsolate : text;
}

QString numberText(double value) {
  if (!std::isfinite(value)) return QString::fromUtf8("–");
  return isolated(digitsOf(value));
}

QString decimalText(double value, int decimals) {
  return isolated(digitsOf(value, decimals));
}

QString percentText(double share) {
  if (!std::isfinite(share)) return QString::fromUtf8("–");
  double percent = 100.0 * share;
  const double size = std::abs(percent);
  const int decimals = size >= 99.95 || size == 0.0 ? 0 : size < 0.005 ? 4 : size < 0.095 ? 2 : 1;
  return isolated(digitsOf(percent, decimals) + narrowSpace + '%');
}

QString marginText(double share) {
  return isolated(QString::fromUtf8("±") + narrowSpace + percentText(share));
}

QString countText(std::uint64_t count) {
  return isolated(grouped(QString::number(count)));
}

QString largeText(std::uint64_t count) {
  constexpr double million = 1e6, billion = 1e9;
  const auto value = static_cast<double>(count);
  if (value < million) return countText(count);
  const bool isMillions = value < billion;
  const QString digits = digitsOf(value / (isMillions ? million : billion));
  return isolated((isMillions ? Words::tr("%1 million") : Words::tr("%1 billion")).arg(digits));
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

}  // namespace relucent::gui
