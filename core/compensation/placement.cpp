// SPDX-License-Identifier: MIT
#include "relucent/compensation/placement.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::compensation {
namespace {

constexpr double usableShare = 0.9;

/// Sums over rectangles of a mask in four look-ups.
class MaskSums {
 public:
  MaskSums(const std::vector<std::uint8_t>& mask, Size size) : width_(size.width + 1) {
    sums_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(size.height + 1), 0);
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x)
        sums_[at(x + 1, y + 1)] = (mask[indexOf(size, {x, y})] ? 1 : 0) + sums_[at(x, y + 1)] +
                                  sums_[at(x + 1, y)] - sums_[at(x, y)];
  }
  int count(int x, int y, int width, int height) const {
    return sums_[at(x + width, y + height)] - sums_[at(x, y + height)] - sums_[at(x + width, y)] +
           sums_[at(x, y)];
  }
  bool mostlyUsable(int x, int y, int width, int height) const {
    return count(x, y, width, height) >= usableShare * width * height;
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  int width_;
  std::vector<int> sums_;
};

/// Half the size, every pixel the mean of four (of fewer at odd borders).
image::Image halved(const image::Image& image) {
  Size size{(image.width() + 1) / 2, (image.height() + 1) / 2};
  image::Image half(size, image.channels());
  parallelFor(0, static_cast<std::size_t>(size.height), 16, [&](std::size_t row) {
    int y = static_cast<int>(row);
    for (int x = 0; x < size.width; ++x) {
      int right = std::min(2 * x + 1, image.width() - 1), below = std::min(2 * y + 1, image.height() - 1);
      for (int c = 0; c < image.channels(); ++c)
        half.at(x, y, c) = 0.25f * (image.at(2 * x, 2 * y, c) + image.at(right, 2 * y, c) +
                                    image.at(2 * x, below, c) + image.at(right, below, c));
    }
  });
  return half;
}

/// Bilinear between pixel centres; u, v in [0, 1] over the whole image, edges continue outward.
void addSample(const image::Image& image, double u, double v, float weight, std::span<float> sum) {
  double x = std::clamp(u * image.width() - 0.5, 0.0, image.width() - 1.0);
  double y = std::clamp(v * image.height() - 0.5, 0.0, image.height() - 1.0);
  int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  int x1 = std::min(x0 + 1, image.width() - 1), y1 = std::min(y0 + 1, image.height() - 1);
  auto fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
  for (int c = 0; c < image.channels(); ++c)
    sum[static_cast<std::size_t>(c)] +=
        weight * ((1 - fy) * ((1 - fx) * image.at(x0, y0, c) + fx * image.at(x1, y0, c)) +
                  fy * ((1 - fx) * image.at(x0, y1, c) + fx * image.at(x1, y1, c)));
}

double edge(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

}  // namespace

Corners uprightCorners(double x, double y, double width, double height) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
}

bool isConvex(const Corners& corners) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto &a = corners[i], &b = corners[(i + 1) % 4], &c = corners[(i + 2) % 4];
    double turn = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
    if (!(turn > 1e-9)) return false;
  }
  return true;
}

Eigen::Matrix3d unitSquareFrom(const Corners& corners) {
  require(isConvex(corners), "the corners of content must turn clockwise");
  // Square to quadrilateral (Heckbert 1989), then inverted.
  const auto &a = corners[0], &b = corners[1], &c = corners[2], &d = corners[3];
  double sx = a[0] - b[0] + c[0] - d[0], sy = a[1] - b[1] + c[1] - d[1];
  double dx1 = b[0] - c[0], dx2 = d[0] - c[0], dy1 = b[1] - c[1], dy2 = d[1] - c[1];
  double determinant = dx1 * dy2 - dx2 * dy1;
  double g = (sx * dy2 - dx2 * sy) / determinant, h = (dx1 * sy - sx * dy1) / determinant;
  Eigen::Matrix3d quadFromSquare;
  quadFromSquare << b[0] - a[0] + g * b[0], d[0] - a[0] + h * d[0], a[0],  //
      b[1] - a[1] + g * b[1], d[1] - a[1] + h * d[1], a[1],                //
      g, h, 1.0;
  return quadFromSquare.inverse();
}

