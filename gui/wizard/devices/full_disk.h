// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>

#include "relucent/calibration/room_on_disk.h"
#include "views/number_text.h"
#include "wizard/frame/page_model.h"

namespace relucent::gui {

/// What stands above a page while its measurement waits for room on the disk.
inline Banner fullDisk(const calibration::FullDisk& disk, PageCommand* goOn) {
  return {Banner::Kind::amber,
          QCoreApplication::translate("FullDisk", "The disk is full. Measuring has paused."),
          QCoreApplication::translate(
              "FullDisk",
              "Every photograph is safe. %1 are free, %2 are needed: then measuring goes on "
              "by itself.")
              .arg(bytesText(disk.free), bytesText(disk.needed)),
          goOn};
}

}  // namespace relucent::gui
