// SPDX-License-Identifier: MIT
#pragma once

#include "content/live_link.h"
#include "desktop/screen_cast.h"

namespace relucent::gui {

/// How long a desktop's dialog stands where nobody sits before it.
struct CastPatience {
  std::chrono::milliseconds question{60'000};    // whoever has started the show may be there still
  std::chrono::milliseconds refusal{10'000};     // an earlier choice was not taken
  std::chrono::milliseconds again{300'000};      // and is tried again: its screen may be off
  std::chrono::milliseconds connection{10'000};  // until PipeWire has joined both sides, whoever is there
};

/// The live picture of a screen or window under Wayland, see ScreenCast. The desktop asks which one, and what
/// was chosen is remembered under its name. Somebody who refuses is not asked again; who sits before the
/// wizard may take time over the answer, and where a show plays unattended the question is withdrawn.
class LiveCast : public LiveLink {
 public:
  LiveCast(ScreenCastWish::What what, const QString& which, const Canvas& canvas, Attendance attendance,
           const CastPatience& patience = {}, const LivePauses& pauses = {});
};

}  // namespace relucent::gui
