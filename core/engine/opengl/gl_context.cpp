// SPDX-License-Identifier: MIT
#include "relucent/engine/opengl/gl_context.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::engine {
namespace {

constexpr int leastVersion = 43;
constexpr auto installDriver = RELUCENT_MESSAGE(
    "engine.install-driver", "install the graphics card's driver, or compute on the processor");

}  // namespace

bool isSoftwareRenderer(const std::string& name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* known : {"llvmpipe", "softpipe", "swrast", "software rasterizer", "openswr"})
    if (lower.find(known) != std::string::npos) return true;
  return false;
}

GlContext::GlContext(Device wanted) {
  if (!platform::HeadlessGl::isInstalled())
    throw Error(
        ErrorKind::device,
        RELUCENT_MESSAGE("engine.no-libegl-or-libopengl",
                         "there is no libEGL or no libOpenGL, which open graphics cards without a display"),
        installDriver);
  std::string found;
  context_ = platform::HeadlessGl::open({leastVersion, wanted == Device::any},
                                        [&] { return accepts(wanted, found); });
  if (!context_)
    throw Error(ErrorKind::device,
                wanted == Device::graphics
                    ? RELUCENT_MESSAGE("engine.no-graphics-card",
                                       "there is no graphics card with OpenGL 4.3 and compute shaders")
                    : RELUCENT_MESSAGE("engine.no-opengl", "there is no OpenGL 4.3 with compute shaders"),
                installDriver, found.empty() ? "" : "found only" + found);
}

GlContext::GlContext(std::unique_ptr<GlHost> host, Device wanted) : host_(std::move(host)) {
  require(host_ != nullptr, "no host");
  std::string found;
  const Current current(*this);
  if (!current || !accepts(wanted, found))
    throw Error(ErrorKind::device,
                RELUCENT_MESSAGE("engine.no-graphics-card",
                                 "there is no graphics card with OpenGL 4.3 and compute shaders"),
                installDriver, found.empty() ? "" : "found only" + found);
}

/// Whether the context that is current may become this one. `found`: names of those that did not.
bool GlContext::accepts(Device wanted, std::string& found) {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (name == nullptr || epoxy_gl_version() < leastVersion) return false;
  renderer_ = name;
  software_ = isSoftwareRenderer(renderer_);
  reportsReset_ = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
  if (wanted == Device::any || !software_) return true;
  found += (found.empty() ? " " : ", ") + renderer_;
  return false;
}

GlContext::Current::Current(const GlContext& context) noexcept : host_(context.host_.get()) {
  if (host_ == nullptr) own_.emplace(*context.context_);
  made_ = host_ != nullptr ? host_->makeCurrent() : static_cast<bool>(*own_);
}

GlContext::Current::~Current() {
  if (host_ != nullptr && made_) host_->doneCurrent();
}

bool GlContext::failed() const noexcept {
  if (reportsReset_ && glGetGraphicsResetStatus() != GL_NO_ERROR) return true;
  bool wrong = false;
  // A lost context may report errors for ever.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) wrong = true;
  return wrong;
}

}  // namespace relucent::engine
