// SPDX-License-Identifier: MIT
#include "engine/cpu_backend.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"
#include "image/color.h"

namespace relucent {
namespace {

constexpr std::size_t nodesOfARange = 2048;
using Clock = std::chrono::steady_clock;

/// In two steps, each of them one instruction without a branch; what is no number becomes 0.
float clamp01(float value) {
  const float positive = value > 0.0f ? value : 0.0f;
  return positive < 1.0f ? positive : 1.0f;
}

}  // namespace

CpuBackend::CpuBackend(const EngineVenue& engine, const EngineKernels* kernels)
    : engine_(engine),
      kernels_(kernels != nullptr ? *kernels : engineKernels().back()),
      name_(fmt::format("CPU, {}", kernels_.instructions)),
      windows_(engine.inverse.view()),
      scratch_(std::thread::hardware_concurrency() + 1, correctColumn * engine.transport.mostColumns()) {
  for (std::size_t code = 0; code < linearOfSrgb_.size(); ++code)
    linearOfSrgb_[code] = static_cast<float>(srgbDecode(static_cast<double>(code) / 255.0));
  std::size_t cameraPixels = engine.venue.usable.size();
  wanted_.resize(3 * cameraPixels);
  held_.resize(3 * cameraPixels);
  placed_.resize(3 * cameraPixels);
  weight_.resize(cameraPixels);
  unmixed_.resize(4 * cameraPixels);
  std::size_t nodes = engine.venue.transport.layout().count();
  nodes_.resize(3 * nodes);
  free_.resize(3 * engine.brightest.size());
  adjoint_.resize(3 * nodes);
  bound_.resize(3 * nodes);
  const PackedTransport& transport = engine.transport;
  sums_.resize(8 * transport.nodes().size());

  std::size_t ranges = (nodes + nodesOfARange - 1) / nodesOfARange;
  std::vector<std::vector<Piece>> ofRange(ranges);
  for (const TransportPatch& patch : transport.patches()) {
    for (std::uint32_t begin = patch.columnBegin; begin < patch.columnEnd;) {
      std::size_t range = transport.nodes()[begin] / nodesOfARange;
      std::uint32_t end = begin;
      while (end < patch.columnEnd && transport.nodes()[end] / nodesOfARange == range) ++end;
      ofRange[range].push_back({begin, end});
      begin = end;
    }
  }
  rangeStart_.push_back(0);
  for (const auto& pieces : ofRange) {
    piece_.insert(piece_.end(), pieces.begin(), pieces.end());
    rangeStart_.push_back(static_cast<std::uint32_t>(piece_.size()));
  }
}

void CpuBackend::setContent(const EngineContent& content) {
  content_ = &content;
  std::fill(wanted_.begin(), wanted_.end(), 0.0f);
  std::fill(held_.begin(), held_.end(), 0.0f);
  std::fill(placed_.begin(), placed_.end(), 0.0f);
  std::fill(weight_.begin(), weight_.end(), 0.0f);
  std::fill(unmixed_.begin(), unmixed_.end(), 0.0f);
  std::fill(nodes_.begin(), nodes_.end(), 0.0f);
  for (std::size_t i = 0; i < free_.size(); ++i) free_[i] = content.free[i / 3] ? 1.0f : 0.0f;
  freeValues_ = 3 * static_cast<std::size_t>(std::count(content.free.begin(), content.free.end(), 1));
}

bool CpuBackend::render(const ContentFrame& frame, const FrameRequest& request,
                        std::span<std::uint32_t> words, FrameReport& report) noexcept {
  report = {};
  Clock::time_point begin = Clock::now();
  placeContent(frame, request);
  if (request.compensated) {
    invert(false);
    passThrough(Pass::correct);
    invert(true);
    Clock::time_point refining = Clock::now();
    const std::vector<float>& lengths = engine_.settings.compensator.steps;
    while (report.steps < request.steps && report.steps < static_cast<int>(lengths.size()))
      refine(lengths[static_cast<std::size_t>(report.steps++)]);
    report.stepSeconds = Clock::now() - refining;
  } else {
    warpOnly();
  }
  encode(words);
  if (freeValues_ > 0) report.clipped = static_cast<double>(clipped_) / static_cast<double>(freeValues_);
  report.seconds = Clock::now() - begin;
  return true;
}

void CpuBackend::warpOnly() noexcept {
  // The brightness that brings flood * content nearest to what is wanted; summed in fixed parts.
  constexpr std::size_t parts = 64;
  std::array<double, parts> wanted{}, seen{};
  const MeasuredVenue& venue = engine_.venue;
  parallelChunks(0, placed_.size(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!venue.usable[i / 3]) continue;
      double light = static_cast<double>(venue.flood[i]) * static_cast<double>(placed_[i]);
      wanted[part] += light * static_cast<double>(wanted_[i]);
      seen[part] += light * light;
    }
  });
  double allWanted = 0.0, allSeen = 0.0;
  for (std::size_t part = 0; part < parts; ++part) {
    allWanted += wanted[part];
    allSeen += seen[part];
  }
  float brightness = allSeen > 0.0 ? static_cast<float>(std::clamp(allWanted / allSeen, 0.0, 1.0)) : 1.0f;
  // Content lies between 0 and 1, and so does the brightness: nothing is cut off.
  clipped_ = 0;
  parallelFor(0, engine_.brightest.size(), 1024, [&](std::size_t j) {
    const bool shown = engine_.brightest[j] >= 0 && content_->free[j];
    const std::size_t from = shown ? 3 * static_cast<std::size_t>(engine_.brightest[j]) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      nodes_[3 * j + c] = shown ? clamp01(brightness * placed_[from + c]) : 0.0f;
  });
}

