// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QString>
#include <QStringList>
#include <Qt>

namespace relucent::gui {

/// A page of the user's guide.
struct HelpPage {
  QString id;        // of the file: "03-linearize"
  QString title;     // its heading
  QString text;      // Markdown
  QString language;  // language of the page: "de", "zh_CN"; empty for a mixture

  /// Reading direction; auto: by paragraph.
  Qt::LayoutDirection direction() const;
};

/// Languages that the guide in the folder `help` (`help`/LANGUAGE/*.md) is written in, sorted.
QStringList guideLanguages(const QString& help);

/// All pages in the order of the English guide, which is complete; each in `language` ("de_AT"), else in the
/// language without its country ("de"), else in English.
QList<HelpPage> guidePages(const QString& help, const QString& language);

}  // namespace relucent::gui
