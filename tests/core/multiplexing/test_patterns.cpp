// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/multiplexing/pattern.h"
#include "relucent/multiplexing/pattern_means.h"

using namespace relucent;
using namespace relucent::multiplexing;
using namespace relucent::transport;

class TestPatterns : public QObject {
  Q_OBJECT

 private slots:
  void everyBlockHasOneColour_data() {
    QTest::addColumn<int>("level");
    for (int level : {0, 1, 3, 7}) QTest::addRow("level %d", level) << level;
  }
  void everyBlockHasOneColour() {
    QFETCH(int, level);
    Rasters projectors({{13, 7}, {5, 3}});
    ProjectorStack pattern = blockPattern(projectors, level, 4, 1);
    QVERIFY(pattern == blockPattern(projectors, level, 4, 1));
    NodeStack means = NodeLayout(projectors).means(pattern);
    NodeLayout layout(projectors);
    for (std::size_t node = 0; node < layout.count(); ++node)
      if (layout.node(node).level <= level)
        for (std::size_t c = 0; c < 3; ++c)
          QVERIFY(means[3 * node + c] == 0.0f || means[3 * node + c] == 1.0f);
  }

  void patternsDiffer() {
    Rasters projectors(Size{32, 32});
    ProjectorStack pattern = blockPattern(projectors, 1, 0, 1);
    QVERIFY(pattern != blockPattern(projectors, 1, 1, 1));
    QVERIFY(pattern != blockPattern(projectors, 1, 0, 2));
    double lit = 0.0;
    for (float value : pattern) lit += static_cast<double>(value);
    // 256 blocks in three channels: half of them, give or take five standard deviations of 1.8 %.
    QVERIFY(std::abs(lit / static_cast<double>(pattern.size()) - 0.5) < 0.09);
  }

  void meansAreThoseOfTheLayout_data() {
    QTest::addColumn<int>("kept");
    for (int kept : {9, 6, 4, 2}) QTest::addRow("%d of 9", kept) << kept;
  }
  /// Of patterns in blocks of every size, also those that are larger than a projector.
  void meansAreThoseOfTheLayout() {
    QFETCH(int, kept);
    Rasters projectors({{13, 7}, {1, 5}});
    NodeLayout layout(projectors);
    PatternMeans means(layout);
    std::vector<ProjectorStack> patterns;
    int next = 0;
    for (int level : {3, 1, 0, 4}) {
      std::vector<ProjectorStack> some;
      for (int i = 0; i < (level == 1 ? 3 : 2); ++i)
        some.push_back(blockPattern(projectors, level, next++, 1));
      means.add(level, some);
      patterns.insert(patterns.end(), some.begin(), some.end());
    }
    QCOMPARE(means.patterns(), patterns.size());
    means.keep(static_cast<std::size_t>(kept));
    patterns.resize(static_cast<std::size_t>(kept));
    QCOMPARE(means.patterns(), patterns.size());
    std::array<std::vector<float>, 3> read;
    for (std::vector<float>& channel : read) channel.resize(patterns.size());
    for (std::size_t node = 0; node < layout.count(); ++node) {
      means.read(means.layout().node(node), {read[0].data(), read[1].data(), read[2].data()});
      for (std::size_t number = 0; number < patterns.size(); ++number)
        for (std::size_t c = 0; c < 3; ++c)
          // Rounded to 1/65535.
          QVERIFY(std::abs(read[c][number] - layout.means(patterns[number])[3 * node + c]) < 1e-5f);
    }
  }
};

QTEST_MAIN(TestPatterns)
#include "test_patterns.moc"
