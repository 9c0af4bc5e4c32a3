// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "relucent/base/raster.h"
#include "relucent/image/image.h"

namespace relucent::test {

struct FakeGigeSettings {
  std::string serial = "RL01";
  Size sensor;                     // all of it; empty: the library's, which is larger than anybody needs
  double lostPackets = 0.0;        // share of the packets that never arrive
  std::uint32_t longestKept = 0;   // microseconds; longer exposures are cut to this without a word; 0: none
  double framesPerSecond = 400.0;  // how often it looks whether a photograph is wanted
  std::string address = "127.0.0.1";
};

/// A GigE Vision camera on the loopback network: Aravis' own, with real sockets and registers. What it "sees"
/// comes from a function. One at a time at an address: the port is fixed by the standard.
class FakeGigeCamera {
 public:
  struct View {
    std::uint8_t* bytes = nullptr;  // to be filled, unpacked
    Size sensor;                    // the part of it that is delivered, ...
    Pixel begin;                    // ... and where that begins
    std::string format;             // "BayerRG12"
    double seconds = 0.0;
    std::uint32_t gain = 0;
  };
  /// Called from the camera's own thread.
  using Look = std::function<void(const View&)>;

  FakeGigeCamera(FakeGigeSettings settings, Look look);
  ~FakeGigeCamera();

  /// False if the port was taken or there is no loopback network.
  bool isRunning() const;
  void unplug();
  /// Comes back as if it had been switched off and on.
  void plug();
  void losePackets(double share);
  /// Changes a register behind the back of whoever controls the camera.
  void setSensorSize(Size size);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The photograph (12 bits, three channels) as a sensor under a colour filter sees it: each pixel a 2x2 cell
/// of red, green, green, blue; two bytes a sample, little endian.
void fillBayerRG12(const image::Image& photograph, std::uint8_t* bytes);

}  // namespace relucent::test
