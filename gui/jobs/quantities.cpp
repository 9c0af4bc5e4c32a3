// SPDX-License-Identifier: MIT
#include "jobs/quantities.h"

#include <QRegularExpression>

#include "jobs/local_digits.h"

namespace relucent {

QList<bool> quantitiesIn(const QString& sentence) {
  static const QRegularExpression gap("\\{\\}");
  // Known by what is counted, directly or with the next gap; or by what is said of it.
  static const QRegularExpression counted(
      "^(?:(?:,| to| of) \\{\\})? (?:%|(?:s|MB|attempts|bytes|cameras|degrees|frames|pixels)\\b)");
  static const QRegularExpression said(
      "(?:a gain of|bytes instead of|can do|can do \\{\\} to|a gain of \\{\\} and keeps to) $");
  QList<bool> quantities;
  for (const QRegularExpressionMatch& match : gap.globalMatch(sentence)) {
    QString before = sentence.left(match.capturedStart()), after = sentence.mid(match.capturedEnd());
    bool stands = before.isEmpty() || before.endsWith(' ') || before.endsWith('(');
    quantities << (stands && (counted.match(after).hasMatch() || said.match(before).hasMatch()));
  }
  return quantities;
}

QString withNarrowUnits(QString sentence) {
  static const QRegularExpression unit(
      QString::fromUtf8("(\\{\\d*\\})[ \u00A0](?=(?:%|s|MB|Mo|ث|秒)(?![\\p{L}\\p{N}]))"));
  return sentence.replace(unit, QString("\\1") + narrowSpace);
}

}  // namespace relucent
