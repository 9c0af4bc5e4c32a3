// SPDX-License-Identifier: MIT
// Calibrations of venues that have changed since, and what becomes of them.
#include "relucent/pipeline/repair.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "relucent/base/error.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/leftovers.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/image/exr.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/kept_windows.h"
#include "relucent/pipeline/moved_content.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/venue/device_faults.h"
#include "support/sanitized.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

Progress quiet;

VenueSettings venueNamed(const std::string& name, const Changes& changes = {}) {
  VenueSettings venue;
  venue.name = name;
  venue.projector = {40, 30};
  venue.camera = {40, 30};
  venue.pathsPerPixel = 32;
  venue.changes = changes;
  return venue;
}

Changes changesNamed(const QString& name) {
  Changes changes;
  if (name.contains("bumped")) changes.cameras.push_back({0, 0.9, -0.6, 0.3});
  if (name.contains("nudged")) changes.cameras.push_back({0, 0.12, 0.08, 0.0});
  if (name.contains("knocked")) changes.projectors.push_back({0, -1.2, 0.7, 0.0});
  if (name.contains("aged")) changes.lamps = {0.9, 0.85, 0.75};
  if (name.contains("filtered")) changes.filter = {1.0, 0.85, 0.6};
  if (name.contains("painted")) changes.painted.push_back({{0.45, 0.5}, 0.12});
  if (name.contains("moved")) changes.moved.push_back({{0.4, 0.55}, 0.04});
  if (name.contains("added")) changes.added.push_back({{0.6, 0.5}, 0.15});
  if (name.contains("dusty")) changes.dust = 0.3;
  if (name.contains("brighter room")) changes.ambient = 0.012;
  return changes;
}

CalibrateSettings settingsFor(const std::string& venue, acquisition::AcquisitionMode mode,
                              const Changes& changes = {}) {
  CalibrateSettings settings;
  settings.rig = venueNamed(venue, changes);
  settings.linearization.levels = 9;
  settings.acquisition = acquisition::settingsOf(mode);
  return settings;
}

/// Of pictures that three standard images make in the venue as it has become, by its true light transport.
struct Quality {
  double psnr = 0.0, deltaE = 0.0;  // dB, encoded, of reachable pixels; mean CIEDE2000
};

}  // namespace

