// SPDX-License-Identifier: MIT
#include "relucent/importing/colour.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace relucent::importing {
namespace {

using Drive = Eigen::Matrix<float, Eigen::Dynamic, 3>;

Drive meansOf(const PictureSequence& patterns, const ImportFrames& frames, const DriveTable& drive) {
  Drive mean(static_cast<Eigen::Index>(frames.fitted.size()), 3);
  parallelFor(0, frames.fitted.size(), 1, [&](std::size_t row) {
    for (int c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t pixel = 0; pixel < patterns.size().count(); ++pixel)
        sum += static_cast<double>(drive(patterns.code(pixel, frames.fitted[row], c), c));
      mean(static_cast<Eigen::Index>(row), c) =
          static_cast<float>(sum / static_cast<double>(patterns.size().count()));
    }
  });
  return mean;
}

/// signal = black + gain * drive of one channel.
struct Line {
  float black = 0.0f;
  float gain = 0.0f;
};

Line lineThrough(const Eigen::VectorXf& drive, const Eigen::VectorXf& signal, const Eigen::VectorXf& weight) {
  float count = weight.sum();
  if (!(count > 0.0f)) return {};
  float meanDrive = drive.dot(weight) / count, meanSignal = signal.dot(weight) / count;
  Eigen::VectorXf centred = (drive.array() - meanDrive).matrix();
  float spread = centred.cwiseAbs2().dot(weight);
  float along = centred.cwiseProduct(weight).dot(signal);
  float gain = spread > 1e-8f ? std::max(0.0f, along / spread) : 0.0f;
  return {meanSignal - gain * meanDrive, gain};
}

}  // namespace

FrameReader::FrameReader(const ImportPictures& pictures, const SequencePyramid& pyramid,
                         const DriveTable& drive)
    : photographs_(pictures.photographs),
      frames_(pictures.frames),
      pyramid_(pyramid),
      mean_(meansOf(pictures.patterns, pictures.frames, drive)) {
  const std::vector<int>& spatial = frames_.spatial;
  for (int frame : frames_.fitted) {
    auto found = std::find(spatial.begin(), spatial.end(), frame);
    spatialPlace_.push_back(found == spatial.end() ? -1 : static_cast<int>(found - spatial.begin()));
  }
}

PixelFrames FrameReader::photographed(std::size_t cameraPixel) const {
  PixelFrames result;
  auto count = static_cast<Eigen::Index>(frames_.fitted.size());
  result.signal.resize(count, 3);
  result.weight.resize(count);
  for (Eigen::Index row = 0; row < count; ++row) {
    for (int c = 0; c < 3; ++c)
      result.signal(row, c) =
          photographs_.value(cameraPixel, frames_.fitted[static_cast<std::size_t>(row)], c);
    result.weight[row] = result.signal.row(row).maxCoeff() < importSaturation ? 1.0f : 0.0f;
  }
  // A pixel cut off in most frames is better known wrongly than not at all.
  if (result.weight.sum() < 4.0f) result.weight.setOnes();
  return result;
}

PixelFrames FrameReader::read(std::size_t cameraPixel, const std::vector<NodeShare>& shares) const {
  PixelFrames result = photographed(cameraPixel);
  Eigen::VectorXf seen = Eigen::VectorXf::Zero(pyramid_.samples);
  float all = 0.0f;
  for (const NodeShare& share : shares) {
    all += share.share;
    const SequencePyramid::Level& level = pyramid_.levels[static_cast<std::size_t>(share.level)];
    seen += share.share *
            Eigen::Map<const Eigen::VectorXf>(
                level.node(indexOf(level.grid, {share.x, share.y}), pyramid_.samples), pyramid_.samples);
  }
  result.mean = mean_;
  result.drive = all * mean_;
  for (std::size_t row = 0; row < spatialPlace_.size(); ++row) {
    if (spatialPlace_[row] < 0) continue;
    for (int c = 0; c < 3; ++c)
      result.drive(static_cast<Eigen::Index>(row), c) =
          seen[spatialPlace_[row] * pyramid_.channels + (pyramid_.channels == 3 ? c : 0)];
  }
  return result;
}

PixelFrames FrameReader::readEverywhere(std::size_t cameraPixel) const {
  PixelFrames result = photographed(cameraPixel);
  result.drive = mean_;
  result.mean = mean_;
  return result;
}

namespace {

// How far a surface's mixing is expected to be from the common one, and how strong far light is, both
// relative to the pixel's gain.
constexpr float mixingSpread = 0.3f;
constexpr float farSpread = 0.1f;

double stiffnessOf(float noise, float spread, float gain) {
  return std::pow(static_cast<double>(noise / (spread * std::max(gain, noise))), 2.0);
}

/// Weighted least squares drawn towards `centre`.
Eigen::VectorXd drawnFit(const Eigen::MatrixXd& basis, const Eigen::VectorXd& signal,
                         const Eigen::VectorXd& centre, const Eigen::VectorXd& stiffness) {
  Eigen::MatrixXd normal = basis.transpose() * basis;
  Eigen::VectorXd rest = basis.transpose() * signal - normal * centre;
  normal.diagonal() += stiffness;
  return centre + normal.ldlt().solve(rest);
}

}  // namespace

