// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "theme/tick.h"
#include "wizard/devices/device_page.h"

namespace relucent::gui {

class Note;

/// Photographs a second while the response was measured: about as often patterns change; none before.
std::optional<double> measuredChanges(const Session& session);

/// The warning with its tick, for a page's inspector; hidden where nobody has to agree.
class FlashConsent : public QWidget {
  Q_OBJECT

 public:
  explicit FlashConsent(QWidget* parent = nullptr);
  /// `changes`: patterns a second, where that is known.
  void show(bool needed, bool given, std::optional<double> changes);
  /// Where to agree.
  QWidget* tick() const { return tick_; }

 Q_SIGNALS:
  void given(bool clear);

 private:
  Note* note_;
  Tick* tick_;
};

/// That of the open venue, for a page whose measurement asks for it.
QWidget* consentWidget(DevicePage& page);

}  // namespace relucent::gui
