// SPDX-License-Identifier: MIT
#include "views/map_view.h"

#include <QLabel>
#include <QVBoxLayout>
#include <QtTest>
#include <cmath>
#include <limits>

#include "theme/tokens.h"
#include "views/view_tag.h"
#include "views/vtk_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;

namespace {

/// Pixel (x, y) is red x and green y, so that each says where it is from.
QImage numbered(QSize size) {
  QImage image(size, QImage::Format_RGB32);
  for (int y = 0; y < size.height(); ++y)
    for (int x = 0; x < size.width(); ++x) image.setPixel(x, y, qRgb(x, y, 0));
  return image;
}

class OpenedView : public MapView {
 public:
  using MapView::vtk;
};

/// With a picture that fills a part of it only.
class FramedView : public MapView {
 public:
  explicit FramedView(QRectF frame) : frame_(frame) {}
  QRectF frame() const override { return frame_; }

 private:
  QRectF frame_;
};

}  // namespace

class TestMapView : public QObject {
  Q_OBJECT

  static void open(MapView& view, QSize size = {400, 300}) {
    view.resize(size);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
  }
  static QColor drawnAt(OpenedView& view, QPointF pixel) {
    QPointF place = view.widgetFromPicture(pixel) * view.devicePixelRatioF();
    return view.vtk()->drawn().pixelColor(QPoint(static_cast<int>(place.x()), static_cast<int>(place.y())));
  }

 private slots:
  /// Law: words about a pick are whole, also where the picture is narrower or lower than they are.
  void wordsAreNotCutByASmallPicture_data() {
    QTest::addColumn<QRectF>("frame");
    QTest::addColumn<QPoint>("pick");
    for (auto [name, frame] : {std::pair("narrow", QRectF(190, 20, 20, 260)),
                               {"low", QRectF(20, 140, 360, 30)},
                               {"at the lower edge", QRectF(20, 260, 360, 30)}})
      for (QPoint pick : {QPoint(0, 0), QPoint(5, 4), QPoint(9, 9)})
        QTest::addRow("%s, %d", name, pick.x()) << frame << pick;
  }
  void wordsAreNotCutByASmallPicture() {
    QFETCH(QRectF, frame);
    QFETCH(QPoint, pick);
    FramedView view(frame);
    open(view);
    view.setPicture(numbered({10, 10}));
    const QString words = "camera 12, 34\nprojector 5, 67\n0.0123";
    view.setReadout([words](QPoint) { return words; });
    const QImage before = view.grab().toImage();
    view.link().setPick(pick);
    const QImage after = view.grab().toImage();
    QRect changed;
    for (int y = 0; y < after.height(); ++y)
      for (int x = 0; x < after.width(); ++x)
        if (after.pixel(x, y) != before.pixel(x, y)) changed |= QRect(x, y, 1, 1);
    const QSizeF seen = QSizeF(changed.size()) / view.devicePixelRatioF(), needed = tagSize(words);
    QVERIFY2(seen.width() >= needed.width() - 1.0 && seen.height() >= needed.height() - 1.0,
             qPrintable(QString("%1 x %2").arg(seen.width()).arg(seen.height())));
  }

