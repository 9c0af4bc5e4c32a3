// SPDX-License-Identifier: MIT
// What is told of many photographs, and what is not.
#include "relucent/monitoring/judgement.h"

#include <QtTest>
#include <functional>

#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::monitoring;

namespace {

constexpr Size cells{4, 3};
constexpr double interval = 4.0;

/// A photograph of one projector's light as it was measured, but for noise.
Look asMeasured(std::uint64_t number) {
  Random random({3, number});
  Look look;
  look.light.gain.assign(3, 1.0);
  look.light.deviation.assign(3, 0.006);
  look.light.total = {1.0 + 0.003 * random.normal()};
  look.light.totalDeviation = {0.006};
  look.light.recognised = 1.0;
  look.light.recognisedOf = {1.0};
  look.light.light = 0.3;
  look.light.cells.assign(cells.count(), {1.0, 0.03});
  look.shift.deviation = 0.05;
  return look;
}

/// Without most of the light in the left part of the view, below the uppermost cells.
void shadow(Look& look) {
  look.light.recognised = 0.8;
  look.light.recognisedOf = {0.8};
  for (std::size_t cell : {4u, 5u, 8u, 9u}) look.light.cells[cell].share = 0.1;
}
/// With visitors who take a little of the light beside them too.
void visit(Look& look) {
  look.light.recognised = 0.8;
  look.light.recognisedOf = {0.8};
  look.light.total[0] -= 0.025;
}

}  // namespace

class TestJudgement : public QObject {
  Q_OBJECT

 private slots:
  /// Two minutes of photographs every four seconds.
  void whatStaysIsToldAndVisitorsAreNot_data() {
    using Changes = std::function<void(int number, Look& look)>;
    QTest::addColumn<Changes>("changes");
    QTest::addColumn<QString>("told");  // a kind, or nothing
    const auto row = [](const char* name, const char* told, const Changes& changes) {
      QTest::newRow(name) << changes << QString(told);
    };
    row("nothing happens", "", [](int, Look&) {});
    row("a shadow that stays", "shadowed", [](int number, Look& look) {
      if (number >= 15) shadow(look);
    });
    row("a shadow that stays, pictures differ", "shadowed", [](int number, Look& look) {
      if (number >= 15) shadow(look);
      for (CellLight& cell : look.light.cells) cell.deviation = number % 4 < 2 ? 0.005 : 0.1;
    });
    // In two of five pictures nothing but visitors is seen well, in the others that they have gone.
    row("visitors, pictures differ", "", [](int number, Look& look) {
      if (number % 5 < 2) shadow(look);
      for (CellLight& cell : look.light.cells) cell.deviation = number % 5 < 2 ? 0.005 : 0.1;
    });
    row("so many visitors that nothing is recognised, between dark pictures", "", [](int number, Look& look) {
      const int at = number % 16;
      if (at >= 4) shadow(look);
      if (at == 8 || at == 13) look.use = Look::Use::unrecognised;
      if (at < 4)
        for (CellLight& cell : look.light.cells) cell.deviation = 1.0;
    });
    row("a lamp that faded", "faded", [](int number, Look& look) {
      if (number >= 15) look.light.total[0] -= 0.05;
    });
    row("a lamp that faded, every other photograph with visitors", "faded", [](int number, Look& look) {
      if (number >= 15) look.light.total[0] -= 0.05;
      if (number % 2 == 0) visit(look);
    });
    row("a lamp that is 2 % weaker and seems to be 4 %, which photographs are not sure of", "",
        [](int, Look& look) {
          look.light.total[0] -= 0.04;
          look.light.totalDeviation[0] = 0.013;
        });
    row("a lamp that is 2 % weaker, and visitors for half a minute", "", [](int number, Look& look) {
      look.light.total[0] -= 0.02;
      if (number % 14 >= 5) visit(look);
    });
  }
  void whatStaysIsToldAndVisitorsAreNot() {
    QFETCH(std::function<void(int, Look&)>, changes);
    QFETCH(QString, told);
    Judgement judgement(1, cells, {});
    double toldAt = 0.0;
    for (int number = 0; number < 31; ++number) {
      Look look = asMeasured(static_cast<std::uint64_t>(number));
      changes(number, look);
      judgement.add(look, interval * number);
      if (toldAt == 0.0 && !judgement.findings().empty()) toldAt = interval * number;
      for (const Finding& finding : judgement.findings())
        QCOMPARE(QString::fromStdString(std::string(nameOf(finding.kind))), told);
    }
    QCOMPARE(toldAt > 0.0, !told.isEmpty());
    QVERIFY2(toldAt <= 15 * interval + 60.0, qPrintable(QString::number(toldAt)));
  }

