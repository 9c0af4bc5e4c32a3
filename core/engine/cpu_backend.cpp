// SPDX-License-Identifier: MIT
#include "relucent/engine/cpu_backend.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <thread>
#include <type_traits>

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
      scratch_(std::thread::hardware_concurrency() + 1, columnFloats * (engine.transport.mostColumns() + 1)),
      contentScratch_(std::thread::hardware_concurrency() + 1, 0) {
  for (std::size_t code = 0; code < linearOfSrgb_.size(); ++code)
    linearOfSrgb_[code] = static_cast<float>(image::srgbDecode(static_cast<double>(code) / 255.0));
  const compensation::MeasuredVenue& venue = engine.venue;
  const std::size_t cameraPixels = venue.usable.size();
  for (std::vector<float>* values : {&wanted_, &held_, &unmixed_, &placed_, &lit_})
    values->resize(4 * cameraPixels);
  known_.resize(8 * cameraPixels);
  for (std::size_t i = 0; i < cameraPixels; ++i) {
    std::copy_n(&venue.black[3 * i], 3, &known_[8 * i]);
    std::copy_n(&venue.flood[3 * i], 3, &known_[8 * i + 4]);
  }
  for (const RowSlice& slice : engine.transport.rowSlices()) {
    unmix_.emplace_back();
    for (std::size_t row = 0; row < rowsTogether; ++row)
      unmix_.back().set(row, Eigen::Map<const transport::ColourBlock>(windows_.unmix + 9 * slice.pixel[row]));
  }
  std::size_t nodes = engine.venue.transport.layout().count();
  nodes_.resize(3 * nodes + 1);  // four values can be read at once wherever three are
  adjoint_.resize(sumFloats * nodes);
  waiting_.resize(sumFloats * patchSums_.places());
  leastBound_.resize(engine.brightest.size());
  firstLine_.push_back(0);
  for (const Size& size : engine.venue.transport.projectors().sizes())
    firstLine_.push_back(firstLine_.back() + static_cast<std::size_t>(size.height));
  preconditioner_.resize(3 * engine.brightest.size());
}

void CpuBackend::setContent(const EngineContent& content) {
  content_ = &content;
  field_ = {};
  for (std::size_t i = 0; i < content.weight.size(); ++i) known_[8 * i + 7] = content.unmaskedShare(i);
  for (std::vector<float>* values : {&wanted_, &held_, &unmixed_, &placed_, &nodes_})
    std::fill(values->begin(), values->end(), 0.0f);
  hasLast_ = false;
  warp_ = WarpTiles(content.warp, engine_.venue.transport.cameras());
  contentScratch_.resize(4 * (warp_.mostPixels + WarpTiles::together));
  takeWeights();
}

void CpuBackend::takeWeights() {
  const EngineContent& content = *content_;
  for (std::size_t i = 0; i < content.weight.size(); ++i) {
    known_[8 * i + 3] = content.weight[i];
  }
  // Where nothing is free C is 0, so that p stays 0.
  for (std::size_t j = 0; j < leastBound_.size(); ++j)
    leastBound_[j] =
        content.free[j] != 0 ? engine_.preconditioner.least() : std::numeric_limits<float>::infinity();
  takeAvailable();
  freeValues_ = 3 * static_cast<std::size_t>(std::count(content.free.begin(), content.free.end(), 1));
}

void CpuBackend::takeAvailable() {
  const EngineContent& content = *content_;
  const CameraStack& flood = engine_.venue.flood;
  const bool all = content.available.empty();
  parallelFor(0, content.weight.size(), 16384, [&](std::size_t i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float missing = all ? 0.0f : content.missing[3 * i + c];
      known_[8 * i + 4 + c] = all ? flood[3 * i + c] : std::max(0.0f, flood[3 * i + c] - missing);
      lit_[4 * i + c] = all ? content.lit[3 * i + c] : std::max(0.0f, content.lit[3 * i + c] - missing);
    }
  });
  const Rasters& projectors = engine_.venue.transport.projectors();
  dimmed_.assign(all ? 0 : firstLine_.back(), 0);
  for (std::size_t device = 0; device < projectors.devices() && !all; ++device)
    parallelFor(0, static_cast<std::size_t>(projectors.size(device).height), 16, [&](std::size_t y) {
      const Size size = projectors.size(device);
      const auto line =
          content.available.begin() +
          static_cast<std::ptrdiff_t>(projectors.offset(device) + indexOf(size, {0, static_cast<int>(y)}));
      dimmed_[lineOf(device, static_cast<int>(y))] =
          std::any_of(line, line + size.width, [](float share) { return share < 1.0f; });
    });
  findFreeTiles();
}

