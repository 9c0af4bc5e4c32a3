// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QString>
#include <QStringList>
#include <Qt>

namespace relucent {

/// A page of the user's guide.
struct HelpPage {
  QString id;        // of the file: "03-linearize"
  QString title;     // its heading
  QString text;      // Markdown
  QString language;  // that it is written in: "de", "zh_CN"; empty where it is in several

  /// The side to read from; auto: each paragraph's own.
  Qt::LayoutDirection direction() const;
};

/// Languages that the guide in the folder `help` (`help`/LANGUAGE/*.md) is written in, sorted.
QStringList guideLanguages(const QString& help);

/// The pages of English, which has them all, in their order; each in `language` ("de_AT"), else in the
/// language without its country ("de"), else in English.
QList<HelpPage> guidePages(const QString& help, const QString& language);

}  // namespace relucent
