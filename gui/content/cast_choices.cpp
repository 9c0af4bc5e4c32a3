// SPDX-License-Identifier: MIT
#include "content/cast_choices.h"

#include <QSettings>
#include <QUrl>

namespace relucent::gui {
namespace {

QString keyOf(const QString& path) {
  return "casts/" + QString::fromLatin1(QUrl::toPercentEncoding(path));
}

/// The wizard's, by whatever name the program goes.
struct Settings : QSettings {
  Settings() : QSettings("relucent", "relucent") {}
};

}  // namespace

QString castChoice(const QString& path) {
  return Settings().value(keyOf(path)).toString();
}

void keepCastChoice(const QString& path, const QString& token) {
  Settings settings;
  if (token.isEmpty())
    settings.remove(keyOf(path));
  else
    settings.setValue(keyOf(path), token);
}

QString unusedCast(const QString& kind, const QStringList& taken) {
  for (int number = 1;; ++number)
    if (const QString path = kind + QString::number(number);
        !taken.contains(path) && castChoice(path).isEmpty())
      return path;
}

}  // namespace relucent::gui
