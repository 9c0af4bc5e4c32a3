// SPDX-License-Identifier: MIT
#include "app/guide.h"

#include <QDir>
#include <QFile>
#include <QLocale>

namespace relucent::gui {
namespace {

QStringList filesOf(const QString& folder) {
  return QDir(folder).entryList({"*.md"}, QDir::Files, QDir::Name);
}

}  // namespace

Qt::LayoutDirection HelpPage::direction() const {
  return language.isEmpty() ? Qt::LayoutDirectionAuto : QLocale(language).textDirection();
}

QStringList guideLanguages(const QString& help) {
  QStringList languages;
  for (const QString& folder : QDir(help).entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name))
    if (!filesOf(help + '/' + folder).isEmpty()) languages << folder;
  return languages;
}

QList<HelpPage> guidePages(const QString& help, const QString& language) {
  QList<HelpPage> pages;
  for (const QString& name : filesOf(help + "/en")) {
    for (const QString& candidate : {language, language.section('_', 0, 0), QString("en")}) {
      QFile file(help + '/' + candidate + '/' + name);
      if (!file.open(QIODevice::ReadOnly)) continue;
      QString text = QString::fromUtf8(file.readAll());
      QString title = text.section('\n', 0, 0).remove('#').trimmed();
      pages.append({name.section('.', 0, 0), title, text, candidate});
      break;
    }
  }
  return pages;
}

}  // namespace relucent::gui
