// SPDX-License-Identifier: MIT
#include "relucent/monitoring/light_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "relucent/monitoring/tukey.h"

namespace relucent::monitoring {
namespace {

// What is known before: how far gains, room light and the moment may be off.
constexpr double gainPrior = 0.5, roomPrior = 1.0, floodPrior = 0.05, momentPrior = 1.0;
constexpr std::array<double, 7> widths{12.0, 6.0, 3.0, 2.0, 1.5, 1.0, 1.0};  // deviations, round after round
constexpr double recognisedWithin = 3.5;                                     // deviations

/// The regressors of one value, few of which are not zero, and what the photograph has there.
struct Rows {
  std::size_t unknowns = 0;
  std::vector<float> x;         // unknowns a value
  std::vector<float> light;     // y - e
  std::vector<std::size_t> at;  // value: 3 * sample + channel
  std::vector<std::size_t> cell;
  const float* of(std::size_t row) const { return &x[row * unknowns]; }
};

Rows rowsOf(const Observed& seen, const std::vector<float>& parts, const std::vector<float>& along,
            const WatchedVenue& venue) {
  const std::size_t projectors = venue.transport.projectors();
  Rows rows;
  rows.unknowns = 3 * projectors + 6 + (along.empty() ? 0 : 1);
  for (std::uint32_t sample : venue.sampling.even)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * sample + c;
      if (seen.valid[i] == 0) continue;
      rows.at.push_back(i);
      rows.cell.push_back(venue.sampling.cell[sample]);
      rows.light.push_back(seen.radiance[i] - venue.black[i]);
      std::vector<float> x(rows.unknowns, 0.0f);
      for (std::size_t j = 0; j < projectors; ++j)
        for (std::size_t k = 0; k < 3; ++k) x[3 * j + k] = parts[9 * (sample * projectors + j) + 3 * c + k];
      x[3 * projectors + c] = venue.black[i];
      x[3 * projectors + 3 + c] = venue.flood[i];
      if (!along.empty())
        for (std::size_t j = 0; j < projectors; ++j)
          for (std::size_t k = 0; k < 3; ++k) x.back() += along[9 * (sample * projectors + j) + 3 * c + k];
      rows.x.insert(rows.x.end(), x.begin(), x.end());
    }
  return rows;
}

class Regression {
 public:
  Regression(const Rows& rows, const Observed& seen, const WatchedVenue& venue)
      : rows_(rows), seen_(seen), venue_(venue), projectors_(venue.transport.projectors()) {
    const auto n = static_cast<Eigen::Index>(rows.unknowns);
    prior_ = Eigen::VectorXd::Constant(n, 1.0 / (momentPrior * momentPrior));
    start_ = Eigen::VectorXd::Zero(n);
    const auto gains = static_cast<Eigen::Index>(3 * projectors_);
    start_.head(gains).setOnes();
    prior_.head(gains).setConstant(1.0 / (gainPrior * gainPrior));
    prior_.segment(gains, 3).setConstant(1.0 / (roomPrior * roomPrior));
    prior_.segment(gains + 3, 3).setConstant(1.0 / (floodPrior * floodPrior));
    theta_ = start_;
    variance_.resize(rows.at.size());
  }

  void solve() {
    for (double width : widths) {
      weigh(width);
      step();
    }
  }
  const Eigen::VectorXd& theta() const { return theta_; }
  double lightOf(std::size_t row) const {  // of the projectors
    double sum = 0.0;
    for (std::size_t k = 0; k < 3 * projectors_; ++k)
      sum += theta_[static_cast<Eigen::Index>(k)] * rows_.of(row)[k];
    return sum;
  }
  double residual(std::size_t row) const {
    double sum = rows_.light[row];
    for (std::size_t k = 0; k < rows_.unknowns; ++k)
      sum -= theta_[static_cast<Eigen::Index>(k)] * rows_.of(row)[k];
    return sum;
  }
  double variance(std::size_t row) const { return variance_[row]; }
  double weight(std::size_t row) const { return weight_[row]; }

