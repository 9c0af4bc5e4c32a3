// SPDX-License-Identifier: MIT
#include "relucent/reduction/reduction.h"

#include <QTest>
#include <cmath>
#include <numeric>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/reduction/pixel_use.h"
#include "relucent/reduction/reduced_rig.h"
#include "relucent/reduction/reduced_transport.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::reduction;
using namespace relucent::rig;
using namespace relucent::test;
using namespace relucent::transport;

namespace {

double codesOf(int bits) {
  return std::ldexp(1.0, bits) - 1.0;
}

/// Light and the noise of a sample on it, as codes of `bits`; 0: as it is.
RawFrame photograph(Size size, double light, double deviation, int bits, std::uint64_t seed) {
  RawFrame frame{Image(size, 3), bits, 0.1};
  Random random{seed};
  for (float& value : frame.signal.data()) {
    double signal = light + deviation * random.normal();
    if (bits > 0) signal = std::round(std::clamp(signal, 0.0, 1.0) * codesOf(bits)) / codesOf(bits);
    value = static_cast<float>(signal);
  }
  return frame;
}

/// A camera that reads no more of its sensor than is looked at.
class ThriftyCamera : public Camera {
 public:
  ThriftyCamera(std::unique_ptr<Camera> camera, std::size_t& read)
      : camera_(std::move(camera)), read_(read) {}
  std::string name() const override { return camera_->name(); }
  Size size() const override { return camera_->size(); }
  ExposureRange exposures() const override { return camera_->exposures(); }
  RawFrame capture(const CaptureRequest& request) override {
    RawFrame frame = camera_->capture(request);
    const PicturePart part = request.part.value_or(PicturePart{{0, 0}, size()});
    read_ = part.size.count();
    for (std::size_t i = 0; i < frame.signal.pixels(); ++i) {
      const Pixel at = pixelAt(size(), i);
      const bool isRead = at.x >= part.begin.x && at.x < part.begin.x + part.size.width &&
                          at.y >= part.begin.y && at.y < part.begin.y + part.size.height;
      if (!isRead) std::ranges::fill(frame.signal.pixel(i), 0.0f);
    }
    return frame;
  }

 private:
  std::unique_ptr<Camera> camera_;
  std::size_t& read_;
};

Reduction whole(Size camera, int bin) {
  return reductionTo(camera, {0, 0}, camera, bin);
}

}  // namespace

class TestReduction : public QObject {
  Q_OBJECT

