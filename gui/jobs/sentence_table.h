// SPDX-License-Identifier: MIT
#pragma once

#include <QHash>
#include <QList>
#include <QRegularExpression>
#include <QStringList>
#include <optional>
#include <span>

namespace relucent {

/// English sentences of core, "{}" where it fills something in, and the way back from a filled one.
class SentenceTable {
 public:
  struct Match {
    const char* sentence = nullptr;  // of the table
    QStringList parts;               // what was filled in, from left to right
  };

  explicit SentenceTable(std::span<const char* const> sentences);

  /// Of several that fit the one that says most itself. None: core says no such thing.
  std::optional<Match> find(const QString& text) const;

 private:
  struct Pattern {
    const char* sentence;
    qsizetype own;  // characters that are not filled in
    QRegularExpression fits;
  };
  QHash<QString, const char*> whole_;
  QList<Pattern> patterns_;
};

/// Puts the parts in: into "{}" from left to right, into "{0}", "{1}" as a translation wants them that needs
/// another order.
QString filledIn(const QString& sentence, const QStringList& parts);

}  // namespace relucent
