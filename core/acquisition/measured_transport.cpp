// SPDX-License-Identifier: MIT
#include "relucent/acquisition/measured_transport.h"

namespace relucent::acquisition {
namespace {

CameraStack summed(const std::vector<std::vector<transport::ColourBlock>>& roots, std::size_t rows) {
  CameraStack sum(3 * rows, 0.0f);
  for (const std::vector<transport::ColourBlock>& root : roots)
    for (std::size_t row = 0; row < rows; ++row)
      Eigen::Map<Eigen::Vector3f>(&sum[3 * row]) += root[row].rowwise().sum();
  return sum;
}

}  // namespace

Floods floodsOf(const photography::References& references) {
  std::size_t rows = references.usable.size();
  return {summed(references.root, rows), summed(references.rootVariance, rows)};
}

}  // namespace relucent::acquisition