class TestRepair : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const { return root() / "cache"; }

  /// A copy of a calibration, measured once.
  fs::path copyOf(const std::string& venue, acquisition::AcquisitionMode mode, const char* name) {
    const fs::path once = root() / fmt::format("{}-{}", venue, nameOf(mode));
    if (!fs::exists(once)) calibrate(once, settingsFor(venue, mode), cache(), quiet);
    fs::path copy = root() / fmt::format("{}-{}-{}", venue, nameOf(mode), name);
    fs::remove_all(copy);
    fs::copy(once, copy, fs::copy_options::recursive);
    return copy;
  }

  Quality qualityOf(const fs::path& folder, const std::string& venue, const Changes& changes) {
    EvaluateSettings settings;
    settings.fewImages = true;
    settings.methods = {compensation::Method::refined};
    settings.rig = venueNamed(venue, changes);
    Quality quality;
    const EvaluateResult result = evaluate(folder, settings, cache(), quiet);
    for (const ImageScore& image : result.images) {
      quality.psnr += image.methods.front().encodedPsnrReachable / static_cast<double>(result.images.size());
      quality.deltaE += image.methods.front().deltaE / static_cast<double>(result.images.size());
    }
    return quality;
  }

  RepairResult repairedAs(const fs::path& folder, const std::string& venue, const Changes& changes,
                          const fs::path& picture = {}) {
    RepairSettings settings;
    settings.image = picture;
    settings.rig = venueNamed(venue, changes);
    return repairCalibration(folder, settings, cache(), quiet);
  }
  static ContentResult predictedIn(const fs::path& folder) {
    const CalibrationFolder reading = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    return resultFrom<Stage::content>(*resultOf(reading, Stage::content));
  }
  /// What lies in a calibration, by names.
  static std::set<std::string> entriesOf(const fs::path& folder) {
    std::set<std::string> entries;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      entries.insert(fs::relative(entry.path(), folder).string());
    return entries;
  }
  static std::string correctionOf(const fs::path& folder) {
    return fingerprintOfCorrection(CalibrationFolder::open(folder, CalibrationFolder::Access::read));
  }

 private slots:
  void asGoodAsMeasuredAnew_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<QString>("change");
    QTest::addColumn<int>("mode");
    using Mode = acquisition::AcquisitionMode;
    const auto row = [](const char* venue, const char* change, Mode mode = Mode::multiplexed) {
      QTest::addRow("%s, %s, %s", venue, change, std::string(nameOf(mode)).c_str())
          << venue << change << static_cast<int>(mode);
    };
    for (const char* change : {"bumped", "nudged", "knocked", "aged", "filtered", "painted", "moved", "added",
                               "dusty", "brighter room", "painted, aged, brighter room"})
      row("corner", change);
    row("depth", "moved");
    row("glass", "bumped");
    row("dome", "painted, aged");
    row("statue", "painted");
    row("glass", "dusty");
    row("statue3", "painted, bumped");
    row("corner", "painted", Mode::adaptive);
    row("corner", "aged, moved", Mode::fast);
  }
  /// Within half a decibel of a new measurement by the true light transport, and not worse than before.
  void asGoodAsMeasuredAnew() {
    QFETCH(QString, venue);
    QFETCH(QString, change);
    QFETCH(int, mode);
    const auto how = static_cast<acquisition::AcquisitionMode>(mode);
    const std::string name = venue.toStdString();
    const Changes changes = changesNamed(change);
    const fs::path folder = copyOf(name, how, "repaired"), fresh = root() / "fresh";
    if (isSanitized) {  // qualities are compared without sanitizers
      const std::string correction = correctionOf(folder);
      const RepairEnd end = repairedAs(folder, name, changes).end;
      QVERIFY(end != RepairEnd::nothingToDo);
      QCOMPARE(correctionOf(folder) != correction, end == RepairEnd::repaired);
      return;
    }
    fs::remove_all(fresh);
    calibrate(fresh, settingsFor(name, how, changes), cache(), quiet);
    const Quality before = qualityOf(folder, name, changes), anew = qualityOf(fresh, name, changes);
    const std::string correction = correctionOf(folder);
    const RepairResult result = repairedAs(folder, name, changes);
    const Quality after = qualityOf(folder, name, changes);
    const QString figures = QString("%1: %2 -> %3 dB, anew %4; %5 -> %6, anew %7; measured %8")
                                .arg(QString::fromStdString(std::string(nameOf(result.end))))
                                .arg(before.psnr)
                                .arg(after.psnr)
                                .arg(anew.psnr)
                                .arg(before.deltaE)
                                .arg(after.deltaE)
                                .arg(anew.deltaE)
                                .arg(result.measured);
    qInfo().noquote() << figures;
    QVERIFY2(after.psnr > anew.psnr - 0.5, qPrintable(figures));
    QVERIFY2(after.deltaE < 1.05 * anew.deltaE, qPrintable(figures));
    // Each is held against a white of its own: a tenth of a decibel is no loss.
    QVERIFY2(after.psnr > std::min(before.psnr, anew.psnr) - 0.1, qPrintable(figures));
    QVERIFY2(after.deltaE < 1.02 * before.deltaE, qPrintable(figures));
    QCOMPARE(correctionOf(folder) != correction, result.end == RepairEnd::repaired);
    // What another light or other colours of a surface explain is not measured again.
    const bool isElsewhere = change.contains("bumped") || change.contains("nudged") ||
                             change.contains("knocked") || change.contains("moved") ||
                             change.contains("added");
    if (!isElsewhere) QVERIFY2(result.measured < 0.01, qPrintable(figures));
    for (const Message& what : result.what) QVERIFY(!english(what).empty());
  }

  void whatIsAsItWasIsLeft() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "same");
    const std::string correction = correctionOf(folder);
    const RepairResult result = repairedAs(folder, "corner", {});
    QCOMPARE(result.end, RepairEnd::nothingToDo);
    QVERIFY(result.what.empty() && result.before.empty());
    QCOMPARE(result.measured, 0.0);
    QCOMPARE(correctionOf(folder), correction);
    QVERIFY_THROWS_EXCEPTION(Error, undoRepair(folder));
  }

  /// What photographs of a picture do not tell apart is not worth another measurement; what was written for
  /// it is gone.
  void whatNobodySeesIsLeft() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "unseen");
    const std::string correction = correctionOf(folder);
    const std::set<std::string> entries = entriesOf(folder);
    Changes changes;
    changes.lamps = {0.98, 0.98, 0.975};
    const RepairResult result = repairedAs(folder, "corner", changes);
    QCOMPARE(result.end, RepairEnd::notBetter);
    QVERIFY(!result.what.empty() && !result.after.empty());
    QCOMPARE(correctionOf(folder), correction);
    QVERIFY(entriesOf(folder) == entries);
    QVERIFY_THROWS_EXCEPTION(Error, undoRepair(folder));
  }

  /// Law: light of the room alone, which darker pictures show more than the one that is proved, is followed
  /// from where black is seen to be brighter.
  void lightOfTheRoomAloneIsFollowed_data() {
    QTest::addColumn<QString>("venue");
    QTest::addColumn<double>("ambient");  // it was 0.002
    QTest::addColumn<bool>("isFollowed");
    // Of the one that is proved photographs hardly tell these apart.
    const auto row = [](const char* venue, double ambient, bool isFollowed) {
      QTest::addRow("%s, %g", venue, ambient) << venue << ambient << isFollowed;
    };
    row("corner", 0.005, true);
    row("statue", 0.0045, true);
    row("dome", 0.005, true);
    row("corner", 0.003, false);
    row("statue", 0.003, false);
  }
  void lightOfTheRoomAloneIsFollowed() {
    QFETCH(QString, venue);
    QFETCH(double, ambient);
    QFETCH(bool, isFollowed);
    const std::string name = venue.toStdString();
    const fs::path folder = copyOf(name, acquisition::AcquisitionMode::multiplexed, "room");
    Changes changes;
    changes.ambient = ambient;
    const RepairResult result = repairedAs(folder, name, changes);
    QVERIFY(!result.what.empty());
    QVERIFY2((result.end == RepairEnd::repaired) == isFollowed, qPrintable(QString("%1 -> %2, %3 -> %4 dB")
                                                                               .arg(result.before[0].deltaE)
                                                                               .arg(result.after[0].deltaE)
                                                                               .arg(result.before[0].psnr)
                                                                               .arg(result.after[0].psnr)));
  }

  /// There and back: the very measurement from before, which `tidy` has left, and its proofs with it.
  void theWayBack() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "back");
    const std::string correction = correctionOf(folder);
    QCOMPARE(repairedAs(folder, "corner", changesNamed("painted")).end, RepairEnd::repaired);
    QVERIFY(correctionOf(folder) != correction);
    {
      const CalibrationFolder repaired = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
      QVERIFY(replacedResults(repaired).empty());
      const auto note = resultFrom<Stage::acquisition>(*currentResultOf(repaired, Stage::acquisition)).repair;
      QVERIFY(note && !note->what.empty() && note->deltaEAfter < note->deltaEBefore);
      for (Stage stage : {Stage::threshold, Stage::inverse}) {
        const bool wasDone = repaired.latest(stage).has_value();
        QVERIFY(!wasDone || progressOf(repaired, stage) == StageProgress::done);
      }
      // A show that starts does not make them, and they are those that it would make.
      const MeasuredCalibration read = loadCalibration(repaired, quiet);
      inverse::WindowSettings windows;
      windows.ridge = read.ridge;
      const auto kept = keptWindows(repaired, read.venue, windows);
      QVERIFY(kept);
      QVERIFY(*kept == computeWindows(read.venue.transport, read.venue.usable, windows, quiet));
    }
    undoRepair(folder);
    QCOMPARE(correctionOf(folder), correction);
    QVERIFY_THROWS_EXCEPTION(Error, undoRepair(folder));
    const CalibrationFolder back = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    QCOMPARE(replacedResults(back).size(), 1);  // the repaired one
  }

  /// The picture on the surface, by whomever it was placed, and what is not to be lit; and back.
  void contentStandsWhereItStood_data() {
    QTest::addColumn<QString>("change");
    QTest::addColumn<bool>("isPlaced");
    for (const char* change : {"bumped", "painted"}) {
      QTest::addRow("%s, automatic", change) << change << false;
      QTest::addRow("%s, placed by hand", change) << change << true;
    }
  }
  void contentStandsWhereItStood() {
    QFETCH(QString, change);
    QFETCH(bool, isPlaced);
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "stands");
    {
      CalibrationFolder writing = CalibrationFolder::open(folder, CalibrationFolder::Access::write);
      CalibrateSettings settings = settingsOf(writing);
      if (isPlaced) {
        settings.content.corners = compensation::Corners{{{8, 7}, {30, 6}, {31, 22}, {7, 23}}};
        settings.content.masks = {{0, compensation::Outline::lines, {{0.3, 0.3}, {0.5, 0.3}, {0.4, 0.5}}}};
      }
      changeSettings(writing, settings);
      saveSet(writing, "day");
      saveSet(writing, "night");
      storeDecision(writing, ContentResult{0.9, 2.0});
    }
    const Size view = venueNamed("corner").camera;
    const auto settingsIn = [&] {
      return CalibrationFolder::open(folder, CalibrationFolder::Access::read).settings();
    };
    const auto placed = [&] {
      const CalibrationFolder reading = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
      const MeasuredCalibration read = loadCalibration(reading, quiet);
      const compensation::TargetSettings target = targetOf(settingsOf(reading).content);
      return fitTarget(standardImages().front().linear, read.venue, target).corners;
    };
    const calibration::Json before = settingsIn();
    const compensation::Corners then = placed();
    QCOMPARE(repairedAs(folder, "corner", changesNamed(change)).end, RepairEnd::repaired);

    sentinels::Movement moved;
    if (change == "bumped") moved = {0.9, -0.6, 0.3};
    const compensation::Corners now = placed(), expected = movedCorners(then, moved, view);
    // Half a pixel of a view this small is what a repair finds a movement to, and an automatic place may stay
    // where it is within another one.
    for (std::size_t i = 0; i < now.size(); ++i)
      QVERIFY2(std::hypot(now[i][0] - expected[i][0], now[i][1] - expected[i][1]) < (isPlaced ? 0.5 : 1.5),
               qPrintable(QString("%1, %2 instead of %3, %4")
                              .arg(now[i][0])
                              .arg(now[i][1])
                              .arg(expected[i][0])
                              .arg(expected[i][1])));
    {
      const CalibrationFolder reading = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
      QCOMPARE(progressOf(reading, Stage::content), StageProgress::done);
      const TargetSets sets = setsOf(reading);
      QCOMPARE(sets.all.size(), std::size_t{2});
      QVERIFY(sets.all[0].content == sets.all[1].content);  // what is not in use goes with the view, too
      if (isPlaced) QCOMPARE(sets.all[0].content.masks.front().points.size(), std::size_t{3});
    }
    undoRepair(folder);
    QVERIFY(settingsIn() == before);
    QVERIFY(predictedIn(folder) == (ContentResult{0.9, 2.0}));
  }

  /// Law: what is kept of the content is of its own picture, whichever was photographed.
  void whatIsPredictedIsOfTheContent() {
    const fs::path picture = root() / "pale.exr";
    image::Image pale({16, 12}, 3);
    std::ranges::fill(pale.data(), 0.2f);
    image::writeExr(picture, pale, image::ExrType::half);
    std::vector<ContentResult> predicted;
    for (const fs::path& photographed : {fs::path(), picture}) {
      const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "predicted");
      {
        CalibrationFolder writing = CalibrationFolder::open(folder, CalibrationFolder::Access::write);
        storeDecision(writing, ContentResult{0.9, 2.0});
      }
      QCOMPARE(repairedAs(folder, "corner", changesNamed("painted"), photographed).end, RepairEnd::repaired);
      predicted.push_back(predictedIn(folder));
    }
    QVERIFY(predicted.front().reachable != 0.9);
    QVERIFY(predicted.front() == predicted.back());  // cameras' noise is theirs, not the calibration's
  }

  /// Whoever changes it after the repair does not lose that by going back.
  void whatWasPlacedSinceStays() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "since");
    QCOMPARE(repairedAs(folder, "corner", changesNamed("bumped")).end, RepairEnd::repaired);
    const compensation::Corners chosen{{{9, 7}, {30, 6}, {31, 22}, {7, 23}}};
    {
      CalibrationFolder writing = CalibrationFolder::open(folder, CalibrationFolder::Access::write);
      CalibrateSettings settings = settingsOf(writing);
      settings.content.corners = chosen;
      changeSettings(writing, settings);
    }
    undoRepair(folder);
    const CalibrationFolder back = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    QVERIFY(settingsOf(back).content.corners == chosen);
  }

  void twoRepairsLeaveOneWayBack() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "twice");
    QCOMPARE(repairedAs(folder, "corner", changesNamed("painted")).end, RepairEnd::repaired);
    const std::string once = correctionOf(folder);
    QCOMPARE(repairedAs(folder, "corner", changesNamed("painted, aged, added")).end, RepairEnd::repaired);
    {
      const CalibrationFolder twice = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
      const std::vector<fs::path> replaced = replacedResults(twice);
      QCOMPARE(replaced.size(), 1);  // the first measurement
      for (const fs::path& result : replaced) fs::remove_all(result);
    }
    undoRepair(folder);
    QCOMPARE(correctionOf(folder), once);
    QVERIFY_THROWS_EXCEPTION(Error, undoRepair(folder));  // what it was made from is gone
    QCOMPARE(correctionOf(folder), once);
  }

  void disturbancesLeaveItAsItWas_data() {
    QTest::addColumn<int>("fault");
    QTest::addColumn<double>("amount");
    QTest::newRow("covered") << static_cast<int>(FaultKind::coveredLens) << 0.0;
    QTest::newRow("asleep") << static_cast<int>(FaultKind::asleepProjector) << 0.0;
    QTest::newRow("unplugged") << static_cast<int>(FaultKind::unplugged) << 0.0;
    QTest::newRow("flicker") << static_cast<int>(FaultKind::flicker) << 0.2;
  }
  void disturbancesLeaveItAsItWas() {
    QFETCH(int, fault);
    QFETCH(double, amount);
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "disturbed");
    const std::string correction = correctionOf(folder);
    SimulatedVenue venue(venueNamed("corner", changesNamed("painted")), cache(), quiet);
    const auto schedule = std::make_shared<FaultSchedule>();
    schedule->faults.push_back({static_cast<FaultKind>(fault), "repair", 0, 100000, amount});
    rig::Rig rig = venue.rig(schedule);
    try {
      repairCalibration(folder, {}, rig, quiet);
      QFAIL("nothing was said");
    } catch (const Error& error) {
      QVERIFY2(error.kind() == ErrorKind::device, error.what());
      QVERIFY(!english(error.sentence()).empty());
    }
    QCOMPARE(correctionOf(folder), correction);
  }
  /// Somebody walks by: what was disturbed is photographed again.
  void whoWalksByIsWaitedFor() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "visited");
    SimulatedVenue venue(venueNamed("corner", changesNamed("painted")), cache(), quiet);
    const auto schedule = std::make_shared<FaultSchedule>();
    DeviceFault hand{FaultKind::hand, "repair", 18, 30};
    hand.x0 = 0.2, hand.x1 = 0.7, hand.y0 = 0.3, hand.y1 = 0.9;
    schedule->faults.push_back(hand);
    rig::Rig rig = venue.rig(schedule);
    const Changes changes = changesNamed("painted");
    const Quality before = isSanitized ? Quality() : qualityOf(folder, "corner", changes);
    try {
      repairCalibration(folder, {}, rig, quiet);
    } catch (const Error& error) {  // or somebody is told that it was too much
      QVERIFY2(error.kind() == ErrorKind::device, error.what());
    }
    if (!isSanitized) QVERIFY(qualityOf(folder, "corner", changes).psnr > before.psnr - 0.05);
  }

  void onlyOneMayChangeIt() {
    const fs::path folder = copyOf("corner", acquisition::AcquisitionMode::multiplexed, "shared");
    const std::string correction = correctionOf(folder);
    const std::set<std::string> entries = entriesOf(folder);
    const CalibrationFolder reader = CalibrationFolder::open(folder, CalibrationFolder::Access::read);
    QVERIFY_THROWS_EXCEPTION(Error, repairedAs(folder, "corner", changesNamed("painted")));
    QCOMPARE(correctionOf(folder), correction);
    QVERIFY(entriesOf(folder) == entries);
  }
};

QTEST_GUILESS_MAIN(TestRepair)
#include "test_repair.moc"
