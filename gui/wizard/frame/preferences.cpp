// SPDX-License-Identifier: MIT
#include "wizard/frame/preferences.h"

#include <QStandardPaths>
#include <algorithm>

namespace relucent::gui {
namespace {

constexpr const char* light = "look/light";
constexpr const char* dimmed = "look/dimmed";
constexpr const char* folderKey = "venues/folder";
constexpr const char* flashes = "measuring/changes_per_second";
constexpr const char* sound = "measuring/sound";
constexpr const char* leaving = "measuring/seconds_to_leave";
constexpr const char* languageKey = "look/language";
constexpr int quickestWithoutConsent = 3;
constexpr int usualSecondsToLeave = 30, mostSecondsToLeave = 600;

}  // namespace

Preferences::Preferences(QSettings& settings, QObject* parent) : QObject(parent), settings_(settings) {}

void Preferences::set(const char* key, const QVariant& value) {
  if (settings_.value(key) == value) return;
  settings_.setValue(key, value);
  Q_EMIT changed();
}

bool Preferences::isLight() const {
  return settings_.value(light, false).toBool();
}
void Preferences::setLight(bool wanted) {
  set(light, wanted);
}

bool Preferences::isDimmed() const {
  return settings_.value(dimmed, false).toBool();
}
void Preferences::setDimmed(bool wanted) {
  set(dimmed, wanted);
}

QString Preferences::folder() const {
  QString usual = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation) + "/Relucent";
  QString chosen = settings_.value(folderKey).toString();
  return chosen.isEmpty() ? usual : chosen;
}
void Preferences::setFolder(const QString& folder) {
  set(folderKey, folder);
}

int Preferences::flashLimit() const {
  return std::clamp(settings_.value(flashes, 0).toInt(), 0, quickestWithoutConsent);
}
void Preferences::setFlashLimit(int changesPerSecond) {
  set(flashes, changesPerSecond);
}

bool Preferences::hasSound() const {
  return settings_.value(sound, true).toBool();
}
void Preferences::setSound(bool wanted) {
  set(sound, wanted);
}

int Preferences::secondsToLeave() const {
  return std::clamp(settings_.value(leaving, usualSecondsToLeave).toInt(), 0, mostSecondsToLeave);
}
void Preferences::setSecondsToLeave(int seconds) {
  set(leaving, seconds);
}

QString Preferences::language() const {
  return settings_.value(languageKey).toString();
}
void Preferences::setLanguage(const QString& language) {
  set(languageKey, language);
}

}  // namespace relucent::gui
