// SPDX-License-Identifier: MIT
#include "wizard/frame/undoable.h"

#include <QUndoStack>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;
using namespace std::chrono_literals;

class TestUndoable : public QObject {
  Q_OBJECT

  int value_ = 0;
  Undoable<int>::Clock::time_point now_{};

  Undoable<int>* change(const char* name, int to) {
    return new Undoable<int>(name, value_, to, [this](int wanted) { value_ = wanted; }, now_);
  }

 private slots:
  void init() { value_ = 0; }

  void aSlidersChangesAreOne() {
    QUndoStack stack;
    for (int to : {1, 2, 3}) {
      stack.push(change("Brightness", to));
      now_ += 100ms;
    }
    QCOMPARE(value_, 3);
    QCOMPARE(stack.count(), 1);
    stack.undo();
    QCOMPARE(value_, 0);
    stack.redo();
    QCOMPARE(value_, 3);
  }

  void aPauseOrAnotherNameBeginsAnother() {
    QUndoStack stack;
    stack.push(change("Brightness", 1));
    now_ += Undoable<int>::quick + 1ms;
    stack.push(change("Brightness", 2));
    stack.push(change("Lift", 3));
    QCOMPARE(stack.count(), 3);
    for (int expected : {2, 1, 0}) {
      stack.undo();
      QCOMPARE(value_, expected);
    }
    stack.undo();  // nothing is left
    QCOMPARE(value_, 0);
  }

  void anotherChangeEndsWhatCouldBeRedone() {
    QUndoStack stack;
    stack.push(change("Brightness", 1));
    stack.undo();
    stack.push(change("Lift", 5));
    QVERIFY(!stack.canRedo());
    QCOMPARE(value_, 5);
  }
};

QTEST_GUILESS_MAIN(TestUndoable)
#include "test_undoable.moc"
