// SPDX-License-Identifier: MIT
#include "relucent/linearization/mosaic_additivity.h"

#include <Eigen/QR>
#include <algorithm>
#include <cstddef>

namespace relucent::linearization {
namespace {

/// Sums of every photograph over values that `wanted` says.
template <typename Wanted>
std::vector<ChannelSums> sumsOf(const PhotographedLight& lights, const Wanted& wanted) {
  std::vector<ChannelSums> sums(lights.light.size(), ChannelSums{});
  for (std::size_t m = 0; m < sums.size(); ++m)
    for (std::size_t i = 0; i < lights.at.size(); ++i)
      if (wanted(i)) sums[m][lights.at[i] % 3] += lights.light[m][i];
  return sums;
}

/// What sums say of the additivity of projectors' light, the drift of their lamps divided out.
class Additivities {
 public:
  Additivities(const MosaicPhotographs& photographs, const PhotographedLight& lights,
               const std::vector<ResponseFit>& fits)
      : photographs_(photographs), order_(photographs.order()), lights_(lights), fits_(fits) {}

  /// White where each projector shines; its first group where that is the brightest of all first groups.
  std::vector<Additivity> run() const {
    const std::vector<std::size_t> brightest = brightestGroups();
    std::vector<Groups> groups;
    for (std::size_t p = 0; p < fits_.size(); ++p) groups.push_back(groupsAt(p, brightest));
    takeOffOthers(groups);
    std::vector<Additivity> result;
    for (std::size_t p = 0; p < fits_.size(); ++p) {
      const auto sums = sumsOf(lights_, [&](std::size_t i) { return lights_.lit[p][i]; });
      result.push_back(additivityOf(inUnits(sums, p, order_.white(p)), sumOfLights(sums, p, order_.lights()),
                                    groups[p].inWhite, groups[p].lights[p]));
    }
    return result;
  }

 private:
  /// At one projector's place, in units of its lamp.
  struct Groups {
    ChannelSums inWhite{};            // all first groups
    std::vector<ChannelSums> lights;  // of each projector's first group, one by one
  };

  double lampIn(std::size_t projector, std::size_t shot) const {
    return 1.0 + fits_[projector].drift *
                     (photographs_.what[shot].time - photographs_.what[order_.white(projector)].time);
  }
  ChannelSums inUnits(const std::vector<ChannelSums>& sums, std::size_t projector, std::size_t shot) const {
    ChannelSums result = sums[shot];
    for (double& sum : result) sum /= lampIn(projector, shot);
    return result;
  }
  ChannelSums sumOfLights(const std::vector<ChannelSums>& sums, std::size_t projector,
                          std::size_t count) const {
    ChannelSums result{};
    for (std::size_t q = 0; q < count; ++q) {
      const ChannelSums light = inUnits(sums, projector, order_.light(projector, q));
      for (std::size_t c = 0; c < 3; ++c) result[c] += light[c];
    }
    return result;
  }

  std::vector<std::size_t> brightestGroups() const {
    std::vector<std::size_t> brightest;
    for (std::size_t i = 0; i < lights_.at.size(); ++i) {
      std::vector<double> light(fits_.size(), 0.0);
      for (std::size_t p = 0; p < light.size(); ++p)
        for (std::size_t q = 0; q < 3; ++q) light[p] += lights_.light[order_.light(p, q)][i];
      brightest.push_back(static_cast<std::size_t>(std::ranges::max_element(light) - light.begin()));
    }
    return brightest;
  }

  Groups groupsAt(std::size_t projector, const std::vector<std::size_t>& brightest) const {
    const std::size_t shot = order_.groupsInWhite();
    const auto sums = sumsOf(
        lights_, [&](std::size_t i) { return brightest[i] == projector && lights_.lit[projector][i]; });
    Groups groups{inUnits(sums, projector, shot), {}};
    for (std::size_t p = 0; p < fits_.size(); ++p) {
      groups.lights.push_back(sumOfLights(sums, p, 3));
      for (double& light : groups.lights.back()) light *= lampIn(p, shot) / lampIn(projector, shot);
    }
    return groups;
  }

  /// Takes off what the other groups add at each one's place, which their own places tell:
  ///   in white_p = sum_o e_o lights_po,   p the places, o the projectors,   solved for e.
  static void takeOffOthers(std::vector<Groups>& groups) {
    const auto count = static_cast<Eigen::Index>(groups.size());
    auto at = [&groups](Eigen::Index p) -> Groups& { return groups[static_cast<std::size_t>(p)]; };
    for (std::size_t c = 0; c < 3; ++c) {
      Eigen::MatrixXd lights(count, count);
      Eigen::VectorXd inWhite(count);
      for (Eigen::Index p = 0; p < count; ++p) {
        inWhite[p] = at(p).inWhite[c];
        for (Eigen::Index o = 0; o < count; ++o) lights(p, o) = at(p).lights[static_cast<std::size_t>(o)][c];
      }
      const Eigen::VectorXd excess = lights.completeOrthogonalDecomposition().solve(inWhite);
      for (Eigen::Index p = 0; p < count; ++p)
        for (Eigen::Index o = 0; o < count; ++o)
          if (o != p) at(p).inWhite[c] -= excess[o] * lights(p, o);
    }
  }

  const MosaicPhotographs& photographs_;
  MosaicOrder order_;
  const PhotographedLight& lights_;
  const std::vector<ResponseFit>& fits_;
};

}  // namespace

std::vector<Additivity> additivitiesOf(const MosaicPhotographs& photographs, const PhotographedLight& lights,
                                       const std::vector<ResponseFit>& fits) {
  return Additivities(photographs, lights, fits).run();
}

}  // namespace relucent::linearization
