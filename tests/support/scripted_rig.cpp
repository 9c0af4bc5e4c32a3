// SPDX-License-Identifier: MIT
#include "support/scripted_rig.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>

#include "relucent/base/error.h"
#include "relucent/base/fingerprint.h"
#include "relucent/base/parallel.h"
#include "relucent/base/random.h"

namespace relucent::test {

Curve identityCurve() {
  return [](double x) { return x; };
}

Curve gammaCurve(double gamma) {
  return [gamma](double x) { return std::pow(x, gamma); };
}

Curve sCurve(double strength) {
  return [strength](double x) {
    double smooth = x * x * (3.0 - 2.0 * x);
    return (1.0 - strength) * 0.5 * (x + x * x) + strength * smooth;
  };
}

struct ScriptedVenue::State {
  transport::TransportMatrix transport;
  CameraStack black;
  ScriptedSettings settings;
  std::vector<image::Image> shown;  // per projector
  Stack lamp;                       // radiance of what is shown, at full lamp power; empty: to be computed
  std::vector<double> lampPower;    // of the lamps that `lamp` is of
  std::atomic<int> captures{0};

  const ScriptedProjector& projector(std::size_t index) const { return pick(settings.projectors, index); }
  const ScriptedCamera& camera(std::size_t index) const { return pick(settings.cameras, index); }

  ProjectorStack linearDrive(const std::vector<image::Image>& patterns, bool withWhiteSegment) const {
    const Rasters& rasters = transport.projectors();
    require(patterns.size() == rasters.devices(), "{} patterns for {} projectors", patterns.size(),
            rasters.devices());
    ProjectorStack linear(image::stackFromImages(patterns, rasters));
    for (std::size_t index = 0; index < rasters.devices(); ++index) {
      const ScriptedProjector& model = projector(index);
      std::array<std::vector<float>, 3> table;
      std::size_t codes = std::size_t{1} << model.bits;
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t code = 0; code < codes; ++code)
          table[c].push_back(static_cast<float>(
              model.curves[c](static_cast<double>(code) / static_cast<double>(codes - 1))));
      for (std::size_t i = 0; i < rasters.size(index).count(); ++i) {
        float* value = &linear[3 * (rasters.offset(index) + i)];
        for (std::size_t c = 0; c < 3; ++c) {
          float drive = std::clamp(value[c], 0.0f, 1.0f) * static_cast<float>(codes - 1);
          value[c] = table[c][static_cast<std::size_t>(std::lround(drive))];
        }
        if (!withWhiteSegment) continue;
        float white = static_cast<float>(model.whiteSegment) * std::min({value[0], value[1], value[2]});
        for (std::size_t c = 0; c < 3; ++c) value[c] += white;
      }
    }
    return linear;
  }

  /// `power` of every projector's own lamp.
  CameraStack lampRadiance(const std::vector<image::Image>& patterns,
                           const std::vector<double>& power) const {
    ProjectorStack drive = linearDrive(patterns, true);
    const Rasters& rasters = transport.projectors();
    for (std::size_t p = 0; p < rasters.devices(); ++p)
      for (std::size_t i = 0; i < 3 * rasters.size(p).count(); ++i)
        drive[3 * rasters.offset(p) + i] *= static_cast<float>(power[p]);
    CameraStack light = transport.apply(drive);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += black.empty() ? 0.0f : black[i];
    return light;
  }

  std::vector<double> brightness() const {
    std::vector<double> power;
    for (std::size_t p = 0; p < transport.projectors().devices(); ++p)
      power.push_back(projector(p).brightness);
    return power;
  }
  /// Drift and flicker included, if a projector has such of its own.
  std::vector<double> powerIn(int shot, std::uint64_t shotKey) const {
    std::vector<double> power = brightness();
    for (std::size_t p = 0; p < power.size(); ++p)
      power[p] *= 1.0 + projector(p).drift * shot / 1000.0 +
                  projector(p).flicker * Random{settings.seed, 4, shotKey, p}.normal();
    return power;
  }

  template <typename Model>
  static const Model& pick(const std::vector<Model>& models, std::size_t index) {
    static const Model standard;
    return models.empty() ? standard : models[std::min(index, models.size() - 1)];
  }
};

namespace {

using State = ScriptedVenue::State;

class ProjectorOfScript : public rig::Projector {
 public:
  ProjectorOfScript(std::shared_ptr<State> state, std::size_t index)
      : state_(std::move(state)), index_(index) {}

