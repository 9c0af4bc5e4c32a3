// SPDX-License-Identifier: MIT
#include "relucent/compensation/methods.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/pixel_mixing.h"
#include "relucent/compensation/stacks.h"

namespace relucent::compensation {
namespace {

CameraStack difference(const CameraStack& a, const CameraStack& b) {
  return stackOf<CameraStack>(a.size(), [&](std::size_t i) { return a[i] - b[i]; });
}

/// Clamps, blackens what is not free, and says what share of the values that can be lit was cut off by the
/// projector's limits.
double finish(ProjectorStack& p, const ProjectorMask& free, const std::vector<float>& available) {
  // A value beyond by less than half a code of an 8-bit projector is not visibly cut.
  constexpr float visible = 0.002f;
  std::size_t cut = 0, values = 0;
  for (std::size_t j = 0; j < p.size(); ++j) {
    const float most = available.empty() ? 1.0f : available[j / 3];
    if (!free[j / 3] || most == 0.0f) {
      p[j] = 0.0f;
      continue;
    }
    ++values;
    cut += p[j] < -visible || p[j] > 1.0f + visible;
    p[j] = std::clamp(p[j], 0.0f, most);
  }
  return values > 0 ? static_cast<double>(cut) / static_cast<double>(values) : 0.0;
}

}  // namespace

std::vector<Message> problems(const CompensatorSettings& settings) {
  std::vector<Message> found = problems(settings.optimum);
  for (const Message& problem : problems(settings.sharpening)) found.push_back(problem);
  for (const Message& problem : problems(settings.direct)) found.push_back(problem);
  for (const Message& problem : problems(settings.clustering)) found.push_back(problem);
  for (const Message& problem : problems(settings.clusterInverse)) found.push_back(problem);
  if (!(settings.correctionByInverse >= 0.0f && settings.correctionByInverse <= 2.0f) ||
      !(settings.correctionByAdjoint >= 0.0f && settings.correctionByAdjoint <= 2.0f))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.window-correction-out-of-range",
                                             "the correction of the windows must lie between 0 and 2"));
  for (float step : settings.steps)
    if (!(step > 0.0f))
      found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.refinement-steps-not-positive",
                                               "the steps of the refined method must be above 0"));
  return found;
}

Compensator::Compensator(const MeasuredVenue& venue, const inverse::WindowInverse& inverse,
                         CompensatorSettings settings)
    : venue_(venue),
      inverse_(inverse),
      settings_(std::move(settings)),
      brightest_(brightestCorrespondence(venue.transport, seesProjection(venue), settings_.direct)),
      mixing_(venue.transport.rowSums()),
      preconditioner_(venue.transport, venue.usable) {
  require(
      inverse.cameras() == venue.transport.cameras() && inverse.projectors() == venue.transport.projectors(),
      "the inverse belongs to another venue");
  auto wrong = problems(settings_);
  require(wrong.empty(), "compensator settings: {}", fmt::join(wrong, "; "));
}

ProjectorStack Compensator::perPixel(Method method, const Target& target,
                                     const std::vector<std::int32_t>& brightest) const {
  ProjectorStack p(3 * brightest.size(), 0.0f);
  parallelFor(0, brightest.size(), 1024, [&](std::size_t j) {
    if (brightest[j] < 0) return;
    auto i = static_cast<std::size_t>(brightest[j]);
    using Colour = Eigen::Map<const Eigen::Vector3f>;
    Eigen::Map<Eigen::Vector3f> drive(&p[3 * j]);
    Eigen::Vector3f residual = Colour(&target.wanted[3 * i]) - Colour(&venue_.black[3 * i]);
    switch (method) {
      case Method::scalar:
        for (Eigen::Index c = 0; c < 3; ++c) {
          float flood = venue_.flood[3 * i + static_cast<std::size_t>(c)];
          drive[c] = flood > 0.0f ? residual[c] / flood : 0.0f;
        }
        break;
      case Method::mix:
      case Method::sharpen:
        drive = inverseMixing(mixing_[i]) * residual;
        break;
      default:
        drive = Colour(&target.content[3 * i]);
    }
  });
  return p;
}

