// SPDX-License-Identifier: MIT
// Calibrations whose cameras have more pixels than the projection needs.
#include "relucent/pipeline/reductions.h"

#include <QTemporaryDir>
#include <QTest>
#include <optional>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/results.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/calibration/stage_progress.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/devices.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/pipeline/memory_needed.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/pipeline/verify.h"
#include "support/sanitized.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::image;
using namespace relucent::linearization;
using namespace relucent::pipeline;
using namespace relucent::reduction;
using namespace relucent::transport;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

CalibrateSettings settingsFor(Size camera, const PixelUse& pixels = {}, const char* scene = "corner") {
  VenueSettings venue;
  venue.name = scene;
  venue.projector = {32, 24};
  venue.camera = camera;
  venue.pathsPerPixel = 32;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 9;
  settings.pixels = pixels;
  return settings;
}

/// Counts what it is told to show.
class CountedProjector : public rig::Projector {
 public:
  CountedProjector(std::unique_ptr<rig::Projector> projector, int& patterns)
      : projector_(std::move(projector)), patterns_(patterns) {}
  std::string name() const override { return projector_->name(); }
  Size size() const override { return projector_->size(); }
  int bits() const override { return projector_->bits(); }
  void show(const Image& encodedDrive) override {
    ++patterns_;
    projector_->show(encodedDrive);
  }

 private:
  std::unique_ptr<rig::Projector> projector_;
  int& patterns_;
};

}  // namespace

