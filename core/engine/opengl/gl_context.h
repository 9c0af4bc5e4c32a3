// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "relucent/platform/headless_gl.h"

namespace relucent::engine {

/// An OpenGL 4.3 context without a window and without a display, for compute shaders. It is current only
/// during the lifetime of a Current, on one thread at a time.
class GlContext {
 public:
  enum class Device {
    any,       // a graphics card if there is one, else a software renderer
    graphics,  // a graphics card
  };

  /// Throws: Error{device} if there is no such device with OpenGL 4.3, with the available devices.
  explicit GlContext(Device wanted);

  /// The driver's name of its device.
  const std::string& renderer() const { return renderer_; }
  /// A software renderer, which is slower than the back end for the processor.
  bool software() const { return software_; }
  /// The driver has reset the device, or reported an error since the last call. Contract: current.
  bool failed() const noexcept;

  /// Makes the context current during its lifetime, and restores the previous one. OpenGL contexts of GLX
  /// must not be current on the same thread.
  class Current : public platform::HeadlessGl::Current {
   public:
    explicit Current(const GlContext& context) noexcept : platform::HeadlessGl::Current(*context.context_) {}
  };

 private:
  bool accepts(Device wanted, std::string& found);

  std::unique_ptr<platform::HeadlessGl> context_;
  std::string renderer_;
  bool software_ = false;
  bool reportsReset_ = false;
};

/// Whether a driver's name is that of a software renderer.
bool isSoftwareRenderer(const std::string& name);

}  // namespace relucent::engine