void CpuBackend::availabilityFollowed() {
  require(content_ != nullptr, "content whose light arrives was not set");
  takeAvailable();
  if (content_->available.empty()) return;
  parallelFor(0, content_->available.size(), 16384, [&](std::size_t j) {
    for (std::size_t c = 0; c < 3; ++c)
      nodes_[3 * j + c] = std::min(nodes_[3 * j + c], content_->available[j]);
  });
}

void CpuBackend::contentFollowed() {
  require(content_ != nullptr, "content that follows was not set");
  takeWeights();
  for (std::size_t j = 0; j < content_->free.size(); ++j)
    if (!content_->free[j]) std::fill_n(&nodes_[3 * j], 3, 0.0f);
}

void CpuBackend::startFrom(std::span<const float> projector) {
  require(content_ != nullptr && projector.size() == 3 * engine_.brightest.size(),
          "{} values of {} projector pixels", projector.size(), engine_.brightest.size());
  for (std::size_t i = 0; i < projector.size(); ++i)
    nodes_[i] = content_->free[i / 3] ? content_->availableOf(i / 3, clamp01(projector[i])) : 0.0f;
  hasLast_ = true;
}

bool CpuBackend::render(const ContentFrame& frame, const FrameRequest& request,
                        std::span<std::uint32_t> words, FrameReport& report) noexcept {
  report = {};
  Clock::time_point begin = Clock::now();
  placeContent(frame, request);
  if (request.compensated) {
    const std::vector<float>& lengths = engine_.settings.compensator.steps;
    const int steps = std::clamp(request.steps, 0, static_cast<int>(lengths.size()));
    const bool goesOn = request.fromLast && hasLast_;
    if (goesOn) {
      fillMeans();
      passThrough(Pass::correct);
      makePreconditioner();
      clipped_ = 0;
      if (steps == 0) encodeAll(words);
    } else {
      invert();
      passThrough(Pass::correct);
      correct(steps == 0 ? words : OutputWords{});
    }
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
  hasLast_ = request.compensated;
  return true;
}

void CpuBackend::warpOnly(OutputWords words) noexcept {
  // The brightness that brings flood * content nearest to what is wanted; summed in fixed parts.
  constexpr std::size_t parts = 64;
  std::array<double, parts> wanted{}, seen{};
  const compensation::MeasuredVenue& venue = engine_.venue;
  const std::vector<std::int32_t>& brightest = content_->brightest;
  parallelChunks(0, venue.usable.size(), parts, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto weight = static_cast<double>(content_->weight[i]);
      if (weight == 0.0) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        double light = static_cast<double>(known_[8 * i + 4 + c]) * static_cast<double>(placed_[4 * i + c]);
        wanted[part] += weight * light * static_cast<double>(wanted_[4 * i + c]);
        seen[part] += weight * light * light;
      }
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
    const std::size_t from = shown ? 4 * static_cast<std::size_t>(brightest[j]) : 0;
    for (std::size_t c = 0; c < 3; ++c)
      nodes_[3 * j + c] = shown ? clamp01(brightness * placed_[from + c]) * content_->keptOf(j) : 0.0f;
  });
  encodeAll(words);
}

