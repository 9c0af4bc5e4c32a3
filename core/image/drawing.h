// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core.hpp>

#include "relucent/image/image.h"

/// Shared by synthetic pictures. Uses OpenCV's types: only for the .cpp files of these pictures.
namespace relucent::image::drawing {

/// Pictures are drawn at four times the size and averaged down: edges are then as smooth as in a photograph.
inline constexpr int oversampling = 4;

cv::Mat canvas(Size size, const cv::Scalar& encoded);

/// Encoded RGB to linear, averaged down in linear light.
Image finished(const cv::Mat& encoded, Size size);

/// Encoded RGB of a hue (turns), saturation and value.
cv::Scalar hsv(double hue, double saturation, double value);

}  // namespace relucent::image::drawing
