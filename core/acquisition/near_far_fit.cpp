// SPDX-License-Identifier: MIT
#include "relucent/acquisition/near_far_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "relucent/base/parallel.h"
#include "relucent/multiplexing/row.h"
#include "relucent/transport/column_kinds.h"

namespace relucent::acquisition {
namespace {

// How far what the light of a kind has become is thought to be from what it was, and may be at most.
constexpr double spread = 0.5, most = 4.0;
// What two factors lack, as a share of the light.
constexpr double modelError = 0.02;
// For the equations of the rows that are fitted at once.
constexpr std::size_t mostBytes = std::size_t{256} << 20;

Eigen::Index at(std::size_t index) {
  return static_cast<Eigen::Index>(index);
}

/// The normal equations of some rows: for each camera channel the matrix, then the right side.
class Fit {
 public:
  Fit(const transport::ColumnKinds& kinds, std::vector<std::size_t> rows)
      : kinds_(kinds),
        rows_(std::move(rows)),
        systems_(at(kinds.count * (kinds.count + 1)), at(3 * rows_.size())) {
    const double expected = 1.0 / (spread * spread);
    systems_.setZero();
    for (std::size_t number = 0; number < rows_.size(); ++number)
      for (std::size_t channel = 0; channel < 3; ++channel) {
        matrix(number, channel).diagonal().setConstant(expected);
        right(number, channel).setConstant(expected);
      }
  }
  static std::size_t bytesOfRow(const transport::ColumnKinds& kinds) {
    return 3 * kinds.count * (kinds.count + 1) * sizeof(double);
  }

  void add(const transport::TransportMatrix& transport, const SeenPattern& seen) {
    const transport::NodeStack means = transport.layout().means(seen.pattern);
    parallelFor(0, rows_.size(), 64, [&](std::size_t number) {
      const Eigen::Matrix3Xd light = lightOfKinds(transport.row(rows_[number]), means);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const SeenPattern::Light shown = seen.shown(3 * rows_[number] + channel);
        const Eigen::VectorXd ofKinds = light.row(at(channel));
        const double variance =
            static_cast<double>(shown.variance) + std::pow(modelError * ofKinds.sum(), 2.0);
        if (!std::isfinite(variance) || !(variance > 0.0)) continue;
        matrix(number, channel).noalias() += ofKinds * (ofKinds / variance).transpose();
        right(number, channel) += static_cast<double>(shown.radiance) / variance * ofKinds;
      }
    });
  }

  transport::TransportMatrix fitted(transport::TransportMatrix transport) {
    constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
    std::vector<std::size_t> numberOf(transport.cameras().count(), nowhere);
    Eigen::MatrixXf factors(at(kinds_.count), at(3 * rows_.size()));
    parallelFor(0, rows_.size(), 64, [&](std::size_t number) {
      numberOf[rows_[number]] = number;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const Eigen::VectorXd factor = matrix(number, channel).llt().solve(right(number, channel));
        factors.col(at(3 * number + channel)) = factor.cwiseMax(0.0).cwiseMin(most).cast<float>();
      }
    });
    return std::move(transport).withColoursScaled(
        kinds_, [&](std::size_t row, std::size_t kind) -> transport::ColourBlock {
          transport::ColourBlock factor = transport::ColourBlock::Ones();
          if (numberOf[row] == nowhere) return factor;
          for (std::size_t channel = 0; channel < 3; ++channel)
            factor.row(at(channel)).setConstant(factors(at(kind), at(3 * numberOf[row] + channel)));
          return factor;
        });
  }

 private:
  Eigen::Map<Eigen::MatrixXd> matrix(std::size_t number, std::size_t channel) {
    return {systems_.col(at(3 * number + channel)).data(), at(kinds_.count), at(kinds_.count)};
  }
  Eigen::Map<Eigen::VectorXd> right(std::size_t number, std::size_t channel) {
    return {systems_.col(at(3 * number + channel)).data() + kinds_.count * kinds_.count, at(kinds_.count)};
  }

  /// Shapes: camera channels x kinds.
  Eigen::Matrix3Xd lightOfKinds(const transport::LeafRow& leaves, const transport::NodeStack& means) const {
    std::vector<Eigen::Array3f> sums(leaves.colourings(), Eigen::Array3f::Zero());
    std::vector<std::uint32_t> kindOf(sums.size(), 0);
    leaves.eachFactor([&](std::size_t entry, std::size_t k, const Eigen::Array3f& factor) {
      const std::uint32_t column = leaves.column(entry);
      sums[k] += factor * Eigen::Map<const Eigen::Array3f>(&means[3 * std::size_t{column}]);
      kindOf[k] = kinds_.kindOf(column);
    });
    Eigen::Matrix3Xd light = Eigen::Matrix3Xd::Zero(3, at(kinds_.count));
    for (std::size_t k = 0; k < sums.size(); ++k)
      light.col(kindOf[k]) += (leaves.colours(k) * sums[k].matrix()).cast<double>();
    return light;
  }

  const transport::ColumnKinds& kinds_;
  std::vector<std::size_t> rows_;
  Eigen::MatrixXd systems_;  // a column for each row's channel
};

}  // namespace

transport::TransportMatrix nearAndFarFitted(transport::TransportMatrix transport, const CameraMask& rows,
                                            const std::vector<SeenPattern>& patterns) {
  const transport::ColumnKinds* shared = transport.ownLeaves().sharedColours();
  const transport::ColumnKinds kinds =
      shared ? *shared : transport::nearAndFar(transport.layout(), multiplexing::RowSettings().nearLevels);
  const std::size_t atOnce = std::max<std::size_t>(1, mostBytes / Fit::bytesOfRow(kinds));
  for (std::size_t row = 0; row < rows.size();) {
    std::vector<std::size_t> some;
    for (; row < rows.size() && some.size() < atOnce; ++row)
      if (rows[row]) some.push_back(row);
    if (some.empty()) break;
    Fit fit(kinds, std::move(some));
    for (const SeenPattern& seen : patterns) fit.add(transport, seen);
    transport = fit.fitted(std::move(transport));
  }
  return transport;
}

}  // namespace relucent::acquisition