  void everyPixelIsWhereItBelongs_data() {
    QTest::addColumn<QSize>("picture");
    QTest::addColumn<double>("zoom");
    QTest::addColumn<QPointF>("centre");
    QTest::newRow("whole") << QSize(40, 30) << 1.0 << QPointF(0.5, 0.5);
    QTest::newRow("wide") << QSize(64, 3) << 1.0 << QPointF(0.5, 0.5);
    QTest::newRow("high") << QSize(5, 60) << 1.0 << QPointF(0.5, 0.5);
    QTest::newRow("corner") << QSize(40, 30) << 7.0 << QPointF(0.0, 1.0);
    QTest::newRow("near") << QSize(200, 150) << 30.0 << QPointF(0.3, 0.6);
    QTest::newRow("one pixel") << QSize(1, 1) << 1.0 << QPointF(0.5, 0.5);
  }
  void everyPixelIsWhereItBelongs() {
    QFETCH(QSize, picture);
    QFETCH(double, zoom);
    QFETCH(QPointF, centre);
    OpenedView view;
    open(view);
    QVERIFY(view.vtk() != nullptr && view.vtk()->works());
    view.setScale({ColourMap::cividis, 0.0, 1.0, false}, "unit", false);  // shown as they are, not dimmed
    view.setPicture(numbered(picture));
    view.link().look(zoom, centre);
    QImage drawn = view.vtk()->drawn();
    double ratio = view.devicePixelRatioF();
    int compared = 0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        QPointF place = view.widgetFromPicture({x + 0.5, y + 0.5});
        if (view.pixelAt(place) != QPoint(x, y)) continue;
        QColor found =
            drawn.pixelColor(static_cast<int>(place.x() * ratio), static_cast<int>(place.y() * ratio));
        QCOMPARE(found, QColor(x, y, 0));
        ++compared;
      }
    QVERIFY(compared > 0);
  }

  void whatLiesOverItIsMixed() {
    OpenedView view;
    open(view);
    view.setScale({ColourMap::cividis, 0.0, 1.0, false}, "unit", false);
    QImage ground(4, 4, QImage::Format_RGB32);
    ground.fill(Qt::black);
    QImage over(4, 4, QImage::Format_ARGB32);
    over.fill(Qt::transparent);
    over.setPixelColor(2, 1, QColor(255, 255, 255, 255));
    view.setPicture(ground);
    view.setOverlay(over);
    QCOMPARE(drawnAt(view, {2.5, 1.5}), QColor(Qt::white));
    QCOMPARE(drawnAt(view, {1.5, 1.5}), QColor(Qt::black));
  }

  void aClickPicksInAllLinkedViews() {
    ViewLink link;
    OpenedView first, second;
    for (OpenedView* view : {&first, &second}) {
      view->setLink(&link);
      open(*view, view == &first ? QSize(400, 300) : QSize(301, 411));
      view->setPicture(numbered({40, 30}));
    }
    link.look(3.0, {0.4, 0.4});
    QTest::mouseClick(&first, Qt::LeftButton, {}, first.widgetFromPicture({17.5, 11.5}).toPoint());
    QCOMPARE(*second.link().pick(), QPoint(17, 11));
    QTest::keyClick(&second, Qt::Key_Left);
    QCOMPARE(*first.link().pick(), QPoint(16, 11));
    QCOMPARE(first.link().zoom(), second.link().zoom());
  }

  void theColourBarIsThere() {
    OpenedView view;
    open(view);
    view.setPicture(numbered({40, 30}));
    view.setScale({ColourMap::viridis, 1e-4, 1.0, true}, "unit", false);
    QImage drawn = view.vtk()->drawn();
    double ratio = view.devicePixelRatioF();
    // Somewhere in the bar's area, its upper and its lower colours.
    auto has = [&](const QColor& wanted) {
      for (int y = 0; y < drawn.height(); ++y)
        for (int x = static_cast<int>(330 * ratio); x < drawn.width(); ++x) {
          QColor found = drawn.pixelColor(x, y);
          if (std::abs(found.red() - wanted.red()) + std::abs(found.green() - wanted.green()) +
                  std::abs(found.blue() - wanted.blue()) <
              9)
            return true;
        }
      return false;
    };
    for (double place : {0.02, 0.5, 0.98}) QVERIFY(has(qtColourAt(ColourMap::viridis, place)));
  }

  void aMapRisesAndLiesDownAgain() {
    OpenedView view;
    open(view);
    QVERIFY(!view.canRise());
    view.setRelief(true);
    QVERIFY(!view.isRelief());
    Size size{40, 30};
    Image values(size, 1);
    for (std::size_t i = 0; i < size.count(); ++i) values.data()[i] = static_cast<float>(i % 40) / 40.0f;
    values.at(3, 3, 0) = std::numeric_limits<float>::quiet_NaN();
    ColourScale scale{ColourMap::cividis, 0.0, 1.0, false};
    view.setPicture(mapped(values.data(), size, scale));
    view.setScale(scale, "unit", true);
    view.setValues(values);
    QImage flat = view.vtk()->drawn();
    view.setRelief(true);
    QVERIFY(view.isRelief());
    QImage risen = view.vtk()->drawn();
    QVERIFY(risen != flat);
    QTest::keyClick(&view, Qt::Key_Left);
    QImage turned = view.vtk()->drawn();
    QVERIFY(turned != risen);
    // The mouse is VTK's now.
    QTest::mousePress(view.vtk(), Qt::LeftButton, {}, {150, 150});
    QTest::mouseMove(view.vtk(), {190, 160});
    QTest::mouseRelease(view.vtk(), Qt::LeftButton, {}, {190, 160});
    QVERIFY(view.vtk()->drawn() != turned);
    QTest::keyClick(&view, Qt::Key_0);
    QCOMPARE(view.vtk()->drawn(), risen);
    view.setRelief(false);
    QCOMPARE(view.vtk()->drawn(), flat);
  }

  void aMapWithoutAnyValueRises() {
    OpenedView view;
    open(view);
    Size size{8, 8};
    Image values(size, 1, std::numeric_limits<float>::quiet_NaN());
    ColourScale scale{ColourMap::cividis, 0.0, 1.0, false};
    view.setPicture(mapped(values.data(), size, scale));
    view.setScale(scale, "unit", true);
    view.setValues(values);
    view.setRelief(true);
    QCOMPARE(view.vtk()->drawn().pixelColor(40, 40), colours(Look::dark).picture);
  }

  void theWholeScreenAndBack() {
    QWidget page;
    auto* column = new QVBoxLayout(&page);
    auto* view = new OpenedView;
    auto* below = new QLabel("below");
    column->addWidget(view, 1);
    column->addWidget(below);
    page.resize(400, 300);
    page.show();
    QVERIFY(QTest::qWaitForWindowExposed(&page));
    view->setPicture(numbered({40, 30}));
    QRect before = view->geometry();
    QColor inPage = drawnAt(*view, {20.5, 10.5});
    QVERIFY(inPage.red() > inPage.green() && inPage.green() > 0);
    for (Qt::Key back : {Qt::Key_Escape, Qt::Key_F11}) {
      QTest::keyClick(view, Qt::Key_F11);
      QVERIFY(view->isWholeScreen());
      QTRY_COMPARE(view->size(), page.screen()->geometry().size());
      QVERIFY(QTest::qWaitForWindowExposed(view->window()));
      QCOMPARE(drawnAt(*view, {20.5, 10.5}), inPage);
      QTest::keyClick(view, back);
      QVERIFY(!view->isWholeScreen());
      QCOMPARE(view->window(), &page);
      QTRY_COMPARE(view->geometry(), before);
      QCOMPARE(column->indexOf(view), 0);
      QCOMPARE(drawnAt(*view, {20.5, 10.5}), inPage);
    }
    // Its page may go meanwhile.
    view->setWholeScreen(true);
  }
};

QTEST_MAIN(TestMapView)
#include "test_map_view.moc"
