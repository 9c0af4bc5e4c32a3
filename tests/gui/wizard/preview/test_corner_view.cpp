// SPDX-License-Identifier: MIT
// Words over the picture leave the corners' handles free.
#include "wizard/preview/corner_view.h"

#include <QFocusEvent>
#include <QtTest>

#include "views/view_tag.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

Q_DECLARE_METATYPE(Corners)

class TestCornerView : public QObject {
  Q_OBJECT

 private slots:
  void aTagGoesWhereItIsInNobodysWay() {
    std::vector<QPointF> places{{0, 0}, {100, 0}, {0, 100}};
    QSizeF size(50, 20);
    QCOMPARE(tagBox(size, places, {}).topLeft(), places[0]);
    QCOMPARE(tagBox(size, places, {{40, 10, 20, 20}}).topLeft(), places[1]);
    QCOMPARE(tagBox(size, places, {{0, 0, 10, 10}, {90, 0, 20, 5}}).topLeft(), places[2]);
    // Nowhere is free: better read than not.
    QCOMPARE(tagBox(size, places, {{0, 0, 200, 200}}).topLeft(), places[0]);
  }

  void wordsLeaveHandlesFree_data() {
    QTest::addColumn<Corners>("corners");
    auto upright = [](double left, double top, double right, double bottom) {
      return Corners{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}};
    };
    QTest::newRow("all of the view") << upright(0, 0, 400, 300);
    QTest::newRow("lower left") << upright(10, 150, 200, 290);
    QTest::newRow("a corner at the divider") << upright(190, 12, 390, 200);
    QTest::newRow("beside it at the left") << upright(20, 16, 170, 200);
    QTest::newRow("inside") << upright(100, 80, 300, 220);
  }
  void wordsLeaveHandlesFree() {
    QFETCH(Corners, corners);
    CornerView view;
    view.resize(400, 300);
    QImage picture(400, 300, QImage::Format_RGB32);
    view.setPicture(picture);
    view.setCompared(picture, "Uncorrected", "Corrected, predicted");
    view.setCorners(corners);
    QFocusEvent byTab(QEvent::FocusIn, Qt::TabFocusReason);
    QCoreApplication::sendEvent(&view, &byTab);
    QCOMPARE(view.active(), 0);
    for (int handle = 0; handle < 4; ++handle) {
      QRectF area = view.handleArea(handle);
      QVERIFY(area.contains(view.widgetFromPicture(
          {corners[static_cast<std::size_t>(handle)][0], corners[static_cast<std::size_t>(handle)][1]})));
      for (QRectF tag : {view.cornerTag(), view.dividerTag(false), view.dividerTag(true)})
        QVERIFY2(!tag.intersects(area), qPrintable(QString("handle %1, a tag at %2, %3, %4 wide")
                                                       .arg(handle)
                                                       .arg(tag.left())
                                                       .arg(tag.top())
                                                       .arg(tag.width())));
    }
    QVERIFY(!view.cornerTag().intersects(view.dividerTag(false)) &&
            !view.cornerTag().intersects(view.dividerTag(true)));
    QVERIFY(QRectF(view.rect()).contains(view.cornerTag()));
  }
};

QTEST_MAIN(TestCornerView)
#include "test_corner_view.moc"
