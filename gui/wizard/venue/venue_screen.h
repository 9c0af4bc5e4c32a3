// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <optional>

#include "wizard/devices/screen_choice.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Which screen the projector of the open calibration is: the one that it was begun with, until its cable
/// hangs elsewhere.
class VenueScreen : public QObject {
  Q_OBJECT

 public:
  explicit VenueScreen(Session& session, QObject* parent = nullptr);

  /// The projector is a screen, and nothing uses it.
  bool isChangeable() const { return session_.screenRig() != nullptr && session_.areDevicesFree(); }
  /// The projector is a screen that is not there.
  bool isMissing() const;
  /// What can be chosen: once something is measured, screens of the same pixels.
  std::vector<ScreenChoice> choices() const;

  const std::optional<ScreenChoice>& chosen() const { return chosen_; }
  void choose(const ScreenChoice& choice);
  void forget() { chosen_.reset(); }
  /// The choice is another screen than the calibration's.
  bool isDifferentScreen() const;
  /// What the choice, or else the calibration's screen, means for what is measured; empty: nothing.
  QString meaning() const;
  /// Uses the choice from now on. Throws: as Session::changeScreen() and changeRig().
  void apply();

 Q_SIGNALS:
  void changed();

 private:
  Session& session_;
  std::optional<ScreenChoice> chosen_;
};

}  // namespace relucent::gui
