// SPDX-License-Identifier: MIT
#include "output/still_solver.h"

#include <QtTest>
#include <atomic>
#include <thread>

#include "core/engine/engine_scenes.h"
#include "relucent/image/colour.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::pipeline;

namespace {

MeasuredCalibration calibrationOf(std::uint64_t seed) {
  synthetic::SceneSettings settings;
  settings.seed = seed;
  synthetic::EngineScene scene = synthetic::engineScene(synthetic::venueOf(synthetic::makeScene(settings)));
  MeasuredCalibration calibration;
  calibration.venue = std::move(scene.venue);
  calibration.inverse = std::move(scene.inverse);
  calibration.linearization.projectors = scene.responses;
  return calibration;
}

/// A ramp of colours that every scene can show in part.
ContentPicture ramp(std::uint64_t number, int turn = 0) {
  QImage image(32, 24, QImage::Format_RGBX8888);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixelColor(x, y, QColor::fromHsv((11 * x + turn) % 360, 60 + 5 * y, 40 + 6 * x));
  return {image, number};
}

float largestDifference(const Stack& a, const Stack& b) {
  float largest = a.size() == b.size() ? 0.0f : 1.0f;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

class TestStillSolver : public QObject {
  Q_OBJECT

 private slots:
  void itIsThePipelinesSolution_data() {
    QTest::addColumn<int>("method");
    QTest::addColumn<quint64>("seed");
    for (Method method : {Method::mix, Method::clusters, Method::windows, Method::refined, Method::optimum})
      for (quint64 seed : {1u, 7u})
        QTest::addRow("%s, %llu", nameOf(method).data(), static_cast<unsigned long long>(seed))
            << static_cast<int>(method) << seed;
  }
  void itIsThePipelinesSolution() {
    QFETCH(int, method);
    QFETCH(quint64, seed);
    MeasuredCalibration calibration = calibrationOf(seed);
    TargetSettings place;
    StillSolver solver(calibration, place, CompensatorSettings().clustering, static_cast<Method>(method));
    ContentPicture content = ramp(1);
    const Compensation* solved = solver.solve(content);
    QVERIFY(solved != nullptr);

    Image encoded(Size{content.image.width(), content.image.height()}, 3);
    for (int y = 0; y < encoded.height(); ++y)
      for (int x = 0; x < encoded.width(); ++x)
        for (int c = 0; c < 3; ++c)
          encoded.at(x, y, c) = static_cast<float>(content.image.constScanLine(y)[4 * x + c]) / 255.0f;
    Progress quiet;
    Target target = fitTarget(srgbDecoded(encoded), calibration.venue, place);
    Compensator compensator(calibration.venue, calibration.inverse);
    Compensation wanted = compensator.solve(static_cast<Method>(method), target, quiet);
    QCOMPARE(solved->projector, wanted.projector);
    QCOMPARE(solved->clipped, wanted.clipped);
  }

  void aPictureIsSolvedOnce() {
    MeasuredCalibration calibration = calibrationOf(3);
    StillSolver solver(calibration, {}, CompensatorSettings().clustering, Method::windows);
    Stack first = solver.solve(ramp(1))->projector;
    QCOMPARE(solver.solve(ramp(1, 90))->projector, first);
    QVERIFY(largestDifference(solver.solve(ramp(2, 90))->projector, first) > 0.03f);
    QCOMPARE(solver.solve(ramp(3))->projector, first);
  }

  void linearFloatsAreTheSamePicture() {
    MeasuredCalibration calibration = calibrationOf(5);
    StillSolver solver(calibration, {}, CompensatorSettings().clustering, Method::mix);
    ContentPicture bytes = ramp(1), floats{QImage(bytes.image.size(), QImage::Format_RGBX32FPx4), 2};
    for (int y = 0; y < bytes.image.height(); ++y)
      for (int x = 0; x < bytes.image.width(); ++x) {
        Image pixel(Size{1, 1}, 3);
        for (int c = 0; c < 3; ++c)
          pixel.at(0, 0, c) = static_cast<float>(bytes.image.constScanLine(y)[4 * x + c]) / 255.0f;
        Image linear = srgbDecoded(pixel);
        auto* line = reinterpret_cast<float*>(floats.image.scanLine(y));
        for (int c = 0; c < 3; ++c) line[4 * x + c] = linear.at(0, 0, c);
        line[4 * x + 3] = 1.0f;
      }
    Stack one = solver.solve(bytes)->projector;
    QVERIFY(largestDifference(solver.solve(floats)->projector, one) < 1e-5f);  // roundings of floats
  }

  void anInterruptedPictureIsGivenUpAndTheNextIsSolved() {
    MeasuredCalibration calibration = calibrationOf(9);
    StillSolver solver(calibration, {}, CompensatorSettings().clustering, Method::optimum);
    solver.interrupt();  // of nothing: nothing
    QVERIFY(solver.solve(ramp(1)) != nullptr);
    bool givenUp = false;
    for (std::uint64_t number = 2; number < 50 && !givenUp; ++number) {
      std::atomic<bool> done = false;
      std::thread other([&] {
        while (!done) solver.interrupt();
      });
      givenUp = solver.solve(ramp(number)) == nullptr;
      done = true;
      other.join();
    }
    QVERIFY(givenUp);
    QVERIFY(solver.solve(ramp(100)) != nullptr);
  }

  void whatIsOutdatedIsGivenUp_data() {
    QTest::addColumn<int>("method");
    QTest::newRow("refined") << static_cast<int>(Method::refined);
    QTest::newRow("optimum") << static_cast<int>(Method::optimum);
  }
  void whatIsOutdatedIsGivenUp() {
    QFETCH(int, method);
    MeasuredCalibration calibration = calibrationOf(11);
    StillSolver solver(calibration, {}, CompensatorSettings().clustering, static_cast<Method>(method));
    int asked = 0;
    QVERIFY(solver.solve(ramp(1), [&] { return ++asked > 3; }) == nullptr);
    QCOMPARE(asked, 4);
    QVERIFY(solver.solve(ramp(1), [] { return false; }) != nullptr);
  }
};

QTEST_GUILESS_MAIN(TestStillSolver)
#include "test_still_solver.moc"
