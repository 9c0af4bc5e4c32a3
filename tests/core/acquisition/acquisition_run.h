// SPDX-License-Identifier: MIT
#pragma once

#include <QtTest>
#include <cmath>
#include <map>

#include "relucent/acquisition/acquisition.h"
#include "relucent/base/random.h"
#include "relucent/transport/difference.h"
#include "support/scripted_rig.h"

/// A scripted venue and one run of acquisition in it, for the tests of this folder.
namespace relucent::test {

inline constexpr double pi = 3.14159265358979;

struct Venue {
  SyntheticSettings synthetic;
  double noise = 0.0;  // standard deviation of the read noise; photon noise goes with it
  double drift = 0.0;
  double black = 1e-3;
  std::function<void(const rig::CaptureRequest&)> beforeCapture;
  std::vector<double> exposures{0.2, 0.05};
  acquisition::AcquisitionSettings settings;
};

/// One run of acquisition in a scripted venue.
class Run {
 public:
  explicit Run(const Venue& venue) : truth(syntheticTransport(exposedWell(venue.synthetic))) {
    ScriptedCamera camera;
    camera.bits = venue.noise > 0.0 ? 14 : 0;
    camera.readNoise = venue.noise;
    camera.gain = venue.noise / 20.0;
    camera.pedestal = 0.05;
    ScriptedSettings scripted;
    scripted.cameras = {camera};
    scripted.drift = venue.drift;
    scripted.beforeCapture = venue.beforeCapture;
    ScriptedVenue devices(truth, syntheticBlack(truth, venue.black), scripted);
    rig_ = devices.rig();
    settings_ = venue.settings;
    linearization_.exposures = venue.exposures;
    linearization_.cameras.resize(rig_.cameras.size());
    for (hdr::CameraModel& model : linearization_.cameras) {
      model.readNoise = std::max(1e-7, venue.noise);
      model.gain = camera.gain;
    }
  }
  transport::Acquisition operator()(rig::ShotLog& log, Progress progress = {},
                                    sentinels::AcquisitionObserver* observer = nullptr) {
    rig::ShotTaker shots(rig_, log, "acquisition");
    return acquisition::acquire({shots, linearization_, settings_, {}, observer}, progress);
  }
  transport::Acquisition operator()() {
    rig::NoShotLog log;
    return (*this)(log);
  }

  transport::TransportMatrix truth;

 private:
  /// Two projectors and the far field on top of white: still below saturation at 0.05 s.
  static SyntheticSettings exposedWell(SyntheticSettings synthetic) {
    synthetic.brightness =
        16.0 / (1.0 + synthetic.interreflection) / static_cast<double>(synthetic.projectors.size());
    return synthetic;
  }

  rig::Rig rig_;
  linearization::Linearization linearization_;
  acquisition::AcquisitionSettings settings_;
};

class MemoryLog : public rig::ShotLog {
 public:
  std::optional<rig::Shot> find(const rig::ShotId& id, const std::string& fingerprint) override {
    auto found = shots.find(id.number);
    if (found == shots.end() || found->second.fingerprint != fingerprint) return std::nullopt;
    return found->second;
  }
  void keep(const rig::Shot& shot) override { shots[shot.id.number] = shot; }
  void forget(const rig::ShotId& id, const std::string&) override { shots.erase(id.number); }
  std::map<int, rig::Shot> shots;
};

inline double relativeError(const Stack& a, const Stack& b) {
  double apart = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    apart += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
    whole += std::pow(static_cast<double>(b[i]), 2);
  }
  return std::sqrt(apart / whole);
}

inline double energyOf(const transport::TransportMatrix& transport) {
  double sum = 0.0;
  for (float value : transport.floodlight()) sum += static_cast<double>(value);
  return sum;
}

/// A smooth picture with edges.
inline ProjectorStack naturalPattern(const Rasters& projectors) {
  ProjectorStack pattern(3 * projectors.count());
  for (std::size_t device = 0; device < projectors.devices(); ++device) {
    Size size = projectors.size(device);
    for (std::size_t i = 0; i < size.count(); ++i) {
      Pixel at = pixelAt(size, i);
      double u = 2.0 * pi * at.x / size.width, v = 2.0 * pi * at.y / size.height;
      for (std::size_t c = 0; c < 3; ++c) {
        double value =
            0.5 + 0.3 * std::sin(u + static_cast<double>(c)) * std::cos(2.0 * v) + (u > v ? 0.2 : 0.0);
        pattern[3 * (projectors.offset(device) + i) + c] = static_cast<float>(value);
      }
    }
  }
  return pattern;
}

inline ProjectorStack randomPattern(const Rasters& projectors) {
  Random random{99};
  ProjectorStack pattern(3 * projectors.count());
  for (float& value : pattern) value = random.uniformFloat();
  return pattern;
}

inline std::size_t flaggedIn(const transport::Acquisition& acquisition) {
  return static_cast<std::size_t>(std::count(acquisition.flagged.begin(), acquisition.flagged.end(), 1));
}

inline int finestLevel(const transport::TransportMatrix& transport) {
  int finest = transport.layout().levels();
  for (std::size_t row = 0; row < transport.cameras().count(); ++row) {
    const transport::LeafRow leaves = transport.row(row);
    for (std::uint32_t column : leaves.columns())
      finest = std::min(finest, transport.layout().node(column).level);
  }
  return finest;
}

inline Venue smallVenue() {
  Venue venue;
  venue.synthetic.projectors = {{29, 19}};
  venue.synthetic.cameras = {{20, 15}};
  venue.synthetic.interreflection = 0.2;
  return venue;
}

inline QString shown(const transport::Acquisition& a, const transport::TransportMatrix& truth) {
  return QString(
             "frobenius %1, energy %2, unresolved %3, verification %4, %5 patterns, %6 exposures, %7 flagged")
      .arg(transport::difference(a.transport, truth).frobenius)
      .arg(energyOf(a.transport) / energyOf(truth) - 1.0)
      .arg(a.unresolvedEnergy)
      .arg(a.verificationError)
      .arg(a.patterns)
      .arg(a.exposures)
      .arg(flaggedIn(a));
}

}  // namespace relucent::test
