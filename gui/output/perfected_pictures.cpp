// SPDX-License-Identifier: MIT
#include "output/perfected_pictures.h"

#include <utility>

#include "relucent/base/error.h"

namespace relucent::gui {

PerfectedPictures::PerfectedPictures(std::filesystem::path calibration, std::string shownFrom,
                                     Rasters projectors, Warn warn)
    : calibration_(std::move(calibration)),
      shownFrom_(std::move(shownFrom)),
      projectors_(std::move(projectors)),
      warn_(std::move(warn)) {}

const compensation::Compensation* PerfectedPictures::of(const ContentPicture& content,
                                                        std::uint64_t edition) {
  if (content.identity.empty()) return nullptr;
  if (content.number != number_ || edition != edition_) {
    number_ = content.number;
    edition_ = edition;
    last_ = {};
    try {
      const std::string key = pipeline::perfectedKey(shownFrom_, content.identity);
      if (const std::optional<pipeline::PerfectedPicture> found = pipeline::findPerfected(calibration_, key))
        last_.projector = driveOf(*found, projectors_);
    } catch (const Error& error) {
      if (warn_) warn_(error.sentence());
    }
  }
  return last_.projector.empty() ? nullptr : &last_;
}

}  // namespace relucent::gui
