// SPDX-License-Identifier: MIT
#include "jobs/core_sentences.h"

#include <QCoreApplication>
#include <optional>

#include "jobs/local_digits.h"
#include "jobs/quantities.h"
#include "jobs/sentence_table.h"

namespace relucent {
namespace {

constexpr const char* ofDevice = QT_TRANSLATE_NOOP("Core", "{}: {}");
constexpr const char* both = QT_TRANSLATE_NOOP("Core", "{}; {}");
constexpr const char* explained = QT_TRANSLATE_NOOP("Core", "{} ({})");
constexpr const char* ended = QT_TRANSLATE_NOOP("Core", "{}.");

std::optional<QString> translated(const QString& text);

const SentenceTable& table() {
  static const SentenceTable all(knownCoreSentences());
  return all;
}

QString filled(const SentenceTable::Match& known) {
  QStringList parts = known.parts;
  const QList<bool> quantities = quantitiesIn(known.sentence);
  for (qsizetype i = 0; i < parts.size(); ++i) {
    std::optional<QString> inWords = quantities[i] ? localDigits(parts[i]) : translated(parts[i]);
    parts[i] = inWords.value_or(parts[i]);
  }
  return filledIn(withNarrowUnits(QCoreApplication::translate("Core", known.sentence)), parts);
}

/// A sentence, or one after the name of what it is about. No deeper: whole scripts may be quoted in a text,
/// which has many places where it could be cut.
std::optional<QString> one(const QString& text) {
  if (auto known = table().find(text)) return filled(*known);
  for (qsizetype at = text.indexOf(": "); at > 0; at = text.indexOf(": ", at + 1))
    if (auto known = table().find(text.mid(at + 2)))
      return filledIn(QCoreApplication::translate("Core", ofDevice), {text.left(at), filled(*known)});
  return std::nullopt;
}

/// Two sentences, with `joint` between them and `end` behind.
std::optional<QString> joined(const QString& text, const char* how, const QString& joint,
                              const QString& end) {
  if (!text.endsWith(end)) return std::nullopt;
  for (qsizetype at = text.indexOf(joint); at > 0; at = text.indexOf(joint, at + 1)) {
    qsizetype second = at + joint.size();
    auto known = table().find(text.mid(second, text.size() - second - end.size()));
    if (!known) continue;
    if (auto first = one(text.left(at)))
      return filledIn(QCoreApplication::translate("Core", how), {*first, filled(*known)});
  }
  return std::nullopt;
}

std::optional<QString> translated(const QString& text) {
  if (auto known = table().find(text); known && known->parts.isEmpty()) return filled(*known);
  // Before those with gaps, as a gap would take the whole of the second sentence.
  if (auto pair = joined(text, both, "; ", "")) return pair;
  if (auto pair = joined(text, explained, " (", ")")) return pair;
  return one(text);
}

}  // namespace

QString coreSentence(const std::string& english) {
  QString text = QString::fromStdString(english);
  return translated(text).value_or(text);
}

QString fullSentence(const std::string& english) {
  QString line = QString::fromStdString(english).trimmed();
  if (line.endsWith('.')) line.chop(1);
  if (line.isEmpty()) return line;
  auto known = translated(line);
  if (known) line = *known;
  line[0] = line[0].toUpper();
  // The stop is that of the sentence's own language.
  return known ? filledIn(QCoreApplication::translate("Core", ended), {line}) : line + '.';
}

}  // namespace relucent
