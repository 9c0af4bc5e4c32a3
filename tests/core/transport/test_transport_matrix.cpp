// SPDX-License-Identifier: MIT
#include <QtTest>
#include <cmath>

#include "random_blocks.h"
#include "relucent/transport/transport_matrix.h"

using namespace relucent;
using namespace relucent::transport;

// What is of cameras cannot be taken for what is of projectors, and costs nothing that a vector does not.
using Relighting = decltype(&TransportMatrix::apply);
static_assert(std::is_invocable_v<Relighting, TransportMatrix, ProjectorStack>);
static_assert(!std::is_invocable_v<Relighting, TransportMatrix, CameraStack>);
static_assert(!std::is_invocable_v<Relighting, TransportMatrix, NodeStack>);
static_assert(!std::is_invocable_v<Relighting, TransportMatrix, Stack>);
static_assert(!std::is_constructible_v<ProjectorStack, CameraStack>);
static_assert(!std::is_assignable_v<ProjectorStack&, CameraStack>);
static_assert(!std::is_convertible_v<CameraMask, ProjectorMask>);
static_assert(sizeof(ProjectorStack) == sizeof(Stack) &&
              std::is_nothrow_move_constructible_v<ProjectorStack>);

namespace {

// Relative error of products in single floats, some hundred terms.
constexpr double rounding = 1e-5;

/// A transport with leaves at every level; `lowest` below zero makes some of them negative, as noise does.
TransportMatrix randomTransport(Rasters cameras, Rasters projectors, std::uint64_t seed,
                                float lowest = 0.0f) {
  NodeLayout layout(projectors);
  return {cameras, projectors, randomBlocks(cameras.count(), layout.count(), 0.2, seed, lowest).sparse};
}

double relativeDifference(const Stack& a, const Stack& b) {
  return (vectorOf(a) - vectorOf(b)).norm() / vectorOf(b).norm();
}

}  // namespace

class TestTransportMatrix : public QObject {
  Q_OBJECT

 private slots:
  void rigs_data() {
    QTest::addColumn<int>("projectors");
    QTest::addColumn<int>("cameras");
    QTest::newRow("1x1") << 1 << 1;
    QTest::newRow("2x1") << 2 << 1;
    QTest::newRow("2x2") << 2 << 2;
  }
  static TransportMatrix ofRig(float lowest = 0.0f) {
    QFETCH(int, projectors);
    QFETCH(int, cameras);
    std::vector<Size> p(static_cast<std::size_t>(projectors), Size{13, 7}),
        c(static_cast<std::size_t>(cameras), Size{9, 5});
    if (projectors > 1) p[1] = {1, 5};
    return randomTransport(c, p, 21, lowest);
  }

  void lightSuperposes_data() { rigs_data(); }
  void lightSuperposes() {
    TransportMatrix transport = ofRig(-0.1f);
    ProjectorStack a(randomStack(transport.projectors().count(), 1)),
        b(randomStack(transport.projectors().count(), 2));
    ProjectorStack sum(a.size());
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = 2.0f * a[i] + 3.0f * b[i];
    CameraStack seenA = transport.apply(a), seenB = transport.apply(b), expected(seenA.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = 2.0f * seenA[i] + 3.0f * seenB[i];
    QVERIFY(relativeDifference(transport.apply(sum), expected) < rounding);
  }

  /// <T p, c> = <p, T^T c>
  void dualPhotographyIsTheAdjoint_data() { rigs_data(); }
  void dualPhotographyIsTheAdjoint() {
    TransportMatrix transport = ofRig(-0.1f);
    ProjectorStack p(randomStack(transport.projectors().count(), 3));
    CameraStack c(randomStack(transport.cameras().count(), 4));
    double left = vectorOf(transport.apply(p)).dot(vectorOf(c));
    double right = vectorOf(p).dot(vectorOf(transport.applyTransposed(c)));
    QVERIFY2(std::abs(left - right) < rounding * left, qPrintable(QString("%1 and %2").arg(left).arg(right)));
  }

  void floodlightIsFullWhiteAndTheSumOfTheRows_data() { rigs_data(); }
  void floodlightIsFullWhiteAndTheSumOfTheRows() {
    TransportMatrix transport = ofRig();
    CameraStack flood = transport.floodlight();
    QVERIFY(relativeDifference(
                flood, transport.apply(ProjectorStack(3 * transport.projectors().count(), 1.0f))) < rounding);
    std::vector<ColourBlock> sums = transport.rowSums();
    for (std::size_t row = 0; row < sums.size(); ++row)
      for (int c = 0; c < 3; ++c)
        QVERIFY(std::abs(sums[row].row(c).sum() - flood[3 * row + static_cast<std::size_t>(c)]) <=
                1e-5f * std::abs(sums[row].row(c).sum()));
  }

  /// Rounding moves each of a row's values by half a step of its scale at most.
  void rescaledRowsSumToTheFloodImage_data() { rigs_data(); }
  void rescaledRowsSumToTheFloodImage() {
    TransportMatrix transport = ofRig();
    CameraStack flood(randomStack(transport.cameras().count(), 5));
    Stack now = transport.floodlight();
    for (std::size_t i = 0; i < flood.size(); ++i) flood[i] = now[i] * (0.5f + flood[i]);
    TransportMatrix rescaled = rescaledToFloodlight(transport, flood);
    Stack sums = rescaled.floodlight();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      std::size_t row = i / 3;
      auto blocks =
          static_cast<float>(rescaled.ownLeaves().rowBegin(row + 1) - rescaled.ownLeaves().rowBegin(row));
      float allowed = 3.0f * blocks * rescaled.ownLeaves().scale(row) * 0.5f + 1e-5f * flood[i];
      QVERIFY2(std::abs(sums[i] - flood[i]) <= allowed,
               qPrintable(QString("%1: %2, flood %3").arg(i).arg(sums[i]).arg(flood[i])));
    }
  }

