// SPDX-License-Identifier: MIT
#pragma once

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <QOpenGLWidget>
#include <functional>
#include <vector>

namespace relucent::gui {

/// The scene, with its mouse and key handlers. Outlives every context in which it is drawn.
struct VtkScene {
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
};

/// The widget into which VTK draws. Qt replaces its context with the window's; VTK's resources are released
/// while the old one is still current.
class VtkCanvas : public QOpenGLWidget {
 public:
  /// Whether a context for VTK can be created.
  static bool isPossible();

  /// `refused`: called once if the context is too old. `scene` must outlive the canvas.
  VtkCanvas(VtkScene& scene, std::function<void()> refused, QWidget* parent);
  ~VtkCanvas() override;

  /// Number of scenes drawn so far.
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
  bool ready_ = false;  // VTK has resources in the context
  int frames_ = 0;
};

}  // namespace relucent::gui
