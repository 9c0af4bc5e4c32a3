// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QMutex>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <functional>
#include <memory>

#include "relucent/engine/gl_host.h"

namespace relucent::gui {

/// The OpenGL contexts of this program that share their textures: those of the engine and of projectors'
/// windows that are made once the engine has one. One for the whole program, as windows come and go.
class SharedGl {
 public:
  /// Made by the first call, which belongs to the thread of the windows. Null where there is no OpenGL.
  static SharedGl* instance();
  /// Null, too, where nobody has asked for it.
  static SharedGl* existing();

  /// What other contexts share with; never current itself.
  QOpenGLContext* root() { return &root_; }
  /// A context for the engine. On the windows' thread; it may then be used and destroyed on any.
  /// Null if the driver gives none.
  std::unique_ptr<engine::GlHost> host();

  /// Runs `work` with a context current, on any thread, one at a time. False: the driver gives none.
  bool run(const std::function<void(QOpenGLContext& context)>& work);

 private:
  class Host;
  SharedGl() = default;
  bool open();

  QOpenGLContext root_;
  QMutex guard_;
  std::unique_ptr<Host> worker_;
};

}  // namespace relucent::gui