void CpuBackend::invert(bool correction) noexcept {
  const float byInverse = engine_.settings.compensator.correctionByInverse;
  const Rasters& projectors = engine_.venue.transport.projectors();
  const std::size_t side = static_cast<std::size_t>(windows_.tile), pixels = side * side;
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    const Size size = projectors.size(device), grid = windows_.tiles->size(device);
    const std::size_t firstTile = windows_.tiles->offset(device), firstPixel = projectors.offset(device);
    parallelFor(0, grid.count(), 64, [&](std::size_t tile) {
      float values[3 * 64];  // of a tile of 8x8, the largest
      kernels_.window(windows_, firstTile + tile, unmixed_.data(), !correction, values);
      const Pixel place = pixelAt(grid, tile);
      const int left = place.x * windows_.tile, top = place.y * windows_.tile;
      const int width = std::min(windows_.tile, size.width - left);
      const int height = std::min(windows_.tile, size.height - top);
      for (int y = 0; y < height; ++y) {
        std::size_t pixel = firstPixel + indexOf(size, {left, top + y});
        std::size_t i = static_cast<std::size_t>(y) * side;
        for (int x = 0; x < width; ++x, ++pixel, ++i) {
          float* const p = &nodes_[3 * pixel];
          const float free = free_[3 * pixel];
          for (std::size_t c = 0; c < 3; ++c) {
            const float value = free * values[c * pixels + i];
            p[c] = correction ? p[c] + byInverse * value : value;
          }
        }
      }
    });
  }
  if (correction) update(engine_.settings.compensator.correctionByAdjoint);
}

void CpuBackend::update(float length) noexcept {
  constexpr std::size_t valuesOfATask = 12288;
  const std::size_t values = free_.size();
  clipped_ = 0;
  // Where nothing is free, C is 0 and p stays 0.
  parallelChunks(0, values, (values + valuesOfATask - 1) / valuesOfATask,
                 [&](std::size_t, std::size_t begin, std::size_t end) {
                   std::size_t cut =
                       kernels_.update(&nodes_[begin], &bound_[begin], &adjoint_[begin], length, end - begin);
                   clipped_.fetch_add(cut, std::memory_order_relaxed);
                 });
}

