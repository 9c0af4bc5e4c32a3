// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

namespace relucent::platform {

/// An OpenGL context without a window and without a display. It is current only during the lifetime of a
/// Current, on one thread at a time.
class HeadlessGl {
  using Handle = void*;  // the system's own

 public:
  struct Wish {
    int version = 43;                   // 10 * major + minor
    bool rendersOnProcessorToo = true;  // devices that are known not to be graphics cards are tried, last
  };

  /// Whether the libraries are there. The function loader ends the program where they are not.
  static bool isInstalled();

  /// Tries this computer's devices, graphics cards first, until one gives such a context and `accepts()`,
  /// called with that current, says yes. nullptr if there is none.
  static std::unique_ptr<HeadlessGl> open(const Wish& wish, const std::function<bool()>& accepts);
  ~HeadlessGl();
  HeadlessGl(const HeadlessGl&) = delete;
  HeadlessGl& operator=(const HeadlessGl&) = delete;

  /// Makes the context current during its lifetime, and restores the previous one. Contexts of the windows'
  /// own system must not be current on the same thread.
  class Current {
   public:
    explicit Current(const HeadlessGl& context) noexcept;
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    explicit operator bool() const { return made_; }

   private:
    const HeadlessGl& context_;
    unsigned int api_;  // the one that the thread had chosen
    Handle display_, before_, draw_, read_;
    bool made_;
  };

 private:
  HeadlessGl(Handle display, Handle context) : display_(display), context_(context) {}
  Handle display_, context_;
};

}  // namespace relucent::platform
