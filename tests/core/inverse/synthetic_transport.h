// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "relucent/base/random.h"
#include "relucent/image/image.h"
#include "relucent/transport/transport_matrix.h"

namespace relucent::synthetic {

/// A made-up venue: textured surface, varying defocus, colour crosstalk, an interreflection on one side, and
/// far-field light on coarse nodes.
struct SceneSettings {
  Size projector{64, 48};
  Size camera{40, 30};
  std::uint64_t seed = 1;
  double sharpest = 0.4;         // defocus: standard deviation in projector pixels at one side ...
  double softest = 1.5;          // ... and at the other
  double margin = 0.05;          // share of the camera's view beyond the projection, on every side
  double texture = 0.8;          // contrast of the reflectance
  double crosstalk = 0.15;       // share of a colour's light that the next camera channels see
  double interreflection = 0.1;  // share of direct light that a mirrored place sends, blurred
  double farField = 0.15;        // share of light that comes from everywhere
  double black = 0.002;          // e relative to the mean flood image
};

struct Scene {
  transport::TransportMatrix transport;
  CameraStack black;
  CameraMask usable;
};

/// Smooth noise in [0, 1]: octaves of interpolated lattice noise, amplitude falling as 1 / frequency.
inline double cloud(double x, double y, std::uint64_t key, int octaves = 6, double coarsest = 32.0) {
  auto lattice = [&](int octave, int ix, int iy) {
    return Random({key, static_cast<std::uint64_t>(octave), static_cast<std::uint64_t>(ix + 100000),
                   static_cast<std::uint64_t>(iy + 100000)})
        .uniform();
  };
  double sum = 0.0, total = 0.0, size = coarsest, amplitude = 1.0;
  for (int octave = 0; octave < octaves; ++octave, size /= 2.0, amplitude /= 2.0) {
    double u = x / size, v = y / size;
    int iu = static_cast<int>(std::floor(u)), iv = static_cast<int>(std::floor(v));
    double fu = u - iu, fv = v - iv;
    fu = fu * fu * (3 - 2 * fu);
    fv = fv * fv * (3 - 2 * fv);
    double value = (1 - fv) * ((1 - fu) * lattice(octave, iu, iv) + fu * lattice(octave, iu + 1, iv)) +
                   fv * ((1 - fu) * lattice(octave, iu, iv + 1) + fu * lattice(octave, iu + 1, iv + 1));
    sum += amplitude * value;
    total += amplitude;
  }
  // Averages of octaves crowd around one half: stretched back to most of the range.
  return std::clamp(0.5 + 1.8 * (sum / total - 0.5), 0.0, 1.0);
}

/// How much of a blurred camera pixel [a, b] falls on projector pixels first, first + 1, ... (they sum to 1).
inline std::vector<double> footprint(double a, double b, double sigma, int first, int count) {
  constexpr int samples = 6;
  std::vector<double> share(static_cast<std::size_t>(count), 0.0);
  auto below = [&](double x, double centre) {
    return 0.5 * std::erfc((centre - x) / (sigma * std::sqrt(2.0)));
  };
  for (int s = 0; s < samples; ++s) {
    double centre = a + (b - a) * (s + 0.5) / samples;
    for (int i = 0; i < count; ++i)
      share[static_cast<std::size_t>(i)] +=
          (below(first + i + 1, centre) - below(first + i, centre)) / samples;
  }
  return share;
}

inline Scene makeScene(const SceneSettings& s) {
  transport::NodeLayout layout{Rasters(s.projector)};
  struct Leaf {
    std::size_t row, node;
    transport::ColourBlock block;
  };
  std::vector<Leaf> leaves;
  std::vector<float> fullScale(s.camera.count(), 0.0f);
  Scene scene;
  scene.usable.assign(s.camera.count(), 0);
  auto add = [&](std::size_t row, std::size_t node, const transport::ColourBlock& block) {
    leaves.push_back({row, node, block});
    fullScale[row] = std::max(fullScale[row], block.cwiseAbs().maxCoeff());
  };

  double span = 1.0 + 2.0 * s.margin;
  double pitchX = span * s.projector.width / s.camera.width,
         pitchY = span * s.projector.height / s.camera.height;
  for (std::size_t row = 0; row < s.camera.count(); ++row) {
    Pixel pixel = pixelAt(s.camera, row);
    auto at = [&](int c) {
      auto key = s.seed * 100 + static_cast<std::uint64_t>(c);
      double fine = cloud(pixel.x, pixel.y, key, 5, 16.0);
      // Joints between bricks: hard edges of the reflectance.
      bool joint = pixel.y % 8 == 0 || (pixel.x + (pixel.y / 8 % 2) * 6) % 12 == 0;
      return 0.9 * (1.0 - s.texture * (joint ? 0.8 : 0.75 * fine));
    };
    std::array<double, 3> reflectance{at(0), 0.5 * (at(0) + at(1)), 0.5 * (at(0) + at(2))};
    transport::ColourBlock mixing;
    for (int c = 0; c < 3; ++c)
      for (int p = 0; p < 3; ++p) {
        double share = c == p ? 1.0 : s.crosstalk * (std::abs(c - p) == 1 ? 1.0 : 0.3);
        // What a surface does to the overlap of two bands differs from what it does to either.
        double between =
            std::sqrt(reflectance[static_cast<std::size_t>(c)] * reflectance[static_cast<std::size_t>(p)]);
        mixing(c, p) = static_cast<float>(share * between);
      }

    double bend = 3.0 * (cloud(pixel.x, pixel.y, s.seed * 100 + 7, 1, 64.0) - 0.5);
    double x = (pixel.x * pitchX - s.margin * s.projector.width) + bend;
    double y = (pixel.y * pitchY - s.margin * s.projector.height) - bend;
    double across = std::clamp(static_cast<double>(pixel.x) / s.camera.width, 0.0, 1.0);
    double sigma = s.sharpest + (s.softest - s.sharpest) * across;

    auto addBlurred = [&](double left, double width, double blur, double strength) {
      int reach = static_cast<int>(std::ceil(3.5 * blur)) + 1;
      int x0 = static_cast<int>(std::floor(left)) - reach, y0 = static_cast<int>(std::floor(y)) - reach;
      int countX = static_cast<int>(std::ceil(width)) + 2 * reach + 1;
      int countY = static_cast<int>(std::ceil(pitchY)) + 2 * reach + 1;
      auto sx = footprint(left, left + width, blur, x0, countX),
           sy = footprint(y, y + pitchY, blur, y0, countY);
      double kept = 0.0;
      for (int j = 0; j < countY; ++j) {
        for (int i = 0; i < countX; ++i) {
          double share = sx[static_cast<std::size_t>(i)] * sy[static_cast<std::size_t>(j)];
          Pixel hit{x0 + i, y0 + j};
          if (share < 2e-4 || hit.x < 0 || hit.y < 0 || hit.x >= s.projector.width ||
              hit.y >= s.projector.height)
            continue;
          add(row, indexOf(s.projector, hit), (static_cast<float>(strength * share) * mixing).eval());
          kept += share;
        }
      }
      return kept;
    };
    double lit = addBlurred(x, pitchX, sigma, 1.0 - s.farField);
    scene.usable[row] = lit > 0.3;
    if (s.interreflection > 0.0 && across > 0.6)
      addBlurred(s.projector.width * 1.2 - x, pitchX, 2.5, s.interreflection);

    // Far field: a smooth distribution over the nodes three levels below the top.
    int level = std::max(0, layout.levels(0) - 3);
    Size grid = layout.gridSize(0, level);
    for (std::size_t node = 0; node < grid.count(); ++node) {
      Pixel place = pixelAt(grid, node);
      double share = (1.0 + cloud(place.x, place.y, s.seed * 100 + 9, 2, 2.0)) /
                     (1.5 * static_cast<double>(grid.count()));
      if (s.farField > 0.0)
        add(row, layout.index({0, level, place.x, place.y}),
            (static_cast<float>(s.farField * share) * mixing).eval());
    }
  }

  transport::BlockSparseBuilder builder(layout.count(), fullScale);
  for (const Leaf& leaf : leaves) builder.add(leaf.row, leaf.node, leaf.block);
  scene.transport = transport::TransportMatrix(s.camera, s.projector, builder.build());
  CameraStack flood = scene.transport.floodlight();
  double mean = 0.0;
  for (float value : flood) mean += value / static_cast<double>(flood.size());
  scene.black.assign(flood.size(), static_cast<float>(s.black * mean));
  return scene;
}

/// T as a measurement would give it: every leaf wrong by its own relative error, and by a share of the row's
/// brightest leaf; rescaled to the true flood image, which is measured well.
inline transport::TransportMatrix measured(const transport::TransportMatrix& truth, double relative,
                                           double absolute, std::uint64_t seed) {
  const transport::BlockSparse& leaves = truth.ownLeaves();
  std::vector<float> fullScale(leaves.rows());
  for (std::size_t row = 0; row < leaves.rows(); ++row) fullScale[row] = 1.5f * 32767.0f * leaves.scale(row);
  transport::BlockSparseBuilder builder(leaves.columns(), fullScale);
  for (std::size_t row = 0; row < leaves.rows(); ++row) {
    Random random({seed, row});
    for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
      transport::ColourBlock block = leaves.block(row, entry);
      for (int i = 0; i < 9; ++i)
        block.data()[i] += static_cast<float>(relative * random.normal()) * block.data()[i] +
                           static_cast<float>(absolute * random.normal()) * fullScale[row] / 1.5f;
      builder.add(row, leaves.column(entry), block);
    }
  }
  transport::TransportMatrix noisy(truth.cameras(), truth.projectors(), builder.build());
  return transport::rescaledToFloodlight(noisy, truth.floodlight());
}

