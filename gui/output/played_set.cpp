// SPDX-License-Identifier: MIT
#include "output/played_set.h"

#include "relucent/base/error.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"

namespace relucent::gui {

PlayedSet playedBy(const std::filesystem::path& calibration, const std::string& set) {
  PlayedSet played;
  played.opened = played.name = set;
  try {
    const calibration::CalibrationFolder folder = pipeline::openWithSet(calibration, set);
    played.correctedFrom = pipeline::fingerprintOfCorrection(folder);
    played.shownFrom = pipeline::fingerprintOfShown(folder);
    if (set.empty()) played.name = pipeline::setsOf(folder).nameInUse();
  } catch (const Error&) {  // whoever renders it tells why
    played.correctedFrom.clear();
    played.shownFrom.clear();
  }
  return played;
}

}  // namespace relucent::gui
