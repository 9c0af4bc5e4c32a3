// SPDX-License-Identifier: MIT
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <QOpenGLWidget>
#include <functional>
#include <vector>

namespace relucent {

/// What is drawn, and who is told of mouse and keys. Outlives every context that it is drawn in.
struct VtkScene {
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
};

/// The picture that VTK draws into. It has a context of its own, which Qt replaces with the window's; what
/// VTK keeps in a context is let go of while that is still current.
class VtkCanvas : public QOpenGLWidget {
 public:
  /// Whether a context can be had in which VTK draws.
  static bool isPossible();

  /// `refused`: told once, where the context turned out to be too old. `scene` outlives the canvas.
  VtkCanvas(VtkScene& scene, std::function<void()> refused, QWidget* parent);
  ~VtkCanvas() override;

  /// Scenes drawn so far.
  int frames() const { return frames_; }

 protected:
  void initializeGL() override;
  void resizeGL(int width, int height) override;
  void paintGL() override;

 private:
  void adopt();
  void release();
  bool isCurrent() const;
  void observe(unsigned long event);
  void answer(unsigned long what, void* answer);

  VtkScene& scene_;
  std::function<void()> refused_;
  std::vector<unsigned long> observers_;
  QMetaObject::Connection losing_;
  bool ready_ = false;  // VTK has something in the context
  int frames_ = 0;
};

}  // namespace relucent
