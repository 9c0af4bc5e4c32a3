// SPDX-License-Identifier: MIT
#include <vtkRenderer.h>

#include <QLabel>
#include <QtTest>

#include "views/vtk_view.h"

using namespace relucent;
using namespace relucent::gui;

/// On X servers that lack GLX, where Qt opens OpenGL by EGL if that is there: GLEW complains and VTK draws.
class TestWithoutGlx : public QObject {
  Q_OBJECT

 private slots:
  void aSceneIsDrawnOrASentenceStandsInItsPlace() {
    VtkView view;
    view.renderer().SetBackground(0.0, 0.0, 1.0);
    view.resize(300, 200);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    if (view.works()) {
      QCOMPARE(view.drawn().pixelColor(150, 100), QColor(Qt::blue));
      return;
    }
    auto* label = view.findChild<QLabel*>();
    QVERIFY(label != nullptr && label->isVisible());
    QCOMPARE(label->text(), view.refusal());
  }
};

QTEST_MAIN(TestWithoutGlx)
#include "test_without_glx.moc"
