// SPDX-License-Identifier: MIT
#include "relucent/importing/response.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "relucent/hdr/isotonic.h"

namespace relucent::importing {
namespace {

constexpr std::size_t mostKnots = 33;

/// The ends and, if they are few enough, every code between; else codes evenly spread.
std::vector<int> knotsOf(const std::vector<int>& codes) {
  std::vector<int> knots{0};
  auto inner = [](int code) { return code > 0 && code < 255; };
  auto count = static_cast<std::size_t>(std::count_if(codes.begin(), codes.end(), inner));
  if (count + 2 <= mostKnots) {
    std::copy_if(codes.begin(), codes.end(), std::back_inserter(knots), inner);
  } else {
    for (int k = 1; k < 16; ++k) knots.push_back(k * 255 / 16);
  }
  knots.push_back(255);
  return knots;
}

/// A row of a system: what each interior knot weighs in it, and what white contributes.
struct KnotRow {
  Eigen::VectorXd weight;
  double known = 0.0;
};

/// Where the interior knots of all channels stand among the unknowns, and the hat functions between them.
class Knots {
 public:
  Knots(const PictureSequence& patterns, const ImportFrames& frames) {
    for (int c = 0; c < 3; ++c) {
      auto channel = static_cast<std::size_t>(c);
      codes_[channel] = knotsOf(codesOf(patterns, frames, c));
      first_[channel] = unknowns_;
      unknowns_ += static_cast<Eigen::Index>(codes_[channel].size()) - 2;
    }
  }
  Eigen::Index unknowns() const { return unknowns_; }
  const std::vector<int>& codes(std::size_t channel) const { return codes_[channel]; }
  Eigen::Index unknown(std::size_t channel, std::size_t knot) const {
    return first_[channel] + static_cast<Eigen::Index>(knot) - 1;
  }
  /// Adds weight * (hat functions at code) of a channel to a row of a system.
  void add(std::size_t channel, int code, float weight, KnotRow& row) const {
    const std::vector<int>& codes = codes_[channel];
    auto above = static_cast<std::size_t>(std::upper_bound(codes.begin(), codes.end(), code) - codes.begin());
    above = std::min(above, codes.size() - 1);
    double t = static_cast<double>(code - codes[above - 1]) / (codes[above] - codes[above - 1]);
    addKnot(channel, above - 1, weight * (1.0 - t), row);
    addKnot(channel, above, weight * t, row);
  }

 private:
  void addKnot(std::size_t channel, std::size_t knot, double weight, KnotRow& row) const {
    if (knot + 1 == codes_[channel].size())
      row.known += weight;
    else if (knot > 0)
      row.weight[unknown(channel, knot)] += weight;
  }

  std::array<std::vector<int>, 3> codes_;
  std::array<Eigen::Index, 3> first_{};
  Eigen::Index unknowns_ = 0;
};

/// Least squares for the curves' values at the interior knots.
class System {
 public:
  System(const PictureSequence& patterns, const PictureSequence& photographs, const ImportFrames& frames)
      : knots_(patterns, frames),
        patterns_(patterns),
        photographs_(photographs),
        frames_(frames),
        normal_(Eigen::MatrixXd::Zero(knots_.unknowns(), knots_.unknowns())),
        wanted_(Eigen::VectorXd::Zero(knots_.unknowns())) {}

  const Knots& knots() const { return knots_; }

  void add(const SamplePixel& sample) {
    std::vector<NodeShare> shares = sharesOf(sample.footprint, patterns_.size());
    for (int frame : frames_.fitted) {
      std::array<KnotRow, 3> rows;
      for (KnotRow& row : rows) row.weight = Eigen::VectorXd::Zero(knots_.unknowns());
      for (const NodeShare& share : shares) addNode(share, frame, rows);
      for (int camera = 0; camera < 3; ++camera) {
        float signal = photographs_.value(sample.pixel, frame, camera);
        if (signal >= importSaturation) continue;
        Eigen::VectorXd line = Eigen::VectorXd::Zero(knots_.unknowns());
        double rest = static_cast<double>(signal - sample.colour.black[camera]);
        for (int c = 0; c < 3; ++c) {
          auto gain = static_cast<double>(sample.colour.block(camera, c));
          line += gain * rows[static_cast<std::size_t>(c)].weight;
          rest -= gain * rows[static_cast<std::size_t>(c)].known;
        }
        normal_.selfadjointView<Eigen::Lower>().rankUpdate(line);
        wanted_ += rest * line;
      }
    }
  }

