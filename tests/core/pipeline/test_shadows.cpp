// SPDX-License-Identifier: MIT
// Shadows of visitors in simulated venues, filled while a show plays: by photographs alone.
#include <QtTest>
#include <cmath>

#include "relucent/pipeline/shadow_rehearsal.h"
#include "support/sanitized.h"

using namespace relucent;
using namespace relucent::pipeline;
using venue::Silhouette;

namespace {

Progress quiet;
constexpr double comes = 0.6, goes = 1.8;
// Seconds until the third photograph without him, by which nothing is held back.
constexpr double taken = 0.2;

ShadowRehearsalSettings settingsOf(const char* name) {
  ShadowRehearsalSettings settings;
  settings.venue.name = name;
  settings.venue.projector = {40, 30};
  settings.venue.camera = {36, 27};
  settings.venue.pathsPerPixel = 32;
  return settings;
}

InTheWay between(const std::vector<Silhouette>& who) {
  return
      [who](double seconds) { return seconds >= comes && seconds < goes ? who : std::vector<Silhouette>(); };
}

struct Means {
  double filled = 0.0, unfilled = 0.0, possible = 0.0, unshadowed = 0.0, beside = 0.0, besideUnshadowed = 0.0;
};
/// Of the pictures while he stands there, from the third photograph on.
Means meansOf(const ShadowRehearsalResult& result) {
  Means means;
  double count = 0.0;
  int seen = 0;
  for (const ShadowedPicture& one : result.pictures) {
    if (one.seconds < comes || one.seconds >= goes || ++seen < 3) continue;
    means.filled += one.filled;
    means.unfilled += one.unfilled;
    means.possible += one.possible;
    means.unshadowed += one.unshadowed;
    means.beside += one.beside;
    means.besideUnshadowed += one.besideUnshadowed;
    count += 1.0;
  }
  for (double* value : {&means.filled, &means.unfilled, &means.possible, &means.unshadowed, &means.beside,
                        &means.besideUnshadowed})
    *value /= count;
  return means;
}

}  // namespace

class TestShadows : public QObject {
  Q_OBJECT

  QTemporaryDir cache_;
  std::map<std::string, std::unique_ptr<ShadowRehearsal>> venues_;
  ShadowRehearsal& venue(const char* name) {
    auto& made = venues_[name];
    if (!made) made = std::make_unique<ShadowRehearsal>(settingsOf(name), cache_.path().toStdString(), quiet);
    return *made;
  }

 private slots:
  void aShadowIsFilledByTheThirdPhotographAndTakenBack_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<ShownContent>("content");
    QTest::addColumn<int>("seed");
    QTest::addColumn<int>("projector");
    QTest::addColumn<double>("x");
    QTest::newRow("relief, still, first") << QByteArray("relief") << ShownContent::still << 1 << 0 << 0.35;
    QTest::newRow("relief, still, second") << QByteArray("relief") << ShownContent::still << 2 << 1 << 0.4;
    if (isSanitized) return;
    QTest::newRow("relief, film, left") << QByteArray("relief") << ShownContent::film << 2 << 0 << 0.35;
    QTest::newRow("relief, film, second") << QByteArray("relief") << ShownContent::film << 2 << 1 << 0.5;
  }
  void aShadowIsFilledByTheThirdPhotographAndTakenBack() {
    QFETCH(QByteArray, name);
    QFETCH(ShownContent, content);
    QFETCH(int, seed);
    QFETCH(int, projector);
    QFETCH(double, x);
    venue(name).setSeed(static_cast<std::uint64_t>(seed));
    const Silhouette who{static_cast<std::size_t>(projector), x, 0.6, 0.1, 0.3};
    const ShadowRehearsalResult result = venue(name).run({content, 3.2, between({who})}, quiet);
    const Means means = meansOf(result);
    const QString told = QString("%1 of %2, %3 possible, %4 alone; beside %5 of %6")
                             .arg(means.filled)
                             .arg(means.unfilled)
                             .arg(means.possible)
                             .arg(means.unshadowed)
                             .arg(means.beside)
                             .arg(means.besideUnshadowed);
    // From the third photograph on, most of what the other projector can give is there.
    QVERIFY2(means.possible < 0.85 * means.unfilled, qPrintable(told));
    QVERIFY2(means.unfilled - means.filled > 0.6 * (means.unfilled - means.possible), qPrintable(told));
    QVERIFY2(means.beside < means.besideUnshadowed + 0.5, qPrintable(told));
    QCOMPARE(result.falseFills, 0);
    for (const ShadowedPicture& one : result.pictures) {
      if (one.seconds < comes) QVERIFY(one.cells == 0 && !one.isOther);
      if (one.seconds > goes + taken) QCOMPARE(one.cells, 0u);
    }
    QVERIFY(std::abs(result.pictures.back().beside - result.pictures.back().besideUnshadowed) < 0.05);
  }

  /// Nobody there: what is shown is, bit by bit, what is shown while nobody looks.
  void withoutVisitorsNothingIsOtherThanBefore_data() {
    QTest::addColumn<ShownContent>("content");
    QTest::newRow("still") << ShownContent::still;
    QTest::newRow("film") << ShownContent::film;
  }
  void withoutVisitorsNothingIsOtherThanBefore() {
    QFETCH(ShownContent, content);
    venue("relief").setSeed(1);
    ShadowRehearsal::Run run{content, 1.2, {}, true, false, true};
    const ShadowRehearsalResult with = venue("relief").run(run, quiet);
    run.fills = false;
    QVERIFY(with.words == venue("relief").run(run, quiet).words);
    QCOMPARE(with.followed, 0);
  }

  /// Who stands before the camera, in nobody's light, makes nothing worse.
  void whoOnlyHidesThePictureChangesNothing() {
    venue("relief").setSeed(1);
    const Silhouette body{{}, 0.45, 0.6, 0.08, 0.35};
    const ShadowRehearsalResult result =
        venue("relief").run({ShownContent::still, 2.0, between({body})}, quiet);
    const ShadowedPicture& last = result.pictures.back();
    QVERIFY(last.cells == 0);
    for (const ShadowedPicture& one : result.pictures)
      QVERIFY2(one.beside < one.besideUnshadowed + 0.3, qPrintable(QString::number(one.beside)));
  }

  /// Nobody can take over.
  void whereBothAreBlockedAllIsLeftAsItIs() {
    venue("relief").setSeed(1);
    const std::vector<Silhouette> who{{0, 0.5, 0.5, 0.2, 0.4}, {1, 0.5, 0.5, 0.2, 0.4}};
    const Means means = meansOf(venue("relief").run({ShownContent::still, 1.8, between(who)}, quiet));
    QVERIFY2(means.filled < means.unfilled + 0.3,
             qPrintable(QString("%1 of %2").arg(means.filled).arg(means.unfilled)));
  }
};

QTEST_GUILESS_MAIN(TestShadows)
#include "test_shadows.moc"