PixelColour fitColour(const PixelFrames& frames, const transport::ColourBlock& mixing, float noise,
                      bool withFar) {
  PixelColour colour;
  const Eigen::Index columns = withFar ? 7 : 4;
  Eigen::VectorXd weight = frames.weight.cast<double>();
  Eigen::MatrixXd basis(frames.drive.rows(), columns);
  basis.col(0) = weight;
  basis.middleCols<3>(1) = weight.asDiagonal() * frames.drive.cast<double>();
  if (withFar) basis.middleCols<3>(4) = weight.asDiagonal() * frames.mean.cast<double>();
  for (int c = 0; c < 3; ++c) {
    Line line = lineThrough(frames.drive * mixing.row(c).transpose(), frames.signal.col(c), frames.weight);
    Eigen::VectorXd centre = Eigen::VectorXd::Zero(columns), stiffness(columns);
    centre[0] = static_cast<double>(line.black);
    centre.segment<3>(1) = (line.gain * mixing.row(c).transpose()).cast<double>();
    stiffness.setConstant(stiffnessOf(noise, farSpread, line.gain));
    stiffness[0] = 1e-6;
    stiffness.segment<3>(1).setConstant(stiffnessOf(noise, mixingSpread, line.gain));
    Eigen::VectorXd signal = weight.cwiseProduct(frames.signal.col(c).cast<double>());
    Eigen::VectorXd fit = drawnFit(basis, signal, centre, stiffness);
    colour.black[c] = static_cast<float>(fit[0]);
    colour.block.row(c) = fit.segment<3>(1).cast<float>();
    if (withFar) colour.far.row(c) = fit.segment<3>(4).cast<float>();
  }
  return colour;
}

PixelColour fitGains(const PixelFrames& frames, float noise, bool withFar) {
  PixelColour colour;
  for (int c = 0; c < 3; ++c) {
    Line line = lineThrough(frames.drive.col(c), frames.signal.col(c), frames.weight);
    colour.black[c] = line.black;
    colour.block(c, c) = line.gain;
    if (!withFar || !(line.gain > 0.0f)) continue;
    Eigen::VectorXd weight = frames.weight.cast<double>();
    Eigen::MatrixXd basis(frames.drive.rows(), 3);
    basis.col(0) = weight;
    basis.col(1) = weight.cwiseProduct(frames.drive.col(c).cast<double>());
    basis.col(2) = weight.cwiseProduct(frames.mean.col(c).cast<double>());
    Eigen::Vector3d centre(static_cast<double>(line.black), static_cast<double>(line.gain), 0.0);
    Eigen::Vector3d stiffness(1e-6, 1e-6, stiffnessOf(noise, farSpread, line.gain));
    Eigen::VectorXd signal = weight.cwiseProduct(frames.signal.col(c).cast<double>());
    Eigen::VectorXd fit = drawnFit(basis, signal, centre, stiffness);
    colour.black[c] = static_cast<float>(fit[0]);
    colour.block(c, c) = static_cast<float>(fit[1]);
    colour.far(c, c) = static_cast<float>(fit[2]);
  }
  return colour;
}

bool isExplained(const PixelFrames& seen, const PixelColour& colour) {
  constexpr float least = 0.25f;
  float apart = 0.0f, varies = 0.0f;
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXf signal = seen.signal.col(c);
    Eigen::VectorXf predicted =
        (seen.drive * colour.block.row(c).transpose() + seen.mean * colour.far.row(c).transpose()).array() +
        colour.black[c];
    apart += (signal - predicted).cwiseAbs2().dot(seen.weight);
    varies += (signal.array() - signal.mean()).matrix().cwiseAbs2().dot(seen.weight);
  }
  return apart <= least * varies;
}

transport::ColourBlock commonMixing(const std::vector<PixelFrames>& sample) {
  constexpr int rounds = 6;
  transport::ColourBlock mixing = transport::ColourBlock::Identity();
  for (int round = 0; round < rounds; ++round) {
    transport::ColourBlock next;
    for (int c = 0; c < 3; ++c) {
      Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
      Eigen::Vector3d wanted = Eigen::Vector3d::Zero();
      for (const PixelFrames& frames : sample) {
        Line line =
            lineThrough(frames.drive * mixing.row(c).transpose(), frames.signal.col(c), frames.weight);
        if (!(line.gain > 1e-4f)) continue;
        // Normalised by the pixel's gain and weighted with it: bright pixels are the surest.
        Eigen::VectorXf target = (frames.signal.col(c).array() - line.black).matrix() -
                                 line.gain * frames.drive * mixing.row(c).transpose();
        Drive lit = line.gain * (frames.weight.asDiagonal() * frames.drive);
        normal += (lit.transpose() * lit).cast<double>();
        wanted += (lit.transpose() * target).cast<double>();
      }
      normal.diagonal().array() += 1e-3 * normal.trace() + 1e-12;
      Eigen::Vector3d row = mixing.row(c).transpose().cast<double>() + normal.ldlt().solve(wanted);
      row = row.cwiseMax(0.0);
      next.row(c) = (row / std::max(1e-6, row.sum())).transpose().cast<float>();
    }
    mixing = next;
  }
  return mixing;
}

}  // namespace relucent::importing
