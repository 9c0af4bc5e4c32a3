// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "content/content_source.h"
#include "relucent/base/message.h"
#include "relucent/compensation/methods.h"
#include "relucent/pipeline/perfected.h"

namespace relucent::gui {

/// Still pictures that were corrected by photographs of themselves, for the renderer. Each is looked for when
/// it comes on, so that what is perfected meanwhile is shown from its next turn on, and of one that stands
/// when it is asked for in another edition.
class PerfectedPictures {
 public:
  using Warn = std::function<void(const Message&)>;
  /// `shownFrom`: how content is shown, see pipeline::fingerprintOfShown(). `warn`: told of one that cannot
  /// be read; that picture is shown as T has it.
  PerfectedPictures(std::filesystem::path calibration, std::string shownFrom, Rasters projectors, Warn warn);

  /// Null if this picture was not perfected, or not as it is shown now; valid until the next call.
  const compensation::Compensation* of(const ContentPicture& content, std::uint64_t edition);

 private:
  std::filesystem::path calibration_;
  std::string shownFrom_;
  Rasters projectors_;
  Warn warn_;
  std::uint64_t number_ = 0, edition_ = 0;  // of the picture that was looked for last
  compensation::Compensation last_;
};

}  // namespace relucent::gui
