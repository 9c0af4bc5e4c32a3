// SPDX-License-Identifier: MIT
#include "relucent/platform/headless_gl.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace relucent::platform {
namespace {

bool holds(const char* extensions, std::string_view name) {
  const std::string_view all = extensions != nullptr ? extensions : "";
  for (std::size_t at = all.find(name); at != std::string_view::npos; at = all.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || all[at - 1] == ' ') && (end == all.size() || all[end] == ' ')) return true;
  }
  return false;
}

bool libraryExists(const char* name) {
  void* library = dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  if (library != nullptr) dlclose(library);
  return library != nullptr;
}

/// Displays that need no screen, graphics cards before software.
std::vector<EGLDisplay> displays(bool softwareToo) {
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
  if (softwareToo) std::for_each(software.begin(), software.end(), add);
  found.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return found;
}

EGLContext contextOn(EGLDisplay display, int version) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return EGL_NO_CONTEXT;
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!epoxy_has_egl_extension(display, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) == EGL_FALSE || count == 0)
      return EGL_NO_CONTEXT;
  }
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                 version / 10,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 version % 10,
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

bool HeadlessGl::isInstalled() {
  return libraryExists("libEGL.so.1") && (libraryExists("libOpenGL.so.0") || libraryExists("libGL.so.1"));
}

std::unique_ptr<HeadlessGl> HeadlessGl::open(const Wish& wish, const std::function<bool()>& accepts) {
  for (EGLDisplay display : displays(wish.rendersOnProcessorToo)) {
    // Displays are the whole process's, not ours: they are never terminated.
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) continue;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) continue;
    EGLContext context = contextOn(display, wish.version);
    if (context == EGL_NO_CONTEXT) continue;
    std::unique_ptr<HeadlessGl> opened(new HeadlessGl(display, context));
    const Current current(*opened);
    if (current && accepts()) return opened;
  }
  return nullptr;
}

HeadlessGl::~HeadlessGl() {
  eglDestroyContext(display_, context_);
}

HeadlessGl::Current::Current(const HeadlessGl& context) noexcept
    : context_(context),
      api_(eglQueryAPI()),
      display_(eglGetCurrentDisplay()),
      before_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      made_(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
            eglMakeCurrent(context.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_TRUE) {}

HeadlessGl::Current::~Current() {
  if (made_) eglMakeCurrent(context_.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglBindAPI(api_);
  if (made_ && before_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, draw_, read_, before_);
}

}  // namespace relucent::platform
