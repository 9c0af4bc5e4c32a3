// SPDX-License-Identifier: MIT
#include "relucent/compensation/direct_light.h"

#include <algorithm>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/transport/statistics.h"

namespace relucent::compensation {
namespace {

// Blocks wider than this share of the projector's side tell of no place.
constexpr double coarsest = 1.0 / 6.0;

/// Runs body(row) on all cores, with a checkpoint now and then.
template <typename Body>
void eachRow(std::size_t rows, Progress& progress, const Body& body) {
  constexpr std::size_t rowsAtOnce = 4096;
  for (std::size_t begin = 0; begin < rows; begin += rowsAtOnce) {
    progress.report(static_cast<double>(begin) / static_cast<double>(rows));
    parallelFor(begin, std::min(begin + rowsAtOnce, rows), 64, body);
  }
  progress.report(1.0);
}

}  // namespace

std::vector<Message> problems(const DirectLightSettings& settings) {
  if (settings.reach > 0.0 && settings.reach <= 1.0) return {};
  return {
      RELUCENT_ENGLISH_MESSAGE("compensation.direct-reach-out-of-range",
                               "the reach of direct light must lie between 0 and 1 of the projector's side")};
}

DirectLeaves::DirectLeaves(const transport::TransportMatrix& transport, const DirectLightSettings& settings)
    : layout_(transport.layout()) {
  auto wrong = problems(settings);
  require(wrong.empty(), "direct light settings: {}", fmt::join(wrong, "; "));
  const double finest = transport::finestSide(transport);
  for (const Size& size : transport.projectors().sizes()) {
    const int side = std::max(size.width, size.height);
    reach_.push_back(std::max({3.0, settings.reach * side, std::min(finest, coarsest * side)}));
  }
}

DirectLook DirectLeaves::lookOf(const transport::LeafRow& leaves) const {
  return LookedAtRow(*this, leaves).look();
}

LookedAtRow::LookedAtRow(const DirectLeaves& rule, const transport::LeafRow& leaves)
    : rule_(rule), places_(rule.reach_.size()) {
  std::vector<Eigen::Array3f> sums;  // over the camera's channels, of each of the row's colours
  for (std::size_t k = 0; k < leaves.colourings(); ++k)
    sums.push_back(leaves.colours(k).colwise().sum().transpose().array());
  leaves_.reserve(leaves.size());
  transport::NodeCursor nodeAt(rule.layout_);
  leaves.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
    const transport::Node node = nodeAt(leaves.column(entry));
    Leaf& leaf = leaves_.emplace_back();
    leaf.block = rule.layout_.block(node);
    leaf.projector = static_cast<std::size_t>(node.projector);
    leaf.sum = (sums[k] * factor).sum();
    leaf.light = leaf.sum / static_cast<float>(leaf.block.count());
    Place& place = places_[leaf.projector];
    if (leaf.light > place.light)
      place = {leaf.light, 0.5 * (leaf.block.x0 + leaf.block.x1), 0.5 * (leaf.block.y0 + leaf.block.y1)};
  });
}

float LookedAtRow::mostLight() const {
  float most = 0.0f;
  for (const Place& place : places_) most = std::max(most, place.light);
  return most;
}

DirectLook LookedAtRow::look() const {
  auto brightest = std::max_element(places_.begin(), places_.end(),
                                    [](const Place& a, const Place& b) { return a.light < b.light; });
  DirectLook look;
  if (brightest == places_.end() || !(brightest->light > 0.0f)) return look;
  auto projector = static_cast<std::size_t>(brightest - places_.begin());
  Pixel pixel{static_cast<int>(brightest->x), static_cast<int>(brightest->y)};
  const Rasters& projectors = rule_.layout_.projectors();
  look.projectorPixel =
      static_cast<std::int32_t>(projectors.offset(projector) + indexOf(projectors.size(projector), pixel));
  look.light = brightest->light;
  float direct = 0.0f, all = 0.0f;
  eachDirect([&](std::size_t, const Leaf& leaf) { direct += leaf.sum; });
  for (const Leaf& leaf : leaves_) all += leaf.sum;
  look.share = all > 0.0f ? std::clamp(direct / all, 0.0f, 1.0f) : 0.0f;
  return look;
}

transport::TransportMatrix directPart(const transport::TransportMatrix& transport,
                                      const DirectLightSettings& settings, Progress& progress) {
  DirectLeaves rule(transport, settings);
  constexpr std::size_t rowsBetweenLooks = 4096;
  transport::TransportMatrix direct = transport.filtered(
      [&](std::size_t row, const transport::LeafRow& leaves, std::vector<std::uint8_t>& keep) {
        if (row % rowsBetweenLooks == 0) progress.checkpoint();
        rule.eachDirect(leaves, [&](std::size_t entry, const transport::Block&) { keep[entry] = 1; });
      });
  progress.report(1.0);
  return direct;
}

std::vector<DirectLook> directLooks(const transport::TransportMatrix& transport,
                                    const DirectLightSettings& settings, Progress& progress) {
  DirectLeaves rule(transport, settings);
  std::vector<DirectLook> looks(transport.cameras().count());
  eachRow(looks.size(), progress, [&](std::size_t row) { looks[row] = rule.lookOf(transport.row(row)); });
  return looks;
}

CameraMask directlyLit(const std::vector<DirectLook>& looks, double leastShare) {
  CameraMask lit(looks.size());
  for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = static_cast<double>(looks[i].share) >= leastShare;
  return lit;
}

CameraMask renewedDirectlyLit(CameraMask lit, const transport::TransportMatrix& former,
                              const transport::TransportMatrix& transport, const CameraMask& changed) {
  Progress quiet;
  // What counts as direct depends on the finest blocks of all.
  if (transport::finestSide(former) != transport::finestSide(transport))
    return directlyLit(directLooks(transport, {}, quiet));
  require(lit.size() == changed.size(), "{} flags for {} camera pixels", lit.size(), changed.size());
  const DirectLeaves rule(transport, {});
  parallelFor(0, lit.size(), 64, [&](std::size_t row) {
    if (changed[row]) lit[row] = directlyLit({rule.lookOf(transport.row(row))}).front();
  });
  return lit;
}

transport::TransportMatrix defocusOnly(const transport::TransportMatrix& transport,
                                       const DirectLightSettings& settings, Progress& progress) {
  return transport::rescaledToFloodlight(directPart(transport, settings, progress), transport.floodlight());
}

}  // namespace relucent::compensation