std::optional<Corners> largestUpright(const CameraMask& usable, Size size, double aspect) {
  require(usable.size() == size.count(), "{} flags for {}x{} pixels", usable.size(), size.width, size.height);
  require(aspect > 0.0, "an aspect of {}", aspect);
  MaskSums sums(usable, size);
  constexpr int lowest = 4;
  for (int height = size.height; height >= lowest; --height) {
    int width = static_cast<int>(std::lround(height * aspect));
    if (width < 1 || width > size.width) continue;
    int strip = std::max(1, std::min(width, height) / 16);
    int bestCount = -1;
    double bestDistance = 0.0;
    Pixel best;
    for (int y = 0; y + height <= size.height; ++y) {
      for (int x = 0; x + width <= size.width; ++x) {
        if (!sums.mostlyUsable(x, y, width, height) || !sums.mostlyUsable(x, y, width, strip) ||
            !sums.mostlyUsable(x, y + height - strip, width, strip) ||
            !sums.mostlyUsable(x, y, strip, height) ||
            !sums.mostlyUsable(x + width - strip, y, strip, height))
          continue;
        int count = sums.count(x, y, width, height);
        double distance = std::hypot(x + 0.5 * (width - size.width), y + 0.5 * (height - size.height));
        if (count < bestCount || (count == bestCount && distance >= bestDistance)) continue;
        bestCount = count;
        bestDistance = distance;
        best = {x, y};
      }
    }
    if (bestCount >= 0) return uprightCorners(best.x, best.y, width, height);
  }
  return std::nullopt;
}

Placement fitted(const Corners& quadrilateral, double aspect, Fit fit) {
  require(aspect > 0.0, "content of an aspect of {}", aspect);
  Placement whole{quadrilateral, {}};
  if (fit == Fit::fill) return whole;
  const Corners& q = quadrilateral;
  double shape = (edge(q[0], q[1]) + edge(q[3], q[2])) / (edge(q[0], q[3]) + edge(q[1], q[2]));
  if (fit == Fit::cover) {
    // The centred part that has the quadrilateral's shape.
    double x = std::min(1.0, shape / aspect), y = std::min(1.0, aspect / shape);
    whole.part = {0.5 - 0.5 * x, 0.5 - 0.5 * y, 0.5 + 0.5 * x, 0.5 + 0.5 * y};
    return whole;
  }
  double x = std::min(1.0, aspect / shape), y = std::min(1.0, shape / aspect);
  Eigen::Matrix3d viewFromSquare = unitSquareFrom(quadrilateral).inverse();
  Corners inner = uprightCorners(0.5 - 0.5 * x, 0.5 - 0.5 * y, x, y);
  for (auto& corner : inner) {
    Eigen::Vector3d p = viewFromSquare * Eigen::Vector3d(corner[0], corner[1], 1.0);
    corner = {p[0] / p[2], p[1] / p[2]};
  }
  return {inner, {}};
}

Placed place(const image::Image& content, const Placement& placement, Size view) {
  require(!content.empty(), "there is no content to place");
  const Corners& corners = placement.corners;
  const ImagePart& part = placement.part;
  Eigen::Matrix3d contentFromView = unitSquareFrom(corners);

  // Content pixels along one view pixel at the quadrilateral's most crowded side.
  double acrossView = std::min(edge(corners[0], corners[1]), edge(corners[3], corners[2]));
  double downView = std::min(edge(corners[0], corners[3]), edge(corners[1], corners[2]));
  auto crowding = [&](const image::Image& image) {
    return std::max((part.x1 - part.x0) * image.width() / acrossView,
                    (part.y1 - part.y0) * image.height() / downView);
  };
  image::Image source = content;
  while (crowding(source) > 8.0 && source.width() > 1 && source.height() > 1) source = halved(source);
  int samples = std::clamp(static_cast<int>(std::ceil(2.0 * crowding(source))), 2, 16);

  Placed placed{image::Image(view, content.channels()), CameraMask(view.count(), 0)};
  auto map = [&](double x, double y) {
    Eigen::Vector3d p = contentFromView * Eigen::Vector3d(x, y, 1.0);
    return Eigen::Vector2d(part.x0 + (part.x1 - part.x0) * p[0] / p[2],
                           part.y0 + (part.y1 - part.y0) * p[1] / p[2]);
  };
  parallelFor(0, static_cast<std::size_t>(view.height), 8, [&](std::size_t row) {
    int y = static_cast<int>(row);
    for (int x = 0; x < view.width; ++x) {
      Eigen::Vector3d centre = contentFromView * Eigen::Vector3d(x + 0.5, y + 0.5, 1.0);
      if (!(centre[2] > 0.0) || centre[0] < 0.0 || centre[1] < 0.0 || centre[0] > centre[2] ||
          centre[1] > centre[2])
        continue;
      std::size_t index = indexOf(view, {x, y});
      placed.inside[index] = 1;
      float weight = 1.0f / static_cast<float>(samples * samples);
      for (int sy = 0; sy < samples; ++sy) {
        for (int sx = 0; sx < samples; ++sx) {
          Eigen::Vector2d uv = map(x + (sx + 0.5) / samples, y + (sy + 0.5) / samples);
          addSample(source, uv[0], uv[1], weight, placed.image.pixel(index));
        }
      }
    }
  });
  return placed;
}

}  // namespace relucent::compensation
