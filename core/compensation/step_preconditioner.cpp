// SPDX-License-Identifier: MIT
#include "relucent/compensation/step_preconditioner.h"

#include <algorithm>

#include "relucent/base/error.h"
#include "relucent/compensation/stacks.h"

namespace relucent::compensation {
namespace {

constexpr std::size_t green = 1;
/// Of a channel's own light, below which green says nothing of it.
constexpr float leastShown = 1e-5f;

}  // namespace

StepPreconditioner::StepPreconditioner(const transport::TransportMatrix& transport,
                                       const CameraMask& usable) {
  require(usable.size() == transport.cameras().count(), "{} flags for {} camera pixels", usable.size(),
          transport.cameras().count());
  std::vector<float> weight(usable.size());
  std::ranges::transform(usable, weight.begin(), [](std::uint8_t flag) { return flag != 0 ? 1.0f : 0.0f; });
  const ProjectorStack bound =
      hessianRowSums(transport, weight, ProjectorMask(transport.projectors().count(), 1));
  least_ = bound.empty() ? 0.0f : 1e-7f * std::ranges::max(bound);
  share_ = stackOf<ProjectorStack>(bound.size(), [&](std::size_t j) {
    const float own = bound[j], shown = bound[j - j % 3 + green];
    if (!(own > least_)) return 0.0f;
    return shown > leastShown * own && shown > least_ ? shown / own : -1.0f / (largestSensitivity * own);
  });
}

ProjectorStack StepPreconditioner::of(const ConstrainedProblem& problem) const {
  require(share_.size() == 3 * problem.free.size(), "C of {} projector values for {} pixels", share_.size(),
          problem.free.size());
  const ProjectorStack bound = hessianRowSums(problem);
  return stackOf<ProjectorStack>(bound.size(), [&](std::size_t j) {
    if (!problem.free[j / 3]) return 0.0f;
    return problem.most(j / 3) * from(share_[j], inverse(bound[j - j % 3 + green], least_));
  });
}

}  // namespace relucent::compensation
