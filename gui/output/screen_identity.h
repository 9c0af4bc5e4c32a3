// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QList>
#include <QScreen>
#include <QSize>
#include <QString>
#include <optional>

namespace relucent {

/// What a display is known by after it was unplugged, or the computer was started again: never its place in a
/// list, which changes.
struct ScreenIdentity {
  QString connector;  // the output that it hangs on: HDMI-1
  QString manufacturer;
  QString model;
  QString serialNumber;

  bool operator==(const ScreenIdentity&) const = default;
};

ScreenIdentity identityOf(const QScreen& screen);

/// Which of the displays that are there is the wanted one:
///  1. the one of that maker, model and serial number, wherever it is plugged in now;
///  2. where the display tells no serial number, or two tell the same, of those the one on the same
///  connector.
/// None of them is better than the wrong one: it may be the operator's.
std::optional<qsizetype> findScreen(const ScreenIdentity& wanted, const QList<ScreenIdentity>& present);

/// The same among the desktop's screens; nullptr if it is not there.
QScreen* findScreen(const ScreenIdentity& wanted);

/// The length in a display's own pixels of what the desktop scales by `ratio` and rounds to `scaled`. Of the
/// lengths that give the same, the one that more powers of two divide: displays are 1024 pixels wide, not
/// 1025.
int nativeLength(int scaled, double ratio);
/// A size on a desktop that scales by `ratio`, in its display's own pixels.
QSize nativeSize(QSize scaled, double ratio);
/// The screen's size in its own pixels, whatever the desktop's scaling.
QSize nativeSize(const QScreen& screen);

QJsonObject toJson(const ScreenIdentity& identity);
ScreenIdentity screenIdentityFrom(const QJsonObject& json);

}  // namespace relucent
