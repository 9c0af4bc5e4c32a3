// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace relucent::engine {

/// An OpenGL context of somebody else's for the engine, one that shares its textures with windows: what the
/// engine computes is shown without leaving the graphics card.
class GlHost {
 public:
  virtual ~GlHost() = default;
  /// On the calling thread, where no other context is current. False: the context is lost.
  virtual bool makeCurrent() noexcept = 0;
  virtual void doneCurrent() noexcept = 0;
};

/// Null where there is none.
using MakeGlHost = std::function<std::unique_ptr<GlHost>()>;

/// Whether a driver's name is that of a software renderer.
bool isSoftwareRenderer(const std::string& name);

}  // namespace relucent::engine