  /// Law: a channel that lost more than the others is told, and what all have lost is no channel's.
  void whatOneChannelLostIsToldOfIt_data() {
    QTest::addColumn<QVector<double>>("lost");  // of red, green, blue
    QTest::addColumn<int>("told");              // of these, or none
    QTest::newRow("blue alone") << QVector<double>{0.0, 0.0, 0.05} << 2;
    QTest::newRow("green alone") << QVector<double>{0.0, 0.05, 0.0} << 1;
    QTest::newRow("red alone, the others seem brighter") << QVector<double>{0.05, -0.01, -0.01} << 0;
    QTest::newRow("2 % of all, blue by more") << QVector<double>{0.018, 0.015, 0.045} << -1;
    QTest::newRow("2 % of all") << QVector<double>{0.02, 0.02, 0.02} << -1;
  }
  void whatOneChannelLostIsToldOfIt() {
    QFETCH(QVector<double>, lost);
    QFETCH(int, told);
    Judgement judgement(1, cells, {});
    for (int number = 0; number < 15; ++number) {
      Look look = asMeasured(static_cast<std::uint64_t>(number));
      for (int k = 0; k < 3; ++k) {
        look.light.gain[static_cast<std::size_t>(k)] -= lost[k];
        look.light.total[0] -= lost[k] / 3.0;
      }
      judgement.add(look, interval * number);
    }
    QCOMPARE(judgement.findings().size(), told < 0 ? 0u : 1u);
    if (told >= 0)
      QCOMPARE(judgement.findings().front().channel, std::optional(static_cast<std::size_t>(told)));
  }

  /// Law: visitors in one projector's light make its light uncertain, whatever the others' share of the view
  /// is, and no other's.
  void visitorsConcernTheProjectorInWhoseLightTheyStand_data() {
    QTest::addColumn<std::size_t>("faded");
    QTest::addColumn<bool>("isTold");
    QTest::newRow("what seems to have faded is behind the visitors") << std::size_t(3) << false;
    QTest::newRow("what faded is another projector") << std::size_t(1) << true;
  }
  void visitorsConcernTheProjectorInWhoseLightTheyStand() {
    QFETCH(std::size_t, faded);
    QFETCH(bool, isTold);
    constexpr std::size_t projectors = 4;
    Judgement judgement(projectors, cells, {});
    for (int number = 0; number < 15; ++number) {
      Look look = asMeasured(static_cast<std::uint64_t>(number));
      look.light.gain.assign(3 * projectors, 1.0);
      look.light.deviation.assign(3 * projectors, 0.006);
      look.light.total.assign(projectors, 1.0);
      look.light.totalDeviation.assign(projectors, 0.006);
      look.light.recognisedOf = {1.0, 1.0, 1.0, 0.8};
      look.light.recognised = 0.95;
      look.light.total[faded] -= 0.045;
      judgement.add(look, interval * number);
    }
    QCOMPARE(!judgement.findings().empty(), isTold);
  }
};

QTEST_GUILESS_MAIN(TestJudgement)
#include "test_judgement.moc"