  std::string name() const override { return fmt::format("scripted projector {}", index_ + 1); }
  Size size() const override { return state_->transport.projectors().size(index_); }
  int bits() const override { return state_->projector(index_).bits; }
  void show(const image::Image& encodedDrive) override {
    require(encodedDrive.size() == size() && encodedDrive.channels() == 3, "a pattern of {}x{} on {}x{}",
            encodedDrive.width(), encodedDrive.height(), size().width, size().height);
    state_->shown[index_] = encodedDrive;
    state_->lamp.clear();
  }

 private:
  std::shared_ptr<State> state_;
  std::size_t index_;
};

class CameraOfScript : public rig::Camera {
 public:
  CameraOfScript(std::shared_ptr<State> state, std::size_t index) : state_(std::move(state)), index_(index) {}

  std::string name() const override { return fmt::format("scripted camera {}", index_ + 1); }
  Size size() const override { return state_->transport.cameras().size(index_); }
  rig::ExposureRange exposures() const override { return model().exposures; }

  rig::RawFrame capture(const rig::CaptureRequest& request) override {
    if (state_->settings.beforeCapture) state_->settings.beforeCapture(request);
    ++state_->captures;

    const ScriptedSettings& settings = state_->settings;
    std::uint64_t shotKey =
        Fingerprint().add(request.shot.stage).add(request.shot.number).add(request.exposure).low();
    double lamp = 1.0 + settings.drift * request.shot.number / 1000.0 +
                  settings.flicker * Random{settings.seed, 1, shotKey}.normal();
    std::vector<double> power = state_->powerIn(request.shot.number, shotKey);
    if (state_->lamp.empty() || state_->lampPower != power) {
      state_->lamp = state_->lampRadiance(state_->shown, power);
      state_->lampPower = std::move(power);
    }
    double reported = std::clamp(request.seconds, model().exposures.shortest, model().exposures.longest);
    double seconds = reported * trueTimeFactor(reported);

    rig::RawFrame frame{image::Image(size(), 3), model().bits, reported};
    std::size_t offset = state_->transport.cameras().offset(index_);
    parallelFor(0, size().count(), 256, [&](std::size_t i) {
      Random random{settings.seed, 2, shotKey, index_, i};
      for (std::size_t c = 0; c < 3; ++c) {
        std::size_t at = 3 * (offset + i) + c;
        double ambient = settings.ambient.empty() ? 0.0 : settings.ambient[at];
        double linear = seconds * (lamp * state_->lamp[at] + ambient);
        double deviation =
            std::sqrt(model().readNoise * model().readNoise + model().gain * std::max(0.0, linear));
        frame.signal.data()[3 * i + c] = signalOf(linear + deviation * random.normal());
      }
    });
    return frame;
  }

 private:
  const ScriptedCamera& model() const { return state_->camera(index_); }

  double trueTimeFactor(double seconds) const {
    Random random{state_->settings.seed, 3, index_, std::bit_cast<std::uint64_t>(seconds)};
    return 1.0 + model().timeError * (2.0 * random.uniform() - 1.0);
  }

  float signalOf(double linear) const {
    linear = std::clamp(linear, -model().pedestal, 1.0);
    double signal = model().response && linear > 0.0 ? model().response(linear) : linear;
    if (model().bits == 0) return static_cast<float>(signal);
    double codes = std::ldexp(1.0, model().bits) - 1.0;
    return static_cast<float>(std::round(signal * codes) / codes);
  }

  std::shared_ptr<State> state_;
  std::size_t index_;
};

}  // namespace

ScriptedVenue::ScriptedVenue(transport::TransportMatrix transport, CameraStack black,
                             ScriptedSettings settings)
    : state_(std::make_shared<State>()) {
  require(black.empty() || black.size() == 3 * transport.cameras().count(), "{} black values for {} pixels",
          black.size(), transport.cameras().count());
  for (const Size& size : transport.projectors().sizes()) state_->shown.emplace_back(size, 3);
  state_->transport = std::move(transport);
  state_->black = std::move(black);
  state_->settings = std::move(settings);
}

rig::Rig ScriptedVenue::rig() const {
  rig::Rig rig;
  for (std::size_t i = 0; i < state_->transport.projectors().devices(); ++i)
    rig.projectors.push_back(std::make_unique<ProjectorOfScript>(state_, i));
  for (std::size_t i = 0; i < state_->transport.cameras().devices(); ++i)
    rig.cameras.push_back(std::make_unique<CameraOfScript>(state_, i));
  return rig;
}

const transport::TransportMatrix& ScriptedVenue::transport() const {
  return state_->transport;
}