enum class Content { natural, text, saturated };

inline image::Image makeContent(Content kind, Size size, std::uint64_t seed) {
  image::Image image(size, 3);
  Random random({seed, 77});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      double light = cloud(x, y, seed * 10, 7, size.width / 2.0);
      for (int c = 0; c < 3; ++c) {
        double chroma = cloud(x, y, seed * 10 + 1 + static_cast<std::uint64_t>(c), 4, size.width / 2.0) - 0.5;
        image.at(x, y, c) = static_cast<float>(std::pow(std::clamp(light + 0.4 * chroma, 0.0, 1.0), 2.2));
      }
    }
  }
  if (kind == Content::natural) return image;
  if (kind == Content::text) image = image::Image(size, 3, 0.9f);
  for (int i = 0; i < 150; ++i) {
    int w = 1 + static_cast<int>(random.below(kind == Content::text ? 6 : 16));
    int h = 1 + static_cast<int>(random.below(kind == Content::text ? 6 : 16));
    int x0 = static_cast<int>(random.below(static_cast<std::uint64_t>(size.width)));
    int y0 = static_cast<int>(random.below(static_cast<std::uint64_t>(size.height)));
    float colour[3] = {0.05f, 0.05f, 0.05f};
    if (kind == Content::saturated) colour[random.below(3)] = 0.8f;
    for (int y = y0; y < std::min(y0 + h, size.height); ++y)
      for (int x = x0; x < std::min(x0 + w, size.width); ++x)
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = colour[c];
  }
  return image;
}

/// `count` values between 0 and 1.
template <typename Values = Stack>
Values randomStack(std::size_t count, std::uint64_t seed) {
  Random random({seed});
  Values stack(count);
  for (float& value : stack) value = random.uniformFloat();
  return stack;
}

/// |a - truth| / |truth|
inline double relativeError(const Stack& a, const Stack& truth) {
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += std::pow(a[i] - truth[i], 2);
    norm += std::pow(truth[i], 2);
  }
  return std::sqrt(error / norm);
}

}  // namespace relucent::synthetic
