// SPDX-License-Identifier: MIT
#include "jobs/sentence_table.h"

#include <algorithm>

#include "jobs/quantities.h"

namespace relucent {
namespace {

/// As little as possible goes to the first parts: what the system says comes last and may hold anything. A
/// quantity is one word.
QString expressionOf(const QString& sentence) {
  const QList<bool> quantities = quantitiesIn(sentence);
  QString expression = QRegularExpression::escape(sentence);
  for (bool isQuantity : quantities)
    expression.replace(expression.indexOf("\\{\\}"), 4, isQuantity ? "(\\S+)" : "(.+?)");
  return expression;
}

}  // namespace

SentenceTable::SentenceTable(std::span<const char* const> sentences) {
  for (const char* sentence : sentences) {
    QString text = QString::fromUtf8(sentence);
    whole_.insert(text, sentence);
    qsizetype filled = text.count("{}");
    if (filled == 0) continue;
    patterns_.append(
        {sentence, text.size() - 2 * filled,
         QRegularExpression('^' + expressionOf(text) + '$', QRegularExpression::DotMatchesEverythingOption)});
  }
  std::stable_sort(patterns_.begin(), patterns_.end(),
                   [](const Pattern& a, const Pattern& b) { return a.own > b.own; });
}

std::optional<SentenceTable::Match> SentenceTable::find(const QString& text) const {
  if (const char* sentence = whole_.value(text)) return Match{sentence, {}};
  for (const Pattern& pattern : patterns_)
    if (QRegularExpressionMatch match = pattern.fits.match(text); match.hasMatch())
      return Match{pattern.sentence, match.capturedTexts().mid(1)};
  return std::nullopt;
}

QString filledIn(const QString& sentence, const QStringList& parts) {
  static const QRegularExpression place("\\{(\\d*)\\}");
  // In one go: a part may hold braces of its own.
  QString text;
  qsizetype end = 0, next = 0;
  for (const QRegularExpressionMatch& match : place.globalMatch(sentence)) {
    qsizetype part = match.captured(1).isEmpty() ? next++ : match.captured(1).toInt();
    text += sentence.mid(end, match.capturedStart() - end);
    text += part < parts.size() ? parts[part] : match.captured();
    end = match.capturedEnd();
  }
  return text + sentence.mid(end);
}

}  // namespace relucent
