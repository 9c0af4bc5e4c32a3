// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QSettings>
#include <QString>

namespace relucent::gui {

/// What the user prefers, whatever is open. Kept by the desktop's settings as soon as it is set.
class Preferences : public QObject {
  Q_OBJECT

 public:
  /// `settings` outlives this.
  explicit Preferences(QSettings& settings, QObject* parent = nullptr);

  bool isLight() const;
  void setLight(bool light);
  bool isDimmed() const;
  void setDimmed(bool dimmed);
  /// Where new calibrations are kept.
  QString folder() const;
  void setFolder(const QString& folder);
  /// Patterns a second at most, while real devices measure; 0: as quickly as they can, after a consent.
  int flashLimit() const;
  void setFlashLimit(int changesPerSecond);
  /// A sound when a measurement ends or needs somebody.
  bool hasSound() const;
  void setSound(bool sound);
  /// What real devices wait for before they measure, so that whoever starts it can leave the room.
  int secondsToLeave() const;
  void setSecondsToLeave(int seconds);
  /// "de"; empty: the computer's.
  QString language() const;
  void setLanguage(const QString& language);

 Q_SIGNALS:
  void changed();

 private:
  void set(const char* key, const QVariant& value);
  QSettings& settings_;
};

}  // namespace relucent::gui