  /// Covariance of the sandwich over cells.
  Eigen::MatrixXd covariance() const {
    const auto n = static_cast<Eigen::Index>(rows_.unknowns);
    std::vector<Eigen::VectorXd> scores(venue_.sampling.cells.count(), Eigen::VectorXd::Zero(n));
    for (std::size_t row = 0; row < rows_.at.size(); ++row) {
      const double factor = weight_[row] / variance_[row] * residual(row);
      for (Eigen::Index k = 0; k < n; ++k) scores[rows_.cell[row]][k] += factor * rows_.of(row)[k];
    }
    Eigen::MatrixXd middle = normal_;  // what noise alone does, and what was known before
    for (const Eigen::VectorXd& score : scores) middle += score * score.transpose();
    const Eigen::LDLT<Eigen::MatrixXd> solver(normal_);
    return solver.solve(solver.solve(middle).transpose());
  }

 private:
  void weigh(double width) {
    weight_.resize(rows_.at.size());
    for (std::size_t row = 0; row < rows_.at.size(); ++row) {
      const std::size_t i = rows_.at[row];
      // Of what is expected, not of what a dead projector sends: else nothing there would be an outlier.
      double predicted = 0.0;
      for (std::size_t k = 0; k < 3 * projectors_; ++k) predicted += rows_.of(row)[k];
      const double wrong = venue_.wrong * predicted + venue_.wrongOfFlood * venue_.flood[i];
      variance_[row] = seen_.variance[i] + wrong * wrong;
      const double left = residual(row) / width;
      weight_[row] = tukeyWeight(left * left / variance_[row]);
    }
  }
  void step() {
    const auto n = static_cast<Eigen::Index>(rows_.unknowns);
    normal_ = prior_.asDiagonal();
    Eigen::VectorXd right = prior_.cwiseProduct(start_);
    Eigen::VectorXd x(n);
    for (std::size_t row = 0; row < rows_.at.size(); ++row) {
      const double w = weight_[row] / variance_[row];
      if (w == 0.0) continue;
      for (Eigen::Index k = 0; k < n; ++k) x[k] = rows_.of(row)[k];
      normal_.selfadjointView<Eigen::Lower>().rankUpdate(x, w);
      right += w * rows_.light[row] * x;
    }
    normal_ = normal_.selfadjointView<Eigen::Lower>();
    theta_ = normal_.ldlt().solve(right);
    clampRoom(right);
  }
  /// Room light that is not there cannot be taken away: what would be less than none is held there, and the
  /// others are solved again.
  void clampRoom(const Eigen::VectorXd& right) {
    Eigen::MatrixXd normal = normal_;
    Eigen::VectorXd r = right;
    bool isHeld = false;
    for (Eigen::Index c = 0; c < 6; ++c) {
      const Eigen::Index at = static_cast<Eigen::Index>(3 * projectors_) + c;
      const double least = c < 3 ? -1.0 : 0.0;
      if (theta_[at] >= least) continue;
      r -= normal.col(at) * least;
      normal.row(at).setZero();
      normal.col(at).setZero();
      normal(at, at) = 1.0;
      r[at] = least;
      isHeld = true;
    }
    if (isHeld) theta_ = normal.ldlt().solve(r);
  }

  const Rows& rows_;
  const Observed& seen_;
  const WatchedVenue& venue_;
  std::size_t projectors_;
  Eigen::VectorXd prior_, start_, theta_;
  Eigen::MatrixXd normal_;
  std::vector<double> weight_, variance_;
};

std::vector<CellLight> cellsOf(const Rows& rows, const Regression& regression, const Observed& seen,
                               const WatchedVenue& venue) {
  struct Sums {
    double products = 0.0, squares = 0.0, light = 0.0, flood = 0.0;
    int values = 0;
  };
  std::vector<Sums> sums(venue.sampling.cells.count());
  for (std::size_t row = 0; row < rows.at.size(); ++row) {
    const std::size_t i = rows.at[row];
    const double predicted = regression.lightOf(row);
    const double floor = venue.wrongOfFlood * venue.flood[i];
    const double weight = 1.0 / (seen.variance[i] + floor * floor);
    Sums& cell = sums[rows.cell[row]];
    cell.products += weight * predicted * (regression.residual(row) + predicted);
    cell.squares += weight * predicted * predicted;
    cell.light += predicted;
    cell.flood += venue.flood[i];
    ++cell.values;
  }
  std::vector<CellLight> cells(sums.size());
  constexpr int leastValues = 6;
  constexpr double leastLight = 0.02;  // of the flood image: below it T's errors are as large as the light
  for (std::size_t c = 0; c < sums.size(); ++c) {
    const Sums& cell = sums[c];
    if (cell.values < leastValues || cell.light < leastLight * cell.flood || cell.squares <= 0.0) continue;
    cells[c].share = cell.products / cell.squares;
    const double relative = cell.flood / std::max(cell.light, 1e-30) * venue.wrongOfFlood;
    cells[c].deviation = std::sqrt(1.0 / cell.squares + venue.wrong * venue.wrong + relative * relative);
  }
  return cells;
}

}  // namespace

