// SPDX-License-Identifier: MIT
// Which camera is offered first, and why.
#include "wizard/devices/camera_ranking.h"

#include <QtTest>
#include <algorithm>
#include <random>

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::gui;

namespace {

ListedCamera cameraOf(const char* name, int bits, double range, Size size, bool isUsable = true) {
  ListedCamera camera;
  camera.address = name;
  camera.usable = isUsable;
  camera.traits.format.bits = bits;
  camera.traits.exposures = {1e-4, 1e-4 * range};
  camera.traits.size = size;
  return camera;
}

std::vector<ListedCamera> inOrder() {
  return {cameraOf("deep", 12, 1000.0, {640, 480}), cameraOf("wide", 8, 40000.0, {640, 480}),
          cameraOf("large", 8, 300.0, {1280, 720}), cameraOf("small", 8, 300.0, {640, 480}),
          cameraOf("held", 0, 0.0, {}, false)};
}

}  // namespace

class TestCameraRanking : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the order does not depend on that in which cameras are found.
  void theOrderIsOne() {
    std::mt19937 random(7);
    for (int i = 0; i < 50; ++i) {
      std::vector<ListedCamera> cameras = inOrder();
      std::ranges::shuffle(cameras, random);
      rank(cameras);
      for (std::size_t place = 0; place < cameras.size(); ++place)
        QCOMPARE(cameras[place].address, inOrder()[place].address);
    }
  }

  void reasonsAreTold() {
    const std::vector<ListedCamera> ranked = inOrder();
    QCOMPARE(meritOf(ranked, 0), CameraMerit::bits);
    QCOMPARE(meritOf(ranked, 1), CameraMerit::bits);
    QCOMPARE(meritOf({ranked[1], ranked[2]}, 0), CameraMerit::exposures);
    QCOMPARE(meritOf({ranked[2], ranked[3]}, 1), CameraMerit::pixels);
    QCOMPARE(meritOf({ranked[0], ranked[4]}, 0), CameraMerit::alone);
    QCOMPARE(meritOf({ranked[3], ranked[3]}, 0), CameraMerit::none);
  }
};

QTEST_APPLESS_MAIN(TestCameraRanking)
#include "test_camera_ranking.moc"
