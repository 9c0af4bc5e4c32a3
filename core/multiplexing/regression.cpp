// SPDX-License-Identifier: MIT
#include "relucent/multiplexing/regression.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "relucent/base/error.h"
#include "relucent/base/matrix_size.h"

namespace relucent::multiplexing {
namespace {

// The floods of black, red, green and blue are not better than this, relative.
constexpr float referenceVariance = 1e-7f;
// What the mixing of near or far light may be off by, relative to it.
constexpr float kindColours = 0.25f;
// A leaf's colours are unknowns of their own if over all patterns they show beyond this share of the noise.
constexpr float shownColours = 1.0f;
// Of the equations, at least this share counts as not used up by unknowns.
constexpr double leastFreedom = 0.15;
// A leaf's light is a share of the pixel's. Photographs that say many times more contradict the floods, as
// those of a pixel that was dark then and has moved: unbounded, such a row leaves first half and then single
// precision.
constexpr float mostLight = 8.0f;

Eigen::Index at(std::size_t index) {
  return static_cast<Eigen::Index>(index);
}
Eigen::Index stride(Eigen::Index count) {
  return at(padded(static_cast<std::size_t>(count)));
}

}  // namespace

RowRegression::RowRegression(const PatternMeans& means, const RowSettings& settings,
                             const SystemKernels& kernels)
    : means_(means),
      settings_(settings),
      kernels_(kernels),
      floods_(at(3 * means.layout().projectors().devices())) {}

const RowFit& RowRegression::solve(Row& row, const RowLight& seen) {
  leaves_ = at(row.leaves.size());
  equations_ = floods_ + at(means_.patterns());
  require(seen.light.rows() == equations_ && seen.variance.rows() == equations_, "{} equations, not {}",
          equations_, seen.light.rows());
  readDesign(row);
  findNoise(seen);
  chooseDetails(row);
  gatherKinds(row);

  sizeTo(system_, leaves_ + 1, stride(leaves_ + 1));
  system_.setZero();
  system_.diagonal().setOnes();
  for (Eigen::Index c = 0; c < 3; ++c) {
    fillColumns(row, seen, c);
    eliminateColours(channels_[static_cast<std::size_t>(c)]);
  }
  solveLight(row);
  for (Channel& channel : channels_) findColours(channel);
  findMisfit();
  adopt(row);
  return fit_;
}

const Eigen::ArrayX3f& RowRegression::predict() {
  Eigen::ArrayX3f light(stride(equations_), 3);
  for (std::size_t c = 0; c < 3; ++c)
    light.col(at(c)).setConstant(channels_[c].amplitude.tail<1>()[0] * channels_[c].colours.tail<1>()[0]);
  for (Eigen::Index j = 0; j < leaves_; ++j)
    kernels_.relight(designOf(j), static_cast<std::size_t>(light.rows()),
                     fit_.blocks[static_cast<std::size_t>(j)].data(),
                     {light.col(0).data(), light.col(1).data(), light.col(2).data()});
  sizeTo(predictions_, equations_ - floods_, 3);
  predictions_ = light.middleRows(floods_, equations_ - floods_);
  return predictions_;
}

std::array<const float*, 3> RowRegression::designOf(Eigen::Index leaf) const {
  return {design_[0].col(leaf).data(), design_[1].col(leaf).data(), design_[2].col(leaf).data()};
}

void RowRegression::readDesign(const Row& row) {
  kinds_.resize(row.leaves.size());
  for (Columns& design : design_) {
    sizeTo(design, stride(equations_), leaves_);
    design.bottomRows(design.rows() - equations_).setZero();
  }
  for (Eigen::Index j = 0; j < leaves_; ++j) {
    transport::Node place = means_.layout().node(row.leaves[static_cast<std::size_t>(j)].node);
    kinds_[static_cast<std::size_t>(j)] = at(kindOf(place, settings_));
    std::array<float*, 3> means{};
    for (std::size_t k = 0; k < 3; ++k) {
      auto column = design_[k].col(j);
      column.head(floods_).setZero();
      column[3 * place.projector + at(k)] = 1.0f;
      means[k] = column.data() + floods_;
    }
    means_.read(place, means);
  }
}

void RowRegression::findNoise(const RowLight& seen) {
  noise_.clear();
  for (Eigen::Index c = 0; c < 3; ++c)
    for (Eigen::Index n = floods_; n < equations_; ++n)
      if (std::isfinite(seen.variance(n, c))) noise_.push_back(seen.variance(n, c));
  fit_.noise = 0.0f;
  if (noise_.empty()) return;
  auto middle = noise_.begin() + static_cast<std::ptrdiff_t>(noise_.size() / 2);
  std::nth_element(noise_.begin(), middle, noise_.end());
  fit_.noise = *middle;
}

float RowRegression::colourSpread(const Row& row, Eigen::Index leaf) const {
  const Leaf& of = row.leaves[static_cast<std::size_t>(leaf)];
  return settings_.colours * std::sqrt(of.spread * of.spread + of.expected * of.expected);
}

void RowRegression::chooseDetails(const Row& row) {
  details_.clear();
  if (settings_.details == 0) return;
  auto length = static_cast<std::size_t>(stride(equations_));
  // Floods, and what is beyond the end, are zeros and ones.
  const float others = 0.25f * static_cast<float>(stride(equations_) - (equations_ - floods_));
  std::vector<std::pair<float, Eigen::Index>> shown;
  for (Eigen::Index j = 0; j < leaves_; ++j) {
    float variation = 0.0f;
    for (const float* design : designOf(j)) variation += kernels_.variation(design, length) - others;
    float spread = colourSpread(row, j), mixing = 1.0f / 3.0f;
    float energy = spread * spread * mixing * mixing * variation;
    if (energy > shownColours * (fit_.noise + row.excess)) shown.push_back({-energy, j});
  }
  std::sort(shown.begin(), shown.end());
  shown.resize(std::min(shown.size(), static_cast<std::size_t>(settings_.details)));
  for (const auto& [energy, leaf] : shown) details_.push_back(leaf);
}

void RowRegression::gatherKinds(const Row& row) {
  Eigen::Index kinds = at(row.mixing.size()), length = stride(equations_);
  std::vector<std::uint8_t> detailed(row.leaves.size(), 0);
  for (Eigen::Index leaf : details_) detailed[static_cast<std::size_t>(leaf)] = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    for (Columns* sums : {&known_[k], &lumped_[k]}) {
      sizeTo(*sums, length, kinds);
      sums->setZero();
    }
  }
  for (Eigen::Index j = 0; j < leaves_; ++j) {
    Eigen::Index kind = kinds_[static_cast<std::size_t>(j)];
    float light = std::max<float>(0.0f, row.leaves[static_cast<std::size_t>(j)].light),
          spread = detailed[static_cast<std::size_t>(j)] ? 0.0f : colourSpread(row, j);
    for (std::size_t k = 0; k < 3; ++k)
      kernels_.gather(design_[k].col(j).data(), static_cast<std::size_t>(length), light,
                      known_[k].col(kind).data(), spread * spread, lumped_[k].col(kind).data());
  }
  for (Columns& lumped : lumped_) lumped.topRows(floods_).setZero();  // floods are known to all leaves
}

