// SPDX-License-Identifier: MIT
#include "text/message_text.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <variant>

#include "text/local_digits.h"

namespace relucent::gui {
namespace {

/// The English pattern of a message whose translation is not known.
const std::string& inEnglish(const Message& message) {
  return message.number() == 1 ? message.singular() : message.pattern();
}

/// The id is the context, and the singular tells the translator of which words the number decides.
QString translatedPattern(const Message& message) {
  if (message.id().empty()) return QString::fromStdString(message.pattern());
  const char* singular = message.singular().empty() ? nullptr : message.singular().c_str();
  const int number = static_cast<int>(message.number().value_or(-1));
  const QString pattern = QString::fromStdString(message.pattern());
  const QString translated =
      QCoreApplication::translate(message.id().c_str(), message.pattern().c_str(), singular, number);
  return translated == pattern ? QString::fromStdString(inEnglish(message)) : translated;
}

/// With narrow spaces between gaps and the units behind them.
QString withNarrowUnits(QString pattern) {
  static const QRegularExpression unit(
      QString::fromUtf8("(\\{\\d*\\})[ \u00A0](?=(?:%|s|ms|MB|Mo|ث|秒)(?![\\p{L}\\p{N}]))"));
  return pattern.replace(unit, QString("\\1") + narrowSpace);
}

struct ArgumentText {
  QString operator()(const Argument::Count& count) const { return grouped(QString::number(count.value)); }
  QString operator()(const Argument::Label& label) const { return QString::number(label.value); }
  QString operator()(const Argument::Quantity& quantity) const {
    if (quantity.digits.kind == Digits::Kind::decimals)
      return digitsOf(quantity.shown(), quantity.digits.count);
    const QString written = QString::fromStdString(english(Argument(Argument::Value(quantity))));
    return localDigits(written).value_or(written);
  }
  QString operator()(const Size& size) const { return QString("%1x%2").arg(size.width).arg(size.height); }
  QString operator()(const Argument::Text& name) const { return QString::fromStdString(name.value); }
  QString operator()(const Argument::File& file) const { return QString::fromStdString(file.path); }
  QString operator()(const Argument::Sentence& sentence) const { return text(*sentence.message); }
};

}  // namespace

QString text(const Message& message) {
  std::vector<std::string> parts;
  for (const Argument& argument : message.arguments())
    parts.push_back(std::visit(ArgumentText(), argument.value()).toStdString());
  return QString::fromStdString(fillGaps(withNarrowUnits(translatedPattern(message)).toStdString(), parts));
}

QString fullSentence(const Message& message) {
  static const QString stops = QString::fromUtf8(".。?？؟!！…");
  QString line = text(message).trimmed();
  if (line.isEmpty()) return line;
  // A device's address, "genicam:RL01", is spelt as it is.
  if (!line.section(' ', 0, 0).chopped(1).contains(':')) line[0] = line[0].toUpper();
  if (stops.contains(line.back())) return line;
  // The stop is that of the sentence's own language.
  return message.id().empty() ? line + '.'
                              : text(RELUCENT_MESSAGE("sentence.ended", "{}.").with(line.toStdString()));
}

}  // namespace relucent::gui
