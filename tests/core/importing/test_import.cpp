// SPDX-License-Identifier: MIT
#include "relucent/importing/import.h"

#include <tbb/global_control.h>

#include <QtTest>
#include <cmath>
#include <optional>
#include <set>

#include "relucent/base/error.h"
#include "relucent/base/random.h"
#include "relucent/importing/pattern_plan.h"
#include "support/scripted_rig.h"
#include "support/stopped.h"

using namespace relucent;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::importing;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

constexpr Size projector{48, 36};
constexpr Size camera{40, 30};

/// A made-up venue and what a camera in it sees: the photographs of an import.
struct Scene {
  explicit Scene(std::uint64_t seed = 1, double projectorGamma = 2.2) : gamma(projectorGamma) {
    SyntheticSettings synthetic;
    synthetic.projectors = {projector};
    synthetic.cameras = {camera};
    synthetic.brightness = 0.7;
    synthetic.seed = seed;
    truth = syntheticTransport(synthetic);
    black = syntheticBlack(truth);
  }
  ProjectorStack drive(const Image& pattern) const {
    ProjectorStack linear(pattern.data());
    for (float& value : linear) value = std::pow(value, static_cast<float>(gamma));
    return linear;
  }
  Image photograph(const Image& pattern) const {
    CameraStack seen = truth.apply(drive(pattern));
    for (std::size_t i = 0; i < seen.size(); ++i) seen[i] += black[i];
    return Image(camera, 3, std::move(seen));
  }

  double gamma;
  TransportMatrix truth;
  CameraStack black;
};

PictureSequence sequenceOf(const std::vector<Image>& images) {
  PictureSequence sequence(images.front().size(), static_cast<int>(images.size()));
  for (std::size_t k = 0; k < images.size(); ++k) sequence.set(static_cast<int>(k), images[k]);
  return sequence;
}

std::vector<Image> photographsOf(const Scene& scene, const std::vector<Image>& patterns) {
  std::vector<Image> photographs;
  for (const Image& pattern : patterns) photographs.push_back(scene.photograph(pattern));
  return photographs;
}

Import imported(const Scene& scene, const std::vector<Image>& patterns) {
  Progress progress;
  return importTransport(sequenceOf(patterns), sequenceOf(photographsOf(scene, patterns)), {}, progress);
}

std::vector<Image> planned(const std::function<bool(const PlannedPattern&)>& keep) {
  PatternPlanSettings settings;
  settings.projector = projector;
  std::vector<Image> images;
  for (const PlannedPattern& pattern : planPatterns(settings))
    if (keep(pattern)) images.push_back(render(pattern, projector));
  return images;
}
std::vector<Image> wholePlan() {
  return planned([](const PlannedPattern&) { return true; });
}
bool isGrayCode(const PlannedPattern& pattern) {
  return pattern.kind == PlannedPattern::Kind::columns || pattern.kind == PlannedPattern::Kind::rows;
}

/// Colour noise, every pixel by itself: nothing that a Gray-code decoder could read.
std::vector<Image> noisePatterns(int count) {
  std::vector<Image> images;
  for (int k = 0; k < count; ++k) {
    Random random{77, static_cast<std::uint64_t>(k)};
    Image image(projector, 3);
    for (float& value : image.data()) value = random.uniformFloat();
    images.push_back(std::move(image));
  }
  return images;
}

Image negative(Image image) {
  for (float& value : image.data()) value = 1.0f - value;
  return image;
}

/// How T and e predict pictures that nobody projected: relative to what varies in them.
double relightingError(const Scene& scene, const Import& import) {
  double apart = 0.0, varies = 0.0;
  for (std::uint64_t seed : {5, 6, 7}) {
    Image pattern(projector, 3);
    for (int y = 0; y < projector.height; ++y)
      for (int x = 0; x < projector.width; ++x)
        for (int c = 0; c < 3; ++c) {
          double phase = static_cast<double>(seed) + 0.35 * x * (c + 1) / 2.0 + 0.27 * y;
          pattern.at(x, y, c) = static_cast<float>(0.5 + 0.5 * std::sin(phase));
        }
    CameraStack seen = scene.truth.apply(ProjectorStack(pattern.data()));
    CameraStack predicted = import.acquisition.transport.apply(ProjectorStack(pattern.data()));
    double mean = 0.0;
    for (float value : seen) mean += static_cast<double>(value) / static_cast<double>(seen.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      apart += std::pow(static_cast<double>(seen[i]) - static_cast<double>(predicted[i]), 2);
      varies += std::pow(static_cast<double>(seen[i]) - mean, 2);
    }
  }
  return std::sqrt(apart / varies);
}

