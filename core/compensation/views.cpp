// SPDX-License-Identifier: MIT
#include "relucent/compensation/views.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"

namespace relucent::compensation {
namespace {

using Place = std::array<float, 2>;

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr float leastKnown = 0.25f;  // of a pixel's direct light
constexpr float near = 3.0f;         // pixels of the first camera: what lies further apart is another surface
constexpr int smoothings = 100;      // of what is filled in

bool isKnown(const Place& place) {
  return std::isfinite(place[0]);
}

/// Light of a pixel's direct leaves, projector pixel by projector pixel.
struct DirectLight {
  std::size_t projectorPixel;
  float light;
};

/// Of the pixels of one T.
class DirectReader {
 public:
  DirectReader(const transport::TransportMatrix& transport, const DirectLightSettings& settings)
      : transport_(transport), direct_(transport, settings) {}

  void read(std::size_t row, std::vector<DirectLight>& seen) const {
    const transport::NodeLayout& layout = transport_.layout();
    const Rasters& projectors = transport_.projectors();
    seen.clear();
    const transport::LeafRow leaves = transport_.row(row);
    direct_.eachDirect(leaves, [&](std::size_t entry, const transport::Block& block) {
      const float light = leaves.block(entry).sum() / static_cast<float>(block.count());
      if (!(light > 0.0f)) return;
      const auto projector = static_cast<std::size_t>(layout.node(leaves.column(entry)).projector);
      for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
          seen.push_back({projectors.offset(projector) + indexOf(projectors.size(projector), {x, y}), light});
    });
  }

 private:
  const transport::TransportMatrix& transport_;
  DirectLeaves direct_;
};

/// Where what each projector pixel lights lies in the first view.
class Correspondence {
 public:
  explicit Correspondence(const transport::TransportMatrix& transport)
      : place_(transport.projectors().count(), {unknown, unknown}) {}

  /// Of projector pixels of which nothing is known yet, where a camera has what they light.
  void learn(const DirectReader& reader, std::span<const Place> map, std::span<const std::uint8_t> usable,
             std::size_t first) {
    std::vector<double> sums(3 * place_.size(), 0.0);
    std::vector<DirectLight> seen;
    for (std::size_t i = 0; i < map.size(); ++i) {
      if (!usable[i] || !isKnown(map[i])) continue;
      reader.read(first + i, seen);
      for (const DirectLight& each : seen) {
        double* sum = &sums[3 * each.projectorPixel];
        const auto light = static_cast<double>(each.light);
        sum[0] += light * static_cast<double>(map[i][0]);
        sum[1] += light * static_cast<double>(map[i][1]);
        sum[2] += light;
      }
    }
    for (std::size_t j = 0; j < place_.size(); ++j)
      if (sums[3 * j + 2] > 0.0 && !isKnown(place_[j]))
        place_[j] = {static_cast<float>(sums[3 * j] / sums[3 * j + 2]),
                     static_cast<float>(sums[3 * j + 1] / sums[3 * j + 2])};
  }

  const std::vector<Place>& places() const { return place_; }

  Place placeOf(const DirectReader& reader, std::size_t row) const {
    std::vector<DirectLight> seen;
    reader.read(row, seen);
    float all = 0.0f, most = 0.0f;
    Place centre{unknown, unknown};
    for (const DirectLight& each : seen) {
      all += each.light;
      if (!isKnown(place_[each.projectorPixel]) || !(each.light > most)) continue;
      most = each.light;
      centre = place_[each.projectorPixel];
    }
    if (!isKnown(centre)) return centre;
    float together = 0.0f;
    for (int round = 0; round < 3; ++round) {
      float x = 0.0f, y = 0.0f;
      together = 0.0f;
      for (const DirectLight& each : seen) {
        const Place& place = place_[each.projectorPixel];
        if (!isKnown(place) || std::abs(place[0] - centre[0]) > near || std::abs(place[1] - centre[1]) > near)
          continue;
        x += each.light * place[0];
        y += each.light * place[1];
        together += each.light;
      }
      centre = {x / together, y / together};
    }
    return together >= leastKnown * all ? centre : Place{unknown, unknown};
  }

