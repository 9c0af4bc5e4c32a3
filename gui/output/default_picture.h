// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <filesystem>

#include "relucent/image/image.h"

namespace relucent::gui {

/// The product's own picture, a resource, where the user has chosen none.
QString defaultPicture();
/// The name of the file that core reads it from.
inline constexpr const char* demonstrationCopy = "Demonstration picture.png";
/// Where the file of a picture is, for core: what lies within the program is named as in `folder`.
std::filesystem::path pathOfPicture(const QString& picture, const std::filesystem::path& folder);
/// The same; what lies within the program is written there. Throws: Error{disk}.
std::filesystem::path pictureFile(const QString& picture, const std::filesystem::path& folder);
/// A picture as linear content; a resource too. Throws: as readLinearContent().
image::Image linearContentOf(const QString& file);

}  // namespace relucent::gui