template <typename Act>
QString errorOf(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class TestImport : public QObject {
  Q_OBJECT

  std::optional<Import> ofGrayCode_;
  /// Made once, for all that is compared with it.
  const Import& ofGrayCode() {
    if (!ofGrayCode_) ofGrayCode_ = imported(Scene(), planned(isGrayCode));
    return *ofGrayCode_;
  }

 private slots:
  void recoversALocalTransport_data() {
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 3; ++seed) QTest::addRow("%d", seed) << seed;
  }
  void recoversALocalTransport() {
    QFETCH(int, seed);
    Scene scene(static_cast<std::uint64_t>(seed));
    Import import = imported(scene, wholePlan());
    qInfo() << import.error.transport << import.error.mix << import.error.oneToOne
            << relightingError(scene, import);
    // Stripes of which neither phase was fitted are predicted from places and spreads alone: 60 % of what a
    // one-to-one map leaves is what the product promises, and footprints of their own do clearly better.
    QVERIFY2(import.error.transport < 0.5 * import.error.oneToOne,
             qPrintable(QString::number(import.error.transport)));
    QVERIFY(import.error.mix <= 1.05 * import.error.oneToOne);
    // The footprint is a Gaussian, cut off at a hundredth; the synthetic one is sampled at pixels' centres.
    QVERIFY2(relightingError(scene, import) < 0.06,
             qPrintable(QString::number(relightingError(scene, import))));
  }

  void orderAndNegativesDoNotMatter_data() {
    QTest::addColumn<bool>("reversed");
    QTest::addColumn<bool>("negative");
    QTest::addRow("reversed") << true << false;
    QTest::addRow("negative") << false << true;
  }
  void orderAndNegativesDoNotMatter() {
    QFETCH(bool, reversed);
    QFETCH(bool, negative);
    Scene scene;
    std::vector<Image> patterns = planned(isGrayCode);
    double before = relightingError(scene, ofGrayCode());
    if (reversed) std::reverse(patterns.begin(), patterns.end());
    if (negative)
      for (Image& pattern : patterns) pattern = ::negative(pattern);
    Import import = imported(scene, patterns);
    // The order decides how sums round, and where two places explain a pixel alike, which is taken.
    QVERIFY(std::abs(relightingError(scene, import) - before) < 0.02);
  }

  void needsNoWholeCode() {
    // Every third picture missing, and neither black nor white.
    std::vector<Image> patterns = planned(isGrayCode), some;
    for (std::size_t k = 0; k < patterns.size(); ++k)
      if (k % 3 != 1) some.push_back(patterns[k]);
    Scene scene;
    Import import = imported(scene, some);
    // What is left cannot spare anything: the figure is for patterns that T needs, so T itself is judged.
    // Half a pixel off turns a smooth pattern's phase by 0.17.
    QVERIFY2(relightingError(scene, import) < 0.25,
             qPrintable(QString::number(relightingError(scene, import))));
  }

  void findsPlacesInNoise() {
    Scene scene;
    Import import = imported(scene, noisePatterns(40));
    qInfo() << import.error.transport << import.error.mix << import.error.oneToOne;
    QVERIFY2(import.error.transport < 0.25, qPrintable(QString::number(import.error.transport)));
    QVERIFY(import.error.transport < 0.6 * import.error.mix);
  }

  void heldOutPatternsTakeNoPart() {
    Scene scene;
    std::vector<Image> patterns = wholePlan();
    std::vector<Image> photographs = photographsOf(scene, patterns);
    Progress progress;
    ImportSettings settings;
    settings.refit = false;
    Import before = importTransport(sequenceOf(patterns), sequenceOf(photographs), settings, progress);
    QVERIFY(before.heldOut.size() >= 4);
    for (int k : before.heldOut) photographs[static_cast<std::size_t>(k)] = Image(camera, 3, 0.3f);
    Import after = importTransport(sequenceOf(patterns), sequenceOf(photographs), settings, progress);
    QCOMPARE(after.heldOut, before.heldOut);
    QVERIFY(after.acquisition.transport == before.acquisition.transport);
    QVERIFY(after.acquisition.black == before.acquisition.black);
    QVERIFY(after.error.transport > before.error.transport);
  }

  /// Law: what is held out is held out with all that says the same, its negative above all, and the rest can
  /// still tell places apart, within what neighbours can settle together.
  void negativesStayTogether() {
    PatternPlanSettings settings;
    settings.projector = projector;
    std::vector<PlannedPattern> plan;
    for (const PlannedPattern& pattern : planPatterns(settings))
      if (isGrayCode(pattern)) plan.push_back(pattern);
    std::vector<int> held = heldOutPatterns(sequenceOf(planned(isGrayCode)), 5);
    QVERIFY2(held.size() >= 4 && held.size() % 2 == 0, qPrintable(QString::number(held.size())));
    auto isHeld = [&](std::size_t k) {
      return std::find(held.begin(), held.end(), static_cast<int>(k)) != held.end();
    };
    for (std::size_t a = 0; a < plan.size(); ++a)
      for (std::size_t b = 0; b < plan.size(); ++b)
        if (plan[a].kind == plan[b].kind && plan[a].bit == plan[b].bit) QCOMPARE(isHeld(a), isHeld(b));
  }

  /// The same for pictures that went through a lossy file: equal but for a few codes.
  void nearlyNegativesStayTogether() {
    std::vector<Image> patterns = planned(isGrayCode);
    std::vector<int> exact = heldOutPatterns(sequenceOf(patterns), 5);
    Random random{5};
    for (Image& pattern : patterns)
      for (float& value : pattern.data())
        value = std::clamp(value + 0.01f * (random.uniformFloat() - 0.5f), 0.0f, 1.0f);
    std::vector<int> noisy = heldOutPatterns(sequenceOf(patterns), 5);
    QCOMPARE(noisy.size() % 2, std::size_t{0});
    QVERIFY(!noisy.empty());
  }

  void evenPatternsAreNeverHeldOut() {
    std::vector<Image> patterns{Image(projector, 3, 0.0f), Image(projector, 3, 1.0f),
                                Image(projector, 3, 0.5f)};
    QVERIFY(heldOutPatterns(sequenceOf(patterns), 2).empty());
  }

  void findsTheProjectorsResponse_data() {
    QTest::addColumn<double>("gamma");
    QTest::addRow("1.6") << 1.6;
    QTest::addRow("2.8") << 2.8;
  }
  void findsTheProjectorsResponse() {
    QFETCH(double, gamma);
    Scene scene(1, gamma);
    Import import = imported(scene, wholePlan());
    for (const ResponseCurve& curve : import.linearization.projectors.front().channels)
      for (double drive : {2.0 / 7.0, 4.0 / 7.0, 6.0 / 7.0})
        // At the ramp's levels, noiseless: what is left is the footprint's.
        QVERIFY2(std::abs(curve(drive) - std::pow(drive, gamma)) < 0.01,
                 qPrintable(QString("%1 at %2").arg(curve(drive)).arg(drive)));
  }

  void greyPicturesGiveNeutralBlocks() {
    Scene scene;
    std::vector<Image> patterns = planned(isGrayCode);
    std::vector<Image> photographs = photographsOf(scene, patterns);
    for (Image& photograph : photographs)
      for (std::size_t i = 0; i < photograph.pixels(); ++i) {
        auto pixel = photograph.pixel(i);
        std::fill(pixel.begin(), pixel.end(), (pixel[0] + pixel[1] + pixel[2]) / 3.0f);
      }
    Progress progress;
    Import import = importTransport(sequenceOf(patterns), sequenceOf(photographs), {}, progress);
    const BlockSparse& leaves = import.acquisition.transport.ownLeaves();
    for (std::size_t row = 0; row < leaves.rows(); ++row)
      for (std::size_t entry = leaves.rowBegin(row); entry < leaves.rowBegin(row + 1); ++entry) {
        const auto& code = leaves.code(entry);
        for (std::size_t i : {1u, 2u, 3u, 5u, 6u, 7u}) QCOMPARE(int(code[i]), 0);
        QVERIFY(std::abs(code[0] - code[4]) <= 1 && std::abs(code[0] - code[8]) <= 1);
      }
    QVERIFY(english(import.acquisition.findings.front()).find("neutral") != std::string::npos);
  }

  void sameBitsForEveryNumberOfThreads() {
    Scene scene;
    std::vector<Image> patterns = planned(isGrayCode);
    const Import& several = ofGrayCode();
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    Import single = imported(scene, patterns);
    QVERIFY(several.acquisition.transport == single.acquisition.transport);
    QCOMPARE(several.error.transport, single.error.transport);
  }

  void survivesOddPictures_data() {
    QTest::addColumn<float>("gain");
    QTest::addRow("nothing reflects") << 0.0f;
    QTest::addRow("overexposed") << 20.0f;
  }
  void survivesOddPictures() {
    QFETCH(float, gain);
    Scene scene;
    std::vector<Image> patterns = planned(isGrayCode);
    std::vector<Image> photographs = photographsOf(scene, patterns);
    for (Image& photograph : photographs)
      for (float& value : photograph.data()) value = std::min(1.0f, gain * value);
    Progress progress;
    auto act = [&] { importTransport(sequenceOf(patterns), sequenceOf(photographs), {}, progress); };
    QString error = errorOf(act);
    if (gain == 0.0f) QVERIFY2(error.contains("all alike"), qPrintable(error));
    if (gain > 1.0f) QVERIFY2(error.isEmpty(), qPrintable(error));
  }

  void saysWhenPatternsAreTooFew_data() {
    QTest::addColumn<int>("count");
    for (int count : {1, 2, 6}) QTest::addRow("%d", count) << count;
  }
  void saysWhenPatternsAreTooFew() {
    QFETCH(int, count);
    Scene scene;
    std::vector<Image> patterns = noisePatterns(count);
    QString error = errorOf([&] { imported(scene, patterns); });
    QVERIFY2(error.contains("too few"), qPrintable(error));
  }

  void stopsWhenAsked() {
    Stopped stopped;
    std::vector<Image> patterns = planned(isGrayCode);
    PictureSequence sequence = sequenceOf(patterns);
    QVERIFY_EXCEPTION_THROWN(
        importTransport(sequence, sequenceOf(photographsOf(Scene(), patterns)), {}, stopped), Cancelled);
  }
};

QTEST_GUILESS_MAIN(TestImport)
#include "test_import.moc"
