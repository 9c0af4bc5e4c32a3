// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "relucent/engine/gl_host.h"
#include "relucent/platform/headless_gl.h"

namespace relucent::engine {

/// An OpenGL 4.3 context for compute shaders: one without a window and without a display, or a host's. It is
/// current only during the lifetime of a Current, on one thread at a time.
class GlContext {
 public:
  enum class Device {
    any,       // a graphics card if there is one, else a software renderer
    graphics,  // a graphics card
  };

  /// Throws: Error{device} if there is no such device with OpenGL 4.3, with the available devices.
  explicit GlContext(Device wanted);
  /// Throws: Error{device} if the host's is no such device.
  GlContext(std::unique_ptr<GlHost> host, Device wanted);

  /// Its textures are those of a host.
  bool isShared() const { return host_ != nullptr; }
  /// The driver's name of its device.
  const std::string& renderer() const { return renderer_; }
  /// A software renderer, which is slower than the back end for the processor.
  bool software() const { return software_; }
  /// The driver has reset the device, or reported an error since the last call. Contract: current.
  bool failed() const noexcept;

  /// Makes the context current during its lifetime, and, where it is none of a host's, restores the previous
  /// one. Other contexts of GLX must not be current on the same thread.
  class Current {
   public:
    explicit Current(const GlContext& context) noexcept;
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    explicit operator bool() const { return made_; }

   private:
    GlHost* host_;
    std::optional<platform::HeadlessGl::Current> own_;
    bool made_;
  };

 private:
  bool accepts(Device wanted, std::string& found);

  std::unique_ptr<platform::HeadlessGl> context_;
  std::unique_ptr<GlHost> host_;  // instead
  std::string renderer_;
  bool software_ = false;
  bool reportsReset_ = false;
};

}  // namespace relucent::engine
