// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QList>
#include <QScreen>
#include <QSize>
#include <QString>
#include <optional>

namespace relucent::gui {

/// Identifies a display after it was unplugged or the computer was restarted: never by its place in a list,
/// which changes.
struct ScreenIdentity {
  QString connector;  // the output that it is connected to: HDMI-1
  QString manufacturer;
  QString model;
  QString serialNumber;

  bool operator==(const ScreenIdentity&) const = default;
};

ScreenIdentity identityOf(const QScreen& screen);

/// Finds a display among those present:
///  1. the one of that maker, model and serial number, wherever it is plugged in now;
///  2. if it has no serial number, or two have the same one, the one of those on the same
///  connector.
/// None is better than the wrong one, which may be the operator's.
std::optional<qsizetype> findScreen(const ScreenIdentity& wanted, const QList<ScreenIdentity>& present);

/// The same among the desktop's screens; nullptr if it is absent.
QScreen* findScreen(const ScreenIdentity& wanted);

/// The length in a display's physical pixels that the desktop scales by `ratio` and rounds to `scaled`. Of
/// several such lengths the one divisible by the largest power of two: displays are 1024 pixels wide, not
/// 1025.
int nativeLength(int scaled, double ratio);
/// A size on a desktop that scales by `ratio`, in the display's physical pixels.
QSize nativeSize(QSize scaled, double ratio);
/// The screen's size in physical pixels, independent of the desktop's scaling: the display's mode where the
/// desktop tells it.
QSize nativeSize(const QScreen& screen);

QJsonObject toJson(const ScreenIdentity& identity);
ScreenIdentity screenIdentityFrom(const QJsonObject& json);

}  // namespace relucent::gui
