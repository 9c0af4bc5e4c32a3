// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "relucent/image/image.h"

namespace relucent::image {

// All comparisons count the pixels where `mask` is not 0 (empty: all) and throw std::logic_error if the
// shapes differ or no pixel is left. The results are the same bits for every number of threads.

/// Mean squared difference over pixels and channels.
double mse(const Image& a, const Image& b, std::span<const std::uint8_t> mask = {});

/// 10 log10(peak^2 / mse), decibels; infinite for equal images. On linear light.
double psnr(const Image& a, const Image& b, double peak, std::span<const std::uint8_t> mask = {});

/// The same with a peak per channel: the signal of the target's white. Each channel is divided by it first.
double psnr(const Image& a, const Image& b, const std::array<float, 3>& white,
            std::span<const std::uint8_t> mask = {});

/// Mean structural similarity of the luma of two encoded images (see viewed()), peak 1: Gaussian window of
/// 11x11, sigma 1.5, K1 = 0.01, K2 = 0.03. The mask selects window centres; centres whose window extends
/// beyond the image count only if there are no others. 1 for equal images.
/// Source: Wang, Bovik, Sheikh & Simoncelli 2004.
double ssim(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask = {});

/// The same over several scales, each half as large as the one before, at most five:
///   prod_k mean(cs_k)^(g_k / sum g),  at the coarsest scale with the term of luminance: mean(l cs),
/// g = 0.0448, 0.2856, 0.3001, 0.2363, 0.1333; cs: contrast and structure, negative means count as 0. There
/// are as many scales as hold a window. A pixel of a coarser scale is masked where one of its four is.
/// Source: Wang, Simoncelli & Bovik 2003.
double multiScaleSsim(const Image& encodedA, const Image& encodedB, std::span<const std::uint8_t> mask = {});

}  // namespace relucent::image
