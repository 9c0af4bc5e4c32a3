// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <chrono>
#include <functional>

namespace relucent::gui {

/// What the desktop is asked for.
struct ScreenCastWish {
  enum class What { screen, window };
  What what = What::screen;
  QString token{};  // of an earlier choice, which the desktop then takes again without a question; or empty
  /// How long its dialog waits for an answer; 0: as long as it takes.
  std::chrono::milliseconds dialog{0};
  std::chrono::milliseconds portal{10'000};      // for what the portal answers by itself
  std::chrono::milliseconds connection{10'000};  // from the agreement until PipeWire has joined both sides
  std::chrono::milliseconds first{2'000};  // and to the first picture of a size, before it is joined anew
};

/// Who waits for a picture of the desktop.
struct ScreenCastVisitor {
  std::function<bool()> isUnwanted;  // waits no longer; looked at many times a second
  std::function<void()> isAsked;     // the desktop asks whoever sits before it
};

}  // namespace relucent::gui
