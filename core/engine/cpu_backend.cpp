// SPDX-License-Identifier: MIT
#include "relucent/engine/cpu_backend.h"

#include <algorithm>
#include <thread>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/image/colour.h"

namespace relucent::engine {
namespace {

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
      patchSums_(engine.transport, engine.venue.transport.layout().count()),
      scratch_(std::thread::hardware_concurrency() + 1,
               stepColumn * (engine.transport.mostColumns() + leavesTogether)) {
  for (std::size_t code = 0; code < linearOfSrgb_.size(); ++code)
    linearOfSrgb_[code] = static_cast<float>(image::srgbDecode(static_cast<double>(code) / 255.0));
  std::size_t cameraPixels = engine.venue.usable.size();
  wanted_.resize(3 * cameraPixels + 1);  // four values can be read at once wherever three are
  held_.resize(3 * cameraPixels + 1);
  placed_.resize(3 * cameraPixels);
  weight_.resize(cameraPixels);
  unmixed_.resize(4 * cameraPixels);
  std::size_t nodes = engine.venue.transport.layout().count();
  nodes_.resize(3 * nodes + 1);  // the same
  adjoint_.resize(3 * nodes);
  part_.resize(3 * nodes);
  waiting_.resize(PatchSums::placeFloats * patchSums_.places());
  std::size_t projectorValues = 3 * engine.brightest.size();
  bound_.resize(projectorValues);
  reachableC_.resize(projectorValues);
  frameC_.resize(projectorValues);
}

void CpuBackend::setContent(const EngineContent& content) {
  content_ = &content;
  std::fill(wanted_.begin(), wanted_.end(), 0.0f);
  std::fill(held_.begin(), held_.end(), 0.0f);
  std::fill(placed_.begin(), placed_.end(), 0.0f);
  std::fill(weight_.begin(), weight_.end(), 0.0f);
  std::fill(unmixed_.begin(), unmixed_.end(), 0.0f);
  std::fill(nodes_.begin(), nodes_.end(), 0.0f);
  reach_.assign(content.isWeighted ? weight_.size() : 0, 0.0f);
  weightedLit_.assign(content.isWeighted ? content.lit.size() : 0, 0.0f);
  for (std::size_t i = 0; i < weightedLit_.size(); ++i)
    weightedLit_[i] = content.weight[i / 3] * content.lit[i];
  freeValues_ = 3 * static_cast<std::size_t>(std::count(content.free.begin(), content.free.end(), 1));
  prepareBound();
}

bool CpuBackend::render(const ContentFrame& frame, const FrameRequest& request,
                        std::span<std::uint32_t> words, FrameReport& report) noexcept {
  report = {};
  Clock::time_point begin = Clock::now();
  placeContent(frame, request);
  if (request.compensated) {
    const std::vector<float>& lengths = engine_.settings.compensator.steps;
    const int steps = std::clamp(request.steps, 0, static_cast<int>(lengths.size()));
    invert();
    passThrough(Pass::correct);
    makePreconditioner();
    correct(steps == 0 ? words : OutputWords{});
    Clock::time_point refining = Clock::now();
    for (; report.steps < steps; ++report.steps)
      refine(lengths[static_cast<std::size_t>(report.steps)],
             report.steps + 1 == steps ? words : OutputWords{});
    report.stepSeconds = Clock::now() - refining;
  } else {
    warpOnly(words);
  }
  if (freeValues_ > 0) report.clipped = static_cast<double>(clipped_) / static_cast<double>(freeValues_);
  report.seconds = Clock::now() - begin;
  return true;
}

void CpuBackend::warpOnly(OutputWords words) noexcept {
  // The brightness that brings flood * content nearest to what is wanted; summed in fixed parts.
  constexpr std::size_t parts = 64;
  std::array<double, parts> wanted{}, seen{};
  const compensation::MeasuredVenue& venue = engine_.venue;
  const std::vector<std::int32_t>& brightest = content_->brightest;
  parallelChunks(0, placed_.size(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto weight = static_cast<double>(content_->weight[i / 3]);
      if (weight == 0.0) continue;
      double light = static_cast<double>(venue.flood[i]) * static_cast<double>(placed_[i]);
      wanted[part] += weight * light * static_cast<double>(wanted_[i]);
      seen[part] += weight * light * light;
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
  parallelFor(0, brightest.size(), 1024, [&](std::size_t j) {
    const bool shown = brightest[j] >= 0 && content_->free[j];
    const std::size_t from = shown ? 3 * static_cast<std::size_t>(brightest[j]) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      nodes_[3 * j + c] = shown ? clamp01(brightness * placed_[from + c]) : 0.0f;
  });
  const Rasters& projectors = venue.transport.projectors();
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(projectors.size(device).height), 8,
                [&](std::size_t y) { encodeLine(device, static_cast<int>(y), words); });
}

template <typename Put>
void CpuBackend::putTiles(std::size_t device, std::size_t tileRow, bool clamped, const Put& put) noexcept {
  constexpr std::size_t mostPixels = 64;  // of a tile of 8x8, the largest
  const Rasters& projectors = engine_.venue.transport.projectors();
  const Size size = projectors.size(device), grid = windows_.tiles->size(device);
  const std::size_t side = static_cast<std::size_t>(windows_.tile), pixels = side * side;
  const int top = static_cast<int>(tileRow) * windows_.tile;
  const int height = std::min(windows_.tile, size.height - top);
  for (int column = 0; column < grid.width; ++column) {
    float values[3 * mostPixels];
    const std::size_t tile =
        windows_.tiles->offset(device) + indexOf(grid, {column, static_cast<int>(tileRow)});
    kernels_.window(windows_, tile, unmixed_.data(), clamped, values);
    const int left = column * windows_.tile;
    const auto width = static_cast<std::size_t>(std::min(windows_.tile, size.width - left));
    for (int y = 0; y < height; ++y) {
      const std::size_t first = projectors.offset(device) + indexOf(size, {left, top + y});
      const float* from = values + static_cast<std::size_t>(y) * side;
      float* p = &nodes_[3 * first];
      for (std::size_t x = 0; x < width; ++x, p += 3) {
        const auto free = static_cast<float>(content_->free[first + x]);
        for (std::size_t c = 0; c < 3; ++c) put(p[c], free * from[c * pixels + x]);
      }
    }
  }
}

void CpuBackend::invert() noexcept {
  for (std::size_t device = 0; device < windows_.tiles->devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(windows_.tiles->size(device).height), 1, [&](std::size_t row) {
      putTiles(device, row, true, [](float& p, float value) { p = value; });
    });
}

void CpuBackend::correct(OutputWords words) noexcept {
  const float byInverse = engine_.settings.compensator.correctionByInverse;
  const float byAdjoint = engine_.settings.compensator.correctionByAdjoint;
  const Rasters& projectors = engine_.venue.transport.projectors();
  clipped_ = 0;
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(windows_.tiles->size(device).height), 1, [&](std::size_t row) {
      putTiles(device, row, false, [byInverse](float& p, float value) { p += byInverse * value; });
      // While the tiles are in the cache.
      const int top = static_cast<int>(row) * windows_.tile;
      const int end = std::min(top + windows_.tile, projectors.size(device).height);
      for (int y = top; y < end; ++y) finishLine(device, y, byAdjoint, words);
    });
}

void CpuBackend::refine(float length, OutputWords words) noexcept {
  passThrough(Pass::step);
  clipped_ = 0;
  const Rasters& projectors = engine_.venue.transport.projectors();
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(projectors.size(device).height), 8,
                [&](std::size_t y) { finishLine(device, static_cast<int>(y), length, words); });
}

void CpuBackend::finishLine(std::size_t device, int y, float length, OutputWords words) noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  const Size size = projectors.size(device);
  const std::size_t first = 3 * (projectors.offset(device) + indexOf(size, {0, y}));
  // Where nothing is free, C is 0 and p stays 0.
  const std::size_t cut =
      kernels_.update(&nodes_[first], preconditioner_ + first, &adjoint_[first],
                      length * preconditionerScale_, 3 * static_cast<std::size_t>(size.width));
  clipped_.fetch_add(cut, std::memory_order_relaxed);
  if (!words.empty()) encodeLine(device, y, words);
}

void CpuBackend::encodeLine(std::size_t device, int y, OutputWords words) const noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  const Size size = projectors.size(device);
  const std::size_t first = projectors.offset(device) + indexOf(size, {0, y});
  engine_.encoders[device].encodeLine(&nodes_[3 * first], size.width, y, &words[first]);
}

}  // namespace relucent::engine
