// SPDX-License-Identifier: MIT
#include "views/vtk_view.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>

#include <QGuiApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QVBoxLayout>
#include <utility>

#include "theme/controls.h"
#include "theme/theme.h"

namespace relucent {
namespace {

/// The least that VTK draws with.
QSurfaceFormat formatOfVtk() {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setVersion(3, 2);
  format.setDepthBufferSize(24);
  format.setAlphaBufferSize(0);
  format.setSamples(0);
  return format;
}

bool isEnough(const QSurfaceFormat& format) {
  return format.renderableType() != QSurfaceFormat::OpenGLES && format.version() >= qMakePair(3, 2);
}

bool foundPossible() {
  QOpenGLContext context;
  context.setFormat(formatOfVtk());
  QOffscreenSurface surface;
  surface.setFormat(formatOfVtk());
  surface.create();
  if (!surface.isValid() || !context.create() || !context.makeCurrent(&surface)) return false;
  bool enough = isEnough(context.format());
  context.doneCurrent();
  return enough;
}

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

struct VtkView::Scene {
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
};

/// The picture that VTK draws into. It has a context of its own, which Qt replaces with the window's.
class VtkView::Canvas : public QOpenGLWidget {
 public:
  Canvas(VtkView& view, Scene& scene) : QOpenGLWidget(&view), view_(view), scene_(scene) {
    setFormat(formatOfVtk());
    setAttribute(Qt::WA_TransparentForMouseEvents);
    observe(vtkCommand::WindowMakeCurrentEvent);
    observe(vtkCommand::WindowIsCurrentEvent);
    observe(vtkCommand::WindowSupportsOpenGLEvent);
    observe(vtkCommand::WindowIsDirectEvent);
  }
  ~Canvas() override {
    disconnect(losing_);
    release();
    for (unsigned long tag : observers_) scene_.window->RemoveObserver(tag);
  }

 protected:
  void initializeGL() override {
    if (!isEnough(context()->format())) return view_.refuse();
    losing_ = connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { release(); });
    scene_.window->SetReadyForRendering(true);
    scene_.window->InitializeFromCurrentContext();
    scene_.window->SetOwnContext(false);
    scene_.window->OpenGLInit();
    ready_ = true;
  }
  void resizeGL(int, int) override { adopt(); }
  void paintGL() override {
    if (!view_.works()) return;
    // Also when only the screen's pixel ratio changed.
    adopt();
    // Qt's painter and compositor have left their own state behind.
    vtkOpenGLState* state = scene_.window->GetState();
    state->Reset();
    state->Push();
    scene_.window->SetFrameBlitModeToBlitToCurrent();
    scene_.window->Render();
    state->Pop();
    ++view_.frames_;
  }

 private:
  void adopt() {
    double ratio = devicePixelRatioF();
    int width = qMax(1, qRound(ratio * this->width())), height = qMax(1, qRound(ratio * this->height()));
    scene_.window->SetSize(width, height);
    scene_.window->SetDPI(qRound(72.0 * ratio));
    scene_.interactor->UpdateSize(width, height);
  }
  /// What VTK keeps in the context goes with it.
  void release() {
    if (!std::exchange(ready_, false)) return;
    makeCurrent();
    scene_.window->Finalize();
    scene_.window->SetReadyForRendering(false);
    doneCurrent();
  }
  bool isCurrent() const { return context() != nullptr && QOpenGLContext::currentContext() == context(); }
  void observe(unsigned long event) {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long what, void* self, void* answer) {
      static_cast<Canvas*>(self)->answer(what, answer);
    });
    observers_.push_back(scene_.window->AddObserver(event, command));
  }
  void answer(unsigned long what, void* answer) {
    switch (what) {
      case vtkCommand::WindowMakeCurrentEvent:
        // Qt's own would also bind the widget's picture, in the middle of VTK's work on its own.
        if (isValid() && !isCurrent()) makeCurrent();
        break;
      case vtkCommand::WindowIsCurrentEvent:
        *static_cast<bool*>(answer) = isCurrent();
        break;
      default:  // whether it is supported, and direct
        *static_cast<int*>(answer) = 1;
    }
  }

  VtkView& view_;
  Scene& scene_;
  std::vector<unsigned long> observers_;
  QMetaObject::Connection losing_;
  bool ready_ = false;  // VTK has something in the context
};

bool VtkView::isPossible() {
  static const bool possible = foundPossible();
  return possible;
}

VtkView::VtkView(QWidget* parent) : QWidget(parent), scene_(std::make_unique<Scene>()) {
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
    column->addWidget(canvas_ = new Canvas(*this, *scene_));
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
                 "pictures and maps are shown without depth."),
              "note", this);
  sentence_->setAlignment(Qt::AlignCenter);
  sentence_->setMargin(space::page);
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

void VtkView::redraw() {
  if (canvas_ != nullptr) canvas_->update();
}

QImage VtkView::drawn() {
  return canvas_ == nullptr ? QImage() : canvas_->grabFramebuffer();
}

void VtkView::tellPlace(QPointF place, Qt::KeyboardModifiers modifiers, int repeat) {
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
  tellPlace(event->position(), event->modifiers());
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonPressEvent();
  if (event->button() == Qt::MiddleButton) scene_->interactor->MiddleButtonPressEvent();
  if (event->button() == Qt::RightButton) scene_->interactor->RightButtonPressEvent();
}

void VtkView::mouseDoubleClickEvent(QMouseEvent* event) {
  tellPlace(event->position(), event->modifiers(), 1);
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonPressEvent();
}

void VtkView::mouseMoveEvent(QMouseEvent* event) {
  tellPlace(event->position(), event->modifiers());
  scene_->interactor->MouseMoveEvent();
}

void VtkView::mouseReleaseEvent(QMouseEvent* event) {
  tellPlace(event->position(), event->modifiers());
  if (event->button() == Qt::LeftButton) scene_->interactor->LeftButtonReleaseEvent();
  if (event->button() == Qt::MiddleButton) scene_->interactor->MiddleButtonReleaseEvent();
  if (event->button() == Qt::RightButton) scene_->interactor->RightButtonReleaseEvent();
}

void VtkView::wheelEvent(QWheelEvent* event) {
  tellPlace(event->position(), event->modifiers());
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

}  // namespace relucent
