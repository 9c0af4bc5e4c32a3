// SPDX-License-Identifier: MIT
#include "engine/opengl/gl_context.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace relucent {
namespace {

constexpr int leastVersion = 43;
constexpr const char* advice = "install the graphics card's driver, or let the processor do the work";

bool holds(const char* extensions, std::string_view name) {
  const std::string_view all = extensions != nullptr ? extensions : "";
  for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

/// The function loader ends the program where there is no library to load from.
bool libraryExists(const char* name) {
  void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) dlclose(library);
  return library != nullptr;
}

/// Displays that need no screen, graphics cards before software.
std::vector<EGLDisplay> displays(GlContext::Device wanted) {
  std::vector<EGLDisplay> found;
  std::vector<EGLDeviceEXT> software;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool byDevice = holds(client, "EGL_EXT_platform_device") &&
                        (holds(client, "EGL_EXT_device_enumeration") || holds(client, "EGL_EXT_device_base"));
  auto add = [&](EGLDeviceEXT device) {
    found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  };
  if (byDevice) {
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
    for (EGLint i = 0; i < count; ++i) {
      EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      if (holds(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software"))
        software.push_back(device);
      else
        add(device);
    }
  }
  if (holds(client, "EGL_MESA_platform_surfaceless"))
    found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (wanted == GlContext::Device::any) std::for_each(software.begin(), software.end(), add);
  found.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return found;
}

EGLContext contextOn(EGLDisplay display) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return EGL_NO_CONTEXT;
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) == EGL_FALSE || count == 0)
      return EGL_NO_CONTEXT;
  }
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                 leastVersion / 10,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 leastVersion % 10,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
  if (epoxy_egl_version(display) < 15)
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  // Wants to be told of resets; where the driver cannot, errors alone have to do.
  std::vector<EGLint> told = attributes;
  told.insert(told.end() - 1, {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, told.data());
  if (context != EGL_NO_CONTEXT) return context;
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

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
  if (!libraryExists("libEGL.so.1") || !(libraryExists("libOpenGL.so.0") || libraryExists("libGL.so.1")))
    throw Error(ErrorKind::device,
                "there is no libEGL or no libOpenGL, which open graphics cards without a display", advice);
  std::string found;
  for (EGLDisplay display : displays(wanted))
    if (open(display, wanted, found)) return;
  throw Error(ErrorKind::device,
              wanted == Device::graphics ? "there is no graphics card with OpenGL 4.3 and compute shaders"
                                         : "there is no OpenGL 4.3 with compute shaders",
              advice, found.empty() ? "" : "found only" + found);
}

bool GlContext::open(EGLDisplay display, Device wanted, std::string& found) {
  // Displays are the whole process's, not ours: they are never terminated.
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return false;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) return false;
  display_ = display;
  context_ = contextOn(display);
  if (context_ == EGL_NO_CONTEXT) return false;
  {
    Current current(*this);
    const auto* name = current ? reinterpret_cast<const char*>(glGetString(GL_RENDERER)) : nullptr;
    if (name != nullptr && epoxy_gl_version() >= leastVersion) {
      renderer_ = name;
      software_ = isSoftwareRenderer(renderer_);
      reportsReset_ = epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_KHR_robustness");
      if (wanted == Device::any || !software_) return true;
      found += (found.empty() ? " " : ", ") + renderer_;
    }
  }
  eglDestroyContext(display_, context_);
  context_ = EGL_NO_CONTEXT;
  return false;
}

GlContext::~GlContext() {
  if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
}

bool GlContext::failed() const noexcept {
  if (reportsReset_ && glGetGraphicsResetStatus() != GL_NO_ERROR) return true;
  bool wrong = false;
  // A lost context may report errors for ever.
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) wrong = true;
  return wrong;
}

GlContext::Current::Current(const GlContext& context) noexcept
    : context_(context),
      api_(eglQueryAPI()),
      display_(eglGetCurrentDisplay()),
      before_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      made_(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
            eglMakeCurrent(context.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_TRUE) {}

GlContext::Current::~Current() {
  if (made_) eglMakeCurrent(context_.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglBindAPI(api_);
  if (made_ && before_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, draw_, read_, before_);
}

}  // namespace relucent
