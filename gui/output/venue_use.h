// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <filesystem>
#include <optional>

#include "relucent/platform/folder_lock.h"

namespace relucent::gui {

/// That a program of this person uses a venue, for as long as it lives: told to the others on this computer,
/// also to those that use the same venue in another way. Nothing is written to the venue; what a program that
/// was killed held is free.
class VenueUse {
 public:
  enum class Way {
    wizard,  // opened by one at a time: its pages show what they have read
    show,    // by `relucent show`, beside a wizard
    night,   // looked after by it meanwhile
    screen   // one of its screens, by whichever venue's show: of ofScreen()
  };
  /// In place of a venue, a screen of this desktop.
  static std::filesystem::path ofScreen(const QString& connector);
  /// Empty: another program uses it in this way. A computer that keeps no such notes grants all.
  static std::optional<VenueUse> take(const std::filesystem::path& venue, Way way);
  /// Whether another program does, or another VenueUse of this one.
  static bool isTaken(const std::filesystem::path& venue, Way way);
  /// Asks that program to end, which it does in its own time. False: there is none.
  static bool end(const std::filesystem::path& venue, Way way);

 private:
  explicit VenueUse(std::optional<platform::FolderLock> lock) : lock_(std::move(lock)) {}
  std::optional<platform::FolderLock> lock_;  // none: nothing can be noted here
};

}  // namespace relucent::gui