void CpuBackend::findFreeTiles() {
  const Rasters &projectors = engine_.venue.transport.projectors(), &tiles = *windows_.tiles;
  freeOfTile_.resize(tiles.count());
  for (std::size_t device = 0; device < tiles.devices(); ++device) {
    const Size size = projectors.size(device), grid = tiles.size(device);
    parallelFor(0, grid.count(), 512, [&](std::size_t tile) {
      const Pixel place = pixelAt(grid, tile);
      const int left = windows_.tile * place.x, top = windows_.tile * place.y;
      std::size_t pixels = 0, none = 0, all = 0;
      for (int y = top; y < std::min(top + windows_.tile, size.height); ++y)
        for (int x = left; x < std::min(left + windows_.tile, size.width); ++x, ++pixels) {
          const float share = shareOf(projectors.offset(device) + indexOf(size, {x, y}));
          none += share == 0.0f;
          all += share == 1.0f;
        }
      freeOfTile_[tiles.offset(device) + tile] = none == pixels  ? Free::none
                                                 : all == pixels ? Free::all
                                                                 : Free::some;
    });
  }
}

template <typename Put>
void CpuBackend::putTiles(std::size_t device, std::size_t tileRow, bool clamped, const Put& put) noexcept {
  constexpr std::size_t mostPixels = 64;  // of a tile of 8x8, the largest
  const Rasters& projectors = engine_.venue.transport.projectors();
  const Size size = projectors.size(device), grid = windows_.tiles->size(device);
  const std::size_t side = static_cast<std::size_t>(windows_.tile);
  const int top = static_cast<int>(tileRow) * windows_.tile;
  const int height = std::min(windows_.tile, size.height - top);
  for (int column = 0; column < grid.width; ++column) {
    const std::size_t tile =
        windows_.tiles->offset(device) + indexOf(grid, {column, static_cast<int>(tileRow)});
    if (freeOfTile_[tile] == Free::none) continue;  // there p is 0
    float values[3 * mostPixels];
    kernels_.window(windows_, tile, unmixed_.data(), clamped, values);
    const int left = column * windows_.tile;
    const auto width = static_cast<std::size_t>(std::min(windows_.tile, size.width - left));
    for (int y = 0; y < height; ++y) {
      const std::size_t first = projectors.offset(device) + indexOf(size, {left, top + y});
      float* line = values + 3 * static_cast<std::size_t>(y) * side;
      if (freeOfTile_[tile] == Free::some)
        for (std::size_t x = 0; x < width; ++x)
          for (std::size_t c = 0; c < 3; ++c) line[3 * x + c] *= shareOf(first + x);
      float* p = &nodes_[3 * first];
      // A length that the compiler knows.
      if (width == 4)
        put(p, line, std::integral_constant<std::size_t, 12>());
      else
        put(p, line, 3 * width);
    }
  }
}

void CpuBackend::invert() noexcept {
  for (std::size_t device = 0; device < windows_.tiles->devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(windows_.tiles->size(device).height), 1, [&](std::size_t row) {
      putTiles(device, row, true, [](float* p, const float* values, auto count) {
        std::memcpy(p, values, count * sizeof(float));
      });
      const int pairs = windows_.tile / 2, first = static_cast<int>(row) * pairs;
      for (int pair = first; pair < std::min(first + pairs, pairsOfLines(device)); ++pair)
        engine_.venue.transport.layout().fillMeansOfLine(device, pair, nodeValues());
    });
}

void CpuBackend::correct(OutputWords words) noexcept {
  const float byInverse = engine_.settings.compensator.correctionByInverse;
  const float byAdjoint = engine_.settings.compensator.correctionByAdjoint;
  const Rasters& projectors = engine_.venue.transport.projectors();
  clipped_ = 0;
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(windows_.tiles->size(device).height), 1, [&](std::size_t row) {
      putTiles(device, row, false, [byInverse](float* p, const float* values, auto count) {
        for (std::size_t i = 0; i < count; ++i) p[i] += byInverse * values[i];
      });
      // While the tiles are in the cache.
      const int pairs = windows_.tile / 2, first = static_cast<int>(row) * pairs;
      const int end = std::min(first + pairs, pairsOfLines(device));
      for (int pair = first; pair < end; ++pair) finishPair(Pass::correct, device, pair, byAdjoint, words);
    });
}

