// SPDX-License-Identifier: MIT
#include "relucent/pipeline/outlook.h"

#include <QTest>
#include <cmath>

#include "relucent/pipeline/expected_transport.h"
#include "relucent/pipeline/outlook_observer.h"
#include "relucent/pipeline/stopped_early.h"
#include "relucent/transport/coarsening.h"
#include "relucent/transport/difference.h"
#include "relucent/transport/statistics.h"
#include "support/scripted_rig.h"

using namespace relucent;
using namespace relucent::pipeline;
using namespace relucent::transport;
using namespace relucent::test;

namespace {

/// A venue measured without noise, as finely as its projector.
Acquisition venueOf(double interreflection, std::uint64_t seed = 1) {
  SyntheticSettings synthetic;
  synthetic.projectors = {{64, 48}};
  synthetic.cameras = {{48, 36}};
  synthetic.interreflection = interreflection;
  synthetic.seed = seed;
  Acquisition acquisition;
  acquisition.transport = syntheticTransport(synthetic);
  acquisition.flood = acquisition.transport.floodlight();
  acquisition.black = CameraStack(acquisition.flood.size(), 1e-3f);
  acquisition.blackVariance = CameraStack(acquisition.flood.size(), 1e-9f);
  acquisition.floodVariance = CameraStack(acquisition.flood.size(), 1e-6f);
  acquisition.flagged.assign(acquisition.flood.size() / 3, 0);
  return acquisition;
}

/// Where a row's light is, on average: projector pixels, and how much of it there is.
std::array<double, 3> centreOf(const TransportMatrix& transport, std::size_t row) {
  const NodeLayout& layout = transport.layout();
  std::array<double, 3> centre{};
  const LeafRow leaves = transport.row(row);
  for (std::size_t entry = 0; entry < leaves.size(); ++entry) {
    const Block block = layout.block(layout.node(leaves.column(entry)));
    const double light = static_cast<double>(leaves.block(entry).sum());
    centre[0] += light * 0.5 * (block.x0 + block.x1);
    centre[1] += light * 0.5 * (block.y0 + block.y1);
    centre[2] += light;
  }
  if (centre[2] > 0.0) centre = {centre[0] / centre[2], centre[1] / centre[2], centre[2]};
  return centre;
}

/// Of where the rows of two T have their light, over the rows that are lit.
double meanDistance(const TransportMatrix& a, const TransportMatrix& b) {
  double sum = 0.0, rows = 0.0;
  for (std::size_t row = 0; row < a.cameras().count(); ++row) {
    const std::array<double, 3> one = centreOf(a, row), other = centreOf(b, row);
    if (!(one[2] > 0.0) || !(other[2] > 0.0)) continue;
    sum += std::hypot(one[0] - other[0], one[1] - other[1]);
    rows += 1.0;
  }
  return sum / rows;
}

/// The same as blocks of 2^level pixels show it.
Draft draftAt(const Acquisition& whole, int level) {
  Draft draft;
  draft.acquisition = coarsened(whole, {0, 0, level});
  draft.level = level;
  return draft;
}

Outlook outlookAt(const Acquisition& whole, int level) {
  Progress quiet;
  return outlookOf(draftAt(whole, level), quiet).value();
}

}  // namespace

class TestOutlook : public QObject {
  Q_OBJECT

 private slots:
  /// Law: light is moved within its leaf, never added.
  void expectedTransportKeepsTheLight() {
    const Draft draft = draftAt(venueOf(0.3), 3);
    const TransportMatrix& coarse = draft.acquisition.transport;
    const TransportMatrix fine = expectedTransport(coarse, CameraMask(coarse.cameras().count(), 1));
    QCOMPARE(finestSide(coarse), 8);
    QCOMPARE(finestSide(fine), 1);
    const CameraStack before = coarse.floodlight(), after = fine.floodlight();
    const float brightest = *std::max_element(before.begin(), before.end());
    for (std::size_t i = 0; i < before.size(); ++i)
      QVERIFY2(std::abs(after[i] - before[i]) < 1e-3f * brightest, qPrintable(QString::number(i)));
  }

  void expectedTransportFindsPlacesInBlocks_data() {
    QTest::addColumn<int>("level");
    for (int level : {2, 3}) QTest::addRow("blocks of %d", 1 << level) << level;
  }
  /// A camera pixel's place in a block is in no photograph of blocks, but in its neighbours'.
  void expectedTransportFindsPlacesInBlocks() {
    QFETCH(int, level);
    const Acquisition whole = venueOf(0.0);
    const TransportMatrix coarse = draftAt(whole, level).acquisition.transport;
    const TransportMatrix fine = expectedTransport(coarse, CameraMask(coarse.cameras().count(), 1));
    const double before = meanDistance(coarse, whole.transport);
    const double after = meanDistance(fine, whole.transport);
    QVERIFY2(after < 0.6 * before, qPrintable(QString("%1 px before, %2 after").arg(before).arg(after)));
  }

  void whatIsNotUsableStaysAsItIs() {
    const TransportMatrix coarse = draftAt(venueOf(0.0), 2).acquisition.transport;
    const TransportMatrix same = expectedTransport(coarse, CameraMask(coarse.cameras().count(), 0));
    QVERIFY(difference(same, coarse).frobenius < 1e-4);
  }

