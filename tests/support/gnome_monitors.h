// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace relucent::tests {

/// The monitors of GNOME's compositor, as its session bus changes and records them: see
/// tests/support/with-two-monitors. Source: org.gnome.Mutter.DisplayConfig and org.gnome.Mutter.ScreenCast,
/// mutter.
class GnomeMonitors {
 public:
  /// Throws: std::runtime_error if no such compositor is on the session bus.
  GnomeMonitors();
  ~GnomeMonitors();

  /// The nearest scale that its mode has. Throws: std::runtime_error.
  double scale(const std::string& connector, double scale);

  /// Pictures of a monitor, in its own pixels, for as long as this lives.
  class Recording {
   public:
    ~Recording();
    Recording(Recording&&) noexcept;
    std::uint32_t node() const;  // of PipeWire

   private:
    friend class GnomeMonitors;
    struct Session;
    explicit Recording(std::unique_ptr<Session> session);
    std::unique_ptr<Session> session_;
  };
  /// Throws: std::runtime_error.
  Recording record(const std::string& connector);

 private:
  struct Bus;
  std::unique_ptr<Bus> bus_;
};

/// A connection to the session's PipeWire, which the caller closes. Throws: std::runtime_error.
int connectedToPipeWire();

}  // namespace relucent::tests
