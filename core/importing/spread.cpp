// SPDX-License-Identifier: MIT
#include "relucent/importing/spread.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace relucent::importing {
namespace {

using Vector4 = Eigen::Vector4f;
using Rows = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr float leastSigma = 0.25f;
constexpr float mostSigma = 6.0f;

/// A Gaussian integrated over the cells [first + j, first + j + 1) of one axis, with its derivatives.
struct AxisKernel {
  int first = 0;
  std::vector<float> value, byCentre, byLogSigma;

  AxisKernel(float centre, float sigma, int length) {
    float reach = 2.5f * sigma + 1.0f;
    first = std::clamp(static_cast<int>(std::floor(centre - reach)), 0, length - 1);
    int last = std::clamp(static_cast<int>(std::floor(centre + reach)), first, length - 1);
    float edge = 0.0f, density = 0.0f, slope = 0.0f;
    for (int j = first; j <= last + 1; ++j) {
      float t = (static_cast<float>(j) - centre) / sigma;
      float nextEdge = 0.5f * std::erfc(-t * std::numbers::sqrt2_v<float> / 2.0f);
      float nextDensity =
          std::exp(-0.5f * t * t) * std::numbers::inv_sqrtpi_v<float> / std::numbers::sqrt2_v<float>;
      if (j > first) {
        value.push_back(nextEdge - edge);
        byCentre.push_back((density - nextDensity) / sigma);
        byLogSigma.push_back(slope - t * nextDensity);
      }
      edge = nextEdge;
      density = nextDensity;
      slope = t * nextDensity;
    }
  }
  int size() const { return static_cast<int>(value.size()); }
  Eigen::Map<const Eigen::VectorXf> of(const std::vector<float>& weights) const {
    return {weights.data(), static_cast<Eigen::Index>(weights.size())};
  }
};

/// Weights of a quadratic B-spline over three nodes around a place given in nodes.
struct SplineWeights {
  int first = 0;
  std::array<float, 3> weight{};
  explicit SplineWeights(float place) {
    float centre = std::floor(place);
    float t = place - centre - 0.5f;
    first = static_cast<int>(centre) - 1;
    weight = {0.5f * (0.5f - t) * (0.5f - t), 0.75f - t * t, 0.5f * (0.5f + t) * (0.5f + t)};
  }
};

/// Where a halo lies: its centre in projector pixels, and the nodes that carry it.
struct HaloPlace {
  float x = 0.0f, y = 0.0f;
  int level = 0;
  Size grid;
};

template <typename Visit>
void visitHalo(const HaloPlace& halo, const Visit& visit) {
  auto side = static_cast<float>(1 << halo.level);
  Size grid = halo.grid;
  SplineWeights across(halo.x / side), down(halo.y / side);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      int nodeX = across.first + i, nodeY = down.first + j;
      if (nodeX < 0 || nodeY < 0 || nodeX >= grid.width || nodeY >= grid.height) continue;
      visit(nodeX, nodeY,
            across.weight[static_cast<std::size_t>(i)] * down.weight[static_cast<std::size_t>(j)]);
    }
}

Size gridAt(Size projector, int level) {
  int side = 1 << level;
  return {(projector.width + side - 1) / side, (projector.height + side - 1) / side};
}

/// The patterns under a Gaussian, and how that changes with centre and widths.
struct Seen {
  Eigen::VectorXf value;
  Eigen::Matrix<float, Eigen::Dynamic, 4> by;  // x, y, ln sigmaX, ln sigmaY
};

/// One camera pixel's problem.
class Problem {
 public:
  Problem(const SequencePyramid& pyramid, const CameraSequence& camera, const FootprintPrior& prior,
          const Decoded& start)
      : pyramid_(pyramid),
        level_(pyramid.levels.front()),
        channels_(pyramid.channels),
        inverseNoise_(1.0f / prior.noise),
        samples_(pyramid.samples),
        weight_(Eigen::Map<const Eigen::VectorXf>(camera.weight.data(), samples_)),
        wanted_(Eigen::Map<const Eigen::VectorXf>(camera.value.data(), samples_).cwiseProduct(weight_)),
        halo_(haloAt(start.x, start.y)),
        prior_(start.x, start.y, std::log(prior.sigmaX), std::log(prior.sigmaY)) {}

  /// A place in parameter space, its cost and what a step needs to know.
  struct State {
    Vector4 at;
    float cost = 0.0f;
    float residualSquare = 0.0f;
    Vector4 gradient;
    Eigen::Matrix4f curvature;
    float direct = 0.0f, halo = 0.0f;  // g and h, summed over channels
  };

  State evaluate(const Vector4& at) const {
    Seen seen = seenAt(at);
    State state;
    state.at = at;
    Vector4 apart = (at - prior_).cwiseProduct(priorScale());
    state.cost = apart.squaredNorm();
    state.gradient = apart.cwiseProduct(priorScale());
    state.curvature = priorScale().cwiseAbs2().asDiagonal();
    for (int c = 0; c < channels_; ++c) addChannel(seen, c, state);
    return state;
  }