void RowRegression::fillColumns(const Row& row, const RowLight& seen, Eigen::Index c) {
  Channel& channel = channels_[static_cast<std::size_t>(c)];
  Eigen::Index kinds = at(row.mixing.size());
  Eigen::Index colours = 3 * (at(details_.size()) + kinds) + 1;
  sizeTo(channel.amplitude, colours);
  sizeTo(channel.columns, stride(equations_), colours + leaves_ + 1);
  Columns& columns = channel.columns;

  // What was not seen weighs nothing, whatever its value.
  Eigen::ArrayXf variance(columns.rows());
  variance.head(equations_) = seen.variance.col(c);
  variance.tail(columns.rows() - equations_).setConstant(std::numeric_limits<float>::infinity());
  variance.head(floods_) += referenceVariance;
  variance.segment(floods_, equations_ - floods_) += row.excess;
  auto mixingOf = [&](Eigen::Index kind, std::size_t k) {
    return row.mixing[static_cast<std::size_t>(kind)](c, at(k)) + settings_.anyColour;
  };
  for (Eigen::Index kind = 0; kind < kinds; ++kind)
    for (std::size_t k = 0; k < 3; ++k)
      variance += mixingOf(kind, k) * mixingOf(kind, k) * lumped_[k].col(kind).array();
  Eigen::ArrayXf weight = variance.isFinite().select(variance.rsqrt(), 0.0f);
  // What contradicts the floods by more than noise does, neither.
  const Eigen::ArrayXf most = mostLight * (1.0f + seen.variance.col(c).max(0.0f).sqrt());
  weight.head(equations_) = (seen.light.col(c).abs() <= most).select(weight.head(equations_), 0.0f);
  channel.seen = (weight.segment(floods_, equations_ - floods_) > 0.0f).count();

  Eigen::Index column = 0;
  auto put = [&](float amplitude, const auto& values) {
    channel.amplitude[column] = amplitude;
    columns.col(column++).array() = amplitude * weight * values;
  };
  for (Eigen::Index kind = 0; kind < kinds; ++kind)
    for (std::size_t k = 0; k < 3; ++k) put(kindColours * mixingOf(kind, k), known_[k].col(kind).array());
  for (Eigen::Index leaf : details_)
    for (std::size_t k = 0; k < 3; ++k)
      put(colourSpread(row, leaf) * mixingOf(kinds_[static_cast<std::size_t>(leaf)], k),
          design_[k].col(leaf).array());
  put(seen.offset[c], Eigen::ArrayXf::Ones(columns.rows()));

  auto left = columns.col(columns.cols() - 1).array();
  left.head(equations_) = weight.head(equations_) * seen.light.col(c);
  left.tail(columns.rows() - equations_).setZero();
  for (Eigen::Index j = 0; j < leaves_; ++j) {
    const Leaf& leaf = row.leaves[static_cast<std::size_t>(j)];
    const auto& mixing = row.mixing[static_cast<std::size_t>(kinds_[static_cast<std::size_t>(j)])];
    kernels_.weigh(designOf(j), static_cast<std::size_t>(columns.rows()),
                   {mixing(c, 0), mixing(c, 1), mixing(c, 2)}, weight.data(), leaf.spread,
                   columns.col(colours + j).data(), leaf.expected, columns.col(columns.cols() - 1).data());
  }
}

