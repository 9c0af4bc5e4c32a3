// SPDX-License-Identifier: MIT
// A column whose lines come and go while somebody works in it.
#include "wizard/frame/steady_scroll.h"

#include <QCursor>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QScrollBar>
#include <QVBoxLayout>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

/// A dozen buttons in parts of three, each part with a line above that may be seen or not.
class Column : public SteadyScroll {
 public:
  Column() {
    auto* inside = new QWidget;
    auto* column = new QVBoxLayout(inside);
    for (int part = 0; part < 4; ++part) {
      auto* group = new QWidget;
      auto* rows = new QVBoxLayout(group);
      rows->addWidget(lines.emplace_back(new QLabel("first\nsecond\nthird")));
      lines.back()->hide();
      for (int i = 0; i < 3; ++i) rows->addWidget(buttons.emplace_back(new QPushButton("press")));
      column->addWidget(group);
    }
    column->addStretch(1);
    setWidget(inside);
    resize(300, 160);
    QCursor::setPos(QGuiApplication::primaryScreen()->geometry().bottomRight());  // nobody is in it
    show();
  }
  int placeOf(std::size_t button) const { return buttons[button]->mapToGlobal(QPoint(0, 0)).y(); }
  void pointAt(const QWidget& widget) const { QCursor::setPos(widget.mapToGlobal(widget.rect().center())); }
  void settle() const { QCoreApplication::processEvents(); }
  /// Until it is laid out anew.
  void setSeen(QLabel* line, bool isSeen) const {
    const int before = widget()->height();
    line->setVisible(isSeen);
    QTRY_VERIFY(widget()->height() != before);
  }
  std::vector<QLabel*> lines;
  std::vector<QPushButton*> buttons;
};

}  // namespace

class TestSteadyScroll : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// Law: what somebody points at stays under the pointer, whatever comes and goes above or below it.
  void whatIsPointedAtStays_data() {
    QTest::addColumn<int>("button");
    QTest::addColumn<int>("line");
    QTest::newRow("above, in another part") << 4 << 0;
    QTest::newRow("above, in the same part") << 4 << 1;
    QTest::newRow("below") << 4 << 2;
    QTest::newRow("above, far down") << 9 << 0;
  }
  void whatIsPointedAtStays() {
    QFETCH(int, button);
    QFETCH(int, line);
    Column column;
    QVERIFY(QTest::qWaitForWindowExposed(&column));
    const auto at = static_cast<std::size_t>(button);
    column.ensureWidgetVisible(column.buttons[at]);
    column.pointAt(*column.buttons[at]);
    column.settle();
    const int before = column.placeOf(at);
    for (bool isSeen : {true, false, true}) {
      column.setSeen(column.lines[static_cast<std::size_t>(line)], isSeen);
      QCOMPARE(column.placeOf(at), before);
    }
  }

  /// With the pointer elsewhere it is the focus that stays; and without either, what is seen first, unless
  /// that is the column's beginning.
  void elseTheFocusOrWhatIsFirst() {
    Column column;
    QVERIFY(QTest::qWaitForWindowActive(&column));
    QCursor::setPos(column.mapToGlobal(QPoint(column.width() + 50, column.height() + 50)));
    if (QWidget* focus = QApplication::focusWidget()) focus->clearFocus();
    column.settle();
    const int top = column.placeOf(0);
    column.setSeen(column.lines[0], true);
    QCOMPARE_GT(column.placeOf(0), top);  // what came is seen
    column.ensureWidgetVisible(column.buttons[7]);
    column.settle();
    const int first = column.placeOf(7);
    column.setSeen(column.lines[1], true);
    QCOMPARE(column.placeOf(7), first);
    column.verticalScrollBar()->setValue(0);
    column.buttons[2]->setFocus();
    column.setSeen(column.lines[0], false);
    const int focused = column.placeOf(2);
    column.setSeen(column.lines[0], true);
    QCOMPARE(column.placeOf(2), focused);
  }

  /// Wherever the pointer was left: what comes at the top of a page that is opened is seen.
  void whoeverIsNotThereYetSeesTheTop() {
    Column column;
    QVERIFY(QTest::qWaitForWindowExposed(&column));
    column.pointAt(*column.buttons[1]);
    column.hide();
    column.show();
    QVERIFY(QTest::qWaitForWindowExposed(&column));
    column.setSeen(column.lines[0], true);
    QCOMPARE(column.verticalScrollBar()->value(), 0);
  }

  /// Each visit begins at the top.
  void aVisitBeginsAtTheTop() {
    Column column;
    QVERIFY(QTest::qWaitForWindowExposed(&column));
    column.ensureWidgetVisible(column.buttons[9]);
    QCOMPARE_GT(column.verticalScrollBar()->value(), 0);
    column.hide();
    column.show();
    QCOMPARE(column.verticalScrollBar()->value(), 0);
  }
};

QTEST_MAIN(TestSteadyScroll)
#include "test_steady_scroll.moc"
