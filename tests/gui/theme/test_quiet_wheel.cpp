// SPDX-License-Identifier: MIT
// The wheel over what it could turn by accident.
#include "theme/quiet_wheel.h"

#include <QtTest/qtestspontaneevent.h>
#include <QComboBox>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QSpinBox>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

void turnWheel(QWidget* over) {
  const QPointF middle = over->rect().center();
  QWheelEvent down(middle, over->mapToGlobal(middle), {}, QPoint(0, -120), Qt::NoButton, Qt::NoModifier,
                   Qt::NoScrollPhase, false);
  QSpontaneKeyEvent::setSpontaneous(&down);  // others are not passed on
  qApp->notify(over, &down);
}

}  // namespace

class TestQuietWheel : public QObject {
  Q_OBJECT

 private slots:
  void itScrollsAndTurnsNothingInPassing() {
    QuietWheel quiet(nullptr);
    QScrollArea inspector;
    auto* inside = new QWidget;
    auto* column = new QVBoxLayout(inside);
    auto* slider = new QSlider(Qt::Horizontal);
    auto* list = new QComboBox;
    auto* number = new QSpinBox;
    list->addItems({"one", "two", "three"});
    list->setCurrentIndex(1);
    slider->setValue(50);
    number->setValue(50);
    for (QWidget* control :
         {static_cast<QWidget*>(slider), static_cast<QWidget*>(list), static_cast<QWidget*>(number)})
      column->addWidget(control);
    inside->setFixedHeight(2000);
    inspector.setWidget(inside);
    inspector.resize(300, 300);
    inspector.show();
    QVERIFY(QTest::qWaitForWindowActive(&inspector));

    for (QWidget* control :
         {static_cast<QWidget*>(slider), static_cast<QWidget*>(list), static_cast<QWidget*>(number)}) {
      QVERIFY(control->focusPolicy() != Qt::WheelFocus);
      inspector.setFocus();
      const int before = inspector.verticalScrollBar()->value();
      turnWheel(control);
      QVERIFY2(inspector.verticalScrollBar()->value() > before, control->metaObject()->className());
    }
    QCOMPARE(slider->value(), 50);
    QCOMPARE(list->currentIndex(), 1);
    QCOMPARE(number->value(), 50);

    // Whoever has the focus was meant; but a list has it long after something was chosen there.
    slider->setFocus();
    turnWheel(slider);
    QVERIFY(slider->value() != 50);
    list->setFocus();
    turnWheel(list);
    QCOMPARE(list->currentIndex(), 1);
  }
};

QTEST_MAIN(TestQuietWheel)
#include "test_quiet_wheel.moc"
