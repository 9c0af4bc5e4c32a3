// SPDX-License-Identifier: MIT
#include "relucent/pipeline/expected_transport.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "relucent/base/parallel.h"

namespace relucent::pipeline {
namespace {

using transport::Block;

// Centres of three blocks are a staircase, whose slope by least squares is 8/9 of that of what it stands for.
constexpr double staircase = 9.0 / 8.0;

/// Where a camera pixel looks to in one projector.
struct Look {
  float light = 0.0f;  // per projector pixel
  Block block;         // the brightest leaf's
  double x = 0.0, y = 0.0;

  int side() const { return std::max(block.x1 - block.x0, block.y1 - block.y0); }
};

/// Looks of all camera pixels, in one projector.
std::vector<Look> looksOf(const transport::TransportMatrix& transport, const CameraMask& usable,
                          std::size_t projector) {
  const transport::NodeLayout& layout = transport.layout();
  std::vector<Look> looks(usable.size());
  parallelFor(0, looks.size(), 256, [&](std::size_t row) {
    if (!usable[row]) return;
    const transport::LeafRow leaves = transport.row(row);
    for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
      transport::Node node = layout.node(leaves.column(entry));
      if (static_cast<std::size_t>(node.projector) != projector) continue;
      Block block = layout.block(node);
      float light = leaves.block(entry).sum() / static_cast<float>(block.count());
      if (light > looks[row].light)
        looks[row] = {light, block, 0.5 * (block.x0 + block.x1), 0.5 * (block.y0 + block.y1)};
    }
  });
  return looks;
}

/// The part of a projector that a camera pixel is expected to see.
struct Area {
  double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
};

/// Where the camera pixels around one look to, as a plane: offset from its own place, slopes along u and v.
using Plane = Eigen::Matrix<double, 3, 2>;

/// `radius`: camera pixels; `reach`: how far from its own place theirs may be, in its blocks.
Plane planeAt(const std::vector<Look>& looks, const Rasters& cameras, std::size_t camera, Pixel at,
              int radius, double reach) {
  Size size = cameras.size(camera);
  const Look& own = looks[cameras.offset(camera) + indexOf(size, at)];
  Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() * 1e-9;
  Plane right = Plane::Zero();
  for (int v = std::max(0, at.y - radius); v <= std::min(size.height - 1, at.y + radius); ++v)
    for (int u = std::max(0, at.x - radius); u <= std::min(size.width - 1, at.x + radius); ++u) {
      const Look& other = looks[cameras.offset(camera) + indexOf(size, {u, v})];
      if (!(other.light > 0.0f) || other.side() > own.side()) continue;
      double apart = std::max(std::abs(other.x - own.x), std::abs(other.y - own.y));
      if (apart > reach * own.side()) continue;
      Eigen::Vector3d equation(1.0, u - at.x, v - at.y);
      normal += equation * equation.transpose();
      right += equation * Eigen::RowVector2d(other.x - own.x, other.y - own.y);
    }
  return normal.ldlt().solve(right);
}

/// Every look moved to where the plane around it says, within its block.
std::vector<Look> moved(const std::vector<Look>& looks, const Rasters& cameras, int radius, double reach,
                        double correction, std::vector<Area>* areas) {
  std::vector<Look> result = looks;
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    parallelFor(0, cameras.size(camera).count(), 32, [&](std::size_t pixel) {
      std::size_t row = cameras.offset(camera) + pixel;
      Look& look = result[row];
      if (!(look.light > 0.0f)) return;
      Plane plane =
          correction * planeAt(looks, cameras, camera, pixelAt(cameras.size(camera), pixel), radius, reach);
      look.x = std::clamp<double>(look.x + plane(0, 0), look.block.x0, look.block.x1);
      look.y = std::clamp<double>(look.y + plane(0, 1), look.block.y0, look.block.y1);
      if (!areas) return;
      double width = std::max(1.0, std::abs(plane(1, 0)) + std::abs(plane(2, 0)));
      double height = std::max(1.0, std::abs(plane(1, 1)) + std::abs(plane(2, 1)));
      (*areas)[row] = {look.x - 0.5 * width, look.y - 0.5 * height, look.x + 0.5 * width,
                       look.y + 0.5 * height};
    });
  return result;
}

/// The pixels of a block that an area meets.
Block metBy(const Area& area, const Block& block) {
  auto low = [](double value) { return static_cast<int>(std::floor(value)); };
  auto high = [](double value) { return static_cast<int>(std::ceil(value)); };
  return {std::max(block.x0, low(area.x0)), std::max(block.y0, low(area.y0)),
          std::min(block.x1, high(area.x1)), std::min(block.y1, high(area.y1))};
}

/// How much of a pixel an area covers.
float coverage(const Area& area, int x, int y) {
  double width = std::min(area.x1, x + 1.0) - std::max(area.x0, static_cast<double>(x));
  double height = std::min(area.y1, y + 1.0) - std::max(area.y0, static_cast<double>(y));
  return static_cast<float>(std::max(0.0, width) * std::max(0.0, height));
}

}  // namespace

