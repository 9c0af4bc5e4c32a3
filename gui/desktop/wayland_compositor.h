// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <memory>

class QScreen;
struct wl_display;
struct wp_viewporter;
struct zwp_idle_inhibit_manager_v1;

namespace relucent::gui {

/// What the compositor of a Wayland session tells beyond what Qt passes on. On Qt's connection, with a queue
/// of its own; for the windows' thread. Sources: the Wayland protocol; xdg-output-unstable-v1.
class WaylandCompositor {
 public:
  /// nullptr: the program does not run under Wayland.
  static WaylandCompositor* instance();

  /// The pixels of the output that a screen stands for, turned as its picture is; empty: it does not tell.
  QSize pixelsOf(const QScreen& screen);
  /// Crops and scales surfaces; nullptr: it cannot, or Qt does it itself where the desktop scales by a
  /// fraction, and a surface has only one viewport.
  wp_viewporter* viewporter() const;
  /// nullptr: it has none.
  zwp_idle_inhibit_manager_v1* idleInhibitor() const;

 private:
  explicit WaylandCompositor(wl_display* display);
  ~WaylandCompositor() = delete;  // lives as long as the connection

  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace relucent::gui
