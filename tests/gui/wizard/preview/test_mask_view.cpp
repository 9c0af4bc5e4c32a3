// SPDX-License-Identifier: MIT
// Masks are drawn and changed in the picture, by mouse and by keys.
#include "wizard/preview/mask_view.h"

#include <QSignalSpy>
#include <QtTest>

using namespace relucent::compensation;
using namespace relucent::gui;

namespace {

const std::vector<Mask> masks{{0, Outline::lines, {{0.1, 0.1}, {0.3, 0.1}, {0.3, 0.3}, {0.1, 0.3}}, 0.02},
                              {0, Outline::curve, {{0.6, 0.6}, {0.9, 0.6}, {0.75, 0.9}}, 0.02}};

}  // namespace

class TestMaskView : public QObject {
  Q_OBJECT

  std::unique_ptr<MaskView> view_;

  QPoint at(double x, double y) const {
    return view_->widgetFromPicture({x * view_->picture().width(), y * view_->picture().height()}).toPoint();
  }
  void click(double x, double y) { QTest::mouseClick(view_.get(), Qt::LeftButton, {}, at(x, y)); }
  void key(int key, int times = 1, Qt::KeyboardModifiers with = {}) {
    for (int n = 0; n < times; ++n) QTest::keyClick(view_.get(), static_cast<Qt::Key>(key), with);
  }

 private slots:
  void init() {
    view_ = std::make_unique<MaskView>();
    view_->resize(400, 300);
    view_->setPicture(QImage(400, 300, QImage::Format_RGB32));
  }

  void clicksDrawAndTheFirstPointCloses() {
    QSignalSpy closed(view_.get(), &MaskView::closed);
    view_->setDrawing(true, Outline::lines);
    click(0.2, 0.2);
    click(0.2, 0.2);  // the same place twice is one point
    click(0.6, 0.2);
    click(0.2, 0.2);  // two points enclose nothing: it stays open
    QVERIFY(closed.isEmpty());
    view_->setDrawing(false, Outline::lines);
    QVERIFY(view_->drawn().empty());
    view_->setDrawing(true, Outline::lines);
    for (const auto& [x, y] : {std::pair(0.2, 0.2), {0.6, 0.2}, {0.6, 0.7}}) click(x, y);
    QCOMPARE(static_cast<int>(view_->drawn().size()), 3);
    click(0.21, 0.2);
    QCOMPARE(closed.size(), 1);
    const auto points = closed[0][0].value<MaskView::Points>();
    QCOMPARE(static_cast<int>(points.size()), 3);
    QVERIFY(std::abs(points[2][0] - 0.6) < 0.01 && std::abs(points[2][1] - 0.7) < 0.01);
  }

  void keysDraw() {
    QSignalSpy closed(view_.get(), &MaskView::closed), cancelled(view_.get(), &MaskView::cancelled);
    view_->setDrawing(true, Outline::curve);
    QVERIFY(view_->accessibleDescription().contains("200, 150"));
    key(Qt::Key_Space);
    key(Qt::Key_Right, 6, Qt::ShiftModifier);
    QVERIFY(view_->accessibleDescription().contains("260, 150"));
    key(Qt::Key_Space);
    key(Qt::Key_Down, 5, Qt::ShiftModifier);
    key(Qt::Key_Left, 7);
    key(Qt::Key_Space);
    key(Qt::Key_Up, 5);
    key(Qt::Key_Space);
    key(Qt::Key_Backspace);
    key(Qt::Key_Return);
    QCOMPARE(closed.size(), 1);
    const auto points = closed[0][0].value<MaskView::Points>();
    QCOMPARE(static_cast<int>(points.size()), 3);
    QVERIFY(std::abs(points[1][0] - 0.65) < 1e-9 && std::abs(points[2][0] - 253.0 / 400.0) < 1e-9 &&
            std::abs(points[2][1] - 200.0 / 300.0) < 1e-9);
    key(Qt::Key_Escape);
    QCOMPARE(cancelled.size(), 1);
  }

  void pointsAreDraggedAndStayInThePicture() {
    view_->setMasks(masks, 0);
    QSignalSpy moved(view_.get(), &MaskView::pointsMoved);
    QTest::mousePress(view_.get(), Qt::LeftButton, {}, at(0.3, 0.1));
    QCOMPARE(view_->activePoint(), 1);
    QTest::mouseMove(view_.get(), at(0.4, 0.2));
    QTest::mouseMove(view_.get(), at(0.4, 0.2) + QPoint(2000, 0));
    QTest::mouseRelease(view_.get(), Qt::LeftButton);
    QVERIFY(moved.size() >= 2);
    QCOMPARE(moved[0][0].toInt(), 0);
    QVERIFY(std::abs(moved[0][1].value<MaskView::Points>()[1][0] - 0.4) < 0.01);
    QCOMPARE(moved.last()[1].value<MaskView::Points>()[1][0], 1.0);
  }

  void keysMoveAndRemovePoints() {
    view_->setMasks(masks, 0);
    QSignalSpy moved(view_.get(), &MaskView::pointsMoved), removed(view_.get(), &MaskView::removed),
        picked(view_.get(), &MaskView::picked);
    key(Qt::Key_Tab, 2);
    QCOMPARE(view_->activePoint(), 1);
    QCOMPARE(view_->accessibleDescription(), QString("Point 2 of 4, 120, 30."));
    key(Qt::Key_Right);
    QVERIFY(std::abs(moved[0][1].value<MaskView::Points>()[1][0] - 121.0 / 400.0) < 1e-9);
    key(Qt::Key_Delete);
    QCOMPARE(static_cast<int>(moved[1][1].value<MaskView::Points>().size()), 3);
    QVERIFY(removed.isEmpty());
    // Without a point it is the mask that goes, and of three points none may go alone.
    key(Qt::Key_Delete);
    QCOMPARE(removed.size(), 1);
    view_->setMasks(masks, 1);
    key(Qt::Key_Tab);
    key(Qt::Key_Delete);
    QCOMPARE(removed.size(), 2);
    QCOMPARE(removed[1][0].toInt(), 1);
    key(Qt::Key_Escape, 2);
    QCOMPARE(picked.last()[0].toInt(), -1);
  }

  void aClickPicksAMask() {
    view_->setMasks(masks, -1);
    QSignalSpy picked(view_.get(), &MaskView::picked);
    click(0.75, 0.7);
    QCOMPARE(picked.size(), 1);
    QCOMPARE(picked[0][0].toInt(), 1);
    click(0.5, 0.5);
    QCOMPARE(picked.size(), 1);
  }

  void masksAreHatched() {
    view_->setMasks({}, -1);
    const QImage before = view_->grab().toImage();
    view_->setMasks(masks, -1);
    const QImage after = view_->grab().toImage();
    const auto changed = [&](const QRect& area) {
      int count = 0;
      for (int y = area.top(); y <= area.bottom(); ++y)
        for (int x = area.left(); x <= area.right(); ++x) count += before.pixel(x, y) != after.pixel(x, y);
      return static_cast<double>(count) / (area.width() * area.height());
    };
    QVERIFY(changed({at(0.15, 0.15), at(0.25, 0.25)}) > 0.05);
    QCOMPARE(changed({at(0.4, 0.2), at(0.5, 0.5)}), 0.0);
  }
};

QTEST_MAIN(TestMaskView)
#include "test_mask_view.moc"
