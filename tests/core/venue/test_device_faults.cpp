// SPDX-License-Identifier: MIT
#include <QTest>
#include <cmath>

#include "relucent/venue/device_faults.h"

using namespace relucent;
using namespace relucent::image;
using namespace relucent::venue;

namespace {

constexpr Size size{24, 16};

/// A smooth picture, no two pixels alike.
Stack view() {
  Stack view(3 * size.count());
  for (std::size_t i = 0; i < view.size(); ++i) {
    Pixel at = pixelAt(size, i / 3);
    view[i] = static_cast<float>(10.0 + 3.0 * at.x + 0.5 * at.y + static_cast<double>(i % 3));
  }
  return view;
}

CameraStack seen(const DeviceFault& fault, int exposure = 0) {
  return CameraStack(withFaults(view(), Stack(3 * size.count(), 0.5f), size, 40.0, exposure, {fault}));
}

DeviceFault fault(FaultKind kind, double amount = 0.0) {
  DeviceFault fault;
  fault.kind = kind;
  fault.stage = "acquisition";
  fault.first = 3;
  fault.last = 5;
  fault.amount = amount;
  return fault;
}

}  // namespace

class TestDeviceFaults : public QObject {
  Q_OBJECT

 private slots:
  void actDuringTheirShotsOnly_data() {
    QTest::addColumn<QString>("stage");
    QTest::addColumn<int>("shot");
    QTest::addColumn<bool>("acts");
    QTest::newRow("before") << "acquisition" << 2 << false;
    QTest::newRow("first") << "acquisition" << 3 << true;
    QTest::newRow("last") << "acquisition" << 5 << true;
    QTest::newRow("after") << "acquisition" << 6 << false;
    QTest::newRow("another stage") << "linearization" << 4 << false;
  }
  void actDuringTheirShotsOnly() {
    QFETCH(QString, stage);
    QFETCH(int, shot);
    QFETCH(bool, acts);
    FaultSchedule schedule{{fault(FaultKind::coveredLens)}};
    QCOMPARE(schedule.during({stage.toStdString(), shot}).size(), std::size_t{acts ? 1u : 0u});
  }

  void lightOfEachFault() {
    CameraStack sound = seen(fault(FaultKind::mirroredScreen));
    for (std::size_t i = 0; i < sound.size(); ++i) {
      QCOMPARE(sound[i], view()[i] + 0.5f);
      QCOMPARE(seen(fault(FaultKind::coveredLens))[i], 0.0f);
      QCOMPARE(seen(fault(FaultKind::asleepProjector))[i], 0.5f);
      QCOMPARE(seen(fault(FaultKind::ambient, 0.1))[i], sound[i] + 4.0f);
      QCOMPARE(seen(fault(FaultKind::flicker, 0.1), 0)[i], sound[i]);
      QVERIFY(std::abs(seen(fault(FaultKind::flicker, 0.1), 1)[i] - (1.1f * view()[i] + 0.5f)) < 1e-4f);
    }
  }

  void flashAndHandKeepToTheirPart() {
    DeviceFault hand = fault(FaultKind::hand), flash = fault(FaultKind::flash, 7.0);
    for (DeviceFault* part : {&hand, &flash}) part->x0 = 0.5, part->y1 = 0.25;
    CameraStack sound = seen(fault(FaultKind::mirroredScreen)), dark = seen(hand), bright = seen(flash);
    for (std::size_t i = 0; i < sound.size(); ++i) {
      Pixel at = pixelAt(size, i / 3);
      bool inside = at.x >= 12 && at.y < 4;
      QCOMPARE(dark[i], inside ? 0.0f : sound[i]);
      QCOMPARE(bright[i], inside ? sound[i] + 7.0f : sound[i]);
    }
  }

  /// A linear picture is interpolated exactly; the border repeats its last pixel.
  void aShiftedCameraSeesTheSameFurtherOn() {
    CameraStack sound = seen(fault(FaultKind::mirroredScreen)),
                shifted = seen(fault(FaultKind::shiftedCamera, 1.5));
    for (int y = 2; y < size.height; ++y)
      for (int x = 2; x < size.width; ++x)
        QVERIFY(std::abs(shifted[3 * indexOf(size, {x, y})] -
                         (sound[3 * indexOf(size, {x, y})] - 1.5f * 3.0f - 1.5f * 0.5f)) < 1e-3f);
  }

  void aMirroredScreenMirrors() {
    Image picture(size, 3);
    picture.at(2, 3, 1) = 1.0f;
    Image mirrored = withFaults(picture, {fault(FaultKind::mirroredScreen)});
    QCOMPARE(mirrored.at(21, 3, 1), 1.0f);
    QCOMPARE(mirrored.at(2, 3, 1), 0.0f);
    QVERIFY(withFaults(mirrored, {fault(FaultKind::mirroredScreen)}) == picture);
    QVERIFY(withFaults(picture, {fault(FaultKind::ambient)}) == picture);
  }
};

QTEST_APPLESS_MAIN(TestDeviceFaults)
#include "test_device_faults.moc"
