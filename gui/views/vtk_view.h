// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <memory>

class QLabel;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkRenderer;

namespace relucent::gui {

class VtkCanvas;
struct VtkScene;

/// A widget for a VTK scene. VTK draws into the framebuffer of a QOpenGLWidget, in device pixels, when Qt
/// repaints it; mouse, wheel and keys go to VTK's interactor. The context may be replaced, for example when
/// the widget moves to another window; the scene is kept. Without OpenGL a sentence is shown instead, and the
/// scene is never drawn.
class VtkView : public QWidget {
  Q_OBJECT

 public:
  explicit VtkView(QWidget* parent = nullptr);
  ~VtkView() override;

  /// Whether this computer can draw a scene; checked once, which takes a tenth of a second.
  static bool isPossible();
  /// Whether this view draws. Also false if its context is too old.
  bool works() const { return canvas_ != nullptr; }
  /// The sentence shown if it does not.
  QString refusal() const;

  vtkRenderer& renderer();
  vtkRenderWindow& renderWindow();
  vtkRenderWindowInteractor& interactor();
  /// Schedules a repaint of the scene, once for several calls.
  void redraw();
  /// Draws now and returns the result, in device pixels; null without OpenGL.
  QImage drawn();
  /// Number of scenes drawn so far.
  int frames() const;

 Q_SIGNALS:
  /// The view no longer draws: the context is too old.
  void refused();

 protected:
  bool event(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;

 private:
  void refuse();
  void forwardPosition(QPointF place, Qt::KeyboardModifiers modifiers, int repeat = 0);

  std::unique_ptr<VtkScene> scene_;
  VtkCanvas* canvas_ = nullptr;
  QLabel* sentence_ = nullptr;
};

}  // namespace relucent::gui
