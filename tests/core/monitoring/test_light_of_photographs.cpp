// SPDX-License-Identifier: MIT
// What single photographs of played frames say: when they were taken, of the lamps, the room and the view.
#include <QtTest>

#include "core/monitoring/synthetic_watch.h"
#include "relucent/monitoring/monitor.h"

using namespace relucent;
using namespace relucent::monitoring;

class TestLightOfPhotographs : public QObject {
  Q_OBJECT

  transport::TransportMatrix transport_;
  WatchedVenue venue_;

  std::vector<PlayedFrame> framesTo(int last) const {
    std::vector<PlayedFrame> frames;
    for (int n = 0; n <= last; ++n)
      frames.push_back({0.04 * n, venue_.transport.meansOf(syntheticPicture(3.0 * n))});
    return frames;
  }
  /// The mean over an exposure.
  ProjectorStack seenFrom(double begins, double seconds) const {
    ProjectorStack sum(3 * 2 * syntheticSize.count(), 0.0f);
    constexpr int parts = 400;
    for (int k = 0; k < parts; ++k) {
      const int frame = static_cast<int>((begins + seconds * (k + 0.5) / parts) / 0.04);
      const ProjectorStack one = syntheticPicture(3.0 * frame);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i] / parts;
    }
    return sum;
  }
  Moment stillMoment(const ProjectorStack& picture) const {
    const std::vector<PlayedFrame> frames{{0.0, venue_.transport.meansOf(picture)}};
    const std::vector<double> gains(6, 1.0);
    return momentOf(observed(radianceOf(transport_, venue_, picture)), frames, 0.02, venue_, gains);
  }

 private slots:
  void initTestCase() {
    transport_ = syntheticTransport();
    venue_ = syntheticVenue(transport_);
  }

  void theMomentIsFoundByContent_data() {
    QTest::addColumn<double>("begins");
    QTest::addColumn<double>("seconds");
    QTest::newRow("within one frame") << 0.165 << 0.01;
    QTest::newRow("over two frames") << 0.19 << 0.02;
    QTest::newRow("over three frames") << 0.11 << 0.07;
    QTest::newRow("over the whole first half") << 0.05 << 0.2;
  }
  void theMomentIsFoundByContent() {
    QFETCH(double, begins);
    QFETCH(double, seconds);
    const std::vector<double> gains(6, 1.0);
    const Moment moment = momentOf(observed(radianceOf(transport_, venue_, seenFrom(begins, seconds))),
                                   framesTo(9), seconds, venue_, gains);
    // Within one frame all moments look alike.
    const double frame = std::floor(begins / 0.04) * 0.04;
    const bool alike = begins + seconds <= frame + 0.04;
    const double off = alike ? std::max({0.0, frame - moment.since, moment.since + seconds - frame - 0.04})
                             : std::abs(moment.since - begins);
    QVERIFY2(off < 0.002, qPrintable(QString("found %1").arg(moment.since)));
    QVERIFY(moment.misfit < 0.1);
  }

  void theLampsAreFound_data() {
    QTest::addColumn<QVector<double>>("gains");
    QTest::newRow("as measured") << QVector<double>{1, 1, 1, 1, 1, 1};
    QTest::newRow("one faded") << QVector<double>{1, 1, 1, 0.95, 0.95, 0.95};
    QTest::newRow("blue faded") << QVector<double>{1, 1, 0.9, 1, 1, 0.9};
    QTest::newRow("one dead") << QVector<double>{0, 0, 0, 1, 1, 1};
    QTest::newRow("both dead") << QVector<double>{0, 0, 0, 0, 0, 0};
  }
  void theLampsAreFound() {
    QFETCH(QVector<double>, gains);
    const ProjectorStack picture = syntheticPicture(5.0);
    const LightFit fit =
        fitLight(observed(radianceOf(transport_, venue_, picture, {gains.begin(), gains.end()})),
                 stillMoment(picture), venue_);
    QVERIFY(fit.recognised > 0.99);
    for (int k = 0; k < 6; ++k) {
      const auto i = static_cast<std::size_t>(k);
      QVERIFY2(std::abs(fit.gain[i] - gains[k]) < 0.004,
               qPrintable(QString("gain %1: %2").arg(k).arg(fit.gain[i])));
      QVERIFY2(fit.deviation[i] < 0.02, qPrintable(QString::number(fit.deviation[i])));
    }
  }

  /// Somebody before a tenth of the view, in whose light nothing is as it should be: he takes a fifth of what
  /// one projector lights, and moves no projector by what a lamp must fade, nor a channel by twice that.
  void whoeverStandsInTheViewIsLeftOut_data() {
    QTest::addColumn<float>("brightness");
    QTest::newRow("dark") << 0.05f;
    QTest::newRow("bright") << 3.0f;
  }
  void whoeverStandsInTheViewIsLeftOut() {
    QFETCH(float, brightness);
    const ProjectorStack picture = syntheticPicture(5.0);
    std::vector<float> radiance = radianceOf(transport_, venue_, picture);
    for (std::size_t i = 0; i < syntheticSize.count(); ++i) {
      const Pixel at = pixelAt(syntheticSize, i);
      if (at.x >= 14 && at.x < 18)
        for (std::size_t c = 0; c < 3; ++c) radiance[3 * i + c] = brightness * 5.0f;
    }
    const LightFit fit = fitLight(observed(radiance), stillMoment(picture), venue_);
    const double fade = MonitorSettings().fade;
    for (double gain : fit.total) QVERIFY2(std::abs(gain - 1.0) < fade, qPrintable(QString::number(gain)));
    for (double gain : fit.gain)
      QVERIFY2(std::abs(gain - 1.0) < 2.0 * fade, qPrintable(QString::number(gain)));
    QVERIFY(fit.recognised > 0.75 && fit.recognised < 0.97);
  }

  /// Law: whose light somebody stands in is said of each projector, and all of them together is their mean by
  /// light.
  void whoseLightIsNotAsPredictedIsSaid_data() {
    QTest::addColumn<int>("from");
    QTest::addColumn<QVector<double>>("least");
    QTest::addColumn<QVector<double>>("most");
    // Each projector lights one half with ten of thirteen parts of its light.
    QTest::newRow("nobody") << syntheticSize.width << QVector<double>{0.999, 0.999}
                            << QVector<double>{1.0, 1.0};
    QTest::newRow("in the left one's") << 2 << QVector<double>{0.7, 0.9} << QVector<double>{0.9, 0.97};
    QTest::newRow("in the right one's") << 32 << QVector<double>{0.9, 0.7} << QVector<double>{0.97, 0.9};
  }
  void whoseLightIsNotAsPredictedIsSaid() {
    QFETCH(int, from);
    QFETCH(QVector<double>, least);
    QFETCH(QVector<double>, most);
    const ProjectorStack picture(3 * 2 * syntheticSize.count(), 0.5f);
    std::vector<float> radiance = radianceOf(transport_, venue_, picture);
    for (std::size_t i = 0; i < syntheticSize.count(); ++i)
      if (const int x = pixelAt(syntheticSize, i).x; x >= from && x < from + 4)
        for (std::size_t c = 0; c < 3; ++c) radiance[3 * i + c] *= 0.05f;
    const LightFit fit = fitLight(observed(radiance), stillMoment(picture), venue_);
    QCOMPARE(fit.recognisedOf.size(), std::size_t(2));
    for (std::size_t j = 0; j < 2; ++j)
      QVERIFY2(fit.recognisedOf[j] >= least[static_cast<int>(j)] &&
                   fit.recognisedOf[j] <= most[static_cast<int>(j)],
               qPrintable(QString("%1: %2").arg(j).arg(fit.recognisedOf[j])));
    QVERIFY(fit.recognised >= std::ranges::min(fit.recognisedOf) - 1e-9);
    QVERIFY(fit.recognised <= std::ranges::max(fit.recognisedOf) + 1e-9);
  }

  void roomLightIsNoFadedLamp_data() {
    QTest::addColumn<double>("more");
    QTest::newRow("as measured") << 0.0;
    QTest::newRow("the light goes out") << -1.0;
    QTest::newRow("the cleaners come") << 4.0;
  }
  void roomLightIsNoFadedLamp() {
    QFETCH(double, more);
    const ProjectorStack picture = syntheticPicture(5.0);
    std::vector<float> radiance = radianceOf(transport_, venue_, picture);
    for (std::size_t i = 0; i < radiance.size(); ++i)
      radiance[i] += static_cast<float>(more) * venue_.black[i];
    const LightFit fit = fitLight(observed(radiance), stillMoment(picture), venue_);
    for (double gain : fit.total) QVERIFY2(std::abs(gain - 1.0) < 0.01, qPrintable(QString::number(gain)));
  }

  /// Law: a lamp's light is told against what it was in the first minutes.
  void lampsAreHeldAgainstTheFirstMinutes_data() {
    QTest::addColumn<double>("first");
    QTest::addColumn<double>("later");
    QTest::addColumn<bool>("isTold");
    QTest::newRow("as measured, then faded") << 1.0 << 0.958 << true;
    QTest::newRow("low from the beginning, then as far down") << 0.988 << 0.958 << false;
    QTest::newRow("faded from the beginning") << 0.94 << 0.94 << true;
  }
  void lampsAreHeldAgainstTheFirstMinutes() {
    QFETCH(double, first);
    QFETCH(double, later);
    QFETCH(bool, isTold);
    Monitor monitor(venue_);
    const ProjectorStack picture = syntheticPicture(5.0);
    const std::vector<PlayedFrame> frames{{0.0, venue_.transport.meansOf(picture)}};
    constexpr double begins = 620.0, interval = 5.0;  // seconds; the reference is known after 600
    for (double seconds = 0.0; seconds < begins + 100.0; seconds += interval) {
      const double gain = seconds < begins ? first : later;
      const std::vector<float> radiance =
          radianceOf(transport_, venue_, picture, std::vector<double>(6, gain));
      rig::RawFrame photograph{image::Image(syntheticSize, 3), 0, 0.5 / *std::ranges::max_element(radiance)};
      for (std::size_t i = 0; i < radiance.size(); ++i)
        photograph.signal.data()[i] = radiance[i] * static_cast<float>(photograph.seconds);
      QCOMPARE(monitor.look(photograph, seconds, frames).use, Look::Use::told);
    }
    const bool told = std::ranges::any_of(monitor.findings(),
                                          [](const Finding& one) { return one.kind == FindingKind::faded; });
    QCOMPARE(told, isTold);
  }

  void theDarkTellsNothing() {
    const ProjectorStack picture(3 * 2 * syntheticSize.count(), 0.0f);
    const LightFit fit =
        fitLight(observed(radianceOf(transport_, venue_, picture)), stillMoment(picture), venue_);
    for (double deviation : fit.totalDeviation)
      QVERIFY(deviation > 5.0 * MonitorSettings().ofGain.informative);
    for (const CellLight& cell : fit.cells) QVERIFY(cell.deviation > 1.0);
  }

  void whatIsMissingIsFoundWhereItIs() {
    const ProjectorStack picture = syntheticPicture(5.0);
    std::vector<float> radiance = radianceOf(transport_, venue_, picture);
    for (std::size_t i = 0; i < syntheticSize.count(); ++i) {
      const Pixel at = pixelAt(syntheticSize, i);
      if (at.x >= 30 && at.x < 36 && at.y >= 5 && at.y < 15)
        for (std::size_t c = 0; c < 3; ++c) radiance[3 * i + c] *= 0.5f;
    }
    const LightFit fit = fitLight(observed(radiance), stillMoment(picture), venue_);
    const Size cells = venue_.sampling.cells;
    for (std::size_t c = 0; c < fit.cells.size(); ++c) {
      const Pixel at = pixelAt(cells, c);
      const double x = (at.x + 0.5) * syntheticSize.width / cells.width,
                   y = (at.y + 0.5) * syntheticSize.height / cells.height;
      if (x > 31 && x < 35 && y > 6.5 && y < 13.5)
        QVERIFY2(fit.cells[c].share < 0.6, qPrintable(QString::number(fit.cells[c].share)));
      if (x < 28 || y > 18)
        QVERIFY2(fit.cells[c].share > 0.95, qPrintable(QString::number(fit.cells[c].share)));
    }
  }

  void aMovedViewIsFound_data() {
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    QTest::newRow("not moved") << 0.0 << 0.0;
    QTest::newRow("right") << 0.3 << 0.0;
    QTest::newRow("up left") << -0.2 << -0.25;
    QTest::newRow("far down") << 0.0 << 0.8;
  }
  void aMovedViewIsFound() {
    QFETCH(double, x);
    QFETCH(double, y);
    const ProjectorStack picture = syntheticPicture(5.0);
    const std::vector<float> radiance = radianceOf(transport_, venue_, picture);
    std::vector<float> moved = radiance;
    for (std::size_t i = 0; i < syntheticSize.count(); ++i) {
      const Pixel at = pixelAt(syntheticSize, i);
      const double u = std::clamp(at.x - x, 0.0, syntheticSize.width - 1.001),
                   v = std::clamp(at.y - y, 0.0, syntheticSize.height - 1.001);
      const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
      const auto fu = static_cast<float>(u - u0), fv = static_cast<float>(v - v0);
      for (std::size_t c = 0; c < 3; ++c) {
        const auto value = [&](int px, int py) { return radiance[3 * indexOf(syntheticSize, {px, py}) + c]; };
        moved[3 * i + c] = (1 - fv) * ((1 - fu) * value(u0, v0) + fu * value(u0 + 1, v0)) +
                           fv * ((1 - fu) * value(u0, v0 + 1) + fu * value(u0 + 1, v0 + 1));
      }
    }
    const ViewShift shift = viewShift(observed(moved), radiance, {}, venue_);
    // Linear interpolation blurs what it moves, and the gradient is that of what was not moved.
    const double tolerance = 0.03 + 0.1 * std::hypot(x, y);
    QVERIFY2(std::hypot(shift.x - x, shift.y - y) < tolerance,
             qPrintable(QString("(%1, %2)").arg(shift.x).arg(shift.y)));
    QVERIFY(std::abs(shift.turn) < tolerance);
    QVERIFY(shift.deviation < 0.1);
  }

  void exposuresSuitThePicture() {
    const std::vector<double> exposures{0.2, 0.09, 0.02, 0.004};
    const auto exposureOf = [&](float level) {
      return suitableExposure(venue_.transport.meansOf(ProjectorStack(3 * 2 * syntheticSize.count(), level)),
                              exposures, 0.1, venue_);
    };
    QCOMPARE(exposureOf(0.01f), 0.09);
    QCOMPARE(exposureOf(1.0f), 0.02);
  }
};

QTEST_GUILESS_MAIN(TestLightOfPhotographs)
#include "test_light_of_photographs.moc"
