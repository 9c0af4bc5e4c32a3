// SPDX-License-Identifier: MIT
#include "relucent/acquisition/exposure_cycle.h"

#include <algorithm>

namespace relucent::acquisition {
namespace {

constexpr double shownByMain = 0.98;
constexpr double worthLonger = 0.15;

/// How many camera pixels each exposure suits best: the longest that their full light does not saturate.
std::vector<std::size_t> suitedPixels(const photography::References& references,
                                      const photography::Photographer& photographer) {
  std::vector<std::size_t> suited;
  for (std::size_t row = 0; row < references.usable.size(); ++row) {
    if (!references.usable[row]) continue;
    float brightest = 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      float light = references.black.radiance[3 * row + c];
      for (const std::vector<transport::ColourBlock>& root : references.root)
        light += root[row].row(static_cast<Eigen::Index>(c)).sum();
      brightest = std::max(brightest, light);
    }
    std::size_t exposure = photographer.longestUnsaturated(row, static_cast<double>(brightest));
    suited.resize(std::max(suited.size(), exposure + 1), 0);
    ++suited[exposure];
  }
  return suited;
}

}  // namespace

std::vector<std::size_t> exposureCycle(const photography::References& references,
                                       const photography::Photographer& photographer) {
  std::vector<std::size_t> suited = suitedPixels(references, photographer);
  if (suited.empty()) return {0};
  double all = 0.0;
  for (std::size_t pixels : suited) all += static_cast<double>(pixels);
  std::size_t main = 0;
  double shown = static_cast<double>(suited[0]), longer = 0.0;
  while (main + 1 < suited.size() && shown < shownByMain * all) {
    longer = shown;
    shown += static_cast<double>(suited[++main]);
  }
  std::vector<std::size_t> cycle(4, main);
  if (longer > worthLonger * all) cycle[1] = main - 1;
  if (main + 1 < suited.size()) cycle[3] = suited.size() - 1;
  return cycle;
}

}  // namespace relucent::acquisition
