// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace relucent::gui {

/// As what of a calibration a show plays.
struct PlayedSet {
  std::string opened;         // the set that was asked for; empty: the one in use
  std::string name;           // of that; empty: it has none
  std::string correctedFrom;  // of pipeline::fingerprintOfCorrection()
  std::string shownFrom;      // of pipeline::fingerprintOfShown()
};

/// That set of a calibration as it is now; all but `opened` empty if it cannot be read.
PlayedSet playedBy(const std::filesystem::path& calibration, const std::string& set);

}  // namespace relucent::gui