  void channelsBelowTheFloorAreLeftAlone() {
    TransportMatrix transport = randomTransport(Size{3, 1}, Size{4, 4}, 6);
    Stack now = transport.floodlight();
    CameraStack flood(now.size(), 1.0f);
    TransportMatrix same = rescaledToFloodlight(transport, flood, *std::max_element(now.begin(), now.end()));
    QVERIFY(same.ownLeaves() == transport.ownLeaves());
  }

  void thresholds_data() {
    QTest::addColumn<double>("absolute");
    QTest::addColumn<double>("share");
    QTest::newRow("none") << 0.0 << 0.0;
    QTest::newRow("paper: a value") << 0.02 << 0.0;
    QTest::newRow("share of the row") << 0.0 << 0.3;
    QTest::newRow("both") << 0.05 << 0.1;
    QTest::newRow("above everything") << 1e9 << 0.0;
  }
  void thresholdNeverAddsEnergy_data() { thresholds_data(); }
  void thresholdNeverAddsEnergy() {
    QFETCH(double, absolute);
    QFETCH(double, share);
    TransportMatrix transport = randomTransport(Size{9, 5}, Size{13, 7}, 22);
    CameraStack flood = transport.floodlight();
    TransportMatrix cut =
        thresholded(transport, {static_cast<float>(absolute), static_cast<float>(share)}, flood);
    Stack sums = cut.floodlight();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      std::size_t row = i / 3;
      auto blocks = static_cast<float>(cut.ownLeaves().rowBegin(row + 1) - cut.ownLeaves().rowBegin(row));
      QVERIFY(blocks > 0 || flood[i] == 0.0f);
      float allowed = 3.0f * blocks * cut.ownLeaves().scale(row) * 0.5f + 1e-5f * flood[i];
      QVERIFY2(std::abs(sums[i] - flood[i]) <= allowed,
               qPrintable(QString("%1: %2, flood %3").arg(i).arg(sums[i]).arg(flood[i])));
    }
    QVERIFY(cut.ownLeaves().blocks() <= transport.ownLeaves().blocks());
    if (absolute > 1e3) QCOMPARE(cut.ownLeaves().blocks(), transport.cameras().count());
  }

  void leavesMustFitTheRig() {
    BlockSparse leaves = randomBlocks(4, 5, 1.0, 1).sparse;
    QVERIFY_EXCEPTION_THROWN(TransportMatrix(Size{2, 2}, Size{2, 2}, randomBlocks(4, 4, 1.0, 1).sparse),
                             std::logic_error);
    QVERIFY_EXCEPTION_THROWN(TransportMatrix(Size{2, 1}, Size{2, 2}, leaves), std::logic_error);
    TransportMatrix fits(Size{2, 2}, Size{2, 2}, leaves);
    QCOMPARE(fits.floodlight().size(), std::size_t{12});
  }
};

QTEST_APPLESS_MAIN(TestTransportMatrix)
#include "test_transport_matrix.moc"
