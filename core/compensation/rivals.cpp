// SPDX-License-Identifier: MIT
#include "relucent/compensation/rivals.h"

#include <cmath>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/parallel.h"
#include "relucent/compensation/colour_spline.h"
#include "relucent/compensation/correspondence.h"
#include "relucent/compensation/pixel_mixing.h"
#include "relucent/compensation/stacks.h"

namespace relucent::compensation {
namespace {

ContentCorrespondence correspondenceOf(const Compensator& compensator, const Target& target) {
  const MeasuredVenue& venue = compensator.venue();
  return contentCorrespondence(venue.transport, seesProjection(venue), target,
                               compensator.brightestCameraPixel(), compensator.settings().direct);
}

Eigen::Vector3f colourAt(const CameraStack& stack, std::size_t pixel) {
  return Eigen::Map<const Eigen::Vector3f>(&stack[3 * pixel]);
}

/// drive(i*(j), old drive of j) for the content's pixels, within the projector's limits; the others are
/// black.
template <typename Drive>
void driveEach(const ContentCorrespondence& content, ProjectorStack& p, const Drive& drive) {
  parallelFor(0, content.free.size(), 64, [&](std::size_t j) {
    Eigen::Map<Eigen::Vector3f> colour(&p[3 * j]);
    if (!content.free[j] || content.brightest[j] < 0)
      colour.setZero();
    else
      colour = drive(static_cast<std::size_t>(content.brightest[j]), Eigen::Vector3f(colour))
                   .cwiseMax(0.0f)
                   .cwiseMin(1.0f);
  });
}

}  // namespace

std::vector<Message> problems(const RivalSettings& settings) {
  std::vector<Message> found;
  if (settings.corrections < 1 || settings.corrections > 100)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.rival-corrections-out-of-range",
                                             "the photographs of correction must be 1 to 100"));
  if (settings.levels < 2 || settings.levels > 8)
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.rival-levels-out-of-range",
                                             "the levels of a photographed colour must be 2 to 8"));
  if (!(settings.smoothing >= 0.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("compensation.rival-smoothing-negative",
                                             "the smoothing of the spline must be 0 or more"));
  return found;
}

RivalCompensator::RivalCompensator(const Compensator& compensator, const inverse::WindowInverse& inverse,
                                   Photograph photograph, RivalSettings settings)
    : compensator_(compensator), inverse_(inverse), photograph_(std::move(photograph)), settings_(settings) {
  const std::vector<Message> wrong = problems(settings_);
  require(wrong.empty(), "settings of rivals: {}", fmt::join(wrong, "; "));
}

CameraStack RivalCompensator::photographed(Rival rival, const ProjectorStack& p) {
  ++taken_[static_cast<std::size_t>(rival)];
  return photograph_(p);
}

Compensation RivalCompensator::corrected(const Target& target, Progress& progress) {
  const ContentCorrespondence content = correspondenceOf(compensator_, target);
  const std::vector<transport::ColourBlock> mixing = compensator_.venue().transport.rowSums();
  Compensation result = compensator_.solve(Method::mix, target, progress);
  for (int k = 0; k < settings_.corrections; ++k) {
    progress.checkpoint();
    const CameraStack seen = photographed(Rival::corrected, result.projector);
    driveEach(content, result.projector, [&](std::size_t i, const Eigen::Vector3f& drive) {
      return Eigen::Vector3f(drive +
                             inverseMixing(mixing[i]) * (colourAt(target.wanted, i) - colourAt(seen, i)));
    });
  }
  return result;
}

void RivalCompensator::photographColours(Progress& progress) {
  // Even steps of the root of light: the eye's scale, roughly, and so that of pictures.
  const auto level = [&](int step) { return std::pow(step / (settings_.levels - 1.0), 2.0); };
  const int colours = settings_.levels * settings_.levels * settings_.levels;
  for (int m = 0; m < colours; ++m) {
    progress.checkpoint();
    const Eigen::Vector3d colour(level(m % settings_.levels), level(m / settings_.levels % settings_.levels),
                                 level(m / settings_.levels / settings_.levels));
    const std::size_t values = 3 * compensator_.venue().transport.projectors().count();
    const auto even = stackOf<ProjectorStack>(
        values, [&](std::size_t j) { return static_cast<float>(colour[static_cast<Eigen::Index>(j % 3)]); });
    shown_.push_back(colour);
    seen_.push_back(photographed(Rival::robust, even));
  }
}

Compensation RivalCompensator::robust(const Target& target, Progress& progress) {
  if (seen_.empty()) photographColours(progress);
  Compensation result;
  result.projector.assign(3 * compensator_.venue().transport.projectors().count(), 0.0f);
  driveEach(correspondenceOf(compensator_, target), result.projector,
            [&](std::size_t i, const Eigen::Vector3f&) -> Eigen::Vector3f {
              // In every pixel the same smoothing against its own light.
              const float white = colourAt(seen_.back(), i).maxCoeff();
              if (!(white > 0.0f)) return Eigen::Vector3f::Zero();
              std::vector<Eigen::Vector3d> from;
              for (const CameraStack& seen : seen_)
                from.emplace_back((colourAt(seen, i) / white).cast<double>());
              const ColourSpline spline(from, shown_, settings_.smoothing);
              return spline((colourAt(target.wanted, i) / white).cast<double>()).cast<float>();
            });
  return result;
}

Compensation RivalCompensator::solve(Rival rival, const Target& target, Progress& progress) {
  switch (rival) {
    case Rival::corrected:
      return corrected(target, progress);
    case Rival::robust:
      return robust(target, progress);
    case Rival::deconvolved:
      break;
  }
  if (!sharpest_) {
    CompensatorSettings settings = compensator_.settings();
    settings.sharpening = settings.optimum;
    sharpest_ = std::make_unique<Compensator>(compensator_.venue(), inverse_, settings);
  }
  return sharpest_->solve(Method::sharpen, target, progress);
}

}  // namespace relucent::compensation
