// SPDX-License-Identifier: MIT
#include "views/vtk_view.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

/// A red square over the right half of what a parallel camera sees, on a blue ground.
void addScene(VtkView& view) {
  vtkNew<vtkPoints> points;
  for (auto [x, y] : {std::pair(0.0, -1.0), std::pair(5.0, -1.0), std::pair(5.0, 1.0), std::pair(0.0, 1.0)})
    points->InsertNextPoint(x, y, 0.0);
  vtkNew<vtkCellArray> cells;
  vtkIdType corners[] = {0, 1, 2, 3};
  cells->InsertNextCell(4, corners);
  vtkNew<vtkPolyData> square;
  square->SetPoints(points);
  square->SetPolys(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(square);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  view.renderer().AddActor(actor);
  view.renderer().SetBackground(0.0, 0.0, 1.0);
  vtkCamera* camera = view.renderer().GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.0);
  camera->SetPosition(0.0, 0.0, 5.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
}

/// Left half blue, right half red, wherever the view stands and however many pixels it has.
void verifyHalves(const QImage& image) {
  QVERIFY(!image.isNull());
  int y = image.height() / 2;
  QCOMPARE(image.pixelColor(image.width() / 4, y), QColor(Qt::blue));
  QCOMPARE(image.pixelColor(image.width() / 2 - 2, y), QColor(Qt::blue));
  QCOMPARE(image.pixelColor(image.width() / 2 + 2, y), QColor(Qt::red));
  QCOMPARE(image.pixelColor(3 * image.width() / 4, y), QColor(Qt::red));
}

/// What VTK's interactor was told, in the order in which it was.
struct Told {
  QList<unsigned long> events;
  QList<QPoint> places;
  QByteArray keys;

  explicit Told(VtkView& view) {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject* source, unsigned long event, void* self, void*) {
      auto* interactor = static_cast<vtkRenderWindowInteractor*>(source);
      auto* told = static_cast<Told*>(self);
      told->events << event;
      told->places << QPoint(interactor->GetEventPosition()[0], interactor->GetEventPosition()[1]);
      if (event == vtkCommand::KeyPressEvent) told->keys += interactor->GetKeySym();
    });
    for (unsigned long event :
         {vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent, vtkCommand::MouseMoveEvent,
          vtkCommand::MouseWheelForwardEvent, vtkCommand::MouseWheelBackwardEvent, vtkCommand::KeyPressEvent})
      view.interactor().AddObserver(event, command);
  }
};

}  // namespace

class TestVtkView : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QVERIFY(VtkView::isPossible()); }

  void aSceneIsDrawnInDevicePixels() {
    VtkView view;
    addScene(view);
    view.resize(200, 100);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QImage image = view.drawn();
    double ratio = view.devicePixelRatioF();
    QCOMPARE(image.size(), QSize(qRound(200 * ratio), qRound(100 * ratio)));
    verifyHalves(image);
    view.resize(331, 77);
    QTRY_COMPARE(view.drawn().size(), QSize(qRound(331 * ratio), qRound(77 * ratio)));
    verifyHalves(view.drawn());
  }

  void itIsSeenInItsWindow() {
    QWidget window;
    VtkView view(&window);
    addScene(view);
    view.setGeometry(20, 30, 100, 60);
    window.resize(200, 200);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QTRY_VERIFY(view.frames() > 0);
    QImage image = window.grab().toImage();
    double ratio = window.devicePixelRatioF();
    auto at = [&](int x, int y) { return image.pixelColor(qRound(x * ratio), qRound(y * ratio)); };
    QCOMPARE(at(40, 60), QColor(Qt::blue));
    QCOMPARE(at(100, 60), QColor(Qt::red));
    QVERIFY(at(150, 150) != QColor(Qt::red));
  }

  void itOutlivesItsContext() {
    auto first = std::make_unique<QWidget>();
    first->resize(300, 200);
    auto* view = new VtkView(first.get());
    addScene(*view);
    view->setGeometry(0, 0, 120, 80);
    first->show();
    QVERIFY(QTest::qWaitForWindowExposed(first.get()));
    verifyHalves(view->drawn());
    for (int i = 0; i < 3; ++i) {
      auto second = std::make_unique<QWidget>();
      second->resize(300, 200);
      view->setParent(second.get());
      view->show();
      second->show();
      QVERIFY(QTest::qWaitForWindowExposed(second.get()));
      first = std::move(second);
      int before = view->frames();
      view->redraw();
      QTRY_VERIFY(view->frames() > before);
      verifyHalves(view->drawn());
    }
    view->setParent(nullptr);
    delete view;
  }

  void itIsHiddenAndShownAgain() {
    VtkView view;
    addScene(view);
    view.resize(64, 64);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    view.hide();
    view.renderer().SetBackground(0.0, 1.0, 0.0);
    view.redraw();
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QCOMPARE(view.drawn().pixelColor(4, 4), QColor(Qt::green));
  }

  void manyRequestsAreOnePicture() {
    VtkView view;
    addScene(view);
    view.resize(64, 64);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QTRY_VERIFY(view.frames() > 0);
    QCoreApplication::processEvents();
    int before = view.frames();
    for (int i = 0; i < 100; ++i) view.redraw();
    QTRY_VERIFY(view.frames() > before);
    QCoreApplication::processEvents();
    QVERIFY(view.frames() < before + 10);
  }

  void itIsToldWhatTheUserDoes() {
    VtkView view;
    Told told(view);
    addScene(view);
    view.resize(100, 60);
    view.show();
    QVERIFY(QTest::qWaitForWindowExposed(&view));
    QVERIFY(!view.drawn().isNull());
    double ratio = view.devicePixelRatioF();
    QTest::mousePress(&view, Qt::LeftButton, {}, {10, 20});
    QTest::mouseRelease(&view, Qt::LeftButton, {}, {30, 40});
    QCOMPARE(told.events.count(vtkCommand::LeftButtonPressEvent), 1);
    QCOMPARE(told.events.count(vtkCommand::LeftButtonReleaseEvent), 1);
    // VTK counts device pixels from below.
    QPoint pressed = told.places[told.events.indexOf(vtkCommand::LeftButtonPressEvent)];
    QCOMPARE(pressed, QPoint(qRound(10 * ratio), qRound(60 * ratio) - 1 - qRound(20 * ratio)));
    for (int delta : {120, -120}) {
      QWheelEvent wheel({50, 30}, view.mapToGlobal(QPointF(50, 30)), {}, {0, delta}, Qt::NoButton, {},
                        Qt::NoScrollPhase, false);
      QCoreApplication::sendEvent(&view, &wheel);
    }
    QCOMPARE(told.events.count(vtkCommand::MouseWheelForwardEvent), 1);
    QCOMPARE(told.events.count(vtkCommand::MouseWheelBackwardEvent), 1);
    QTest::keyClick(&view, Qt::Key_Left);
    QCOMPARE(told.keys, QByteArray("Left"));
  }

  void manyOfThemStandInOneWindow() {
    QWidget window;
    window.resize(300, 100);
    std::vector<VtkView*> views;
    for (int i = 0; i < 3; ++i) {
      views.push_back(new VtkView(&window));
      addScene(*views.back());
      views.back()->setGeometry(100 * i, 0, 90, 90);
    }
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    for (VtkView* view : views) verifyHalves(view->drawn());
    delete views[1];
    verifyHalves(views[0]->drawn());
    verifyHalves(views[2]->drawn());
  }
};

QTEST_MAIN(TestVtkView)
#include "test_vtk_view.moc"