class TestReductions : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  fs::path path(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }
  fs::path cache() const { return path("cache"); }
  CalibrationFolder opened(const std::string& name) const {
    return CalibrationFolder::open(path(name), CalibrationFolder::Access::write);
  }
  std::optional<CalibrateResult> many_;
  /// A calibration whose camera has many more pixels than are needed, measured once.
  std::string many() {
    Progress quiet;
    if (!many_) many_ = calibrate(path("many"), settingsFor({128, 96}), cache(), quiet);
    return "many";
  }

 private slots:
  /// Whoever has no more camera pixels than needed has what there was before.
  void fewPixelsAreUsedAsTheyAre() {
    Progress quiet;
    calibrate(path("few"), settingsFor({30, 22}), cache(), quiet);
    calibrate(path("all"), settingsFor({30, 22}, {PixelUse::Kind::all}), cache(), quiet);
    CalibrationFolder few = opened("few"), all = opened("all");
    QVERIFY(!few.settings().contains("reduction"));
    QCOMPARE(fingerprintOf(few, Stage::acquisition), fingerprintOf(all, Stage::acquisition));
    QVERIFY(loadAcquisition(*few.latest(Stage::acquisition)).transport.ownLeaves() ==
            loadAcquisition(*all.latest(Stage::acquisition)).transport.ownLeaves());
  }

  /// The reduced camera measures what the same camera would with larger pixels: not less well than one that
  /// has as many pixels and a sample's full well each.
  void manyPixelsAreReduced_data() {
    QTest::addColumn<QString>("scene");
    for (const char* scene : {"corner", "plain", "depth"}) {
      QTest::newRow(scene) << scene;
      if (isSanitized) break;
    }
  }
  void manyPixelsAreReduced() {
    QFETCH(QString, scene);
    const std::string name = scene == "corner" ? many() : "many " + scene.toStdString();
    const std::string sceneName = scene.toStdString();
    Progress quiet;
    const CalibrateResult result =
        scene == "corner"
            ? *many_
            : calibrate(path(name), settingsFor({128, 96}, {}, sceneName.c_str()), cache(), quiet);
    const std::vector<Reduction> reductions = reductionsOf(opened(name));
    QCOMPARE(reductions.size(), std::size_t{1});
    QVERIFY(reductions[0].bin >= 2);
    const Acquisition acquisition = loadAcquisition(*opened(name).latest(Stage::acquisition));
    QCOMPARE(acquisition.transport.cameras(), Rasters(reductions[0].size()));
    bool told = false;
    for (const Message& finding : result.findings) told = told || finding.id() == "reduction.binned";
    QVERIFY(told);

    if (isSanitized) return;  // qualities are compared without sanitizers
    calibrate(path(name + " small"), settingsFor({32, 24}, {}, sceneName.c_str()), cache(), quiet);
    EvaluateSettings evaluation;
    evaluation.fewImages = true;  // a night has little light to gain
    evaluation.methods = {compensation::Method::none, compensation::Method::refined};
    const EvaluateResult reduced = evaluate(path(name), evaluation, cache(), quiet);
    const EvaluateResult small = evaluate(path(name + " small"), evaluation, cache(), quiet);
    QVERIFY2(reduced.transport.frobenius < 1.1 * small.transport.frobenius,
             qPrintable(QString("T is off by %1, by %2 with a small camera")
                            .arg(reduced.transport.frobenius)
                            .arg(small.transport.frobenius)));
    QVERIFY(std::abs(reduced.transport.energy - 1.0) < 0.01);
    for (const ImageScore& score : reduced.images)
      QVERIFY(score.methods[1].psnrReachable > score.methods[0].psnrReachable + 3.0);
  }

  /// The law of every calibration: what was interrupted ends in the same bits.
  void aReductionIsChosenOnce() {
    Progress quiet;
    const std::string undisturbed = many();
    {
      CalibrationFolder folder = beginCalibration(path("in parts"), settingsFor({128, 96}));
      OpenedRig devices = openRig(settingsOf(folder).rig, cache(), quiet);
      measureLinearization(folder, devices.rig, quiet);
    }
    const std::string chosen = opened("in parts").settings().at("reduction").dump();
    resume(path("in parts"), cache(), quiet);
    CalibrationFolder parts = opened("in parts"), whole = opened(undisturbed);
    QCOMPARE(parts.settings().at("reduction").dump(), chosen);
    QCOMPARE(chosen, whole.settings().at("reduction").dump());
    QVERIFY(loadAcquisition(*parts.latest(Stage::acquisition)).transport.ownLeaves() ==
            loadAcquisition(*whole.latest(Stage::acquisition)).transport.ownLeaves());
  }

  /// Photographs that are there already are of the size that was used then.
  void whatWasBegunWithAllPixelsGoesOnWithThem() {
    Progress quiet;
    CalibrationFolder folder = beginCalibration(path("begun"), settingsFor({128, 96}));
    createFolder(folder.shotFolder());
    writeFileAtomically(folder.shotFolder() / "linearization-000000-00000000.shot", "of an earlier version");
    OpenedRig devices = openRig(settingsOf(folder).rig, cache(), quiet);
    chooseReductions(folder, devices.rig, quiet);
    QVERIFY(!folder.settings().contains("reduction"));
    QCOMPARE(reducedRig(folder, devices.rig).cameras[0]->size(), (Size{128, 96}));
  }
  void earlierCalibrationsHaveAllPixels() {
    CalibrationFolder folder = beginCalibration(path("earlier"), settingsFor({128, 96}));
    Json settings = folder.settings();
    settings.erase("camera_pixels");
    folder.setSettings(settings);
    QVERIFY(settingsOf(folder).pixels.kind == PixelUse::Kind::all);
  }

  void othersMayBeWantedLater() {
    Progress quiet;
    CalibrationFolder folder =
        beginCalibration(path("changed"), settingsFor({128, 96}, {PixelUse::Kind::all}));
    OpenedRig devices = openRig(settingsOf(folder).rig, cache(), quiet);
    measureLinearization(folder, devices.rig, quiet);
    QVERIFY(reductionsOf(folder).empty());
    const PixelUse halves{PixelUse::Kind::binned, 2};
    changePixels(folder, halves);
    QVERIFY(progressOf(folder, Stage::linearization) != StageProgress::done);
    measureLinearization(folder, devices.rig, quiet);
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
    QCOMPARE(reductionsOf(folder).at(0).bin, 2);
    QVERIFY(settingsOf(folder).pixels == halves);
    // What was measured with all of them is still there.
    changePixels(folder, {PixelUse::Kind::all});
    QVERIFY(progressOf(folder, Stage::linearization) == StageProgress::done);
  }

  /// Automatic pixels are as many as there is memory for; one sentence says so, later as well.
  void automaticPixelsFitIntoMemory_data() {
    QTest::addColumn<int>("larger");
    for (int larger : {0, 1, 2}) QTest::addRow("bins %d larger", larger) << larger;
  }
  void automaticPixelsFitIntoMemory() {
    QFETCH(int, larger);
    Progress quiet;
    CalibrateSettings settings = settingsFor({256, 192});
    std::get<VenueSettings>(settings.rig).pathsPerPixel = 4;  // where light is, is enough
    OpenedRig devices = openRig(settings.rig, cache(), quiet);
    auto chosen = [&](const std::string& name, const PixelUse& use, const platform::MemoryUse& memory) {
      CalibrateSettings own = settings;
      own.pixels = use;
      CalibrationFolder folder = beginCalibration(path(std::string(QTest::currentDataTag()) + name), own);
      chooseReductions(folder, devices.rig, memory, quiet);
      return reductionsOf(folder).at(0);
    };
    constexpr platform::MemoryUse plenty{std::uint64_t{1} << 40, std::uint64_t{1} << 40};
    const Reduction suitable = chosen(" suitable", {}, plenty);
    const PixelUse wanted{PixelUse::Kind::binned, suitable.bin + larger};
    const Rasters size(chosen(" wanted", wanted, plenty).size());
    const platform::MemoryUse needed =
        memoryNeeded(size, devices.rig.projectorRasters(), settings.acquisition);
    QVERIFY(needed.resident < needed.addressSpace);
    const Reduction found = chosen(" found", {}, {needed.resident, plenty.addressSpace});
    const Reduction mapped = chosen(" mapped", {}, {plenty.resident, needed.addressSpace});
    QVERIFY(mapped == found);
    QCOMPARE(Rasters(found.size()), size);
    QCOMPARE(found.savesMemory, larger > 0);
    const std::vector<Message> findings = findingsOf({found});
    QCOMPARE(findings.size(), std::size_t{1});
    QCOMPARE(findings[0].id() == "reduction.binned-for-memory", larger > 0);
  }

  /// What fitted when it was chosen need not fit later, and then needs nothing to spare.
  void laterMemoryIsLookedAtAgain() {
    Progress quiet;
    const CalibrateSettings settings = settingsFor({128, 96});
    const OpenedRig devices = openRig(settings.rig, cache(), quiet);
    const platform::MemoryUse chosen =
        memoryNeeded(devices.rig.cameraRasters(), devices.rig.projectorRasters(), settings.acquisition);
    constexpr std::uint64_t plenty = std::uint64_t{1} << 40;
    ensureMemory(devices.rig, settings, {chosen.resident * 3 / 4, plenty});
    const std::string sentence =
        sentenceOf([&] { ensureMemory(devices.rig, settings, {1'000'000, plenty}); }, ErrorKind::memory);
    QVERIFY(mentions(sentence, "0.00 GB may be taken"));
    QVERIFY(mentions(
        sentenceOf([&] { ensureMemory(devices.rig, settings, {plenty, 20'000'000}); }, ErrorKind::memory),
        "0.02 GB may be taken"));
  }

  void tooLittleMemoryIsRefusedBeforeTheFirstPhotograph_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("advice");
    QTest::newRow("automatic") << static_cast<int>(PixelUse::Kind::automatic) << "a limit with more memory";
    QTest::newRow("all") << static_cast<int>(PixelUse::Kind::all) << "choose fewer camera pixels";
    QTest::newRow("binned") << static_cast<int>(PixelUse::Kind::binned) << "choose fewer camera pixels";
  }
  void tooLittleMemoryIsRefusedBeforeTheFirstPhotograph() {
    QFETCH(int, kind);
    QFETCH(QString, advice);
    Progress quiet;
    const PixelUse use{static_cast<PixelUse::Kind>(kind), 2};
    CalibrateSettings settings = settingsFor({128, 96}, use);
    CalibrationFolder folder =
        beginCalibration(path("refused " + std::string(QTest::currentDataTag())), settings);
    OpenedRig devices = openRig(settings.rig, cache(), quiet);
    constexpr std::uint64_t plenty = std::uint64_t{1} << 40;
    int patterns = 0;
    devices.rig.projectors[0] =
        std::make_unique<CountedProjector>(std::move(devices.rig.projectors[0]), patterns);
    const std::string sentence = sentenceOf(
        [&] { chooseReductions(folder, devices.rig, {100'000'000, plenty}, quiet); }, ErrorKind::memory);
    QVERIFY(mentions(sentence, "0.10 GB may be taken"));
    QVERIFY(mentions(sentence, advice.toStdString()));
    QCOMPARE(patterns, 0);
    QVERIFY(!hasReductions(folder));
    // With more it goes on.
    chooseReductions(folder, devices.rig, {2'000'000'000, plenty}, quiet);
  }

  /// People look at all that the camera sees; figures are of what was measured.
  void aProofShowsAllThatTheCameraSees() {
    Progress quiet;
    const std::string name = many();
    Image content({32, 24}, 3, 0.5f);
    writePng(path("grey.png"), content, 8);
    ProveSettings settings;
    settings.image = path("grey.png");
    settings.out = path("proof");
    const ProveResult result = proveCalibration(path(name), settings, cache(), quiet);
    QVERIFY(result.after.surprise < 0.05);
    const Reduction reduction = reductionsOf(opened(name)).at(0);
    for (const char* shown : {"before", "after"}) {
      const Image whole = readPicture(settings.out / (std::string(shown) + "_whole.png")).encoded;
      const Image used = readPicture(settings.out / (std::string(shown) + ".png")).encoded;
      QCOMPARE(whole.size(), (Size{128, 96}));
      QCOMPARE(used.size(), reduction.size());
      // The same light in the same brightness: codes of bins and the middle of their samples.
      double apart = 0.0, sum = 0.0;
      for (int y = 0; y < used.height(); ++y)
        for (int x = 0; x < used.width(); ++x)
          for (int c = 0; c < 3; ++c) {
            const double mean = static_cast<double>(used.at(x, y, c));
            apart += mean - static_cast<double>(
                                whole.at(reduction.begin.x + x * reduction.bin + reduction.bin / 2,
                                         reduction.begin.y + y * reduction.bin + reduction.bin / 2, c));
            sum += mean;
          }
      QVERIFY2(std::abs(apart) < 0.03 * sum, qPrintable(QString("%1: %2").arg(shown).arg(apart / sum)));
    }
    const VerifyResult verified = verifyCalibration(path(name), {}, cache(), quiet);
    QVERIFY(verified.found.error < 0.1);
  }

  void aDamagedReductionIsSaid_data() {
    QTest::addColumn<QString>("key");
    QTest::addColumn<QString>("value");
    QTest::newRow("no bin") << "bin"
                            << "0";
    QTest::newRow("not on the grid") << "part"
                                     << "[31, 24]";
    QTest::newRow("outside") << "begin"
                             << "[120, 0]";
    QTest::newRow("a sample that is not there") << "defective"
                                                << "[99999999]";
    QTest::newRow("another type") << "clip"
                                  << "\"much\"";
  }
  void aDamagedReductionIsSaid() {
    QFETCH(QString, key);
    QFETCH(QString, value);
    CalibrationFolder folder =
        beginCalibration(path("damaged " + std::string(QTest::currentDataTag())), settingsFor({128, 96}));
    Reduction reduction = reductionTo({128, 96}, {10, 12}, {64, 48}, 2);
    reduction.defective = {5, 77};
    reduction.savesMemory = true;
    keepReductions(folder, {reduction});
    QVERIFY(reductionsOf(folder) == std::vector<Reduction>{reduction});
    Json settings = folder.settings();
    settings["reduction"][0][key.toStdString()] = Json::parse(value.toStdString());
    folder.setSettings(settings);
    QVERIFY_THROWS_EXCEPTION(Error, reductionsOf(folder));
  }
};

QTEST_GUILESS_MAIN(TestReductions)
#include "test_reductions.moc"
