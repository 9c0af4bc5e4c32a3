// SPDX-License-Identifier: MIT
#include "output/drive_pictures.h"

#include "relucent/base/require.h"

namespace relucent::gui {

std::vector<QImage> drivePictures(const ProjectorStack& linear, const Rasters& projectors,
                                  const std::vector<engine::DriveEncoder>& encoders) {
  require(encoders.size() == projectors.devices(), "{} encoders for {} projectors", encoders.size(),
          projectors.devices());
  std::vector<QImage> pictures;
  for (std::size_t i = 0; i < projectors.devices(); ++i) {
    const Size size = projectors.size(i);
    QImage picture(size.width, size.height, QImage::Format_RGBX8888);
    for (int y = 0; y < size.height; ++y) {
      const std::size_t first = projectors.offset(i) + indexOf(size, {0, y});
      encoders[i].encodeLine(&linear[3 * first], size.width, y,
                             reinterpret_cast<std::uint32_t*>(picture.scanLine(y)));
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace relucent::gui