ProjectorMask Compensator::contentPixelsOf(const Target& target) const {
  return contentCorrespondence(venue_.transport, seesProjection(venue_), target, brightest_, settings_.direct)
      .free;
}

float Compensator::bestBrightness(const Target& target) const {
  const CameraStack& flood = floodOf(venue_, target);
  double wanted = 0.0, seen = 0.0;
  const Rasters& cameras = venue_.transport.cameras();
  for (std::size_t camera = 0; camera < cameras.devices(); ++camera) {
    const auto ofView = static_cast<double>(target.viewWeight[camera]);
    const std::size_t begin = 3 * cameras.offset(camera), end = begin + 3 * cameras.size(camera).count();
    for (std::size_t i = begin; i < end; ++i) {
      if (!target.inside[i / 3] || !venue_.usable[i / 3]) continue;
      const double weight =
          ofView * static_cast<double>(relianceOn(venue_, i / 3) * unmaskedShare(target, i / 3));
      double light = static_cast<double>(flood[i]) * static_cast<double>(target.content[i]);
      wanted += weight * light * static_cast<double>(target.asked[i]);
      seen += weight * light * light;
    }
  }
  return seen > 0.0 ? static_cast<float>(std::clamp(wanted / seen, 0.0, 1.0)) : 1.0f;
}

Compensation Compensator::sharpened(const Target& target, Compensation mixed, const ProjectorMask& free,
                                    Progress& progress) const {
  Progress separating = progress.part(0.3, RELUCENT_MESSAGE("stage.finding-defocus", "Finding the defocus"));
  transport::TransportMatrix defocus = defocusOnly(venue_.transport, settings_.direct, separating);
  ConstrainedProblem problem{defocus, target.asked, target.weight, free, target.available};
  Progress solving = progress.part(0.7, RELUCENT_MESSAGE("stage.sharpening", "Sharpening"));
  SolveResult solved = solveConstrained(problem, mixed.projector, settings_.sharpening, solving);
  mixed.projector = std::move(solved.x);
  mixed.iterations = solved.iterations;
  return mixed;
}

const inverse::ClusterInverse& Compensator::clusters(Progress& progress) const {
  std::call_once(clustersMade_, [&] {
    Progress clustering = progress.part(
        0.3, RELUCENT_MESSAGE("stage.clustering-light-transport", "Clustering the light transport"));
    clustering::ConnectionGraph graph(venue_.transport, venue_.usable, {}, clustering);
    clustering::Clustering clustered =
        relucent::clustering::clustered(graph, settings_.clustering, clustering);
    Progress inverting =
        progress.part(0.6, RELUCENT_MESSAGE("stage.inverting-clusters", "Inverting the clusters"));
    clusters_ = inverse::computeClusterInverse(clustered, venue_.usable, settings_.clusterInverse, inverting);
  });
  return clusters_;
}

Compensation Compensator::byInverse(const std::function<ProjectorStack(const CameraStack&)>& inverse,
                                    const Target& target, const ProjectorMask& free,
                                    const ProjectorStack& preconditioner, const Progress& progress) const {
  // What no projection can reach would be asked of its neighbours too: wanted as nearly as it can be had.
  CameraStack wantedLessBlack(target.wanted.size(), 0.0f);
  const CameraStack& flood = floodOf(venue_, target);
  parallelFor(0, wantedLessBlack.size() / 3, 4096, [&](std::size_t i) {
    using Colour = Eigen::Map<const Eigen::Vector3f>;
    Eigen::Map<Eigen::Vector3f> wanted(&wantedLessBlack[3 * i]);
    wanted = held(Colour(&target.wanted[3 * i]) - Colour(&venue_.black[3 * i]), Eigen::Vector3f::Zero(),
                  Colour(&flood[3 * i]).cwiseMax(0.0f), target.clipping);
  });
  Compensation result;
  const auto ofMost = [&](ProjectorStack p) {
    if (!target.available.empty())
      parallelFor(0, p.size(), 4096, [&](std::size_t j) { p[j] *= target.available[j / 3]; });
    return p;
  };
  result.projector = inverse(wantedLessBlack);
  // As if a filter hung before the projector: a clamp(M r).
  if (!target.available.empty()) finish(result.projector, free, {});
  result.projector = ofMost(std::move(result.projector));
  result.clipped = finish(result.projector, free, target.available);
  progress.checkpoint();
  CameraStack residual = difference(wantedLessBlack, venue_.transport.apply(result.projector));
  // M knows of no weights: where they differ within a window, it would take them for light.
  const auto weighted = [&](const std::vector<float>& weight) {
    return stackOf<CameraStack>(residual.size(), [&](std::size_t i) { return weight[i / 3] * residual[i]; });
  };
  const ProjectorStack sharpening = ofMost(inverse(weighted(target.windowsWeight)));
  ProjectorStack byAdjoint = venue_.transport.applyTransposed(weighted(target.weight));
  parallelFor(0, sharpening.size(), 4096, [&](std::size_t j) {
    result.projector[j] += settings_.correctionByInverse * sharpening[j] +
                           settings_.correctionByAdjoint * preconditioner[j] * byAdjoint[j];
  });
  result.clipped = finish(result.projector, free, target.available);
  result.iterations = 1;
  return result;
}

