// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <filesystem>

#include "relucent/image/image.h"

namespace relucent::gui {

/// The product's own picture, a resource, where the user has chosen none.
QString defaultPicture();
/// The file of a picture, for core. What lies within the program is written into `folder`, which is created.
/// Throws: Error{disk}.
std::filesystem::path pictureFile(const QString& picture, const std::filesystem::path& folder);
/// A picture as linear content; a resource too. Throws: as readLinearContent().
image::Image linearContentOf(const QString& file);

}  // namespace relucent::gui
