// SPDX-License-Identifier: MIT
#include <QLabel>
#include <QtTest>

#include "core/transport/random_blocks.h"
#include "views/map_view.h"
#include "views/matrix_view.h"
#include "views/vtk_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::transport;

/// On a platform that makes no contexts.
class TestWithoutGl : public QObject {
  Q_OBJECT

 private slots:
  void aSentenceStandsInPlaceOfAScene() {
    QVERIFY(!VtkView::isPossible());
    VtkView view;
    view.resize(300, 200);
    view.show();
    QVERIFY(!view.works());
    QVERIFY(view.refusal().contains("OpenGL"));
    auto* label = view.findChild<QLabel*>();
    QVERIFY(label != nullptr && label->isVisible());
    QCOMPARE(view.accessibleDescription(), view.refusal());
    view.redraw();
    QVERIFY(view.drawn().isNull());
    QTest::mouseClick(&view, Qt::LeftButton);
    QTest::keyClick(&view, Qt::Key_Left);
  }

  void aMapIsPaintedAllTheSame() {
    MapView view;
    view.resize(200, 100);
    view.show();
    Size size{20, 10};
    Image values(size, 1, 1.0f);
    ColourScale scale{ColourMap::viridis, 0.0, 1.0, false};
    view.setScale(scale, "unit", false);
    view.setPicture(mapped(values.data(), size, scale));
    view.setValues(values);
    QVERIFY(!view.canRise());
    view.setRelief(true);
    QVERIFY(!view.isRelief());
    QPoint place = view.widgetFromPicture({4.5, 5.5}).toPoint();
    QCOMPARE(view.asSeen().pixelColor(place), qtColourAt(ColourMap::viridis, 1.0));
    QTest::mouseClick(&view, Qt::LeftButton, {}, place);
    QCOMPARE(view.link().pick(), std::optional(QPoint(4, 5)));
  }

  void theMatrixSaysWhyItIsNotThere() {
    NodeLayout layout{Rasters(Size{4, 4})};
    MatrixView view;
    view.resize(300, 200);
    view.show();
    view.setMatrix(std::make_shared<MatrixPictures>(std::make_shared<TransportMatrix>(
        Size{3, 3}, Size{4, 4}, randomBlocks(9, layout.count(), 0.5, 1).sparse)));
    QVERIFY(view.isSettled());
    QVERIFY(view.values().empty());
    auto* label = view.findChild<QLabel*>();
    QVERIFY(label != nullptr && label->isVisible());
    QTest::keyClick(&view, Qt::Key_Plus);
    QTest::mouseClick(&view, Qt::LeftButton, {}, {150, 100});
    QVERIFY(!view.asSeen().isNull());
  }
};

QTEST_MAIN(TestWithoutGl)
#include "test_without_gl.moc"
