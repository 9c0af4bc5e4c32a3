// SPDX-License-Identifier: MIT
#include "relucent/inverse/cluster_inverse.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/parallel.h"
#include "relucent/inverse/unmixing.h"

namespace relucent::inverse {

std::vector<Message> problems(const ClusterInverseSettings& settings) {
  std::vector<Message> found;
  if (!(settings.ridge > 0.0 && settings.ridge <= 100.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("inverse.ridge-out-of-range", "the ridge must lie above 0 and at most 100"));
  if (!(settings.truncation >= 0.0 && settings.truncation < 1.0))
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("inverse.truncation-out-of-range",
                                 "the truncation of singular values must be at least 0 and below 1"));
  return found;
}

std::size_t ClusterInverse::bytes() const {
  return (unmix_.size() + scale_.size()) * sizeof(float) +
         (rowStart_.size() + pixelStart_.size() + weightStart_.size()) * sizeof(std::size_t) +
         (row_.size() + pixel_.size()) * sizeof(std::uint32_t) + weight_.size() * sizeof(std::int16_t);
}

ProjectorStack ClusterInverse::apply(const CameraStack& cameraResidual) const {
  CameraStack light = unmixed(unmix_, cameraResidual);
  ProjectorStack projector(3 * projectors_.count(), 0.0f);
  parallelFor(0, scale_.size(), 16, [&](std::size_t cluster) {
    constexpr std::size_t lanes = 32;  // pixels at once: what stays in registers and the first cache
    std::size_t pixels = pixelStart_[cluster + 1] - pixelStart_[cluster];
    for (std::size_t first = 0; first < pixels; first += lanes) {
      std::size_t count = std::min(lanes, pixels - first);
      float sum[3][lanes] = {};
      const std::int16_t* code = weight_.data() + weightStart_[cluster] + first;
      for (std::size_t k = rowStart_[cluster]; k < rowStart_[cluster + 1]; ++k, code += planes() * pixels) {
        const float* in = &light[3 * static_cast<std::size_t>(row_[k])];
        for (std::size_t p = 0; p < 3; ++p) {
          if (full_) {
            for (std::size_t c = 0; c < 3; ++c)
              for (std::size_t i = 0; i < count; ++i)
                sum[p][i] += in[c] * static_cast<float>(code[(3 * p + c) * pixels + i]);
          } else {
            for (std::size_t i = 0; i < count; ++i) sum[p][i] += in[p] * static_cast<float>(code[i]);
          }
        }
      }
      for (std::size_t i = 0; i < count; ++i) {
        float* out = &projector[3 * static_cast<std::size_t>(pixel_[pixelStart_[cluster] + first + i])];
        for (std::size_t p = 0; p < 3; ++p) out[p] = scale_[cluster] * sum[p][i];
      }
    }
  });
  return projector;
}

transport::BlockSparse ClusterInverse::matrix() const {
  std::vector<std::size_t> start(projectors_.count() + 1, 0);
  for (std::size_t cluster = 0; cluster < scale_.size(); ++cluster)
    for (std::size_t j = pixelStart_[cluster]; j < pixelStart_[cluster + 1]; ++j)
      start[pixel_[j] + 1] = rowStart_[cluster + 1] - rowStart_[cluster];
  for (std::size_t pixel = 0; pixel < projectors_.count(); ++pixel) start[pixel + 1] += start[pixel];

  LargeVector<std::uint32_t> column(start.back());
  LargeVector<transport::BlockSparseWriter::Code> codes(start.back());
  std::vector<float> scale(projectors_.count(), 0.0f);
  parallelFor(0, scale_.size(), 16, [&](std::size_t cluster) {
    std::size_t pixels = pixelStart_[cluster + 1] - pixelStart_[cluster];
    std::vector<transport::ColourBlock> blocks(rowStart_[cluster + 1] - rowStart_[cluster]);
    for (std::size_t j = 0; j < pixels; ++j) {
      std::size_t pixel = pixel_[pixelStart_[cluster] + j];
      float largest = 0.0f;
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        const std::int16_t* code = weight_.data() + weightStart_[cluster] + k * planes() * pixels + j;
        transport::ColourBlock weight = transport::ColourBlock::Identity() * static_cast<float>(code[0]);
        for (std::size_t plane = 0; full_ && plane < 9; ++plane)
          weight.data()[plane] = static_cast<float>(code[plane * pixels]);
        std::size_t row = row_[rowStart_[cluster] + k];
        blocks[k] = scale_[cluster] * weight * Eigen::Map<const transport::ColourBlock>(&unmix_[9 * row]);
        largest = std::max(largest, blocks[k].cwiseAbs().maxCoeff());
      }
      scale[pixel] = largest / 32767.0f;
      for (std::size_t k = 0; k < blocks.size(); ++k) {
        column[start[pixel] + k] = row_[rowStart_[cluster] + k];
        codes[start[pixel] + k] = transport::codeOf(blocks[k], scale[pixel]);
      }
    }
  });
  return transport::BlockSparse::assembled(cameras_.count(), std::move(start), std::move(column),
                                           std::move(codes), std::move(scale));
}

}  // namespace relucent::inverse
