// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>
#include <memory>

class QLabel;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkRenderer;

namespace relucent {

class VtkCanvas;
struct VtkScene;

/// A place for a VTK scene. VTK draws into the picture of a QOpenGLWidget, in device pixels, whenever Qt
/// wants it drawn; mouse, wheel and keys go to VTK's interactor. The context may come and go, as it does when
/// the widget moves to another window: the scene stays. Where there is no OpenGL it shows a sentence instead,
/// and the scene is never drawn.
class VtkView : public QWidget {
  Q_OBJECT

 public:
  explicit VtkView(QWidget* parent = nullptr);
  ~VtkView() override;

  /// Whether this computer can draw a scene at all; found out once, which takes a tenth of a second.
  static bool isPossible();
  /// Whether this view draws. False as well where its context turned out to be too old.
  bool works() const { return canvas_ != nullptr; }
  /// The sentence where it does not.
  QString refusal() const;

  vtkRenderer& renderer();
  vtkRenderWindow& renderWindow();
  vtkRenderWindowInteractor& interactor();
  /// The scene has changed: draws it soon, once for many calls.
  void redraw();
  /// Draws now and gives what was drawn, in device pixels; null where there is no OpenGL.
  QImage drawn();
  /// Scenes drawn so far.
  int frames() const;

 Q_SIGNALS:
  /// It no longer draws: the context is too old.
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
  void tellPlace(QPointF place, Qt::KeyboardModifiers modifiers, int repeat = 0);

  std::unique_ptr<VtkScene> scene_;
  VtkCanvas* canvas_ = nullptr;
  QLabel* sentence_ = nullptr;
};

}  // namespace relucent