void RowRegression::eliminateColours(Channel& channel) {
  Eigen::Index all = channel.columns.cols(), colours = channel.amplitude.size();
  Symmetric& system = channel.system;
  sizeTo(system, all, stride(all));
  kernels_.gram(channel.columns.data(), static_cast<std::size_t>(channel.columns.rows()),
                static_cast<std::size_t>(all), system.data(), static_cast<std::size_t>(system.cols()));
  channel.known = 0.0;
  for (Eigen::Index i = 0; i < colours; ++i) {
    channel.known += static_cast<double>(system(i, i) / (1.0f + system(i, i)));
    system(i, i) += 1.0f;
  }
  kernels_.eliminate(system.data(), static_cast<std::size_t>(system.cols()), static_cast<std::size_t>(all),
                     static_cast<std::size_t>(colours));
  system_.leftCols(leaves_ + 1) += system.block(colours, colours, leaves_ + 1, leaves_ + 1);
}

void RowRegression::solveLight(Row& row) {
  auto width = static_cast<std::size_t>(system_.cols()), count = static_cast<std::size_t>(leaves_);
  kernels_.eliminate(system_.data(), width, count + 1, count);
  sizeTo(inverse_, leaves_, system_.cols());
  kernels_.invert(system_.data(), width, count, inverse_.data());
  sizeTo(light_, leaves_);
  light_ = system_.col(leaves_).head(leaves_);
  for (Eigen::Index j = leaves_ - 1; j >= 0; --j) {
    float known = system_.row(j).segment(j + 1, leaves_ - j - 1).dot(light_.tail(leaves_ - j - 1));
    light_[j] = (light_[j] - known) / system_(j, j);
  }
  // The inverse of R^T D^-1 R is R^-1 D R^-T.
  determined_ = 0.0;
  auto pivots = system_.diagonal().head(leaves_).array();
  for (Eigen::Index j = 0; j < leaves_; ++j) {
    Leaf& leaf = row.leaves[static_cast<std::size_t>(j)];
    auto inverse = inverse_.row(j).segment(j, leaves_ - j).array();
    float rest = (inverse.square().transpose() * pivots.tail(leaves_ - j)).sum();
    determined_ += 1.0 - static_cast<double>(std::min(rest, 1.0f));
    leaf.deviation = std::min(leaf.spread * std::sqrt(rest), mostLight);
  }
}

void RowRegression::findColours(Channel& channel) {
  const Symmetric& system = channel.system;
  Eigen::Index colours = channel.amplitude.size();
  sizeTo(channel.colours, colours);
  channel.colours = system.col(colours + leaves_).head(colours);
  for (Eigen::Index i = colours - 1; i >= 0; --i) {
    float known = system.row(i).segment(i + 1, colours - i - 1).dot(channel.colours.tail(colours - i - 1)) +
                  system.row(i).segment(colours, leaves_).dot(light_);
    channel.colours[i] = (channel.colours[i] - known) / system(i, i);
  }
}

