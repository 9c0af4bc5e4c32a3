// SPDX-License-Identifier: MIT
#pragma once

#include <QTemporaryDir>
#include <filesystem>

#include "wizard/session/session.h"

namespace relucent::gui {

/// A calibration's results as they were before it began to be measured again, to be read while that goes on
/// or has not ended: a copy of its manifest, with the settings of those results, beside a link to them, which
/// nobody changes. Gone with this.
class ResultsBeside {
 public:
  /// Whether they are needed: the folder is a measurement's, or its settings are those of one.
  static bool areNeeded(const Session& session);

  /// Throws: Error{disk, format}.
  explicit ResultsBeside(const std::filesystem::path& calibration);

  /// A calibration's folder, for reading.
  std::filesystem::path path() const { return folder_.path().toStdString(); }

 private:
  QTemporaryDir folder_;
};

}  // namespace relucent::gui