  const Vector4& prior() const { return prior_; }
  float countedSamples() const { return weight_.sum(); }

 private:
  static Vector4 priorScale() { return {1.0f, 1.0f, 2.0f, 2.0f}; }

  Eigen::VectorXf haloAt(float x, float y) const {
    Size projector = level_.grid;
    int level = std::min(haloLevel(projector), static_cast<int>(pyramid_.levels.size()) - 1);
    const SequencePyramid::Level& coarse = pyramid_.levels[static_cast<std::size_t>(level)];
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(samples_);
    visitHalo({x, y, level, coarse.grid}, [&](int nodeX, int nodeY, float weight) {
      sum += weight * Eigen::Map<const Eigen::VectorXf>(
                          coarse.node(indexOf(coarse.grid, {nodeX, nodeY}), samples_), samples_);
    });
    return sum;
  }

  Seen seenAt(const Vector4& at) const {
    AxisKernel across(at[0], std::exp(at[2]), level_.grid.width);
    AxisKernel down(at[1], std::exp(at[3]), level_.grid.height);
    Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor> kernels(3, across.size());
    kernels.row(0) = across.of(across.value);
    kernels.row(1) = across.of(across.byCentre);
    kernels.row(2) = across.of(across.byLogSigma);
    Seen seen;
    seen.value = Eigen::VectorXf::Zero(samples_);
    seen.by.setZero(samples_, 4);
    Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor> line(3, samples_);
    for (int j = 0; j < down.size(); ++j) {
      std::size_t begin = indexOf(level_.grid, {across.first, down.first + j});
      Rows block(level_.node(begin, samples_), across.size(), samples_);
      line.noalias() = kernels.lazyProduct(block);
      auto row = static_cast<std::size_t>(j);
      seen.value += down.value[row] * line.row(0).transpose();
      seen.by.col(0) += down.value[row] * line.row(1).transpose();
      seen.by.col(1) += down.byCentre[row] * line.row(0).transpose();
      seen.by.col(2) += down.value[row] * line.row(2).transpose();
      seen.by.col(3) += down.byLogSigma[row] * line.row(0).transpose();
    }
    return seen;
  }

  /// Fits black, gain and halo of one channel and adds what they leave over.
  void addChannel(const Seen& seen, int c, State& state) const {
    Eigen::Index frames = samples_ / channels_;
    auto part = [&](const auto& vector) {
      return Eigen::Map<const Eigen::VectorXf, 0, Eigen::InnerStride<>>(vector.data() + c, frames,
                                                                        Eigen::InnerStride<>(channels_));
    };
    Eigen::VectorXf weight = part(weight_), wanted = part(wanted_);
    Eigen::Matrix<float, Eigen::Dynamic, 3> basis(frames, 3);
    basis.col(0) = weight;
    basis.col(1) = part(seen.value).cwiseProduct(weight);
    basis.col(2) = part(halo_).cwiseProduct(weight);

    // A little stiffness keeps what the patterns cannot tell apart from exploding.
    Eigen::Matrix3f normal = basis.transpose() * basis;
    normal.diagonal() += Eigen::Vector3f(1e-4f, 1e-4f, 0.05f);
    Eigen::LDLT<Eigen::Matrix3f> solver(normal);
    Eigen::Vector3f fit = solver.solve(basis.transpose() * wanted);
    if (!(fit[2] > 0.0f)) {
      normal.row(2).setZero();
      normal.col(2).setZero();
      normal(2, 2) = 1.0f;
      basis.col(2).setZero();
      solver.compute(normal);
      fit = solver.solve(basis.transpose() * wanted);
    }
    if (!(fit[1] > 0.0f)) fit[1] = 0.0f;
    Eigen::VectorXf residual = wanted - basis * fit;
    Eigen::Matrix<float, Eigen::Dynamic, 4> jacobian(frames, 4);
    for (int p = 0; p < 4; ++p) {
      Eigen::Map<const Eigen::VectorXf, 0, Eigen::InnerStride<>> by(seen.by.col(p).data() + c, frames,
                                                                    Eigen::InnerStride<>(channels_));
      jacobian.col(p) = -fit[1] * by.cwiseProduct(weight);
    }
    jacobian -= basis * solver.solve(basis.transpose() * jacobian);
    float scale = inverseNoise_ * inverseNoise_;
    state.residualSquare += residual.squaredNorm();
    state.cost += scale * residual.squaredNorm();
    state.gradient += scale * jacobian.transpose() * residual;
    state.curvature += scale * jacobian.transpose() * jacobian;
    state.direct += fit[1];
    state.halo += std::max(0.0f, fit[2]);
  }

  const SequencePyramid& pyramid_;
  const SequencePyramid::Level& level_;
  int channels_;
  float inverseNoise_;
  int samples_;
  Eigen::VectorXf weight_, wanted_, halo_;
  Vector4 prior_;
};