void RowRegression::findMisfit() {
  double known = determined_, squared = 0.0, seen = 0.0;
  for (const Channel& channel : channels_) {
    Eigen::Index colours = channel.amplitude.size(), patterns = equations_ - floods_;
    Eigen::VectorXf left = channel.columns.col(colours + leaves_).segment(floods_, patterns);
    left.noalias() -= channel.columns.block(floods_, 0, patterns, colours) * channel.colours;
    left.noalias() -= channel.columns.block(floods_, colours, patterns, leaves_) * light_;
    squared += static_cast<double>(left.squaredNorm());
    seen += static_cast<double>(channel.seen);
    known += channel.known;
  }
  double freedom = std::max(seen - known, leastFreedom * seen);
  fit_.misfit = freedom > 0.0 ? static_cast<float>(squared / freedom) : 1.0f;
}

Eigen::Array3f RowRegression::floodVariance(const Row& row) const {
  Eigen::Array3f variances;
  // Of the sum over leaves and projector channels. Light and colours cannot be told apart each for itself:
  // more light of darker colours is the same.
  Eigen::VectorXf light(leaves_);
  for (std::size_t c = 0; c < 3; ++c) {
    const Channel& channel = channels_[c];
    Eigen::VectorXf colours = channel.amplitude;
    Eigen::Index count = colours.size();
    for (Eigen::Index kind = 0; kind < at(row.mixing.size()); ++kind)
      colours.segment(3 * kind, 3) *= known_[0](3 * (kind / 2), kind);
    colours[count - 1] = 0.0f;  // e is not part of it
    for (Eigen::Index j = 0; j < leaves_; ++j) light[j] = row.leaves[static_cast<std::size_t>(j)].spread;
    float variance = 0.0f;
    for (Eigen::Index i = 0; i < count; ++i) {
      float share = colours[i] / channel.system(i, i);
      variance += share * colours[i];
      colours.tail(count - i - 1) -= share * channel.system.row(i).segment(i + 1, count - i - 1).transpose();
      light -= share * channel.system.row(i).segment(count, leaves_).transpose();
    }
    for (Eigen::Index j = 0; j < leaves_; ++j) {
      float share = light[j] / system_(j, j);
      variance += share * light[j];
      light.tail(leaves_ - j - 1) -= share * system_.row(j).segment(j + 1, leaves_ - j - 1).transpose();
    }
    variances[at(c)] = variance;
  }
  return variances;
}

void RowRegression::adopt(Row& row) {
  fit_.blocks.resize(row.leaves.size());
  fit_.sums.assign(row.mixing.size(), transport::ColourBlock::Zero());
  std::vector<transport::ColourBlock> off(row.mixing.size());
  Eigen::Index kinds = at(row.mixing.size());
  for (Eigen::Index kind = 0; kind < kinds; ++kind)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const Channel& channel = channels_[static_cast<std::size_t>(c)];
      for (Eigen::Index k = 0; k < 3; ++k)
        off[static_cast<std::size_t>(kind)](c, k) =
            channel.amplitude[3 * kind + k] * channel.colours[3 * kind + k];
    }
  for (std::size_t j = 0; j < row.leaves.size(); ++j) {
    Leaf& leaf = row.leaves[j];
    auto kind = static_cast<std::size_t>(kinds_[j]);
    float before = std::max<float>(0.0f, leaf.light);
    leaf.light = std::clamp(leaf.expected + leaf.spread * light_[at(j)], -mostLight, mostLight);
    fit_.blocks[j] = leaf.light * row.mixing[kind] + before * off[kind];
  }
  for (std::size_t d = 0; d < details_.size(); ++d)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const Channel& channel = channels_[static_cast<std::size_t>(c)];
      for (Eigen::Index k = 0; k < 3; ++k) {
        Eigen::Index unknown = 3 * (kinds + at(d)) + k;
        fit_.blocks[static_cast<std::size_t>(details_[d])](c, k) +=
            channel.amplitude[unknown] * channel.colours[unknown];
      }
    }
  for (std::size_t j = 0; j < row.leaves.size(); ++j)
    fit_.sums[static_cast<std::size_t>(kinds_[j])] += fit_.blocks[j];
  fit_.flood.setZero();
  for (const transport::ColourBlock& sum : fit_.sums) fit_.flood += sum.rowwise().sum().array();
}

}  // namespace relucent::multiplexing
