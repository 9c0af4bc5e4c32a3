// SPDX-License-Identifier: MIT
// Stands in for fake_gige_camera.cpp where Aravis is not installed.
#include "support/fake_gige_camera.h"

namespace relucent::test {

struct FakeGigeCamera::Parts {};

FakeGigeCamera::FakeGigeCamera(FakeGigeSettings, Look) {}
FakeGigeCamera::~FakeGigeCamera() = default;
bool FakeGigeCamera::isRunning() const {
  return false;
}
void FakeGigeCamera::unplug() {}
void FakeGigeCamera::plug() {}
void FakeGigeCamera::losePackets(double) {}
void FakeGigeCamera::setSensorSize(Size) {}
void fillBayerRG12(const image::Image&, std::uint8_t*) {}

}  // namespace relucent::test
