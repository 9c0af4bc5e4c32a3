// SPDX-License-Identifier: MIT
#include "relucent/venue/traced_transport.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "relucent/base/parallel.h"
#include "relucent/base/signed_codes.h"

namespace relucent::venue {
namespace {

/// Siblings that are together less than this of a row are not told apart: on average they hold less than
/// half of what the camera's noise hides.
constexpr float weakShare = 1.0f / 400.0f;

/// One line of camera pixels, compact: a full picture of rows in floats would not fit.
struct Line {
  std::vector<std::size_t> rowStart{0};
  std::vector<std::uint32_t> node;
  std::vector<std::array<std::int16_t, 9>> code;
  std::vector<float> scale;  // per pixel
  CameraStack flood, roomLight;
};

void appendRow(const TransportRow& row, const transport::NodeLayout& layout, Line& line) {
  std::vector<transport::ColourBlock> blocks;
  blocks.reserve(row.entries().size());
  float largest = 0.0f;
  Eigen::Vector3f flood = Eigen::Vector3f::Zero();
  for (const TransportRow::Entry& entry : row.entries()) {
    blocks.push_back(colourBlock(entry.transport));
    largest = std::max(largest, blocks.back().maxCoeff());
    flood += blocks.back().rowwise().sum();
  }
  float scale = largest / largestCode;
  line.scale.push_back(scale);
  line.flood.insert(line.flood.end(), {flood.x(), flood.y(), flood.z()});
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    std::array<std::int16_t, 9> code{};
    bool zero = true;
    for (std::size_t k = 0; k < 9; ++k) {
      code[k] = static_cast<std::int16_t>(std::lround(blocks[i].data()[k] / scale));
      zero = zero && code[k] == 0;
    }
    if (zero) continue;
    line.node.push_back(static_cast<std::uint32_t>(layout.index(row.entries()[i].node)));
    line.code.push_back(code);
  }
  line.rowStart.push_back(line.node.size());
}

/// `first`: its first pixel.
Line traceLine(const Tracer& tracer, const TracerSettings& settings, std::size_t first, int width) {
  int coarsest = tracer.layout().levels() - 1;
  for (std::size_t p = 0; p < tracer.layout().projectors().devices(); ++p)
    coarsest = std::min(coarsest, tracer.layout().levels(p) - 1);
  TransportRow row;
  Line line;
  for (int x = 0; x < width; ++x) {
    row.clear();
    Spectrum seen = tracer.trace(first + static_cast<std::size_t>(x), row);
    row.condense(weakShare, std::min(settings.finestIndirectLevel, coarsest), coarsest);
    appendRow(row, tracer.layout(), line);
    Eigen::Array3f room = underRoomLight(seen);
    line.roomLight.insert(line.roomLight.end(), {room[0], room[1], room[2]});
  }
  return line;
}

/// Of all cameras in turn.
std::vector<Line> traceLines(const Tracer& tracer, const TracerSettings& settings, Progress& progress) {
  struct Place {
    std::size_t first;
    int width;
  };
  std::vector<Place> places;
  for (std::size_t camera = 0; camera < tracer.cameras().devices(); ++camera) {
    const Size size = tracer.cameras().size(camera);
    for (int y = 0; y < size.height; ++y)
      places.push_back({tracer.cameras().offset(camera) + indexOf(size, {0, y}), size.width});
  }
  std::vector<Line> lines(places.size());
  constexpr std::size_t together = 8;
  for (std::size_t begin = 0; begin < lines.size(); begin += together) {
    std::size_t end = std::min(lines.size(), begin + together);
    parallelFor(begin, end, 1, [&](std::size_t line) {
      lines[line] = traceLine(tracer, settings, places[line].first, places[line].width);
    });
    progress.report(static_cast<double>(end) / static_cast<double>(lines.size()));
  }
  return lines;
}

/// The factor that takes the 99th percentile of the flood image's brightest channel to `brightSignal`.
float unitsFactor(const std::vector<Line>& lines, double brightSignal) {
  std::vector<float> brightest;
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.flood.size(); i += 3)
      brightest.push_back(std::max({line.flood[i], line.flood[i + 1], line.flood[i + 2]}));
  auto place = brightest.begin() + static_cast<std::ptrdiff_t>(brightest.size() * 99 / 100);
  std::nth_element(brightest.begin(), place, brightest.end());
  return *place > 0.0f ? static_cast<float>(brightSignal) / *place : 1.0f;
}