LightFit fitLight(const Observed& seen, const Moment& moment, const WatchedVenue& venue) {
  const std::size_t projectors = venue.transport.projectors(), samples = venue.sampling.pixels.size();
  std::vector<std::uint32_t> all(samples);
  for (std::size_t s = 0; s < samples; ++s) all[s] = static_cast<std::uint32_t>(s);
  const std::vector<float> parts = venue.transport.lightOf(moment.means, all);
  const std::vector<float> along =
      moment.along.empty() ? std::vector<float>() : venue.transport.lightOf(moment.along, all);
  const Rows rows = rowsOf(seen, parts, along, venue);
  Regression regression(rows, seen, venue);
  regression.solve();

  LightFit fit;
  const Eigen::VectorXd& theta = regression.theta();
  const Eigen::MatrixXd covariance = regression.covariance();
  for (std::size_t k = 0; k < 3 * projectors; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    fit.gain.push_back(theta[i]);
    fit.deviation.push_back(std::sqrt(std::max(0.0, covariance(i, i))));
  }
  // The channels of a projector by their light, so that one that is hardly used counts for little.
  std::vector<double> light(3 * projectors, 0.0), asPredicted(projectors, 0.0);
  double flood = 0.0;
  for (std::size_t row = 0; row < rows.at.size(); ++row) {
    const bool isAsPredicted =
        std::abs(regression.residual(row)) < recognisedWithin * std::sqrt(regression.variance(row));
    for (std::size_t k = 0; k < 3 * projectors; ++k) {
      light[k] += rows.of(row)[k];
      if (isAsPredicted) asPredicted[k / 3] += rows.of(row)[k];
    }
    flood += venue.flood[rows.at[row]];
  }
  const double predicted = std::accumulate(light.begin(), light.end(), 0.0);
  for (std::size_t j = 0; j < projectors; ++j) {
    const double sum = light[3 * j] + light[3 * j + 1] + light[3 * j + 2];
    const auto first = static_cast<Eigen::Index>(3 * j);
    Eigen::Vector3d weight = Eigen::Vector3d::Constant(1.0 / 3.0);
    if (sum > 0.0) weight = Eigen::Vector3d(light[3 * j], light[3 * j + 1], light[3 * j + 2]) / sum;
    fit.recognisedOf.push_back(sum > 0.0 ? asPredicted[j] / sum : 0.0);
    fit.total.push_back(weight.dot(theta.segment<3>(first)));
    fit.totalDeviation.push_back(
        std::sqrt(std::max(0.0, weight.dot(covariance.block<3, 3>(first, first) * weight))));
  }
  for (Eigen::Index k = 0; k < 6; ++k)
    fit.room.push_back(theta[static_cast<Eigen::Index>(3 * projectors) + k]);
  fit.recognised =
      predicted > 0.0 ? std::accumulate(asPredicted.begin(), asPredicted.end(), 0.0) / predicted : 0.0;
  fit.light = flood > 0.0 ? predicted / flood : 0.0;
  fit.cells = cellsOf(rows, regression, seen, venue);

  fit.predicted.resize(3 * samples);
  fit.along.resize(along.empty() ? 0 : 3 * samples);
  for (std::size_t s = 0; s < samples; ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * s + c;
      double sum = venue.black[i] * (1.0 + fit.room[c]) + venue.flood[i] * fit.room[3 + c], later = 0.0;
      for (std::size_t j = 0; j < projectors; ++j)
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t part = 9 * (s * projectors + j) + 3 * c + k;
          sum += fit.gain[3 * j + k] * parts[part];
          if (!along.empty()) later += fit.gain[3 * j + k] * along[part];
        }
      if (!along.empty()) {
        sum += theta[theta.size() - 1] * later;
        fit.along[i] = static_cast<float>(later);
      }
      fit.predicted[i] = static_cast<float>(sum);
    }
  return fit;
}

}  // namespace relucent::monitoring
