// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

#include "relucent/image/image.h"

namespace relucent::gui {

/// The product's own picture, a resource, where the user has chosen none.
QString defaultPicture();
/// A picture as linear content; a resource too. Throws: as readLinearContent().
image::Image linearContentOf(const QString& file);

}  // namespace relucent::gui
