// SPDX-License-Identifier: MIT
// Sets of a calibration: laws of saving, using, renaming and removing them, what belongs to each, bad input.
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <random>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/image/colour.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/masks_file.h"
#include "relucent/pipeline/perfect.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

Progress quiet;

compensation::Mask door() {
  return {0, compensation::Outline::lines, {{0.3, 0.3}, {0.6, 0.3}, {0.6, 0.6}}, 0.02};
}

CalibrateSettings corner() {
  CalibrateSettings settings;
  venue::VenueSettings corner;
  corner.name = "corner";
  corner.projector = {32, 24};
  corner.camera = {32, 24};
  corner.pathsPerPixel = 16;
  settings.rig = corner;
  return settings;
}

void change(CalibrationFolder& folder, double darkShare) {
  CalibrateSettings settings = settingsOf(folder);
  settings.content.reachablePercentile = darkShare;
  changeSettings(folder, settings);
}

/// Why it is refused; empty: it is not.
template <typename Work>
QString refusal(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return QString::fromStdString(error.what());
  }
  return {};
}

}  // namespace

class TestSets : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  static CalibrationFolder read(const fs::path& path) {
    return CalibrationFolder::open(path, CalibrationFolder::Access::read);
  }
  static CalibrationFolder opened(const fs::path& path) {
    return CalibrationFolder::open(path, CalibrationFolder::Access::write);
  }

 private slots:
  /// Whatever is done in whatever order: names are different, one is in use and is the calibration's content,
  /// the others are as they were left, a refused step changes nothing, and a written manifest reads the same.
  void anyOrderKeepsThem() {
    const fs::path path = root() / "any";
    createCalibration(path, corner());
    std::mt19937 random(7);
    const std::vector<std::string> names{"day", "night", "3. Klasse", "夜"};
    std::map<std::string, double> expected;  // what each was left with
    double now = settingsOf(read(path)).content.reachablePercentile;
    for (int step = 0; step < 200; ++step) {
      CalibrationFolder folder = opened(path);
      const TargetSets before = setsOf(folder);
      const std::string name = names[random() % names.size()], other = names[random() % names.size()];
      const auto kind = random() % 5;
      const QString why = refusal([&] {
        if (kind == 0) saveSet(folder, name);
        if (kind == 1) useSet(folder, name);
        if (kind == 2) renameSet(folder, name, other);
        if (kind == 3) removeSet(folder, name);
        if (kind == 4) change(folder, 1.0 + step % 40);
      });
      const TargetSets after = setsOf(folder);
      if (!why.isEmpty()) {
        QCOMPARE(after, before);
        continue;
      }
      if (kind == 0) expected[name] = now;
      if (kind == 1) now = expected.at(name);
      if (kind == 2) {
        auto moved = expected.extract(name);
        moved.key() = other;
        expected.insert(std::move(moved));
      }
      if (kind == 3) expected.erase(name);
      if (kind == 4) now = 1.0 + step % 40;
      if (kind == 4 && !after.all.empty()) expected[after.nameInUse()] = now;
      QCOMPARE(settingsOf(folder).content.reachablePercentile, now);
      QCOMPARE(after.all.size(), expected.size());
      for (const TargetSet& set : after.all) QCOMPARE(set.content.reachablePercentile, expected.at(set.name));
      if (!after.all.empty()) QCOMPARE(after.all[after.inUse].content, settingsOf(folder).content);
    }
    QVERIFY(expected.size() > 1);
    QCOMPARE(setsOf(read(path)).all.size(), expected.size());
  }

  /// What is shown by a set is what is shown where it is in use, and none changes what is shown by another.
  void aSetIsWhatItIsInUse() {
    const fs::path path = root() / "corner", picture = root() / "picture.png";
    calibrate(path, corner(), root() / "cache", quiet);
    image::writePng(picture, image::srgbEncoded(standardImages({32, 24}).front().linear), 8);
    {
      CalibrationFolder folder = opened(path);
      saveSet(folder, "day");
      saveSet(folder, "night");
      keepMasks(folder, {door()});
    }
    const auto pattern = [&](const std::string& set) {
      CompensateSettings settings;
      settings.image = picture;
      settings.out = root() / "out";
      settings.set = set;
      compensate(path, settings, quiet);
      return readFile(settings.out / "pattern.exr");
    };
    const std::string byNight = pattern("night"), byDay = pattern("day");
    QVERIFY(byNight != byDay);
    const std::string shownByNight = fingerprintOfShown(read(path));
    QCOMPARE(fingerprintOfShown(openWithSet(path, "night")), shownByNight);
    QVERIFY(fingerprintOfShown(openWithSet(path, "day")) != shownByNight);
    // Looking at another set writes nothing.
    QCOMPARE(setsOf(read(path)).nameInUse(), std::string("night"));
    {
      CalibrationFolder folder = opened(path);
      useSet(folder, "day");
    }
    QCOMPARE(pattern("night"), byNight);
    QCOMPARE(pattern("day"), byDay);
    // A still that was perfected for another set than the one in use is no rubbish: tidy would remove it.
    const PerfectedPicture kept{"key", path, "picture.png", {}, {}, {}, shownByNight};
    QVERIFY(!isOutOfDate(kept, read(path)));
    CalibrationFolder folder = opened(path);
    removeSet(folder, "night");
    QVERIFY(isOutOfDate(kept, folder));
    // The last one's name goes, and the content stays.
    const ContentSettings content = settingsOf(folder).content;
    removeSet(folder, "day");
    QVERIFY(setsOf(folder).all.empty() && !folder.settings().contains("sets"));
    QCOMPARE(settingsOf(folder).content, content);
  }

  void badNamesAreSentences_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("empty") << QByteArray() << "a set needs a name";
    QTest::newRow("long") << QByteArray(61, 'x') << "at most 60 bytes";
    QTest::newRow("space before") << QByteArray(" day") << "neither begins nor ends with a space";
    QTest::newRow("space behind") << QByteArray("day ") << "neither begins nor ends with a space";
    QTest::newRow("control") << QByteArray("day\nnight") << "plain text";
    QTest::newRow("no UTF-8") << QByteArray("d\xe4y") << "plain text";
  }
  void badNamesAreSentences() {
    QFETCH(QByteArray, name);
    QFETCH(QString, sentence);
    const fs::path path = root() / QTest::currentDataTag();
    CalibrationFolder folder = createCalibration(path, corner());
    const QString why = refusal([&] { saveSet(folder, name.toStdString()); });
    QVERIFY2(why.contains(sentence), qPrintable(why));
    saveSet(folder, "day");
    QVERIFY(refusal([&] { renameSet(folder, "day", name.toStdString()); }).contains(sentence));
    QVERIFY(setsOf(folder).names() == std::vector<std::string>{"day"});
  }

  void whatIsRefused() {
    const fs::path path = root() / "refused";
    CalibrationFolder folder = createCalibration(path, corner());
    QVERIFY(
        refusal([&] { useSet(folder, "day"); }).contains("there is no set 'day'; this calibration has no"));
    saveSet(folder, "day");
    saveSet(folder, "night");
    QVERIFY(refusal([&] { saveSet(folder, "day"); }).contains("there is a set 'day' already"));
    QVERIFY(refusal([&] { renameSet(folder, "day", "night"); }).contains("there is a set 'night' already"));
    QVERIFY(refusal([&] { useSet(folder, "dusk"); }).contains("choose one of day, night"));
    QVERIFY(refusal([&] { removeSet(folder, "night"); }).contains("the set 'night' is in use"));
  }

  void damagedSetsAreASentence_data() {
    QTest::addColumn<QString>("sets");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no object") << "7"
                               << "cannot be read";
    QTest::newRow("no list") << R"({"version": 1, "in_use": "day"})"
                             << "cannot be read";
    QTest::newRow("none in use") << R"({"version": 1, "in_use": "x", "sets": [{"name": "day"}]})"
                                 << "cannot be read";
    QTest::newRow("no content") << R"({"version": 1, "in_use": "x", "sets": [{"name": "x"}, {"name": "y"}]})"
                                << "cannot be read";
    QTest::newRow("twice") << R"({"version": 1, "in_use": "x", "sets": [{"name": "x"}, {"name": "x"}]})"
                           << "cannot be read";
    QTest::newRow("content that cannot be")
        << R"({"in_use": "x", "sets": [{"name": "x"}, {"name": "y", "content": {"reachablePercentile": 900}}]})"
        << "cannot be read";
    QTest::newRow("newer") << R"({"version": 2, "in_use": "x", "sets": []})"
                           << "newer Relucent";
  }
  void damagedSetsAreASentence() {
    QFETCH(QString, sets);
    QFETCH(QString, sentence);
    const fs::path path = root() / "damaged";
    fs::remove_all(path);
    CalibrationFolder folder = createCalibration(path, corner());
    Json settings = folder.settings();
    settings["sets"] = Json::parse(sets.toStdString());
    folder.setSettings(settings);
    const QString why = refusal([&] { setsOf(folder); });
    QVERIFY2(why.contains(sentence), qPrintable(why));
    QVERIFY(!refusal([&] { saveSet(folder, "day"); }).isEmpty());
    QCOMPARE(folder.settings(), settings);
    settingsOf(folder);  // the rest of the calibration opens
  }
};

QTEST_GUILESS_MAIN(TestSets)
#include "test_sets.moc"
