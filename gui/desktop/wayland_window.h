// SPDX-License-Identifier: MIT
#pragma once

#include <QWindow>

#include "desktop/exact_crop.h"

struct wl_surface;
struct wp_viewport;
struct zwp_idle_inhibitor_v1;

namespace relucent::gui {

/// What a Wayland compositor does with one window on a projector beyond what Qt asks of it: lays its pixels
/// on the display's, and does not let the display sleep while it is seen. Elsewhere all of it does nothing.
/// Sources: viewporter; idle-inhibit-unstable-v1.
class WaylandWindow {
 public:
  explicit WaylandWindow(QWindow& window) : window_(window) {}
  ~WaylandWindow() { forget(); }
  WaylandWindow(const WaylandWindow&) = delete;
  WaylandWindow& operator=(const WaylandWindow&) = delete;

  /// Takes effect with the picture that is drawn next. Before each drawing.
  void prepare();
  /// Before the window hides: its surface ends.
  void forget();

 private:
  QWindow& window_;
  wl_surface* surface_ = nullptr;
  wp_viewport* viewport_ = nullptr;
  zwp_idle_inhibitor_v1* awake_ = nullptr;
};

/// How a full-screen window is laid on its output, where Qt draws another number of pixels than that has.
/// None: pixel for pixel without, or it cannot be helped.
std::optional<ExactCrop> cropOf(const QWindow& window);

/// Whether a full-screen window can be pixel for pixel there, as far as the compositor tells.
bool canBeExactOn(const QScreen& screen);

/// What Qt draws for it.
QSize drawnSize(const QWindow& window);

}  // namespace relucent::gui
