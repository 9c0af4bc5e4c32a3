// SPDX-License-Identifier: MIT
// Masks of a calibration: kept, read, and judged by the venue's true light.
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/image/exr.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/masks_file.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/standard_images.h"
#include "relucent/pipeline/stored_settings.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

Progress quiet;

Mask door() {
  return {0, Outline::curve, {{0.42, 0.35}, {0.58, 0.35}, {0.58, 0.65}, {0.42, 0.65}}, 0.05};
}

}  // namespace

class TestMaskedVenue : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path venue() const { return root() / "corner"; }
  CalibrationFolder opened(CalibrationFolder::Access access = CalibrationFolder::Access::read) const {
    return CalibrationFolder::open(venue(), access);
  }

 private slots:
  void initTestCase() {
    CalibrateSettings settings;
    venue::VenueSettings corner;
    corner.name = "corner";
    corner.projector = {40, 30};
    corner.camera = {40, 30};
    corner.pathsPerPixel = 32;
    settings.rig = corner;
    calibrate(venue(), settings, root() / "cache", quiet);
  }

  /// What was there is gone to less than a tenth, and the picture elsewhere has not become worse by more than
  /// the light that came from there: measured, core/compensation/README.md.
  void theTrueLightIsGone() {
    EvaluateSettings settings;
    settings.fewImages = true;
    settings.methods = {Method::refined};
    settings.target.masks = {door()};
    const EvaluateResult result = evaluate(venue(), settings, root() / "cache", quiet);
    QVERIFY(!result.images.empty());
    for (const ImageScore& image : result.images) {
      QVERIFY(image.masked.has_value());
      const MaskScore& masked = *image.masked;
      qInfo("%s: light %.3f, direct %.4f, %.2f dB of %.2f, white %.3f", image.name.c_str(), masked.light,
            masked.direct, masked.psnr, masked.psnrWithout, masked.white);
      QVERIFY(masked.direct < 0.1);
      QVERIFY(masked.light >= 0.0 && masked.light < 0.5);
      QVERIFY(masked.psnr > masked.psnrWithout - 1.0);
    }
    settings.target.masks.reset();
    QVERIFY(!evaluate(venue(), settings, root() / "cache", quiet).images.front().masked.has_value());
  }

  void masksAreKeptAndUsed() {
    const std::string none = fingerprintOfShown(opened());
    const Json before = opened().settings().at("content");
    QVERIFY(!before.contains("masks"));
    CompensateSettings compensate;
    compensate.image = root() / "picture.png";
    image::writePng(compensate.image, standardImages().front().linear, 8);
    compensate.out = root() / "open";
    pipeline::compensate(venue(), compensate, quiet);

    Mask second = door();
    second.outline = Outline::lines;
    for (auto& point : second.points) point[0] += 0.3;
    {
      CalibrationFolder folder = opened(CalibrationFolder::Access::write);
      keepMasks(folder, {door(), second});
    }
    QVERIFY(settingsOf(opened()).content.masks == (std::vector<Mask>{door(), second}));
    QVERIFY(fingerprintOfShown(opened()) != none);
    writeMasks(root() / "masks.json", {door(), second});
    QVERIFY(readMasks(root() / "masks.json") == (std::vector<Mask>{door(), second}));

    compensate.out = root() / "masked";
    pipeline::compensate(venue(), compensate, quiet);
    compensate.target.masks.emplace();  // none, whatever is kept
    compensate.out = root() / "none";
    pipeline::compensate(venue(), compensate, quiet);
    const auto pattern = [&](const char* folder) { return readFile(root() / folder / "pattern.png"); };
    QVERIFY(pattern("masked") != pattern("open"));
    QVERIFY(pattern("none") == pattern("open"));
    {
      CalibrationFolder folder = opened(CalibrationFolder::Access::write);
      keepMasks(folder, {});
    }
    QVERIFY(opened().settings().at("content") == before && fingerprintOfShown(opened()) == none);
  }

  void badMasksAreOneSentence_data() {
    QTest::addColumn<QByteArray>("json");
    QTest::addColumn<QString>("sentence");
    const char* unreadable =
        "mask 1 cannot be read: it needs points as [[x, y], ...], and may have camera, outline and feather";
    QTest::newRow("no JSON") << QByteArray("{") << "this file of masks is not JSON";
    QTest::newRow("no list") << QByteArray("[]") << "this file holds no list of masks";
    QTest::newRow("a number") << QByteArray(R"({"masks": 3})") << unreadable;
    QTest::newRow("no points") << QByteArray(R"({"masks": [{}]})") << unreadable;
    QTest::newRow("texts") << QByteArray(R"({"masks": [{"points": [["a", "b"]]}]})") << unreadable;
    QTest::newRow("null") << QByteArray(R"({"masks": [{"points": [[null, 0], [0, 0], [1, 1]]}]})")
                          << unreadable;
    QTest::newRow("camera 0") << QByteArray(
                                     R"({"masks": [{"camera": 0, "points": [[0, 0], [1, 0], [1, 1]]}]})")
                              << unreadable;
    QTest::newRow("outline") << QByteArray(
                                    R"({"masks": [{"outline": "star", "points": [[0, 0], [1, 0], [1, 1]]}]})")
                             << "star";
    QTest::newRow("unknown") << QByteArray(R"({"masks": [{"depth": 1, "points": [[0, 0], [1, 0], [1, 1]]}]})")
                             << "mask 1 has \"depth\", which this version does not know";
    QTest::newRow("crossed")
        << QByteArray(R"({"masks": [{"points": [[0.2, 0.2], [0.8, 0.8], [0.8, 0.2], [0.2, 0.8]]}]})")
        << "mask 1: its outline crosses itself";
    QTest::newRow("huge") << QByteArray(R"({"masks": [{"points": [[1e400, 0], [1, 0], [1, 1]]}]})") << "";
  }
  void badMasksAreOneSentence() {
    QFETCH(QByteArray, json);
    QFETCH(QString, sentence);
    writeFileAtomically(root() / "bad.json",
                        std::string_view(json.constData(), static_cast<std::size_t>(json.size())));
    try {
      readMasks(root() / "bad.json");
      QFAIL("it was taken");
    } catch (const Error& error) {
      QVERIFY2(QString(error.what()).contains(sentence), error.what());
      QVERIFY(error.kind() == ErrorKind::format);
    }
  }

  void aMaskOfNoCameraIsSaid() {
    CompensateSettings compensate;
    compensate.image = root() / "picture.png";
    compensate.out = root() / "other";
    Mask other = door();
    other.camera = 1;
    compensate.target.masks = {other};
    try {
      pipeline::compensate(venue(), compensate, quiet);
      QFAIL("it was taken");
    } catch (const Error& error) {
      QVERIFY2(QString(error.what()).contains("in the view of camera 2"), error.what());
    }
  }
};

QTEST_GUILESS_MAIN(TestMaskedVenue)
#include "test_masked_venue.moc"
