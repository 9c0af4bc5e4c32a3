// SPDX-License-Identifier: MIT
// Two pictures on either side of a divider.
#include "views/image_view.h"

#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

class TestImageView : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  /// Law: what is to be compared lies on both sides of the divider, wherever in the picture it is; and a
  /// divider that somebody has moved within it stays.
  void theDividerComesToWhatIsCompared_data() {
    QTest::addColumn<double>("left");
    QTest::addColumn<double>("right");
    QTest::addColumn<double>("middle");  // share of the view, in which the picture has a third beside it
    QTest::newRow("left of it") << 0.0 << 40.0 << 1.0 / 3 + 1.0 / 3 * 0.2;
    QTest::newRow("right of it") << 80.0 << 100.0 << 1.0 / 3 + 1.0 / 3 * 0.9;
    QTest::newRow("on both sides") << 10.0 << 60.0 << 0.5;
  }
  void theDividerComesToWhatIsCompared() {
    QFETCH(double, left);
    QFETCH(double, right);
    QFETCH(double, middle);
    ImageView view;
    view.resize(300, 100);
    view.divideWithin(left, right);
    QCOMPARE(view.divider(), 0.5);  // there is no picture
    QImage picture(100, 100, QImage::Format_RGB32);
    picture.fill(Qt::gray);
    view.setPicture(picture);
    view.setCompared(picture, "before", "after");
    view.divideWithin(left, right);
    QVERIFY2(std::abs(view.divider() - middle) < 0.01, qPrintable(QString::number(view.divider())));
    // The view, not the picture, is where somebody moves it.
    const double moved = 1.0 / 3 + 1.0 / 300 * (0.25 * left + 0.75 * right);
    view.setDivider(moved);
    view.divideWithin(left, right);
    QCOMPARE(view.divider(), moved);
  }
};

QTEST_MAIN(TestImageView)
#include "test_image_view.moc"