std::vector<float> largestByNode(const std::vector<Line>& lines, std::size_t nodes, float factor) {
  std::vector<float> largest(nodes, 0.0f);
  for (const Line& line : lines) {
    for (std::size_t pixel = 0; pixel < line.scale.size(); ++pixel) {
      for (std::size_t i = line.rowStart[pixel]; i < line.rowStart[pixel + 1]; ++i) {
        std::int16_t code = *std::max_element(line.code[i].begin(), line.code[i].end());
        float& value = largest[line.node[i]];
        value = std::max(value, factor * line.scale[pixel] * static_cast<float>(code));
      }
    }
  }
  return largest;
}

/// What was traced, times `factor`.
TracedTransport assembled(const Tracer& tracer, std::vector<Line> lines, float factor) {
  TracedTransport traced;
  traced.fullScale = largestByNode(lines, tracer.layout().count(), factor);
  transport::BlockSparseBuilder builder(tracer.cameras().count(), traced.fullScale);
  std::size_t pixel = 0;
  for (Line& line : lines) {
    for (std::size_t i = 0; i < line.scale.size(); ++i, ++pixel) {
      for (std::size_t entry = line.rowStart[i]; entry < line.rowStart[i + 1]; ++entry) {
        transport::ColourBlock block;
        for (std::size_t k = 0; k < 9; ++k)
          block.data()[k] = factor * line.scale[i] * static_cast<float>(line.code[entry][k]);
        builder.add(line.node[entry], pixel, block.transpose());
      }
    }
    traced.roomLight.insert(traced.roomLight.end(), line.roomLight.begin(), line.roomLight.end());
    line = {};
  }
  traced.cameraByNode = builder.build();
  return traced;
}

double sumOf(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// By which factor the flood image is brighter than what is traced: that of the first camera's brightest
/// line, traced once more.
float unitsOf(const Tracer& tracer, const TracerSettings& settings, const CameraStack& flood) {
  const Size size = tracer.cameras().size(0);
  const std::size_t values = 3 * static_cast<std::size_t>(size.width);
  const auto lightOf = [&](int y) {
    return sumOf(std::span<const float>(flood).subspan(static_cast<std::size_t>(y) * values, values));
  };
  int brightest = 0;
  for (int y = 1; y < size.height; ++y)
    if (lightOf(y) > lightOf(brightest)) brightest = y;
  const Line line = traceLine(tracer, settings, indexOf(size, {0, brightest}), size.width);
  const double traced = sumOf(line.flood);
  return traced > 0.0 ? static_cast<float>(lightOf(brightest) / traced) : 1.0f;
}

}  // namespace

TracedTransport traceTransport(const Scene& scene, const TracerSettings& settings, double brightSignal,
                               Progress& progress) {
  Tracer tracer(scene, settings);
  std::vector<Line> lines = traceLines(tracer, settings, progress);
  const float factor = unitsFactor(lines, brightSignal);
  return assembled(tracer, std::move(lines), factor);
}

TracedTransport traceInUnitsOf(const Scene& known, const CameraStack& flood, const Scene& scene,
                               const TracerSettings& settings, Progress& progress) {
  const float factor = unitsOf(Tracer(known, settings), settings, flood);
  const Tracer tracer(scene, settings);
  return assembled(tracer, traceLines(tracer, settings, progress), factor);
}

}  // namespace relucent::venue