void Compensator::takeSteps(const ConstrainedProblem& problem, const ProjectorStack& preconditioner,
                            int rounds, const std::vector<float>& available, Compensation& p,
                            Progress& progress) const {
  const std::size_t all = static_cast<std::size_t>(rounds) * settings_.steps.size();
  for (std::size_t step = 0; step < all; ++step) {
    progress.report(static_cast<double>(step) / static_cast<double>(all));
    takeStep(problem, preconditioner, settings_.steps[step % settings_.steps.size()], p.projector);
    p.clipped = finish(p.projector, problem.free, available);
    ++p.iterations;
  }
}

Compensation Compensator::goOn(const Target& target, Compensation p, int rounds, Progress& progress) const {
  const auto [brightest, free] =
      contentCorrespondence(venue_.transport, seesProjection(venue_), target, brightest_, settings_.direct);
  const ConstrainedProblem problem{venue_.transport, target.asked, target.weight, free, target.available};
  takeSteps(problem, preconditioner_.of(problem), rounds, target.available, p, progress);
  progress.report(1.0);
  return p;
}

Compensation Compensator::solve(Method method, const Target& target, Progress& progress) const {
  require(target.wanted.size() == venue_.black.size() && target.inside.size() == venue_.usable.size(),
          "a target of {} values for {} camera values", target.wanted.size(), venue_.black.size());
  const auto [brightest, free] =
      contentCorrespondence(venue_.transport, seesProjection(venue_), target, brightest_, settings_.direct);
  Compensation result;
  if (method == Method::none || method == Method::scalar || method == Method::mix ||
      method == Method::sharpen) {
    result.projector = perPixel(method, target, brightest);
    if (method == Method::none) {
      float brightness = bestBrightness(target);
      for (std::size_t j = 0; j < result.projector.size(); ++j)
        result.projector[j] *= target.available.empty() ? brightness : brightness * target.available[j / 3];
    }
    result.clipped = finish(result.projector, free, target.available);
    if (method == Method::sharpen) result = sharpened(target, std::move(result), free, progress);
    progress.report(1.0);
    return result;
  }

  ConstrainedProblem problem{venue_.transport, target.asked, target.weight, free, target.available};
  const ProjectorStack c = preconditioner_.of(problem);
  auto apply = [](const auto& inverse) { return [&](const CameraStack& r) { return inverse.apply(r); }; };
  result = method == Method::clusters ? byInverse(apply(clusters(progress)), target, free, c, progress)
                                      : byInverse(apply(inverse_), target, free, c, progress);
  if (method == Method::refined) takeSteps(problem, c, 1, target.available, result, progress);
  if (method == Method::optimum) {
    SolveResult solved = solveConstrained(problem, result.projector, settings_.optimum, progress);
    result.projector = std::move(solved.x);
    result.iterations += solved.iterations;
  }
  progress.report(1.0);
  return result;
}

}  // namespace relucent::compensation