void CpuBackend::passThrough(Pass pass) noexcept {
  const PackedTransport& transport = engine_.transport;
  engine_.venue.transport.layout().fillMeans(nodes_);
  const bool correct = pass == Pass::correct;
  const CameraArrays camera{correct ? held_.data() : wanted_.data(), weight_.data(), content_->lit.data(),
                            windows_.unmix, unmixed_.data()};
  parallelFor(0, transport.patches().size(), 1, [&](std::size_t index) {
    const TransportPatch& patch = transport.patches()[index];
    const std::uint32_t* node = transport.nodes().data() + patch.columnBegin;
    const std::size_t columns = patch.columnEnd - patch.columnBegin;
    const std::size_t stride = correct ? correctColumn : stepColumn;
    ScratchPool::Loan loan(scratch_);
    float* const scratch = loan.data();
    for (std::size_t column = 0; column < columns; ++column) {
      const float* from = &nodes_[3 * std::size_t{node[column]}];
      float* to = scratch + stride * column;
      to[0] = from[0];
      to[1] = from[1];
      to[2] = from[2];
      std::memset(to + 3, 0, (stride - 3) * sizeof(float));
    }
    const PatchRows rows{patch.rowBegin,
                         patch.rowEnd,
                         transport.pixels().data(),
                         transport.leafStart().data(),
                         transport.leaves().data(),
                         transport.mixing().data()};
    (correct ? kernels_.correct : kernels_.step)(rows, camera, scratch);
    const std::size_t lanes = correct ? 8 : 4;
    float* sums = sums_.data() + lanes * patch.columnBegin;
    for (std::size_t column = 0; column < columns; ++column)
      std::memcpy(sums + lanes * column, scratch + stride * column + 4, lanes * sizeof(float));
  });
  sumPatches(pass);
  engine_.venue.transport.layout().gatherMeansAdjoint(adjoint_);
  if (correct) makePreconditioner();
}

void CpuBackend::sumPatches(Pass pass) noexcept {
  const std::vector<std::uint32_t>& node = engine_.transport.nodes();
  const std::size_t nodes = nodes_.size() / 3;
  const bool correct = pass == Pass::correct;
  parallelFor(0, rangeStart_.size() - 1, 4, [&](std::size_t range) {
    const std::size_t begin = range * nodesOfARange, end = std::min(begin + nodesOfARange, nodes);
    std::fill(&adjoint_[3 * begin], adjoint_.data() + 3 * end, 0.0f);
    if (correct) std::fill(&bound_[3 * begin], bound_.data() + 3 * end, 0.0f);
    for (std::uint32_t p = rangeStart_[range]; p < rangeStart_[range + 1]; ++p) {
      for (std::size_t column = piece_[p].begin; column < piece_[p].end; ++column) {
        float* out = &adjoint_[3 * std::size_t{node[column]}];
        const float* sum = &sums_[(correct ? 8 : 4) * column];
        for (std::size_t c = 0; c < 3; ++c) out[c] += sum[c];
        if (!correct) continue;
        float* bound = &bound_[3 * std::size_t{node[column]}];
        for (std::size_t c = 0; c < 3; ++c) bound[c] += sum[4 + c];
      }
    }
  });
}

void CpuBackend::makePreconditioner() noexcept {
  engine_.venue.transport.layout().gatherMeansAdjoint(bound_);
  const std::size_t values = 3 * engine_.brightest.size();
  constexpr std::size_t parts = 64;
  std::array<float, parts> largest{};
  parallelChunks(0, values, parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j)
      if (content_->free[j / 3]) largest[part] = std::max(largest[part], bound_[j]);
  });
  // What hardly any weighted pixel sees would take steps of any length on rounding errors.
  const float least = 1e-7f * *std::max_element(largest.begin(), largest.end());
  parallelChunks(0, values, parts, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels_.reciprocal(&bound_[begin], &free_[begin], least, end - begin);
  });
}

void CpuBackend::refine(float length) noexcept {
  passThrough(Pass::step);
  update(length);
}

void CpuBackend::encode(std::span<std::uint32_t> words) const noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    const Size size = projectors.size(device);
    const DriveEncoder& encoder = engine_.encoders[device];
    parallelFor(0, static_cast<std::size_t>(size.height), 8, [&](std::size_t y) {
      const std::size_t first = projectors.offset(device) + y * static_cast<std::size_t>(size.width);
      encoder.encodeLine(&nodes_[3 * first], size.width, static_cast<int>(y), &words[first]);
    });
  }
}

}  // namespace relucent