transport::TransportMatrix expectedTransport(const transport::TransportMatrix& transport,
                                             const CameraMask& usable) {
  const transport::NodeLayout& layout = transport.layout();
  const Rasters &cameras = transport.cameras(), &projectors = transport.projectors();
  std::vector<std::vector<Look>> looks;
  std::vector<std::vector<Area>> areas(projectors.devices(), std::vector<Area>(usable.size()));
  for (std::size_t projector = 0; projector < projectors.devices(); ++projector) {
    looks.push_back(looksOf(transport, usable, projector));
    // About as far as a block reaches on the camera.
    double lit = 0.0, side = 0.0;
    for (const Look& look : looks.back())
      if (look.light > 0.0f) {
        lit += 1.0;
        side += look.side();
      }
    double across =
        lit > 0.0 ? side / lit * std::sqrt(lit / static_cast<double>(projectors.size(projector).count()))
                  : 1.0;
    int radius = std::clamp(static_cast<int>(std::ceil(1.5 * across)), 1, 32);
    std::vector<Look> once = moved(looks.back(), cameras, radius, 1.5, staircase, nullptr);
    moved(once, cameras, (radius + 1) / 2, 1.0, 1.0, &areas[projector]);
  }
  std::vector<std::vector<std::pair<std::size_t, transport::ColourBlock>>> rows(usable.size());
  std::vector<float> fullScale(usable.size(), 0.0f);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    parallelFor(0, cameras.size(camera).count(), 32, [&](std::size_t pixel) {
      std::size_t row = cameras.offset(camera) + pixel;
      const transport::LeafRow leaves = transport.row(row);
      for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
        std::size_t column = leaves.column(entry);
        transport::Node node = layout.node(column);
        auto projector = static_cast<std::size_t>(node.projector);
        transport::ColourBlock value = leaves.block(entry);
        Block block = layout.block(node);
        Block met = metBy(areas[projector][row], block);
        bool divides = looks[projector][row].light > 0.0f && met.x0 < met.x1 && met.y0 < met.y1 &&
                       std::max(block.x1 - block.x0, block.y1 - block.y0) <= looks[projector][row].side();
        if (!divides) {
          rows[row].emplace_back(column, value);
          continue;
        }
        float covered = 0.0f;
        for (int y = met.y0; y < met.y1; ++y)
          for (int x = met.x0; x < met.x1; ++x) covered += coverage(areas[projector][row], x, y);
        for (int y = met.y0; y < met.y1; ++y)
          for (int x = met.x0; x < met.x1; ++x)
            rows[row].emplace_back(layout.index({node.projector, 0, x, y}),
                                   value * (coverage(areas[projector][row], x, y) / covered));
      }
      for (const auto& [column, value] : rows[row])
        fullScale[row] = std::max(fullScale[row], value.cwiseAbs().maxCoeff());
    });
  std::size_t count = 0;
  for (const auto& row : rows) count += row.size();
  transport::BlockSparseWriter writer(layout.count(), fullScale, count);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (const auto& [column, value] : rows[row])
      writer.add(column, transport::codeOf(value, fullScale[row] / 32767.0f));
    writer.endRow();
  }
  return {cameras, projectors, writer.build()};
}

}  // namespace relucent::pipeline
