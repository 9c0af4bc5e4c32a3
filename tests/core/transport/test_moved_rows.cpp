// SPDX-License-Identifier: MIT
#include "relucent/transport/moved_rows.h"

#include <QtTest>
#include <cmath>

#include "core/transport/random_blocks.h"
#include "relucent/transport/leaf_sharing.h"

using namespace relucent;
using namespace relucent::transport;

namespace {

constexpr Size camera{12, 9}, projector{10, 8};

/// Every camera pixel sees a spot of the projector and all of it a little; spots drift over the picture.
TransportMatrix someTransport(bool shared) {
  const NodeLayout layout{Rasters(projector)};
  Random random{7};
  const ColumnKinds kinds = nearAndFar(layout, 2);
  SharedColourWriter writer(layout.count(), camera.count(), kinds, 0);
  SharedColourEncoder encoder(kinds);
  SharedColourRow encoded;
  BlockSparseBuilder builder(layout.count(), std::vector<float>(camera.count(), 4.0f));
  for (std::size_t row = 0; row < camera.count(); ++row) {
    const Pixel at = pixelAt(camera, row);
    std::vector<std::uint32_t> columns;
    std::vector<ColourBlock> blocks;
    ColourBlock colours;
    for (int i = 0; i < 9; ++i) colours.data()[i] = 0.2f + random.uniformFloat();
    for (int x = 0; x < 2; ++x) {
      const Pixel seen{std::min(projector.width - 1, at.x * 3 / 4 + x),
                       std::min(projector.height - 1, at.y * 3 / 4)};
      if (!columns.empty() && columns.back() == indexOf(projector, seen)) continue;
      columns.push_back(static_cast<std::uint32_t>(indexOf(projector, seen)));
      blocks.push_back((0.3f + random.uniformFloat()) * colours);
    }
    const int top = layout.levels() - 1;
    columns.push_back(static_cast<std::uint32_t>(layout.index({0, top, 0, 0})));
    blocks.push_back(0.2f * colours);
    encoder.encode(columns, blocks, encoded);
    writer.add(encoded);
    for (std::size_t i = 0; i < columns.size(); ++i) builder.add(row, columns[i], blocks[i]);
  }
  return {Rasters(camera), Rasters(projector), shared ? writer.build() : builder.build()};
}

std::array<double, 4> cubic(double t) {
  return {-0.5 * t + t * t - 0.5 * t * t * t, 1.0 - 2.5 * t * t + 1.5 * t * t * t,
          0.5 * t + 2.0 * t * t - 1.5 * t * t * t, -0.5 * t * t + 0.5 * t * t * t};
}

}  // namespace

class TestMovedRows : public QObject {
  Q_OBJECT

 private slots:
  void lightMovesAsRowsDo_data() {
    QTest::addColumn<int>("form");
    QTest::addColumn<double>("x");
    QTest::addColumn<double>("y");
    const char* forms[] = {"own colours", "shared colours", "groups"};
    for (int form = 0; form < 3; ++form) {
      QTest::addRow("%s, not at all", forms[form]) << form << 0.0 << 0.0;
      QTest::addRow("%s, by whole pixels", forms[form]) << form << 2.0 << -1.0;
      QTest::addRow("%s, by parts of pixels", forms[form]) << form << 0.4 << 1.3;
    }
  }
  /// Law: what is seen of any pattern is what was seen of it, interpolated at the former place. In own
  /// colours within rounding; shared ones keep the light of white and, of a row's near and far light, its
  /// colours.
  void lightMovesAsRowsDo() {
    QFETCH(int, form);
    QFETCH(double, x);
    QFETCH(double, y);
    Progress quiet;
    TransportMatrix transport = someTransport(form > 0);
    if (form == 2) transport = withSharedLeaves(transport, sharingTolerance, quiet);
    const MovedRows moved = movedRows(transport, [&](std::size_t, const Pixel& place) {
      return Eigen::Vector2d(place.x - x, place.y - y);
    });
    QVERIFY(moved.transport.groups().empty());
    QCOMPARE(moved.transport.ownLeaves().sharedColours() != nullptr, form > 0);
    const ProjectorStack white(3 * projector.count(), 1.0f);
    ProjectorStack pattern = white;
    if (form == 0) {
      Random random{3};
      for (float& value : pattern) value = random.uniformFloat();
    }
    const CameraStack before = transport.apply(pattern), after = moved.transport.apply(pattern);
    for (std::size_t row = 0; row < camera.count(); ++row) {
      const Pixel at = pixelAt(camera, row);
      const double px = at.x - x, py = at.y - y;
      const bool isInside = px >= 0.0 && py >= 0.0 && px <= camera.width - 1.0 && py <= camera.height - 1.0;
      QCOMPARE(moved.unknown[row] == 0, isInside);
      for (std::size_t c = 0; c < 3; ++c) {
        double expected = 0.0;
        if (isInside) {
          const int left = static_cast<int>(px), top = static_cast<int>(py);
          const auto across = cubic(px - left), down = cubic(py - top);
          for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
              const Pixel from{std::clamp(left + i - 1, 0, camera.width - 1),
                               std::clamp(top + j - 1, 0, camera.height - 1)};
              expected += across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)] *
                          static_cast<double>(before[3 * indexOf(camera, from) + c]);
            }
        }
        const double off = std::abs(static_cast<double>(after[3 * row + c]) - expected);
        QVERIFY2(off < 2e-3, qPrintable(QString("row %1: off by %2 of %3").arg(row).arg(off).arg(expected)));
      }
    }
  }

  /// Law: every one of the nine ways of light is multiplied on its own, whatever the form.
  void lightIsScaledValueByValue_data() {
    QTest::addColumn<int>("form");
    QTest::newRow("own colours") << 0;
    QTest::newRow("shared colours") << 1;
    QTest::newRow("groups") << 2;
  }
  void lightIsScaledValueByValue() {
    QFETCH(int, form);
    Progress quiet;
    TransportMatrix transport = someTransport(form > 0);
    if (form == 2) transport = withSharedLeaves(transport, sharingTolerance, quiet);
    const auto factor = [](std::size_t row, std::size_t) {
      ColourBlock factors;
      for (int i = 0; i < 9; ++i) factors.data()[i] = 0.1f * static_cast<float>((row + 2) % 7 + i % 5);
      return factors;
    };
    const TransportMatrix scaled = transport.withLightScaled(factor);
    for (std::size_t row = 0; row < camera.count(); ++row) {
      const LeafRow before = transport.row(row), after = scaled.row(row);
      QCOMPARE(before.size(), after.size());
      for (std::size_t entry = 0; entry < before.size(); ++entry) {
        const ColourBlock expected = before.block(entry).cwiseProduct(factor(row, 0));
        QVERIFY((after.block(entry) - expected).cwiseAbs().maxCoeff() < 4.0f * 1.1f / 32767.0f);
      }
    }
  }
};

QTEST_GUILESS_MAIN(TestMovedRows)
#include "test_moved_rows.moc"
