// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <optional>

#include "wizard/devices/screen_choice.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// Which screens the projectors of the open calibration are: those that it was begun with, until a cable
/// hangs elsewhere.
class VenueScreen : public QObject {
  Q_OBJECT

 public:
  explicit VenueScreen(Session& session, QObject* parent = nullptr);

  /// Which projector's screen is changed: the first one that is not there, until another is chosen.
  std::size_t projector() const;
  void chooseProjector(std::size_t projector);
  /// The projectors are screens, and nothing uses them.
  bool isChangeable() const { return session_.screenRig() != nullptr && session_.areDevicesFree(); }
  /// A projector is a screen that is not there.
  bool isMissing() const { return missing().has_value(); }
  /// Which one.
  std::optional<std::size_t> missing() const;
  /// What can be chosen: once something is measured, screens of the same pixels.
  std::vector<ScreenChoice> choices() const;

  const std::optional<ScreenChoice>& chosen() const { return chosen_; }
  void choose(const ScreenChoice& choice);
  void forget() {
    chosen_.reset();
    projector_.reset();
  }
  /// The choice is another screen than the calibration's.
  bool isDifferentScreen() const;
  /// Which other projector has the choice already; none: no other.
  std::optional<std::size_t> alsoOf() const;
  /// What the choice, or else the calibration's screen, means for what is measured; empty: nothing.
  QString meaning() const;
  /// Uses the choice from now on. Throws: as Session::changeScreen() and changeRig().
  void apply();

 Q_SIGNALS:
  void changed();

 private:
  Session& session_;
  std::optional<std::size_t> projector_;
  std::optional<ScreenChoice> chosen_;
};

}  // namespace relucent::gui
