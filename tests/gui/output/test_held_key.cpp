// SPDX-License-Identifier: MIT
// A key that counts once it was held.
#include "output/held_key.h"

#include <QElapsedTimer>
#include <QKeyEvent>
#include <QSignalSpy>
#include <QTimer>
#include <QWindow>
#include <QtTest>

using namespace relucent::gui;

namespace {

constexpr std::chrono::milliseconds enough{60};

void send(QWindow& window, QEvent::Type type, int key = Qt::Key_Escape, bool isRepeated = false) {
  QKeyEvent event(type, key, Qt::NoModifier, {}, isRepeated);
  QCoreApplication::sendEvent(&window, &event);
}

}  // namespace

class TestHeldKey : public QObject {
  Q_OBJECT

 private slots:
  /// Law: it counts once, when it was held for long enough, however the keyboard repeats it.
  void aKeyThatIsHeldCountsOnce_data() {
    QTest::addColumn<bool>("isTold");
    QTest::newRow("repeats are told") << true;
    QTest::newRow("let go of and pressed at once, as some X servers repeat") << false;
  }
  void aKeyThatIsHeldCountsOnce() {
    QFETCH(bool, isTold);
    QWindow window;
    HeldKey escape(Qt::Key_Escape, enough);
    escape.watch(window);
    QSignalSpy held(&escape, &HeldKey::held);
    QElapsedTimer time;
    time.start();
    send(window, QEvent::KeyPress);
    QCOMPARE(held.size(), 0);
    QTimer repeating;
    connect(&repeating, &QTimer::timeout, &window, [&window, isTold] {
      send(window, QEvent::KeyRelease, Qt::Key_Escape, isTold);
      send(window, QEvent::KeyPress, Qt::Key_Escape, isTold);
    });
    repeating.start(enough / 4);
    QTRY_COMPARE(held.size(), 1);
    QVERIFY(time.elapsed() >= enough.count() - 1);
    QTest::qWait(2 * enough.count());
    repeating.stop();
    send(window, QEvent::KeyPress, Qt::Key_Escape, true);
    send(window, QEvent::KeyRelease);
    QTest::qWait(2 * enough.count());
    QCOMPARE(held.size(), 1);
  }

  void aKeyGoesDownAndUpOnce_data() { aKeyThatIsHeldCountsOnce_data(); }
  /// Law: between its going down and up a key is down, however the keyboard repeats it.
  void aKeyGoesDownAndUpOnce() {
    QFETCH(bool, isTold);
    QWindow window;
    HeldKey original(Qt::Key_A);
    original.watch(window);
    QSignalSpy pressed(&original, &HeldKey::pressed), released(&original, &HeldKey::released);
    send(window, QEvent::KeyPress, Qt::Key_A);
    QVERIFY(pressed.size() == 1 && original.isDown());
    for (int repeat = 0; repeat < 8; ++repeat) {
      QTest::qWait(10);
      send(window, QEvent::KeyRelease, Qt::Key_A, isTold);
      send(window, QEvent::KeyPress, Qt::Key_A, isTold);
    }
    QVERIFY(pressed.size() == 1 && released.isEmpty());
    send(window, QEvent::KeyRelease, Qt::Key_A);
    QTRY_COMPARE(released.size(), 1);
    QVERIFY(!original.isDown());
    // Another window has the keys: it is not heard of any more.
    send(window, QEvent::KeyPress, Qt::Key_A);
    QEvent away(QEvent::WindowDeactivate);
    QCoreApplication::sendEvent(&window, &away);
    QVERIFY(pressed.size() == 2 && released.size() == 2);
  }

  void whatIsLetGoOfDoesNotCount_data() {
    QTest::addColumn<QList<int>>("events");
    QTest::newRow("let go of") << QList<int>{QEvent::KeyRelease};
    QTest::newRow("another window") << QList<int>{QEvent::FocusOut};
    QTest::newRow("hidden") << QList<int>{QEvent::Hide};
  }
  void whatIsLetGoOfDoesNotCount() {
    QFETCH(QList<int>, events);
    QWindow window;
    HeldKey escape(Qt::Key_Escape, enough);
    escape.watch(window);
    QSignalSpy held(&escape, &HeldKey::held);
    send(window, QEvent::KeyPress);
    for (int type : events) {
      if (type == QEvent::KeyRelease) {
        send(window, QEvent::KeyRelease);
        continue;
      }
      QEvent event(static_cast<QEvent::Type>(type));
      QCoreApplication::sendEvent(&window, &event);
    }
    QTest::qWait(3 * enough.count());
    QCOMPARE(held.size(), 0);
  }

  void otherKeysDoNotCount() {
    QWindow window;
    HeldKey escape(Qt::Key_Escape, enough);
    escape.watch(window);
    QSignalSpy held(&escape, &HeldKey::held);
    send(window, QEvent::KeyPress, Qt::Key_B);
    QTest::qWait(3 * enough.count());
    QCOMPARE(held.size(), 0);
  }
};

QTEST_MAIN(TestHeldKey)
#include "test_held_key.moc"
