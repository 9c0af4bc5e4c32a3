// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>

#include "wizard/frame/page_model.h"

namespace relucent::gui {

/// What stands above a page while its measurement waits for the projector's screen.
inline Banner missingScreen() {
  return {Banner::Kind::amber,
          QCoreApplication::translate("MissingScreen", "The projector's screen is unplugged"),
          QCoreApplication::translate(
              "MissingScreen", "Every photograph is safe. Plug it in again: measuring goes on by itself.")};
}

}  // namespace relucent::gui
