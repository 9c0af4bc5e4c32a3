// SPDX-License-Identifier: MIT
#include "relucent/engine/content_warp.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::engine {
namespace {

double edge(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// One axis of the content, halved as often as its crowding asks for.
class Axis {
 public:
  explicit Axis(int pixels) : lengths_{pixels} {}
  void halve() { lengths_.push_back((lengths_.back() + 1) / 2); }
  int length() const { return lengths_.back(); }
  /// What a pixel of the coarsest level is the mean of: adds `weight` in all to the full-size pixels from
  /// `first` on.
  void spread(int pixel, double weight, int first, std::vector<double>& sums) const {
    spread(lengths_.size() - 1, pixel, weight, first, sums);
  }
  /// The first full-size pixel under one of the coarsest level, and behind the last one.
  int begin(int pixel) const { return pixel << (lengths_.size() - 1); }
  int end(int pixel) const { return std::min((pixel + 1) << (lengths_.size() - 1), lengths_.front()); }

 private:
  void spread(std::size_t level, int pixel, double weight, int first, std::vector<double>& sums) const {
    if (level == 0) {
      sums[static_cast<std::size_t>(pixel - first)] += weight;
      return;
    }
    int last = lengths_[level - 1] - 1;
    spread(level - 1, 2 * pixel, 0.5 * weight, first, sums);
    spread(level - 1, std::min(2 * pixel + 1, last), 0.5 * weight, first, sums);
  }
  std::vector<int> lengths_;
};

/// Weights over a rectangle of pixels.
struct Patch {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // [x0, x1) x [y0, y1)
  std::vector<double> weight;
  int width() const { return x1 - x0; }
  double& at(int x, int y) {
    return weight[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
                  static_cast<std::size_t>(x - x0)];
  }
};

/// Where a sample falls between pixel centres along one axis.
struct Between {
  int first, second;
  double share;  // of the second
};
Between between(double place, int length) {
  double x = std::clamp(place * length - 0.5, 0.0, length - 1.0);
  int first = static_cast<int>(x);
  return {first, std::min(first + 1, length - 1), x - first};
}

/// How place() samples the content: pixel for pixel the same places.
class Sampler {
 public:
  Sampler(Size content, const compensation::Placement& placement)
      : contentFromView_(compensation::unitSquareFrom(placement.corners)),
        part_(placement.part),
        columns_(content.width),
        rows_(content.height) {
    const compensation::Corners& c = placement.corners;
    double across = std::min(edge(c[0], c[1]), edge(c[3], c[2]));
    double down = std::min(edge(c[0], c[3]), edge(c[1], c[2]));
    auto crowding = [&] {
      return std::max((part_.x1 - part_.x0) * columns_.length() / across,
                      (part_.y1 - part_.y0) * rows_.length() / down);
    };
    while (crowding() > 8.0 && columns_.length() > 1 && rows_.length() > 1) {
      columns_.halve();
      rows_.halve();
    }
    samples_ = std::clamp(static_cast<int>(std::ceil(2.0 * crowding())), 2, 16);
  }

  bool inside(double x, double y) const {
    Eigen::Vector3d p = contentFromView_ * Eigen::Vector3d(x, y, 1.0);
    return p[2] > 0.0 && p[0] >= 0.0 && p[1] >= 0.0 && p[0] <= p[2] && p[1] <= p[2];
  }

  /// The mean over the view pixel (x, y), as weights of content pixels that sum to one.
  Patch meanOver(int x, int y) const {
    std::vector<std::pair<Between, Between>> places;
    Patch coarse{columns_.length(), rows_.length(), 0, 0, {}};
    for (int sy = 0; sy < samples_; ++sy) {
      for (int sx = 0; sx < samples_; ++sx) {
        Eigen::Vector3d p =
            contentFromView_ * Eigen::Vector3d(x + (sx + 0.5) / samples_, y + (sy + 0.5) / samples_, 1.0);
        Between u = between(part_.x0 + (part_.x1 - part_.x0) * p[0] / p[2], columns_.length());
        Between v = between(part_.y0 + (part_.y1 - part_.y0) * p[1] / p[2], rows_.length());
        coarse.x0 = std::min(coarse.x0, u.first);
        coarse.y0 = std::min(coarse.y0, v.first);
        coarse.x1 = std::max(coarse.x1, u.second + 1);
        coarse.y1 = std::max(coarse.y1, v.second + 1);
        places.emplace_back(u, v);
      }
    }
    coarse.weight.assign(
        static_cast<std::size_t>(coarse.width()) * static_cast<std::size_t>(coarse.y1 - coarse.y0), 0.0);
    double each = 1.0 / (samples_ * samples_);
    for (const auto& [u, v] : places) {
      coarse.at(u.first, v.first) += each * (1.0 - u.share) * (1.0 - v.share);
      coarse.at(u.second, v.first) += each * u.share * (1.0 - v.share);
      coarse.at(u.first, v.second) += each * (1.0 - u.share) * v.share;
      coarse.at(u.second, v.second) += each * u.share * v.share;
    }
    return atFullSize(coarse);
  }

 private:
  Patch atFullSize(Patch& coarse) const {
    Patch full{columns_.begin(coarse.x0),
               rows_.begin(coarse.y0),
               columns_.end(coarse.x1 - 1),
               rows_.end(coarse.y1 - 1),
               {}};
    auto width = static_cast<std::size_t>(full.width()), height = static_cast<std::size_t>(full.y1 - full.y0);
    full.weight.assign(width * height, 0.0);
    std::vector<double> alongX(width), alongY(height);
    for (int y = coarse.y0; y < coarse.y1; ++y) {
      std::fill(alongY.begin(), alongY.end(), 0.0);
      rows_.spread(y, 1.0, full.y0, alongY);
      std::fill(alongX.begin(), alongX.end(), 0.0);
      for (int x = coarse.x0; x < coarse.x1; ++x) columns_.spread(x, coarse.at(x, y), full.x0, alongX);
      for (std::size_t j = 0; j < height; ++j)
        for (std::size_t i = 0; i < width; ++i) full.weight[j * width + i] += alongY[j] * alongX[i];
    }
    return full;
  }

  Eigen::Matrix3d contentFromView_;
  compensation::ImagePart part_;
  Axis columns_, rows_;
  int samples_ = 2;
};

/// Its weights are added to `weights`.
ContentWarp::Footprint coded(const Patch& mean, std::vector<std::uint16_t>& weights) {
  const double largest = *std::max_element(mean.weight.begin(), mean.weight.end());
  ContentWarp::Footprint footprint{mean.x0,
                                   mean.y0,
                                   static_cast<std::uint16_t>(mean.width()),
                                   static_cast<std::uint16_t>(mean.y1 - mean.y0),
                                   static_cast<std::uint32_t>(weights.size()),
                                   0.0f};
  double sum = 0.0;
  for (double weight : mean.weight) {
    auto code = static_cast<std::uint16_t>(std::lround(weight / largest * 65535.0));
    weights.push_back(code);
    sum += code;
  }
  footprint.scale = static_cast<float>(1.0 / sum);
  return footprint;
}

}  // namespace

ContentWarp::ContentWarp(Size content, const std::vector<std::optional<compensation::Placement>>& placements,
                         const Rasters& cameras, const compensation::ViewMap& views)
    : content_(content) {
  require(!content.empty(), "content of {}x{} pixels", content.width, content.height);
  require(placements.size() == cameras.devices() && placements.front().has_value(),
          "{} placements in the views of {} cameras", placements.size(), cameras.devices());
  footprint_.resize(cameras.count());
  const Size view = cameras.size(0);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera)
    if (placements[camera]) placeInView(*placements[camera], cameras.size(camera), cameras.offset(camera));
  if (views.empty()) return;
  CameraMask covered(view.count());
  for (std::size_t i = 0; i < covered.size(); ++i) covered[i] = inside(i);
  for (std::size_t camera = 1; camera < cameras.devices(); ++camera)
    if (!placements[camera])
      lieOnSurface(views, view, covered, cameras.offset(camera),
                   cameras.offset(camera) + cameras.size(camera).count());
}