  /// Drawn a little towards the curves before: knots that few pixels show stay near them.
  linearization::ProjectorResponse solve(const linearization::ProjectorResponse& before) const {
    Eigen::VectorXd prior(knots_.unknowns());
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t knot = 1; knot + 1 < knots_.codes(c).size(); ++knot)
        prior[knots_.unknown(c, knot)] = before.channels[c](knots_.codes(c)[knot] / 255.0);
    Eigen::MatrixXd system = normal_.selfadjointView<Eigen::Lower>();
    Eigen::VectorXd rest = wanted_ - system * prior;
    system.diagonal().array() += 1e-4 * system.trace() / static_cast<double>(knots_.unknowns()) + 1e-12;
    Eigen::VectorXd values = prior + system.ldlt().solve(rest);
    linearization::ProjectorResponse response = before;
    for (std::size_t c = 0; c < 3; ++c)
      if (knots_.codes(c).size() > 2) response.channels[c] = curve(c, values, system);
    return response;
  }

 private:
  void addNode(const NodeShare& share, int frame, std::array<KnotRow, 3>& rows) const {
    Size size = patterns_.size();
    int side = 1 << share.level;
    int x0 = share.x * side, y0 = share.y * side;
    int x1 = std::min(size.width, x0 + side), y1 = std::min(size.height, y0 + side);
    // A wide block's mean is known well enough from a few of its pixels.
    int step = std::max(1, side / 4);
    int count = ((x1 - x0 + step - 1) / step) * ((y1 - y0 + step - 1) / step);
    float weight = share.share / static_cast<float>(count);
    for (int y = y0; y < y1; y += step)
      for (int x = x0; x < x1; x += step)
        for (std::size_t c = 0; c < 3; ++c) {
          int code = (patterns_.code(indexOf(size, {x, y}), frame, static_cast<int>(c)) + 128) / 257;
          knots_.add(c, code, weight, rows[c]);
        }
  }

  hdr::ResponseCurve curve(std::size_t channel, const Eigen::VectorXd& values,
                           const Eigen::MatrixXd& system) const {
    std::vector<double> x{0.0}, y{0.0}, weight{1e6};
    const std::vector<int>& codes = knots_.codes(channel);
    double sure = 1.0;
    for (std::size_t knot = 1; knot + 1 < codes.size(); ++knot) {
      Eigen::Index unknown = knots_.unknown(channel, knot);
      x.push_back(codes[knot] / 255.0);
      y.push_back(std::clamp(values[unknown], 0.0, 1.0));
      weight.push_back(std::max(1e-9, system(unknown, unknown)));
      sure = std::max(sure, weight.back());
    }
    x.push_back(1.0);
    y.push_back(1.0);
    weight.front() = 1e3 * sure;
    weight.push_back(1e3 * sure);
    return hdr::curveFromRamp(x, y, weight);
  }

  Knots knots_;
  const PictureSequence& patterns_;
  const PictureSequence& photographs_;
  const ImportFrames& frames_;
  Eigen::MatrixXd normal_;
  Eigen::VectorXd wanted_;
};

}  // namespace

std::vector<int> codesOf(const PictureSequence& patterns, const ImportFrames& frames, int channel) {
  std::array<bool, 256> there{};
  for (std::size_t pixel = 0; pixel < patterns.size().count(); ++pixel)
    for (int frame : frames.fitted) there[(patterns.code(pixel, frame, channel) + 128u) / 257u] = true;
  std::vector<int> codes;
  for (int code = 0; code < 256; ++code)
    if (there[static_cast<std::size_t>(code)]) codes.push_back(code);
  return codes;
}

linearization::ProjectorResponse estimateResponse(const ImportPictures& pictures,
                                                  const std::vector<SamplePixel>& sample,
                                                  const linearization::ProjectorResponse& before) {
  System system(pictures.patterns, pictures.photographs, pictures.frames);
  if (system.knots().unknowns() == 0) return before;
  for (const SamplePixel& pixel : sample) system.add(pixel);
  return system.solve(before);
}

hdr::ResponseCurve usualCurve() {
  std::vector<double> x, y;
  for (int k = 0; k <= 32; ++k) {
    x.push_back(k / 32.0);
    y.push_back(std::pow(k / 32.0, 2.2));
  }
  return hdr::ResponseCurve(std::move(x), std::move(y));
}

}  // namespace relucent::importing