/// A step that stays within two pixels and halves or doubles widths at most.
Vector4 limited(const Vector4& at, const Vector4& step, const Vector4& start) {
  Vector4 next = at + step.cwiseMax(-0.7f).cwiseMin(0.7f);
  for (int p = 0; p < 2; ++p) next[p] = std::clamp(next[p], start[p] - 4.0f, start[p] + 4.0f);
  for (int p = 2; p < 4; ++p) next[p] = std::clamp(next[p], std::log(leastSigma), std::log(mostSigma));
  return next;
}

}  // namespace

int haloLevel(Size projector) {
  int level = 0;
  while ((std::max(projector.width, projector.height) >> (level + 1)) >= 32) ++level;
  return level;
}

FootprintFitter::FootprintFitter(const SequencePyramid& pyramid, const PictureSequence& photographs,
                                 const ImportFrames& frames, const FootprintPrior& prior)
    : pyramid_(pyramid), photographs_(photographs), frames_(frames), prior_(prior) {}

FootprintFitter::Fit FootprintFitter::fit(std::size_t cameraPixel, const Decoded& start) const {
  constexpr int mostSteps = 12;
  constexpr float enough = 1e-3f;  // relative gain of a step below which it is the last
  if (start.pixel < 0) return {};
  CameraSequence camera;
  readSequence(photographs_, frames_, cameraPixel, camera);
  Problem problem(pyramid_, camera, prior_, start);

  Problem::State state = problem.evaluate(problem.prior());
  float damping = 1e-2f;
  for (int step = 0; step < mostSteps; ++step) {
    Eigen::Matrix4f system = state.curvature;
    system.diagonal() *= 1.0f + damping;
    Vector4 move = -system.ldlt().solve(state.gradient);
    Problem::State next = problem.evaluate(limited(state.at, move, problem.prior()));
    if (next.cost < state.cost) {
      bool last = next.cost > (1.0f - enough) * state.cost;
      state = next;
      damping *= 0.3f;
      if (last) break;
    } else {
      damping *= 6.0f;
      if (damping > 1e3f) break;
    }
  }
  if (!(state.direct + state.halo > 0.0f)) return {};
  Footprint footprint{state.at[0], state.at[1], std::exp(state.at[2]), std::exp(state.at[3]),
                      state.halo / (state.direct + state.halo)};
  return {footprint, std::sqrt(state.residualSquare / std::max(1.0f, problem.countedSamples()))};
}

namespace {

/// Shares of the same node as one.
std::vector<NodeShare> merged(std::vector<NodeShare> shares) {
  auto place = [](const NodeShare& share) { return std::tuple(share.level, share.y, share.x); };
  std::sort(shares.begin(), shares.end(),
            [&](const NodeShare& a, const NodeShare& b) { return place(a) < place(b); });
  std::vector<NodeShare> result;
  for (const NodeShare& share : shares) {
    if (!result.empty() && place(result.back()) == place(share))
      result.back().share += share.share;
    else
      result.push_back(share);
  }
  return result;
}

}  // namespace

std::vector<NodeShare> sharesOf(const Footprint& footprint, Size projector) {
  constexpr float leastShare = 0.01f;  // of the strongest
  std::vector<NodeShare> shares;
  // A Gaussian is well sampled by blocks of up to 1.2 of its width.
  int level = 0;
  while (1.2f * std::min(footprint.sigmaX, footprint.sigmaY) >= static_cast<float>(2 << level)) ++level;
  auto side = static_cast<float>(1 << level);
  Size grid = gridAt(projector, level);
  AxisKernel across(footprint.x / side, footprint.sigmaX / side, grid.width);
  AxisKernel down(footprint.y / side, footprint.sigmaY / side, grid.height);
  float strongest = 0.0f, all = 0.0f, kept = 0.0f;
  for (float a : across.value)
    for (float d : down.value) {
      strongest = std::max(strongest, a * d);
      all += a * d;
    }
  for (int j = 0; j < down.size(); ++j)
    for (int i = 0; i < across.size(); ++i) {
      float share = across.value[static_cast<std::size_t>(i)] * down.value[static_cast<std::size_t>(j)];
      if (share < leastShare * strongest) continue;
      shares.push_back({level, across.first + i, down.first + j, share});
      kept += share;
    }
  for (NodeShare& share : shares) share.share *= (1.0f - footprint.halo) * all / kept;
  if (footprint.halo > 0.0f) {
    int wide = haloLevel(projector);
    Size wideGrid = gridAt(projector, wide);
    visitHalo({footprint.x, footprint.y, wide, wideGrid},
              [&](int x, int y, float weight) { shares.push_back({wide, x, y, footprint.halo * weight}); });
    if (wide == level) shares = merged(std::move(shares));
  }
  return shares;
}

}  // namespace relucent::importing