CameraStack ScriptedVenue::black() const {
  CameraStack black(3 * state_->transport.cameras().count(), 0.0f);
  for (std::size_t i = 0; i < black.size(); ++i)
    black[i] = (state_->black.empty() ? 0.0f : state_->black[i]) +
               (state_->settings.ambient.empty() ? 0.0f : state_->settings.ambient[i]);
  return black;
}

ProjectorStack ScriptedVenue::linearDrive(const std::vector<image::Image>& encodedPatterns) const {
  return state_->linearDrive(encodedPatterns, false);
}

CameraStack ScriptedVenue::radiance(const std::vector<image::Image>& encodedPatterns) const {
  CameraStack light = state_->lampRadiance(encodedPatterns, state_->brightness());
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] += state_->settings.ambient.empty() ? 0.0f : state_->settings.ambient[i];
  return light;
}

int ScriptedVenue::captures() const {
  return state_->captures;
}

namespace {

/// A smooth random function on the unit square, between 0 and 1.
class Texture {
 public:
  explicit Texture(Random random) {
    for (Wave& wave : waves_) {
      double angle = 2.0 * std::numbers::pi * random.uniform();
      double frequency = 2.0 * std::numbers::pi * (1.0 + 7.0 * random.uniform());
      wave = {frequency * std::cos(angle), frequency * std::sin(angle),
              2.0 * std::numbers::pi * random.uniform()};
    }
  }
  double operator()(double u, double v) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.u * u + wave.v * v + wave.phase);
    return 0.5 + 0.5 * sum / static_cast<double>(waves_.size());
  }

 private:
  struct Wave {
    double u = 0, v = 0, phase = 0;
  };
  std::array<Wave, 6> waves_;
};

struct Point {
  double x = 0, y = 0;
};

/// Where in a projector (pixels) a camera's point (unit square) looks: turned, shifted, gently warped.
class Correspondence {
 public:
  Correspondence(Size projector, double shareSeen, Random random) : projector_(projector) {
    scale_ = 1.0 / shareSeen;
    angle_ = 0.1 * (random.uniform() - 0.5);
    shift_ = {0.06 * (random.uniform() - 0.5), 0.06 * (random.uniform() - 0.5)};
    phase_ = 2.0 * std::numbers::pi * random.uniform();
  }
  Point operator()(double u, double v) const {
    double x = scale_ * (u - 0.5), y = scale_ * (v - 0.5);
    double warpedX =
        std::cos(angle_) * x - std::sin(angle_) * y + shift_.x + 0.01 * std::sin(7.0 * y + phase_);
    double warpedY =
        std::sin(angle_) * x + std::cos(angle_) * y + shift_.y + 0.01 * std::cos(6.0 * x + phase_);
    return {(warpedX + 0.5) * projector_.width, (warpedY + 0.5) * projector_.height};
  }

 private:
  Size projector_;
  double scale_ = 1, angle_ = 0, phase_ = 0;
  Point shift_;
};

struct Leaf {
  std::size_t node;
  transport::ColourBlock block;
};

class Builder {
 public:
  explicit Builder(const SyntheticSettings& settings)
      : settings_(settings), layout_(Rasters(settings.projectors)), cameras_(settings.cameras) {}

