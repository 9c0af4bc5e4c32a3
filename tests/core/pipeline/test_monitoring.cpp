// SPDX-License-Identifier: MIT
// A venue that is watched while its show plays: what is told of it, and what is not.
#include <QtTest>

#include "relucent/pipeline/monitoring_rehearsal.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;
using monitoring::FindingKind;

namespace {

Progress quiet;
constexpr double begins = 70.0;

RehearsalSettings settingsOf(const char* venue) {
  RehearsalSettings settings;
  settings.venue.name = venue;
  settings.venue.projector = {40, 30};
  settings.venue.camera = {32, 24};
  settings.venue.pathsPerPixel = 64;
  settings.interval = 2.5;
  return settings;
}

RehearsedTrouble moved() {
  RehearsedTrouble trouble{.at = begins, .expected = FindingKind::moved};
  trouble.changes.emplace().cameras = {{0, 0.21, -0.21, 0.0}};  // 0.3 pixels
  return trouble;
}
RehearsedTrouble lamps(const std::vector<float>& left, FindingKind expected) {
  RehearsedTrouble trouble{.at = begins, .expected = expected};
  for (float share : left) trouble.lamps.push_back({share, share, share});
  return trouble;
}
RehearsedTrouble shadow(std::size_t projector) {
  RehearsedTrouble trouble{.at = begins, .expected = FindingKind::shadowed};
  trouble.shadows = {{projector, 0.4, 0.5, 0.1, 0.18}};
  return trouble;
}

QByteArray described(const std::vector<ToldFinding>& told) {
  QByteArray text;
  for (const ToldFinding& one : told)
    text += QByteArray::number(one.seconds) +
            " s: " + QByteArray::fromStdString(english(sentenceOf(one.finding))) + "; ";
  return text;
}

}  // namespace

class TestMonitoring : public QObject {
  Q_OBJECT

  std::map<std::string, std::unique_ptr<MonitoringRehearsal>> venues_;
  QTemporaryDir cache_;
  MonitoringRehearsal& venue(const char* name) {
    auto& made = venues_[name];
    if (!made)
      made = std::make_unique<MonitoringRehearsal>(settingsOf(name), cache_.path().toStdString(), quiet);
    return *made;
  }

 private slots:
  void whatLastsIsToldWithinAMinute_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<ShownContent>("content");
    QTest::addColumn<std::function<RehearsedTrouble()>>("trouble");
    using Made = std::function<RehearsedTrouble()>;
    for (ShownContent content : {ShownContent::still, ShownContent::film, ShownContent::slides}) {
      const std::string shown(nameOf(content));
      QTest::addRow("%s, moved by 0.3 pixels", shown.c_str())
          << QByteArray("corner") << content << Made(moved);
      QTest::addRow("%s, faded by 5 %%", shown.c_str())
          << QByteArray("corner") << content << Made([] { return lamps({0.95f}, FindingKind::faded); });
      QTest::addRow("%s, a shadow", shown.c_str())
          << QByteArray("corner") << content << Made([] { return shadow(0); });
      QTest::addRow("%s, the projector dead", shown.c_str())
          << QByteArray("corner") << content << Made([] { return lamps({0.0f}, FindingKind::dark); });
    }
    QTest::newRow("slides, one of two faded")
        << QByteArray("relief") << ShownContent::slides
        << Made([] { return lamps({0.95f, 1.0f}, FindingKind::faded); });
    QTest::newRow("dark film, the projector dead") << QByteArray("corner") << ShownContent::dark
                                                   << Made([] { return lamps({0.0f}, FindingKind::dark); });
    QTest::newRow("film, one of two dead") << QByteArray("relief") << ShownContent::film
                                           << Made([] { return lamps({1.0f, 0.0f}, FindingKind::dark); });
  }
  void whatLastsIsToldWithinAMinute() {
    QFETCH(QByteArray, name);
    QFETCH(ShownContent, content);
    QFETCH(std::function<RehearsedTrouble()>, trouble);
    const RehearsedTrouble what = trouble();
    const RehearsalResult result = venue(name.constData()).run(content, begins + 62.0, what, {}, quiet);
    const QByteArray told = described(result.told);
    QVERIFY2(result.falseAlarms(what).empty(), told.constData());
    QVERIFY2(result.toldAfter(what), told.constData());
    QVERIFY2(*result.toldAfter(what) <= 60.0, told.constData());
    QCOMPARE(result.told.front().finding.kind, *what.expected);
    if (what.lamps.size() == 2)  // whose it is
      QCOMPARE(*result.told.front().finding.projector, what.lamps[0][0] < 1.0f ? 0u : 1u);
  }

  /// A lamp that drifts, dusk and dawn, and visitors: one every half minute, of whom half stop.
  void whatGoesAwayIsNotTold_data() {
    QTest::addColumn<ShownContent>("content");
    for (ShownContent content : allValues<ShownContent>())
      QTest::newRow(std::string(nameOf(content)).c_str()) << content;
  }
  void whatGoesAwayIsNotTold() {
    QFETCH(ShownContent, content);
    const RehearsedTrouble none{.at = 1e9};
    const RehearsalResult result =
        venue("corner").run(content, isSanitized ? 200.0 : 1200.0, none, {0.02, 0.9}, quiet);
    QVERIFY2(result.told.empty(), described(result.told).constData());
    QVERIFY2(result.used > 0.9 * result.photographs, qPrintable(QString::number(result.used)));
  }

  /// The moment is found by content, within half of a frame in the middle.
  void photographsAreSynchronisedByContent() {
    const RehearsedTrouble none{.at = 1e9};
    const RehearsalResult result = venue("corner").run(ShownContent::film, 200.0, none, {}, quiet);
    QVERIFY2(result.offBy < 0.02, qPrintable(QString::number(result.offBy)));
  }

  void whatIsPutRightIsNoLongerTold() {
    MonitoringRehearsal& corner = venue("corner");
    RehearsedTrouble trouble = shadow(0);
    trouble.until = begins + 60.0;
    const RehearsalResult result = corner.run(ShownContent::still, begins + 130.0, trouble, {}, quiet);
    QVERIFY2(result.toldAfter(trouble), described(result.told).constData());
    QVERIFY2(result.lasting.empty(), "the shadow has gone");
  }
};

QTEST_GUILESS_MAIN(TestMonitoring)
#include "test_monitoring.moc"