void CpuBackend::refine(float length, OutputWords words) noexcept {
  passThrough(Pass::step);
  clipped_ = 0;
  const Rasters& projectors = engine_.venue.transport.projectors();
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(pairsOfLines(device)), 4, [&](std::size_t pair) {
      finishPair(Pass::step, device, static_cast<int>(pair), length, words);
    });
}

void CpuBackend::makePreconditioner() noexcept {
  const transport::NodeLayout& layout = engine_.venue.transport.layout();
  for (std::size_t device = 0; device < layout.projectors().devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(layout.projectors().size(device).height), 8, [&](std::size_t y) {
      layout.addToLine(device, static_cast<int>(y), adjoint_, sumFloats);
      preconditionLine(device, static_cast<int>(y));
    });
}

void CpuBackend::preconditionLine(std::size_t device, int y) noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  const std::size_t first = projectors.offset(device) + indexOf(projectors.size(device), {0, y});
  kernels_.precondition(&preconditioner_[3 * first], &adjoint_[sumFloats * first],
                        &engine_.preconditioner.share()[3 * first], &leastBound_[first],
                        static_cast<std::size_t>(projectors.size(device).width));
  if (!isDimmed(device, y)) return;
  const auto width = static_cast<std::size_t>(projectors.size(device).width);
  for (std::size_t i = 0; i < 3 * width; ++i)
    preconditioner_[3 * first + i] *= content_->available[first + i / 3];
}

void CpuBackend::fillMeans() noexcept {
  for (std::size_t device = 0; device < engine_.venue.transport.projectors().devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(pairsOfLines(device)), 4, [&](std::size_t pair) {
      engine_.venue.transport.layout().fillMeansOfLine(device, static_cast<int>(pair), nodeValues());
    });
}

void CpuBackend::encodeAll(OutputWords words) const noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  for (std::size_t device = 0; device < projectors.devices(); ++device)
    parallelFor(0, static_cast<std::size_t>(projectors.size(device).height), 8,
                [&](std::size_t y) { encodeLine(device, static_cast<int>(y), words); });
}

int CpuBackend::pairsOfLines(std::size_t device) const noexcept {
  return (engine_.venue.transport.projectors().size(device).height + 1) / 2;
}

void CpuBackend::finishPair(Pass pass, std::size_t device, int pair, float length,
                            OutputWords words) noexcept {
  const transport::NodeLayout& layout = engine_.venue.transport.layout();
  const Size size = layout.projectors().size(device);
  for (int y = 2 * pair; y < std::min(2 * pair + 2, size.height); ++y) {
    layout.addToLine(device, y, adjoint_, sumFloats);
    if (pass == Pass::correct) preconditionLine(device, y);
    const std::size_t first = layout.projectors().offset(device) + indexOf(size, {0, y});
    const std::size_t cut =
        kernels_.update(&nodes_[3 * first], &preconditioner_[3 * first], &adjoint_[sumFloats * first], length,
                        static_cast<std::size_t>(size.width));
    clipped_.fetch_add(cut, std::memory_order_relaxed);
    if (isDimmed(device, y))
      for (std::size_t i = 0; i < 3 * static_cast<std::size_t>(size.width); ++i)
        nodes_[3 * first + i] = std::min(nodes_[3 * first + i], content_->available[first + i / 3]);
    if (!words.empty()) encodeLine(device, y, words);
  }
  if (words.empty()) layout.fillMeansOfLine(device, pair, nodeValues());
}

void CpuBackend::encodeLine(std::size_t device, int y, OutputWords words) const noexcept {
  const Rasters& projectors = engine_.venue.transport.projectors();
  const Size size = projectors.size(device);
  const std::size_t first = projectors.offset(device) + indexOf(size, {0, y});
  engine_.encoders[device].encodeLine(&nodes_[3 * first], size.width, y, &words[first]);
}

}  // namespace relucent::engine