void ContentWarp::placeInView(const compensation::Placement& placement, Size view, std::size_t first) {
  Sampler sampler(content_, placement);
  struct Row {
    std::vector<std::uint16_t> weight;
  };
  std::vector<Row> rows(static_cast<std::size_t>(view.height));
  parallelFor(0, rows.size(), 4, [&](std::size_t row) {
    int y = static_cast<int>(row);
    for (int x = 0; x < view.width; ++x) {
      if (!sampler.inside(x + 0.5, y + 0.5)) continue;
      footprint_[first + indexOf(view, {x, y})] = coded(sampler.meanOver(x, y), rows[row].weight);
    }
  });
  for (std::size_t row = 0; row < rows.size(); ++row) {
    auto before = static_cast<std::uint32_t>(weight_.size());
    for (int x = 0; x < view.width; ++x)
      footprint_[first + indexOf(view, {x, static_cast<int>(row)})].weight += before;
    weight_.insert(weight_.end(), rows[row].weight.begin(), rows[row].weight.end());
    rows[row].weight = {};
  }
}

/// Of up to four rectangles that lie beside each other, one.
void ContentWarp::lieOnSurface(const compensation::ViewMap& views, Size view, const CameraMask& covered,
                               std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const std::optional<compensation::ViewSample> sample = compensation::sampleAt(views[i], view, covered);
    if (!sample) continue;
    Patch mean{content_.width, content_.height, 0, 0, {}};
    for (std::size_t k = 0; k < sample->pixel.size(); ++k) {
      if (!(sample->share[k] > 0.0f)) continue;
      const Footprint& from = footprint_[sample->pixel[k]];
      mean.x0 = std::min(mean.x0, from.x);
      mean.y0 = std::min(mean.y0, from.y);
      mean.x1 = std::max(mean.x1, from.x + from.width);
      mean.y1 = std::max(mean.y1, from.y + from.height);
    }
    mean.weight.assign(static_cast<std::size_t>(mean.width()) * static_cast<std::size_t>(mean.y1 - mean.y0),
                       0.0);
    for (std::size_t k = 0; k < sample->pixel.size(); ++k) {
      if (!(sample->share[k] > 0.0f)) continue;
      const Footprint& from = footprint_[sample->pixel[k]];
      for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x)
          mean.at(from.x + x, from.y + y) +=
              static_cast<double>(sample->share[k] * from.scale) *
              weight_[from.weight + static_cast<std::size_t>(y * from.width + x)];
    }
    footprint_[i] = coded(mean, weight_);
  }
}

}  // namespace relucent::engine
