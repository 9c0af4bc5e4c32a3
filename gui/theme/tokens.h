// SPDX-License-Identifier: MIT
#pragma once

#include <QColor>
#include <array>

namespace relucent::gui {

enum class Look { dark, light };

/// Colours by meaning. Text has a contrast of at least 4.5 : 1 on every background.
struct Colours {
  QColor window, rail, card, raised, input;  // backgrounds, from back to front
  QColor line, border;                       // separators; outlines of controls
  QColor text, secondary, disabled;
  QColor accent, accentGround, onAccent;
  QColor good;
  QColor amber, amberGround;
  QColor error, errorGround;
  QColor information, informationGround;
  QColor picture;           // behind pictures
  QColor red, green, blue;  // of curves
};
const Colours& colours(Look look);
/// Of what is drawn over pictures, whatever the theme.
inline const Colours& darkColours() {
  return colours(Look::dark);
}

/// Distinguishes clusters, without further meaning.
inline const std::array<QColor, 8> clusterPalette{
    QColor(0x5B, 0x9B, 0xC8), QColor(0xD9, 0x8E, 0x4A), QColor(0x6F, 0xB0, 0x8C), QColor(0xC9, 0x78, 0xA0),
    QColor(0xC7, 0xB4, 0x55), QColor(0x7C, 0x86, 0xC9), QColor(0xB8, 0x6B, 0x5A), QColor(0x8F, 0xB7, 0xB9)};
/// In maps, for pixels without a value.
inline const QColor invalidColour(0x16, 0x18, 0x1E);

/// Logical pixels.
namespace space {
inline constexpr int tight = 4, small = 8, gap = 16, page = 24, card = 16;
inline constexpr int rail = 224, wideRail = 248, inspector = 320, wideInspector = 376, wideFrom = 1700;
inline constexpr int header = 72, actionBar = 64, statusStrip = 32;
inline constexpr int control = 36, primary = 40, smallControl = 32;
inline constexpr int cardRadius = 8, controlRadius = 6;
}  // namespace space

/// Font sizes in pixels.
namespace type {
inline constexpr int axis = 11, note = 12, body = 13, section = 15, title = 20, readout = 24;
}  // namespace type

/// Pictures are shown no brighter than this share of white, since the laptop lights the room. Dimmed: half of
/// it.
inline constexpr double brightestPicture = 0.86, dimmedPicture = 0.43;

}  // namespace relucent::gui
