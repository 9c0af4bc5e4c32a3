// SPDX-License-Identifier: MIT
#pragma once

#include <QGuiApplication>
#include <QImage>
#include <QPixmap>
#include <QProcess>
#include <QScreen>
#include <QtTest>

#include "support/noise_picture.h"

/// The two screens of tests/support/with-two-screens: DUMMY0 is the operator's, DUMMY1 a projector's.
namespace relucent::gui {

inline QScreen* screenOn(const QString& connector) {
  for (QScreen* screen : QGuiApplication::screens())
    if (screen->name() == connector) return screen;
  return nullptr;
}

inline void xrandr(const QStringList& arguments) {
  QCOMPARE(QProcess::execute("xrandr", arguments), 0);
}
inline void unplug() {
  xrandr({"--output", "DUMMY1", "--off"});
  QTRY_VERIFY(screenOn("DUMMY1") == nullptr);
}
inline void plug() {
  xrandr({"--output", "DUMMY1", "--mode", "1024x768", "--right-of", "DUMMY0"});
  QTRY_VERIFY(screenOn("DUMMY1") != nullptr);
}

inline void xset(const QStringList& arguments) {
  QCOMPARE(QProcess::execute("xset", arguments), 0);
}
/// Ways to put displays to sleep, for xset: by the screen saver, and by DPMS where the server has it.
inline void addWaysToSleep() {
  QTest::addColumn<QStringList>("sleep");
  QTest::addColumn<QStringList>("wake");
  QTest::newRow("screen saver") << QStringList{"s", "activate"} << QStringList{"s", "reset"};
  for (const char* level : {"standby", "suspend", "off"})
    QTest::newRow(level) << QStringList{"dpms", "force", level} << QStringList{"dpms", "force", "on"};
}
/// Why the displays cannot be put to sleep so; empty: they can.
inline QString whyNoSleep(const QStringList& sleep) {
  if (sleep.front() != "dpms") return {};
  QProcess query;
  query.start("xset", {"q"});
  if (!query.waitForFinished() || query.readAllStandardOutput().contains("not have the DPMS Extension"))
    return "the X server's driver has no DPMS";
  return {};
}

/// How often a test unplugs the projector: $RELUCENT_UNPLUG_CYCLES, or as often as there is time for usually.
inline int unplugCycles(int usually) {
  bool given = false;
  int cycles = qEnvironmentVariableIntValue("RELUCENT_UNPLUG_CYCLES", &given);
  return given ? cycles : usually;
}

using test::noise;

/// What stands on a screen now.
inline QImage seenOn(const QString& connector) {
  QScreen* screen = screenOn(connector);
  if (screen == nullptr) return {};
  return screen->grabWindow(0).toImage().convertToFormat(QImage::Format_RGB32);
}

inline bool allBlack(const QImage& image) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if ((image.pixel(x, y) & 0xffffffu) != 0) return false;
  return !image.isNull();
}

}  // namespace relucent::gui
