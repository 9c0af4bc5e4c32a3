// SPDX-License-Identifier: MIT
#pragma once

#include <QSize>
#include <optional>

namespace relucent::gui {

/// How a window's pixels come to lie on an output's one by one although the desktop scales by a fraction and
/// Qt draws for the next whole number: of what was drawn the upper left `pixels` are laid on `place`, in the
/// desktop's units, and what then stands out over the output's edge is cut off by it.
struct ExactCrop {
  QSize pixels;
  QSize place;
};

/// The scale of an output of `mode` pixels that the desktop counts as `logical`, each length divided and then
/// rounded in whatever direction: of all scales that explain both lengths the one with the smallest
/// denominator of those that desktops offer, down to 1/120 (fractional-scale-v1). None: no scale explains it.
std::optional<double> scaleOf(QSize mode, QSize logical);

/// place = ceil(mode / scale), pixels = round(place scale), for each length: at least the output's own.
/// None: `drawn`, what Qt draws, is less than that.
std::optional<ExactCrop> exactCrop(QSize mode, QSize logical, QSize drawn);

}  // namespace relucent::gui
