// SPDX-License-Identifier: MIT
#pragma once

#include <new>
#include <opencv2/core.hpp>

namespace relucent::image {

/// What `call` returns, which calls OpenCV: where there is too little memory, that throws what the standard
/// library does, instead of an exception of its own that nobody takes for that.
template <typename Call>
auto withinMemory(const Call& call) {
  try {
    return call();
  } catch (const cv::Exception& failure) {
    if (failure.code == cv::Error::StsNoMem) throw std::bad_alloc();
    throw;
  }
}

}  // namespace relucent::image