 private:
  std::vector<Place> place_;  // a_j
};

/// One camera's part of the map goes on into usable pixels that nothing is known of: from the nearest known
/// ones, then smoothly between them.
void fill(std::span<Place> map, std::span<const std::uint8_t> usable, Size size) {
  constexpr std::array<Pixel, 4> beside{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const auto eachNeighbour = [&](std::size_t pixel, const auto& visit) {
    const Pixel at = pixelAt(size, pixel);
    for (const Pixel& step : beside) {
      const Pixel to{at.x + step.x, at.y + step.y};
      if (to.x >= 0 && to.y >= 0 && to.x < size.width && to.y < size.height) visit(indexOf(size, to));
    }
  };
  std::vector<std::size_t> reached, filled;
  for (std::size_t i = 0; i < map.size(); ++i)
    if (isKnown(map[i])) reached.push_back(i);
  for (std::size_t next = 0; next < reached.size(); ++next)
    eachNeighbour(reached[next], [&](std::size_t to) {
      if (!usable[to] || isKnown(map[to])) return;
      map[to] = map[reached[next]];
      reached.push_back(to);
      filled.push_back(to);
    });
  for (int round = 0; round < smoothings; ++round)
    for (std::size_t pixel : filled) {
      float x = 0.0f, y = 0.0f, count = 0.0f;
      eachNeighbour(pixel, [&](std::size_t from) {
        if (!isKnown(map[from])) return;
        x += map[from][0];
        y += map[from][1];
        count += 1.0f;
      });
      map[pixel] = {x / count, y / count};
    }
}

/// What is known at first: every pixel of the first camera is where it is.
ViewMap firstView(const Rasters& cameras) {
  ViewMap map(cameras.count(), {unknown, unknown});
  for (std::size_t row = 0; row < cameras.size(0).count(); ++row) {
    const Pixel at = pixelAt(cameras.size(0), row);
    map[row] = {static_cast<float>(at.x) + 0.5f, static_cast<float>(at.y) + 0.5f};
  }
  return map;
}

}  // namespace

ViewMap viewMap(const transport::TransportMatrix& transport, const CameraMask& usable,
                const DirectLightSettings& settings) {
  const Rasters& cameras = transport.cameras();
  require(usable.size() == cameras.count(), "{} flags for {} camera pixels", usable.size(), cameras.count());
  if (cameras.devices() < 2) return {};
  ViewMap map = firstView(cameras);
  const DirectReader reader(transport, settings);
  Correspondence correspondence(transport);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), count = cameras.size(camera).count();
    const std::span<Place> part(map.data() + begin, count);
    const std::span<const std::uint8_t> usableHere(usable.data() + begin, count);
    if (camera > 0) {
      parallelFor(0, count, 256, [&](std::size_t i) {
        if (usableHere[i]) part[i] = correspondence.placeOf(reader, begin + i);
      });
      fill(part, usableHere, cameras.size(camera));
    }
    correspondence.learn(reader, part, usableHere, begin);
  }
  return map;
}

ViewMap viewMapInto(const transport::TransportMatrix& transport, const CameraMask& usable,
                    const ViewMap& views, const transport::TransportMatrix& others,
                    const CameraMask& usableOthers, const DirectLightSettings& settings) {
  const Rasters &measured = transport.cameras(), &cameras = others.cameras();
  require(others.projectors() == transport.projectors() && usable.size() == measured.count() &&
              views.size() == measured.count() && usableOthers.size() == cameras.count(),
          "{} flags, {} places and {} flags for {} and {} camera pixels", usable.size(), views.size(),
          usableOthers.size(), measured.count(), cameras.count());
  const DirectReader known(transport, settings), reader(others, settings);
  Correspondence correspondence(transport);
  for (std::size_t camera = 0; camera < measured.devices(); ++camera) {
    const std::size_t begin = measured.offset(camera), count = measured.size(camera).count();
    correspondence.learn(known, {views.data() + begin, count}, {usable.data() + begin, count}, begin);
  }
  ViewMap map(cameras.count(), {unknown, unknown});
  parallelFor(0, cameras.count(), 256, [&](std::size_t row) {
    if (usableOthers[row]) map[row] = correspondence.placeOf(reader, row);
  });
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), count = cameras.size(camera).count();
    fill({map.data() + begin, count}, {usableOthers.data() + begin, count}, cameras.size(camera));
  }
  return map;
}

std::vector<Place> projectorPlaces(const transport::TransportMatrix& transport, const CameraMask& usable,
                                   const ViewMap& views, const DirectLightSettings& settings) {
  const Rasters& cameras = transport.cameras();
  require(usable.size() == cameras.count() && (views.empty() || views.size() == cameras.count()),
          "{} flags and {} places for {} camera pixels", usable.size(), views.size(), cameras.count());
  const ViewMap map = views.empty() ? firstView(cameras) : views;
  const DirectReader reader(transport, settings);
  Correspondence correspondence(transport);
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const std::size_t begin = cameras.offset(camera), count = cameras.size(camera).count();
    correspondence.learn(reader, {map.data() + begin, count}, {usable.data() + begin, count}, begin);
  }
  return correspondence.places();
}

std::vector<std::size_t> camerasApart(const ViewMap& map, const Rasters& cameras) {
  std::vector<std::size_t> apart;
  for (std::size_t camera = 1; camera < cameras.devices() && !map.empty(); ++camera)
    if (std::ranges::none_of(std::span(map).subspan(cameras.offset(camera), cameras.size(camera).count()),
                             isKnown))
      apart.push_back(camera);
  return apart;
}

std::optional<ViewSample> sampleAt(const Place& place, Size view, const CameraMask& inside) {
  if (!isKnown(place)) return std::nullopt;
  const int column = static_cast<int>(std::floor(place[0])), line = static_cast<int>(std::floor(place[1]));
  if (column < 0 || line < 0 || column >= view.width || line >= view.height ||
      !inside[indexOf(view, {column, line})])
    return std::nullopt;
  const float x = place[0] - 0.5f, y = place[1] - 0.5f;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
  ViewSample sample;
  float sum = 0.0f;
  for (std::size_t i = 0; i < 4; ++i) {
    const bool right = i % 2 == 1, below = i / 2 == 1;
    const Pixel at{x0 + (right ? 1 : 0), y0 + (below ? 1 : 0)};
    if (at.x < 0 || at.y < 0 || at.x >= view.width || at.y >= view.height) continue;
    sample.pixel[i] = indexOf(view, at);
    if (!inside[sample.pixel[i]]) continue;
    sample.share[i] = (right ? u : 1.0f - u) * (below ? v : 1.0f - v);
    sum += sample.share[i];
  }
  for (float& share : sample.share) share /= sum;
  return sample;
}

}  // namespace relucent::compensation
