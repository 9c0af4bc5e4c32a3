// SPDX-License-Identifier: MIT
#include "views/vtk_canvas.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkOpenGLState.h>

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <utility>

namespace relucent::gui {
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

}  // namespace

bool VtkCanvas::isPossible() {
  static const bool possible = foundPossible();
  return possible;
}

VtkCanvas::VtkCanvas(VtkScene& scene, std::function<void()> refused, QWidget* parent)
    : QOpenGLWidget(parent), scene_(scene), refused_(std::move(refused)) {
  setFormat(formatOfVtk());
  setAttribute(Qt::WA_TransparentForMouseEvents);
  observe(vtkCommand::WindowMakeCurrentEvent);
  observe(vtkCommand::WindowIsCurrentEvent);
  observe(vtkCommand::WindowSupportsOpenGLEvent);
  observe(vtkCommand::WindowIsDirectEvent);
}

VtkCanvas::~VtkCanvas() {
  disconnect(losing_);
  release();
  for (unsigned long tag : observers_) scene_.window->RemoveObserver(tag);
}

void VtkCanvas::initializeGL() {
  if (!isEnough(context()->format())) {
    if (refused_) std::exchange(refused_, nullptr)();
    return;
  }
  losing_ = connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, [this] { release(); });
  scene_.window->SetReadyForRendering(true);
  scene_.window->InitializeFromCurrentContext();
  scene_.window->SetOwnContext(false);
  scene_.window->OpenGLInit();
  ready_ = true;
}

void VtkCanvas::resizeGL(int, int) {
  adopt();
}

void VtkCanvas::paintGL() {
  if (!ready_) return;
  // Also when only the screen's pixel ratio changed.
  adopt();
  // Qt's painter and compositor have left their own state behind.
  vtkOpenGLState* state = scene_.window->GetState();
  state->Reset();
  state->Push();
  scene_.window->SetFrameBlitModeToBlitToCurrent();
  scene_.window->Render();
  state->Pop();
  ++frames_;
}

void VtkCanvas::adopt() {
  double ratio = devicePixelRatioF();
  int width = qMax(1, qRound(ratio * this->width())), height = qMax(1, qRound(ratio * this->height()));
  scene_.window->SetSize(width, height);
  scene_.window->SetDPI(qRound(72.0 * ratio));
  scene_.interactor->UpdateSize(width, height);
}

/// What VTK keeps in the context goes with it.
void VtkCanvas::release() {
  if (!std::exchange(ready_, false)) return;
  makeCurrent();
  scene_.window->Finalize();
  scene_.window->SetReadyForRendering(false);
  doneCurrent();
}

bool VtkCanvas::isCurrent() const {
  return context() != nullptr && QOpenGLContext::currentContext() == context();
}

void VtkCanvas::observe(unsigned long event) {
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback([](vtkObject*, unsigned long what, void* self, void* answer) {
    static_cast<VtkCanvas*>(self)->answer(what, answer);
  });
  observers_.push_back(scene_.window->AddObserver(event, command));
}

void VtkCanvas::answer(unsigned long what, void* answer) {
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

}  // namespace relucent::gui