  void finerBlocksShowMore_data() {
    QTest::addColumn<double>("interreflection");
    QTest::addColumn<quint64>("seed");
    QTest::newRow("direct light") << 0.0 << quint64{1};
    QTest::newRow("walls light each other") << 0.5 << quint64{2};
  }
  /// Of what is told at blocks of 4 and of 2, the end is not further away than what is told of now.
  void finerBlocksShowMore() {
    QFETCH(double, interreflection);
    QFETCH(quint64, seed);
    const Acquisition whole = venueOf(interreflection, seed);
    const double end = outlookAt(whole, 0).now;
    double before = 0.0;
    for (int level : {3, 2, 1, 0}) {
      const Outlook outlook = outlookAt(whole, level);
      QCOMPARE(outlook.blocks, 1 << level);
      QVERIFY2(outlook.now > before && outlook.now <= outlook.whole,
               qPrintable(QString("%1 dB now, %2 in the end").arg(outlook.now).arg(outlook.whole)));
      QVERIFY2(
          std::abs(outlook.whole - end) <= std::abs(outlook.now - end),
          qPrintable(
              QString("%1 dB now, %2 expected, %3 in the end").arg(outlook.now).arg(outlook.whole).arg(end)));
      before = outlook.now;
    }
  }

  void lookedAtLessCloselyItIsTheSame_data() {
    QTest::addColumn<int>("level");
    for (int level : {0, 1, 2, 3}) QTest::addRow("blocks of %d", 1 << level) << level;
  }
  /// As a larger camera's draft is: half as closely. What both pixels and blocks hide is known of pictures
  /// only by their statistics.
  void lookedAtLessCloselyItIsTheSame() {
    QFETCH(int, level);
    const Acquisition whole = venueOf(0.3);
    Draft draft = draftAt(whole, level);
    Progress quiet;
    const Outlook closely = outlookOf(draft, quiet).value();
    draft.acquisition = coarsened(draft.acquisition, {1, 1, 0});
    draft.coarsening = 1;
    const Outlook less = outlookOf(draft, quiet).value();
    const QString said = QString("%1 and %2 dB, in the end %3 and %4")
                             .arg(closely.now)
                             .arg(less.now)
                             .arg(closely.whole)
                             .arg(less.whole);
    QCOMPARE(less.blocks, closely.blocks);
    QCOMPARE(less.picture.size(), (Size{24, 18}));
    QVERIFY2(std::abs(less.now - closely.now) < 2.0, qPrintable(said));
  }

  /// PSNR is that of the sum of both errors.
  void anErrorOfTheTransportCounts() {
    const Acquisition whole = venueOf(0.0);
    Draft draft = draftAt(whole, 0);
    Progress quiet;
    const double without = outlookOf(draft, quiet)->now;
    draft.error = 0.01;
    const double some = outlookOf(draft, quiet)->now;
    draft.error = 1.0;
    const double all = outlookOf(draft, quiet)->now;
    QVERIFY(some < without);
    // As large as the light: mean |T p|^2 / white^2 is below 1 and above a hundredth.
    QVERIFY2(all > 0.0 && all < 20.0, qPrintable(QString::number(all)));
    const double light = std::pow(10.0, -0.1 * all) - std::pow(10.0, -0.1 * without);
    const double expected = -10.0 * std::log10(std::pow(10.0, -0.1 * without) + 1e-4 * light);
    QVERIFY2(std::abs(some - expected) < 0.3, qPrintable(QString("%1, %2").arg(some).arg(expected)));
  }

  /// Law: what is expected to be no better than uncorrected is said, with its figure and what to do, of a
  /// measurement to the end and of one that going on with would not help; nothing is said of any other.
  void whatFitsNothingIsSaid_data() {
    QTest::addColumn<double>("now");
    QTest::addColumn<double>("whole");
    QTest::addColumn<bool>("isPoor");
    QTest::newRow("bumped unseen") << -10.0 << -10.0 << true;
    QTest::newRow("as uncorrected") << 15.9 << 15.9 << true;
    QTest::newRow("the wine glass") << 24.6 << 24.6 << false;
    QTest::newRow("stopped early") << 2.0 << 31.0 << false;
    QTest::newRow("stopped early, in vain") << 2.0 << 8.0 << true;
  }
  void whatFitsNothingIsSaid() {
    QFETCH(double, now);
    QFETCH(double, whole);
    QFETCH(bool, isPoor);
    const std::optional<Message> said = poorQuality(ExpectedQuality{now, whole});
    QCOMPARE(said.has_value(), isPoor);
    if (!said) return;
    const QString sentence = QString::fromStdString(english(*said));
    const QString figure = QString("%1 dB").arg(std::lround(whole));
    QVERIFY2(sentence.contains(figure) && sentence.contains("measure again"), qPrintable(sentence));
  }

  void nothingIsSaidOfWhatNobodyWorkedOut() { QVERIFY(!poorQuality(std::nullopt)); }

  void nothingIsSaidWhereNothingIsLit() {
    Acquisition dark = venueOf(0.0);
    dark.flagged.assign(dark.flagged.size(), 1);
    Progress quiet;
    QVERIFY(!outlookOf(draftAt(dark, 0), quiet));
  }

  /// Drafts may come faster than they are worked out; the last is, and nothing comes after last().
  void theLastDraftIsWorkedOut() {
    struct Other : sentinels::AcquisitionObserver {
      void grew(const std::vector<int>&, int through) override { patterns = through; }
      int patterns = 0;
    } other;
    std::vector<int> told;
    OutlookObserver observer(other, [&](const Outlook& outlook) { told.push_back(outlook.blocks); });
    QVERIFY(!observer.last());
    const Acquisition whole = venueOf(0.0);
    for (int level : {3, 2, 1}) {
      observer.grew({10, 20}, 7);
      observer.drafted(draftAt(whole, level));
    }
    QCOMPARE(observer.last()->blocks, 2);
    QVERIFY(!told.empty() && told.size() <= 3);
    QCOMPARE(told.back(), 2);
    QCOMPARE(observer.levels(), (std::vector<int>{10, 20}));
    QCOMPARE(other.patterns, 7);
  }
};

QTEST_GUILESS_MAIN(TestOutlook)
#include "test_outlook.moc"
