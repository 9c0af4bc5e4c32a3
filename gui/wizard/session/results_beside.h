// SPDX-License-Identifier: MIT
#pragma once

#include <QTemporaryDir>
#include <filesystem>

#include "wizard/session/session.h"

namespace relucent::gui {

/// A calibration's results as they were before it began to be measured again, or before other settings were
/// chosen, to be read until there are new ones: a copy of its manifest, in which they are current, beside a
/// link to them, which nobody changes. Gone with this.
class ResultsBeside {
 public:
  /// Whether they are needed: the folder is a measurement's, or its settings are not those of its results.
  static bool areNeeded(const Session& session);

  /// Throws: Error{disk, format}.
  explicit ResultsBeside(const std::filesystem::path& calibration);

  /// A calibration's folder, for reading.
  std::filesystem::path path() const { return folder_.path().toStdString(); }

 private:
  QTemporaryDir folder_;
};

}  // namespace relucent::gui
