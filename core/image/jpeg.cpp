// SPDX-License-Identifier: MIT
#include "relucent/image/jpeg.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "relucent/base/require.h"
#include "relucent/image/picture_files.h"

namespace relucent::image {

std::string encodeJpeg(const Image& encoded) {
  // Which clamps, rounds and orders channels.
  std::string png = encodePng(encoded, 8);
  const cv::Mat picture =
      cv::imdecode(cv::Mat(1, static_cast<int>(png.size()), CV_8U, png.data()), cv::IMREAD_UNCHANGED);
  std::vector<std::uint8_t> bytes;
  require(cv::imencode(".jpg", picture, bytes), "OpenCV cannot encode {}x{} pixels as JPEG", encoded.width(),
          encoded.height());
  return {bytes.begin(), bytes.end()};
}

}  // namespace relucent::image
