// SPDX-License-Identifier: MIT
#include "theme/folding_rows.h"

#include <QWidget>
#include <QtTest>

using namespace relucent::gui;

class TestFoldingRows : public QObject {
  Q_OBJECT

  QWidget window_;
  FoldingRows* rows_ = new FoldingRows(&window_);
  std::vector<QWidget*> cards_;

  QWidget* card() {
    cards_.push_back(new QWidget);
    cards_.back()->setMinimumSize(200, 100);
    return cards_.back();
  }
  void layOut(QSize size) { rows_->setGeometry(QRect(QPoint(), size)); }

 private slots:
  void initTestCase() {
    QWidget *first = card(), *second = card(), *third = card();
    rows_->addRow({first, second}, 5);
    rows_->addRow({third}, 3);
    rows_->setFoldedHeight(150);
    for (QWidget* each : cards_) each->show();
  }

  /// Law: what has the room stands beside each other, with heights by their shares.
  void withRoomThereAreRows() {
    const QSize size(408 + rows_->spacing(), 800 + rows_->spacing());
    QVERIFY(!rows_->isFoldedAt(size.width()));
    layOut(size);
    QCOMPARE(cards_[0]->geometry(), QRect(0, 0, 204, 500));
    QCOMPARE(cards_[1]->geometry(), QRect(204 + rows_->spacing(), 0, 204, 500));
    QCOMPARE(cards_[2]->geometry(), QRect(0, 500 + rows_->spacing(), size.width(), 300));
  }
  /// Law: no card is wider than there is room, nor lower than it can be, and none covers another.
  void withoutRoomTheyAreBelowEachOther_data() {
    QTest::addColumn<int>("width");
    QTest::newRow("a pixel too narrow") << 399 + rows_->spacing();
    QTest::newRow("narrow") << 250;
    QTest::newRow("least") << 200;
  }
  void withoutRoomTheyAreBelowEachOther() {
    QFETCH(int, width);
    QVERIFY(rows_->isFoldedAt(width) && rows_->minimumSize().width() <= width);
    layOut({width, rows_->minimumHeightForWidth(width)});
    int top = 0;
    for (const QWidget* each : cards_) {
      QCOMPARE(each->geometry(), QRect(0, top, width, 150));
      top += 150 + rows_->spacing();
    }
    QCOMPARE(rows_->minimumHeightForWidth(width), top - rows_->spacing());
  }
  /// Law: none is lower than it can be for the others' sake.
  void theLeastHeightIsKept() {
    layOut({600, 240 + rows_->spacing()});
    QCOMPARE(cards_[0]->height(), 140);
    QCOMPARE(cards_[2]->height(), 100);
  }
  void itIsMirrored() {
    window_.setLayoutDirection(Qt::RightToLeft);
    layOut({408 + rows_->spacing(), 800});
    QCOMPARE(cards_[1]->x(), 0);
    QVERIFY(cards_[0]->x() > cards_[1]->x());
    window_.setLayoutDirection(Qt::LeftToRight);
  }
};

QTEST_MAIN(TestFoldingRows)
#include "test_folding_rows.moc"