  transport::TransportMatrix build() {
    rows_.resize(cameras_.count());
    for (std::size_t camera = 0; camera < cameras_.devices(); ++camera)
      for (std::size_t projector = 0; projector < layout_.projectors().devices(); ++projector)
        light(camera, projector);

    std::vector<float> fullScale(rows_.size(), 0.0f);
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const Leaf& leaf : rows_[row]) fullScale[row] = std::max(fullScale[row], leaf.block.maxCoeff());
    transport::BlockSparseBuilder builder(layout_.count(), std::move(fullScale));
    for (std::size_t row = 0; row < rows_.size(); ++row)
      for (const Leaf& leaf : rows_[row]) builder.add(row, leaf.node, leaf.block);
    return transport::TransportMatrix(cameras_, layout_.projectors(), builder.build());
  }

 private:
  void light(std::size_t camera, std::size_t projector) {
    Size size = cameras_.size(camera);
    const double parts = settings_.sideBySide ? static_cast<double>(layout_.projectors().devices()) : 1.0,
                 begin = settings_.sideBySide ? static_cast<double>(projector) : 0.0;
    Correspondence place(layout_.projectors().size(projector), settings_.shareSeen,
                         Random{settings_.seed, 1, camera, projector});
    std::array<Texture, 3> reflectance{Texture(Random{settings_.seed, 2, camera, 0}),
                                       Texture(Random{settings_.seed, 2, camera, 1}),
                                       Texture(Random{settings_.seed, 2, camera, 2})};
    parallelFor(0, size.count(), 64, [&](std::size_t index) {
      Pixel pixel = pixelAt(size, index);
      double u = (pixel.x + 0.5) / size.width, v = (pixel.y + 0.5) / size.height;
      transport::ColourBlock mix;
      for (int row = 0; row < 3; ++row) {
        double rho = 0.1 + 0.9 * reflectance[static_cast<std::size_t>(row)](u, v);
        for (int column = 0; column < 3; ++column) {
          // A third each, so that full white gives a white surface `brightness`; green is the strongest.
          double share = row == column ? 1.0 - 2.0 * settings_.crosstalk : settings_.crosstalk;
          double strength = column == 1 ? 1.0 : 0.8;
          mix(row, column) = static_cast<float>(settings_.brightness * rho * share * strength);
        }
      }
      std::vector<Leaf>& leaves = rows_[cameras_.offset(camera) + index];
      const Point at = place(parts * u - begin, v);
      addDirect(leaves, projector, at, mix);
      if (settings_.interreflection > 0.0) addFarField(leaves, projector, at, mix);
    });
  }

  void addDirect(std::vector<Leaf>& leaves, std::size_t projector, Point at,
                 const transport::ColourBlock& mix) const {
    Size size = layout_.projectors().size(projector);
    double reach = 3.0 * settings_.footprint + 0.5;
    double norm = 1.0 / (2.0 * std::numbers::pi * settings_.footprint * settings_.footprint);
    int x0 = std::max(0, static_cast<int>(at.x - reach));
    int x1 = std::min(size.width - 1, static_cast<int>(at.x + reach));
    int y0 = std::max(0, static_cast<int>(at.y - reach));
    int y1 = std::min(size.height - 1, static_cast<int>(at.y + reach));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        double dx = x + 0.5 - at.x, dy = y + 0.5 - at.y;
        double weight =
            norm * std::exp(-0.5 * (dx * dx + dy * dy) / (settings_.footprint * settings_.footprint));
        if (weight < 1e-4 * norm) continue;
        leaves.push_back({layout_.projectors().offset(projector) + indexOf(size, {x, y}),
                          mix * static_cast<float>(weight)});
      }
    }
  }

  void addFarField(std::vector<Leaf>& leaves, std::size_t projector, Point at,
                   const transport::ColourBlock& mix) const {
    int level = std::min(settings_.interreflectionLevel, layout_.levels(projector) - 1);
    require(level > 0, "the far field needs a coarser level than pixels, not {}", level);
    Size grid = layout_.gridSize(projector, level);
    Size size = layout_.projectors().size(projector);
    std::vector<double> weights;
    double sum = 0.0;
    for (std::size_t index = 0; index < grid.count(); ++index) {
      transport::Block block = layout_.block(nodeAt(projector, level, pixelAt(grid, index)));
      double dx = (0.5 * (block.x0 + block.x1) - at.x) / size.width;
      double dy = (0.5 * (block.y0 + block.y1) - at.y) / size.height;
      weights.push_back(block.count() / (0.05 + dx * dx + dy * dy));
      sum += weights.back();
    }
    for (std::size_t index = 0; index < grid.count(); ++index) {
      double share = settings_.interreflection * weights[index] / sum;
      leaves.push_back(
          {layout_.index(nodeAt(projector, level, pixelAt(grid, index))), mix * static_cast<float>(share)});
    }
  }

  static transport::Node nodeAt(std::size_t projector, int level, Pixel place) {
    return {static_cast<int>(projector), level, place.x, place.y};
  }

  const SyntheticSettings& settings_;
  transport::NodeLayout layout_;
  Rasters cameras_;
  std::vector<std::vector<Leaf>> rows_;
};

}  // namespace

transport::TransportMatrix syntheticTransport(const SyntheticSettings& settings) {
  return Builder(settings).build();
}

CameraStack syntheticBlack(const transport::TransportMatrix& transport, double share) {
  CameraStack flood = transport.floodlight();
  double mean = 0.0;
  for (float value : flood) mean += value;
  mean /= static_cast<double>(flood.size());
  for (std::size_t i = 0; i < flood.size(); ++i)
    flood[i] = static_cast<float>(share * (0.8 * mean + 0.2 * flood[i]));
  return flood;
}

}  // namespace relucent::test
