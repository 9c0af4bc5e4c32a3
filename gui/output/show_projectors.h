// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QJsonArray>
#include <memory>
#include <optional>

#include "output/show_settings.h"
#include "projectors/projector_watch.h"

namespace relucent::gui {

/// Whether projectors should be on, and their picture black.
class ProjectorWishes {
 public:
  /// `offAfter`: how long black lasts before they are switched off; none: as long as there are hours of play.
  explicit ProjectorWishes(std::optional<std::chrono::minutes> offAfter) : offAfter_(offAfter) {}

  /// `plays`: within the hours. `black`: somebody wants black meanwhile.
  pjlink::Wanted at(const QDateTime& now, bool plays, bool black);

 private:
  std::optional<std::chrono::minutes> offAfter_;
  std::optional<QDateTime> darkSince_;
};

/// Looks after the projectors of the settings; nullptr: none is on the network.
std::unique_ptr<ProjectorWatch> watchOf(const ShowSettings& settings, const pjlink::Wanted& wanted,
                                        const MachineClock& clock);

/// As health.json has them.
QJsonArray toJson(const std::vector<ProjectorState>& projectors);

}  // namespace relucent::gui
