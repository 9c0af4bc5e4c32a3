// SPDX-License-Identifier: MIT
#pragma once

#include <QGuiApplication>
#include <QImage>
#include <QProcess>
#include <QScreen>
#include <QtTest>

#include "support/screencopy.h"

/// The two outputs of tests/support/with-two-outputs: HEADLESS-1 is the operator's, HEADLESS-2 a projector's.
namespace relucent::gui {

inline QScreen* outputOf(const QString& connector) {
  for (QScreen* screen : QGuiApplication::screens())
    if (screen->name() == connector) return screen;
  return nullptr;
}

/// What the compositor is told to do.
inline void sway(const QStringList& command) {
  QProcess tell;
  tell.start("swaymsg", command);
  QVERIFY(tell.waitForFinished());
  QVERIFY2(tell.exitCode() == 0, tell.readAllStandardOutput() + tell.readAllStandardError());
}
/// false: the compositor cannot; outputs without hardware are always there before wlroots 0.16.
inline bool unplugOutput() {
  sway({"output", "HEADLESS-2", "disable"});
  if (QTest::qWaitFor([] { return outputOf("HEADLESS-2") == nullptr; }, 2000)) return true;
  sway({"output", "HEADLESS-2", "enable"});  // else it would come to that later
  return false;
}
inline void plugOutput() {
  sway({"output", "HEADLESS-2", "enable"});
  QTRY_VERIFY(outputOf("HEADLESS-2") != nullptr);
}

/// What an output shows now, in its own pixels.
inline QImage shownOn(const QString& connector) {
  const tests::OutputPicture shown = tests::pictureOfOutput(connector.toStdString());
  return QImage(reinterpret_cast<const uchar*>(shown.pixels.data()), shown.width, shown.height,
                QImage::Format_RGB32)
      .copy();
}

}  // namespace relucent::gui
