// SPDX-License-Identifier: MIT
#include "views/vtk_view.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>

#include <QLabel>
#include <QMouseEvent>
#include <QVBoxLayout>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/vtk_canvas.h"

namespace relucent::gui {
namespace {

/// VTK's name of a key: what its styles compare with.
const char* keyName(int key) {
  switch (key) {
    case Qt::Key_Left:
      return "Left";
    case Qt::Key_Right:
      return "Right";
    case Qt::Key_Up:
      return "Up";
    case Qt::Key_Down:
      return "Down";
    case Qt::Key_Plus:
      return "plus";
    case Qt::Key_Minus:
      return "minus";
    default:
      return "None";
  }
}

}  // namespace

bool VtkView::isPossible() {
  return VtkCanvas::isPossible();
}

VtkView::VtkView(QWidget* parent) : QWidget(parent), scene_(std::make_unique<VtkScene>()) {
  scene_->window->SetReadyForRendering(false);
  scene_->window->SetMultiSamples(0);
  scene_->window->AddRenderer(scene_->renderer);
  scene_->renderer->SetBackgroundAlpha(1.0);
  scene_->interactor->SetRenderWindow(scene_->window);
  // Nothing turns and moves of itself; who wants that sets a style.
  scene_->interactor->SetInteractorStyle(nullptr);
  scene_->interactor->Initialize();
  // It asks for a picture; when that is drawn is Qt's to say.
  scene_->interactor->EnableRenderOff();
  vtkNew<vtkCallbackCommand> wanted;
  wanted->SetClientData(this);
  wanted->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<VtkView*>(self)->redraw(); });
  scene_->interactor->AddObserver(vtkCommand::RenderEvent, wanted);

  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  if (isPossible())
    column->addWidget(canvas_ = new VtkCanvas(*scene_, [this] { refuse(); }, this));
  else
    refuse();
}

VtkView::~VtkView() {
  // Its context must still be there when VTK lets go of what is in it.
  delete canvas_;
}

void VtkView::refuse() {
  if (sentence_ != nullptr) return;
  sentence_ =
      labelOf(tr("This view needs OpenGL 3.2, and this computer draws without it. Everything else works: "
                 "pictures and maps are shown without depth.") +
                  '\n' + tr("For this view, install the graphics card's driver and start Relucent again."),
              "note", this);
  sentence_->setAlignment(Qt::AlignCenter);
  sentence_->setMargin(space::page);
  // Views are dark in every look.
  sentence_->setStyleSheet(QString("color: %1;").arg(darkColours().secondary.name()));
  layout()->addWidget(sentence_);
  setAccessibleDescription(sentence_->text());
  if (canvas_ == nullptr) return;
  canvas_->hide();
  canvas_->deleteLater();
  canvas_ = nullptr;
  Q_EMIT refused();
}

QString VtkView::refusal() const {
  return sentence_ == nullptr ? QString() : sentence_->text();
}

vtkRenderer& VtkView::renderer() {
  return *scene_->renderer;
}

vtkRenderWindow& VtkView::renderWindow() {
  return *scene_->window;
}

vtkRenderWindowInteractor& VtkView::interactor() {
  return *scene_->interactor;
}

int VtkView::frames() const {
  return canvas_ == nullptr ? 0 : canvas_->frames();
}

void VtkView::redraw() {
  if (canvas_ != nullptr) canvas_->update();
}

QImage VtkView::drawn() {
  return canvas_ == nullptr ? QImage() : canvas_->grabFramebuffer();
}

void VtkView::forwardPosition(QPointF place, Qt::KeyboardModifiers modifiers, int repeat) {
  double ratio = devicePixelRatioF();
  scene_->interactor->SetEventInformationFlipY(qRound(place.x() * ratio), qRound(place.y() * ratio),
                                               modifiers.testFlag(Qt::ControlModifier),
                                               modifiers.testFlag(Qt::ShiftModifier), 0, repeat);
  scene_->interactor->SetAltKey(modifiers.testFlag(Qt::AltModifier));
}

bool VtkView::event(QEvent* event) {
  if (event->type() == QEvent::Enter) scene_->interactor->InvokeEvent(vtkCommand::EnterEvent);
  if (event->type() == QEvent::Leave) scene_->interactor->InvokeEvent(vtkCommand::LeaveEvent);
  return QWidget::event(event);
}

void VtkView::mousePressEvent(QMouseEvent* event) {
  forwardPosition(event->position(), event->modifiers());
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonPressEvent();
  if (event->button() == Qt::MiddleButton) scene_->interactor->MiddleButtonPressEvent();
  if (event->button() == Qt::RightButton) scene_->interactor->RightButtonPressEvent();
}

void VtkView::mouseDoubleClickEvent(QMouseEvent* event) {
  forwardPosition(event->position(), event->modifiers(), 1);
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonPressEvent();
}

void VtkView::mouseMoveEvent(QMouseEvent* event) {
  forwardPosition(event->position(), event->modifiers());
  scene_->interactor->MouseMoveEvent();
}

void VtkView::mouseReleaseEvent(QMouseEvent* event) {
  forwardPosition(event->position(), event->modifiers());
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonReleaseEvent();
  if (event->button() == Qt::MiddleButton) scene_->interactor->MiddleButtonReleaseEvent();
  if (event->button() == Qt::RightButton) scene_->interactor->RightButtonReleaseEvent();
}

void VtkView::wheelEvent(QWheelEvent* event) {
  forwardPosition(event->position(), event->modifiers());
  if (event->angleDelta().y() > 0) scene_->interactor->MouseWheelForwardEvent();
  if (event->angleDelta().y() < 0) scene_->interactor->MouseWheelBackwardEvent();
  event->accept();
}

void VtkView::keyPressEvent(QKeyEvent* event) {
  QByteArray text = event->text().toLatin1();
  scene_->interactor->SetKeyEventInformation(event->modifiers().testFlag(Qt::ControlModifier),
                                             event->modifiers().testFlag(Qt::ShiftModifier),
                                             text.isEmpty() ? '\0' : text[0], 0, keyName(event->key()));
  scene_->interactor->KeyPressEvent();
  if (!text.isEmpty()) scene_->interactor->CharEvent();
  QWidget::keyPressEvent(event);
}

void VtkView::keyReleaseEvent(QKeyEvent* event) {
  scene_->interactor->SetKeyEventInformation(0, 0, '\0', 0, keyName(event->key()));
  scene_->interactor->KeyReleaseEvent();
  QWidget::keyReleaseEvent(event);
}

}  // namespace relucent::gui