 private slots:
  void aConstantStaysOne_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("bin");
    for (int bits : {0, 1, 8, 10, 12, 15, 16})
      for (int bin : {1, 2, 3, 5}) QTest::addRow("%d bits, bins of %d", bits, bin) << bits << bin;
  }
  void aConstantStaysOne() {
    QFETCH(int, bits);
    QFETCH(int, bin);
    const Size size{17, 11};  // no multiple of any of these bins
    const double code = bits == 0 ? 0.3 : std::floor(0.3 * codesOf(bits)) / codesOf(bits);
    const Reducer reducer(whole(size, bin));
    const RawFrame small = reducer(photograph(size, code, 0.0, bits, 1));
    QCOMPARE(small.signal.size(), (Size{17 / bin, 11 / bin}));
    QCOMPARE(small.seconds, 0.1);
    const double tolerance = small.bits > 0 ? 0.5 / codesOf(small.bits) + 1e-7 : 1e-7;
    for (float value : small.signal.data()) QVERIFY(std::abs(static_cast<double>(value) - code) <= tolerance);
  }

  /// A mean of N independent samples has an Nth of their variance. The bound: five deviations of the sample
  /// variance of n values, sqrt(2 / n), and the rounding of the result.
  void noiseFallsWithTheNumberOfSamples_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("bin");
    for (int bits : {0, 10, 12})
      for (int bin : {2, 3, 4}) QTest::addRow("%d bits, bins of %d", bits, bin) << bits << bin;
  }
  void noiseFallsWithTheNumberOfSamples() {
    QFETCH(int, bits);
    QFETCH(int, bin);
    const Size size{240, 180};
    const double light = 0.4, deviation = 0.01;
    const RawFrame small = Reducer(whole(size, bin))(photograph(size, light, deviation, bits, 7));
    const auto n = static_cast<double>(small.signal.data().size());
    double sum = 0.0, squares = 0.0;
    for (float value : small.signal.data()) sum += static_cast<double>(value);
    for (float value : small.signal.data()) squares += std::pow(static_cast<double>(value) - sum / n, 2.0);
    const double rounding = bits > 0 ? 1.0 / (12.0 * std::pow(codesOf(bits), 2.0)) : 0.0;
    const double expected = (deviation * deviation + rounding) / (bin * bin);
    const double found = squares / (n - 1.0);
    // The result's own rounding adds no more than a sample's over N squared.
    const double added = rounding / std::pow(bin, 4.0);
    QVERIFY2(std::abs(found - expected) <= 5.0 * std::sqrt(2.0 / n) * expected + added,
             qPrintable(QString("%1 instead of %2").arg(found).arg(expected)));
    QVERIFY(std::abs(sum / n - light) <= 5.0 * std::sqrt(expected / n) + 1e-6);
  }

  void oneFullSampleMakesABinFull_data() {
    QTest::addColumn<double>("clip");
    QTest::addRow("full scale") << 1.0;
    QTest::addRow("a camera that clips below it") << 0.8;
  }
  void oneFullSampleMakesABinFull() {
    QFETCH(double, clip);
    const Size size{9, 6};
    for (std::size_t at = 0; at < 3 * size.count(); ++at) {
      RawFrame frame = photograph(size, 0.2, 0.0, 12, 1);
      frame.signal.data()[at] = static_cast<float>(clip);
      Reduction reduction = whole(size, 3);
      reduction.clip = clip;
      const RawFrame small = Reducer(reduction)(frame);
      const Pixel pixel = pixelAt(size, at / 3);
      for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
          for (int c = 0; c < 3; ++c) {
            const bool holds = pixel.x / 3 == x && pixel.y / 3 == y && static_cast<int>(at % 3) == c;
            QCOMPARE(small.signal.at(x, y, c) == 1.0f, holds);
          }
    }
  }

  /// The most that a camera can tell is the most that its bins can tell: exposures are chosen by it.
  void whatClipsBelowFullScaleReachesFullScale() {
    Reduction reduction = whole({8, 8}, 2);
    reduction.clip = 0.5;
    const RawFrame small = Reducer(reduction)(photograph({8, 8}, 0.25, 0.0, 0, 1));
    for (float value : small.signal.data()) QCOMPARE(value, 0.5f);
  }

  void hotSamplesAreLeftOut() {
    const Size size{4, 4};
    RawFrame frame = photograph(size, 0.2, 0.0, 12, 1);
    const float sound = frame.signal.data()[0];
    frame.signal.at(1, 1, 1) = 1.0f;
    Reduction reduction = whole(size, 2);
    reduction.defective = {3 * (1 * 4 + 1) + 1};
    const RawFrame small = Reducer(reduction)(frame);
    for (float value : small.signal.data())
      QVERIFY(std::abs(value - sound) <= 0.5f / static_cast<float>(codesOf(small.bits)));
    // Nothing else is known of a bin that has no sound sample.
    reduction.defective.clear();
    for (std::uint32_t x : {0U, 1U})
      for (std::uint32_t y : {0U, 1U}) reduction.defective.push_back(3 * (4 * y + x) + 1);
    std::ranges::sort(reduction.defective);
    QCOMPARE(Reducer(reduction)(frame).signal.at(0, 0, 1), 1.0f);
  }

  void withoutBinsEverySampleStaysAsItIs() {
    const Size size{20, 14};
    const RawFrame frame = photograph(size, 0.3, 0.1, 12, 3);
    QVERIFY(Reducer(noReduction(size))(frame).signal == frame.signal);
    const RawFrame part = Reducer(reductionTo(size, {3, 5}, {11, 7}, 1))(frame);
    QCOMPARE(part.signal.size(), (Size{11, 7}));
    QCOMPARE(part.bits, frame.bits);
    for (int y = 0; y < 7; ++y)
      for (int x = 0; x < 11; ++x)
        for (int c = 0; c < 3; ++c) QCOMPARE(part.signal.at(x, y, c), frame.signal.at(3 + x, 5 + y, c));
  }

  /// A journal stores codes, in no more than 16 bits.
  void samplesAreWholeCodes_data() {
    QTest::addColumn<int>("bits");
    QTest::addColumn<int>("bin");
    QTest::addColumn<int>("expected");
    QTest::newRow("none") << 0 << 4 << 0;
    QTest::newRow("8 and 2x2") << 8 << 2 << 10;
    QTest::newRow("12 and 3x3") << 12 << 3 << 16;
    QTest::newRow("12 and 4x4") << 12 << 4 << 16;
    QTest::newRow("14 and 2x2") << 14 << 2 << 16;
    QTest::newRow("15 and 2x2") << 15 << 2 << 16;
    QTest::newRow("12 and none") << 12 << 1 << 12;
  }
  void samplesAreWholeCodes() {
    QFETCH(int, bits);
    QFETCH(int, bin);
    QFETCH(int, expected);
    const RawFrame small = Reducer(whole({24, 24}, bin))(photograph({24, 24}, 0.3, 0.05, bits, 5));
    QCOMPARE(small.bits, expected);
    if (expected == 0) return;
    const double codes = codesOf(expected);
    for (float value : small.signal.data()) {
      const double code = std::nearbyint(static_cast<double>(value) * codes);
      QCOMPARE(value, static_cast<float>(code / codes));
    }
  }

  /// The mean of encoded values is not the code of their mean.
  void aCurvedCameraIsMadeLinearFirst() {
    const ResponseCurve square({0.0, 0.25, 0.5, 0.75, 1.0}, {0.0, 0.0625, 0.25, 0.5625, 1.0});
    Reduction reduction = whole({4, 2}, 2);
    reduction.response = {square, square, square};
    RawFrame frame{Image({4, 2}, 3, 0.25f), 0, 1.0};
    for (int c = 0; c < 3; ++c) frame.signal.at(0, 0, c) = frame.signal.at(3, 1, c) = 0.75f;
    const float expected = (3.0f * 0.0625f + 0.5625f) / 4.0f;  // not the square of (3 * 0.25 + 0.75) / 4
    const RawFrame exact = Reducer(reduction)(frame);
    for (float value : exact.signal.data()) QCOMPARE(value, expected);
    frame.bits = 8;
    const double rounding = 0.5 / 255.0 * 1.5 + 1e-5;  // of samples that are no codes, at the steepest
    const RawFrame coded = Reducer(reduction)(frame);
    for (float value : coded.signal.data())
      QVERIFY(std::abs(static_cast<double>(value - expected)) < rounding);
  }

  void aPartLiesOnTheGridOfItsBins_data() {
    QTest::addColumn<int>("bin");
    for (int bin : {1, 2, 3, 4, 7, 16}) QTest::addRow("%d", bin) << bin;
  }
  void aPartLiesOnTheGridOfItsBins() {
    QFETCH(int, bin);
    const Size camera{61, 43};
    Random random{11, static_cast<std::uint64_t>(bin)};
    for (int i = 0; i < 200; ++i) {
      auto below = [&random](int n) { return static_cast<int>(random.uniform() * n); };
      const Pixel begin{below(61), below(43)};
      const Size part{1 + below(61 - begin.x), 1 + below(43 - begin.y)};
      const Reduction made = reductionTo(camera, begin, part, bin);
      auto check = [bin](int first, int length, int from, int all, int madeLength) {
        QCOMPARE(from % bin, 0);
        QCOMPARE(madeLength % bin, 0);
        QVERIFY(from >= 0 && madeLength >= bin && from + madeLength <= all);
        // All that was asked for, but pixels at the end that fill no bin.
        QVERIFY(from <= std::min(first, all / bin * bin - bin));
        QVERIFY(from <= first && from + madeLength >= std::min(first + length, all / bin * bin));
        QVERIFY(madeLength < length + 2 * bin);
      };
      check(begin.x, part.width, made.begin.x, camera.width, made.part.width);
      check(begin.y, part.height, made.begin.y, camera.height, made.part.height);
    }
  }

  /// T of a reduced camera predicts what the camera's radiance becomes. Tolerance: codes of T, 2e-5 of a
  /// row's largest value for each of its leaves.
  void reducedTransportRelightsReducedRadiance() {
    SyntheticSettings scene;
    scene.projectors = {{16, 12}};
    scene.cameras = {{41, 30}, {20, 16}};
    scene.interreflection = 0.2;
    const TransportMatrix full = syntheticTransport(scene);
    const std::vector<Reduction> reductions{reductionTo({41, 30}, {5, 4}, {31, 22}, 3),
                                            noReduction({20, 16})};
    const TransportMatrix small = reducedTransport(full, reductions);
    QCOMPARE(small.cameras(), Rasters({reductions[0].size(), {20, 16}}));
    ProjectorStack pattern(3 * full.projectors().count());
    Random random{5};
    for (float& value : pattern) value = static_cast<float>(random.uniform());
    const CameraStack expected = reducedRadiance(full.apply(pattern), reductions),
                      found = small.apply(pattern);
    QCOMPARE(found.size(), expected.size());
    const float most = *std::ranges::max_element(expected);
    for (std::size_t i = 0; i < found.size(); ++i) QVERIFY(std::abs(found[i] - expected[i]) < 1e-3f * most);
  }

  void anotherSizeIsNamed() {
    SyntheticSettings scene;
    ScriptedVenue venue(syntheticTransport(scene), {}, {});
    Rig rig = venue.rig();
    const std::vector<Reduction> reductions{reductionTo({80, 60}, {0, 0}, {80, 60}, 2)};
    try {
      reduced(rig, reductions);
      QFAIL("a camera of another size was accepted");
    } catch (const Error& error) {
      const QString text = error.what();
      QVERIFY2(text.contains("40x30") && text.contains("80x60"), error.what());
    }
    QVERIFY_THROWS_EXCEPTION(Error, reduced(rig, {reductions[0], reductions[0]}));
  }

  void reducedCamerasAreThoseOfTheRig() {
    SyntheticSettings scene;
    ScriptedVenue venue(syntheticTransport(scene), {}, {});
    Rig rig = venue.rig();
    const Reduction reduction = reductionTo({40, 30}, {4, 2}, {30, 20}, 2);
    Rig small = reduced(rig, {reduction});
    QCOMPARE(small.cameras[0]->size(), (Size{15, 10}));
    QCOMPARE(small.cameras[0]->name(), rig.cameras[0]->name());
    small.projectors[0]->show(Image(rig.projectors[0]->size(), 3, 0.7f));
    const CaptureRequest request{{"test", 3}, 0, 0.01};
    QVERIFY(small.cameras[0]->capture(request).signal ==
            Reducer(reduction)(rig.cameras[0]->capture(request)).signal);
    // As they are.
    QVERIFY(reduced(rig, {}).cameras[0]->capture(request).signal == rig.cameras[0]->capture(request).signal);
  }

  /// Law: what is beside the part need not be read.
  void onlyThePartIsReadOfACamera() {
    SyntheticSettings scene;
    ScriptedVenue venue(syntheticTransport(scene), {}, {});
    Rig rig = venue.rig(), thrifty = venue.rig();
    std::size_t read = 0;
    thrifty.cameras[0] = std::make_unique<ThriftyCamera>(std::move(thrifty.cameras[0]), read);
    const Reduction reduction = reductionTo({40, 30}, {4, 2}, {30, 20}, 2);
    const CaptureRequest request{{"test", 3}, 0, 0.01};
    for (Rig* each : {&rig, &thrifty}) each->projectors[0]->show(Image(each->projectors[0]->size(), 3, 0.7f));
    QVERIFY(reduced(thrifty, {reduction}).cameras[0]->capture(request).signal ==
            reduced(rig, {reduction}).cameras[0]->capture(request).signal);
    QCOMPARE(read, reduction.part.count());
    sparse(thrifty, 200).cameras[0]->capture(request);
    QCOMPARE(read, std::size_t{40 * 30});
  }

  void sparseCamerasKeepSamplesAsTheyAre() {
    SyntheticSettings scene;
    scene.cameras = {{41, 30}};
    ScriptedVenue venue(syntheticTransport(scene), {}, {});
    Rig rig = venue.rig();
    QCOMPARE(strideFor({41, 30}, 200), 3);
    Rig thin = sparse(rig, 200);
    QCOMPARE(thin.cameras[0]->size(), (Size{14, 10}));
    const CaptureRequest request{{"test", 1}, 0, 0.01};
    const RawFrame all = rig.cameras[0]->capture(request), some = thin.cameras[0]->capture(request);
    QCOMPARE(some.bits, all.bits);
    for (int y = 0; y < 10; ++y)
      for (int x = 0; x < 14; ++x) QCOMPARE(some.signal.at(x, y, 1), all.signal.at(3 * x, 3 * y, 1));
  }

  void choicesAreWrittenAndRead_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<bool>("known");
    for (const char* text : {"auto", "all", "1/1", "1/2", "1/16"}) QTest::newRow(text) << text << true;
    for (const char* text : {"", "1/0", "1/17", "1/", "1/2x", "2", "half", "1/-2", "Auto"})
      QTest::addRow("'%s'", text) << text << false;
  }
  void choicesAreWrittenAndRead() {
    QFETCH(QString, text);
    QFETCH(bool, known);
    const auto use = pixelUseFrom(text.toStdString());
    QCOMPARE(use.has_value(), known);
    if (known) QCOMPARE(toString(*use), text.toStdString());
  }
};

QTEST_GUILESS_MAIN(TestReduction)
#include "test_reduction.moc"
