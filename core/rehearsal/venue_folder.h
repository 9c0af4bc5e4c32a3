// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "relucent/pjlink/address.h"
#include "relucent/rehearsal/day_settings.h"
#include "relucent/rehearsal/show_process.h"

namespace relucent::rehearsal {

/// What a rehearsal keeps on the disk: a copy of the calibration, whose nights are then rehearsed ones,
/// content and the show's log.
class VenueFolder {
 public:
  /// Throws: as CalibrationFolder::open(); Error{input} if the calibration is not finished or its venue is
  /// not a simulated one; Error{disk}.
  explicit VenueFolder(const DaysSettings& settings);

  const std::filesystem::path& calibration() const { return calibration_; }
  std::filesystem::path log() const { return root_ / "log"; }
  std::filesystem::path alarms() const { return root_ / "alarms"; }
  std::size_t projectors() const { return projectors_; }

  /// Where the projectors are on the network. Throws: Error{disk}.
  void tellProjectors(const std::vector<pjlink::Address>& addresses) const;
  /// A still, and the live picture at `stream`. Throws: Error{disk}.
  void writePlaylist(const std::string& stream) const;
  /// The show's time from now on; a show that starts begins at `from`. Throws: Error{disk}.
  void writeTime(ShowTime from, ShowTime until, double speed) const;
  ShowCommand command(const DaysSettings& settings) const;

  /// The still: there, not there, or nothing that can be read. Throws: Error{disk}.
  void writeStill() const;
  void removeStill() const;
  void spoilStill() const;

 private:
  std::filesystem::path still() const { return root_ / "still.png"; }
  /// A desktop without a display: the operator's screen and one of each projector's size.
  void writeScreens() const;

  std::filesystem::path root_, calibration_;
  Size projector_{};
  std::size_t projectors_ = 1;
};

/// Bytes of all files in a folder and below.
std::uint64_t bytesIn(const std::filesystem::path& folder);

}  // namespace relucent::rehearsal
