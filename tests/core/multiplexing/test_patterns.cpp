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

  void meansAreThoseOfTheLayout() {
    Rasters projectors({{13, 7}, {1, 5}});
    NodeLayout layout(projectors);
    PatternMeans means(layout);
    std::vector<ProjectorStack> patterns;
    for (int number = 0; number < 5; ++number)
      patterns.push_back(blockPattern(projectors, number % 2, number, 1));
    means.add({patterns[0], patterns[1]});
    means.add({patterns[2], patterns[3], patterns[4]});
    QCOMPARE(means.patterns(), patterns.size());
    std::array<std::vector<float>, 3> read;
    for (std::vector<float>& channel : read) channel.resize(patterns.size());
    for (std::size_t node = 0; node < layout.count(); ++node) {
      means.read(node, {read[0].data(), read[1].data(), read[2].data()});
      for (std::size_t number = 0; number < patterns.size(); ++number)
        for (std::size_t c = 0; c < 3; ++c)
          // Rounded to 1/65535.
          QVERIFY(std::abs(read[c][number] - layout.means(patterns[number])[3 * node + c]) < 1e-5f);
    }
  }
};

QTEST_MAIN(TestPatterns)
#include "test_patterns.moc"
