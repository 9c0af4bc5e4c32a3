// SPDX-License-Identifier: MIT
// Predictions of some rows of T, and which rows are looked at.
#include "relucent/monitoring/sampled_transport.h"

#include <QtTest>

#include "core/monitoring/synthetic_watch.h"

using namespace relucent;
using namespace relucent::monitoring;

class TestSampledTransport : public QObject {
  Q_OBJECT

  static std::vector<float> predicted(const SampledTransport& sampled, const FrameMeans& frame) {
    std::vector<std::uint32_t> all(sampled.rows());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    const FrameMeans* one = &frame;
    const double weight = 1.0;
    const std::vector<float> parts = sampled.lightOf(mixed({&one, 1}, {&weight, 1}), all);
    std::vector<float> total(3 * all.size(), 0.0f);
    for (std::size_t i = 0; i < parts.size(); ++i)
      total[3 * (i / (9 * sampled.projectors())) + i % 9 / 3] += parts[i];
    return total;
  }

 private slots:
  void smallRastersArePredictedExactly() {
    const transport::TransportMatrix transport = syntheticTransport();
    const std::vector<std::uint32_t> rows{3, 77, 500, 1199};
    const SampledTransport sampled(transport, rows);
    const ProjectorStack picture = syntheticPicture(0.0);
    const CameraStack all = transport.apply(picture);
    const std::vector<float> some = predicted(sampled, sampled.meansOf(picture));
    for (std::size_t s = 0; s < rows.size(); ++s)
      for (std::size_t c = 0; c < 3; ++c)
        // Means are rounded to 1 / 65535, codes of rows to 1 / 32767 of the largest.
        QVERIFY2(std::abs(some[3 * s + c] - all[3 * rows[s] + c]) < 3e-3f,
                 qPrintable(QString("%1 for %2").arg(some[3 * s + c]).arg(all[3 * rows[s] + c])));
  }

  /// Pixels spread over wide nodes stand for all of them: sixteen of a picture whose values deviate by a
  /// quarter are off by a sixteenth of full drive, of a tenth of the light.
  void largeRastersAreReadAtFewPixels() {
    const transport::TransportMatrix transport = syntheticTransport();
    const std::vector<std::uint32_t> rows{410, 620};
    const SampledTransport exact(transport, rows), few(transport, rows, 0);
    QVERIFY(few.pixels().size() < exact.pixels().size() / 4);
    const ProjectorStack picture = syntheticPicture(3.0);
    const std::vector<float> a = predicted(exact, exact.meansOf(picture)),
                             b = predicted(few, few.meansOf(picture));
    for (std::size_t i = 0; i < a.size(); ++i) QVERIFY(std::abs(a[i] - b[i]) < 0.05f * a[i]);
  }

  /// Stripes of single pixels are grey to a wide node, however they lie.
  void stripesAreNotTakenForOneOfTheirColours() {
    const Rasters projector(Size{64, 64});
    const transport::NodeLayout layout(projector);
    transport::BlockSparseBuilder builder(layout.count(), {1.0f});
    builder.add(0, layout.index({0, 6, 0, 0}), transport::ColourBlock::Identity());
    const transport::TransportMatrix transport(Rasters(Size{1, 1}), projector, builder.build());
    const SampledTransport sampled(transport, {0}, 0);
    for (bool across : {false, true}) {
      ProjectorStack stripes(3 * projector.count());
      for (std::size_t i = 0; i < projector.count(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          const Pixel at = pixelAt({64, 64}, i);
          stripes[3 * i + c] = (across ? at.y : at.x) % 2 == 0 ? 1.0f : 0.0f;
        }
      const float seen = predicted(sampled, sampled.meansOf(stripes))[0];
      QVERIFY2(seen > 0.15f && seen < 0.85f, qPrintable(QString::number(seen)));
    }
  }

  void predictionsAreLinearInTheFrames() {
    const transport::TransportMatrix transport = syntheticTransport();
    const SampledTransport sampled(transport, {100, 101, 900});
    const FrameMeans a = sampled.meansOf(syntheticPicture(0.0)), b = sampled.meansOf(syntheticPicture(9.0));
    const std::vector<const FrameMeans*> frames{&a, &b};
    const std::vector<double> shares{0.25, 0.75};
    const std::vector<float> both = mixed(frames, shares);
    for (std::size_t i = 0; i < both.size(); ++i)
      QVERIFY(std::abs(both[i] - (0.25f * a[i] + 0.75f * b[i]) / 65535.0f) < 1e-6f);
  }

  void aLargeCameraCostsNoMoreThanIsAllowed_data() {
    QTest::addColumn<int>("width");
    QTest::addColumn<int>("height");
    QTest::newRow("tiny") << 9 << 7;
    QTest::newRow("small") << 64 << 48;
    QTest::newRow("large") << 1632 << 1224;
    QTest::newRow("wide") << 2000 << 200;
  }
  void aLargeCameraCostsNoMoreThanIsAllowed() {
    QFETCH(int, width);
    QFETCH(int, height);
    const Size camera{width, height};
    std::vector<std::uint8_t> usable(camera.count(), 1);
    for (int y = 0; y < height; ++y)  // the left third is not lit
      for (int x = 0; x < width / 3; ++x) usable[indexOf(camera, {x, y})] = 0;
    const Sampling sampling = sampledPixels(camera, usable);
    QVERIFY(sampling.pixels.size() <= 9500);
    QVERIFY(std::is_sorted(sampling.pixels.begin(), sampling.pixels.end()));
    for (std::uint32_t sample : sampling.even) QVERIFY(usable[sampling.pixels[sample]] != 0);
    std::vector<int> perCell(sampling.cells.count(), 0);
    for (std::uint32_t sample : sampling.even) ++perCell[sampling.cell[sample]];
    for (int y = 0; y < sampling.cells.height; ++y)
      QVERIFY(perCell[indexOf(sampling.cells, {sampling.cells.width - 1, y})] > 0);
    for (const Patch& patch : sampling.patches)
      for (std::uint32_t sample : patch.samples) QVERIFY(sample < sampling.pixels.size());
    if (camera.count() > 100) QVERIFY(sampling.patches.size() >= 4);
  }
};

QTEST_GUILESS_MAIN(TestSampledTransport)
#include "test_sampled_transport.moc"
