// SPDX-License-Identifier: MIT
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/random.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/results.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::hdr;
using namespace relucent::linearization;
using namespace relucent::transport;
namespace fs = std::filesystem;

namespace {

Linearization someLinearization() {
  std::vector<double> x, y;
  for (int i = 0; i <= 20; ++i) {
    x.push_back(i / 20.0);
    y.push_back(std::pow(i / 20.0, 2.2));
  }
  ResponseCurve curve(x, y);
  Linearization linearization;
  linearization.projectors = {{{curve, ResponseCurve(), curve}}, {{ResponseCurve(), curve, curve}}};
  linearization.projectors[1].residuals = {{{{0.0, 0.0}, {1.0 / 3.0, -1e-3}}, {}, {{1.0, 2e-4}}}};
  CameraModel camera;
  camera.response = {ResponseCurve(), curve, ResponseCurve()};
  camera.readNoise = 1.0 / 3.0;
  camera.gain = 1e-5;
  camera.saturation = 0.9;
  camera.times = {{0.1, 1.01}, {0.3, 1.0 / 0.97}};
  linearization.cameras = {camera, CameraModel()};
  linearization.exposures = {0.5, 1.0 / 24.0};
  linearization.additivityError = {0.01, 0.02};
  linearization.findings = {RELUCENT_ENGLISH_MESSAGE("test.white", "White is {} % too bright")
                                .with(as::share(0.18, as::decimals(0)))};
  return linearization;
}

/// Where the list ends that begins at `open`; no brackets are within its texts.
std::size_t closingBracket(const std::string& text, std::size_t open) {
  int depth = 0;
  std::size_t at = open;
  do {
    if (text[at] == '[') ++depth;
    if (text[at] == ']') --depth;
  } while (depth > 0 && ++at < text.size());
  return at;
}

CameraStack randomStack(std::size_t pixels, std::uint64_t seed) {
  Random random{seed};
  CameraStack stack(3 * pixels);
  for (float& value : stack) value = static_cast<float>(random.normal());
  return stack;
}

}  // namespace

class TestResults : public QObject {
  Q_OBJECT

 private:
  QTemporaryDir temporary_;
  fs::path root_;

 private slots:
  void init() {
    temporary_ = QTemporaryDir();
    root_ = temporary_.path().toStdString();
  }

  /// As calibrations hold them that were made before findings were messages.
  void findingsThatAreSentencesAreRead() {
    {
      CalibrationFolder made = CalibrationFolder::create(root_ / "c", {}, {});
      storeLinearization(made, "f", someLinearization(), {1.5});
    }
    const fs::path manifest = root_ / "c" / "calibration.relucent";
    std::string text = readFile(manifest);
    const std::size_t begin = text.find('[', text.find("\"findings\""));
    text.replace(begin, closingBracket(text, begin) + 1 - begin, R"(["White is 18 % too bright."])");
    writeFileAtomically(manifest, text);
    CalibrationFolder folder = CalibrationFolder::open(root_ / "c", CalibrationFolder::Access::read);
    const Linearization read = loadLinearization(folder.find(Stage::linearization, "f").value());
    QCOMPARE(read.findings.size(), std::size_t{1});
    QCOMPARE(english(read.findings.front()), std::string("White is 18 % too bright."));
  }

  void linearizationComesBackNumberForNumber() {
    Linearization before = someLinearization();
    {
      CalibrationFolder made = CalibrationFolder::create(root_ / "c", {}, {});
      storeLinearization(made, "f", before, {1.5});
    }
    CalibrationFolder folder = CalibrationFolder::open(root_ / "c", CalibrationFolder::Access::read);
    Linearization after = loadLinearization(folder.find(Stage::linearization, "f").value());
    QCOMPARE(after.exposures, before.exposures);
    QVERIFY(after.findings == before.findings);
    QCOMPARE(after.cameras[0].times, before.cameras[0].times);
    QCOMPARE(after.cameras[0].readNoise, before.cameras[0].readNoise);
    QVERIFY(after.projectors[0].channels[1].isIdentity());
    QVERIFY(after.projectors[1].residuals == before.projectors[1].residuals);
    for (double drive : {0.0, 0.123, 0.5, 0.987, 1.0})
      QCOMPARE(after.projectors[1].channels[2](drive), before.projectors[1].channels[2](drive));
  }

  void damagedLinearizationIsAnError_data() {
    QTest::addColumn<QByteArray>("path");
    QTest::addColumn<QByteArray>("value");
    QTest::newRow("missing") << QByteArray("/projectors") << QByteArray("null");
    QTest::newRow("type") << QByteArray("/exposures") << QByteArray("\"short\"");
    QTest::newRow("curve that falls") << QByteArray("/projectors/0/0/y/3") << QByteArray("-1");
    QTest::newRow("two channels") << QByteArray("/cameras/0/response") << QByteArray("[]");
  }
  void damagedLinearizationIsAnError() {
    QFETCH(QByteArray, path);
    QFETCH(QByteArray, value);
    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    StageResult result = storeLinearization(folder, "f", someLinearization(), {});
    Json values = *result.values;
    values[Json::json_pointer(path.toStdString())] = Json::parse(value.toStdString());
    result.values = std::make_shared<const Json>(std::move(values));
    try {
      loadLinearization(result);
      QFAIL("was read");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::format);
    }
  }

  void acquisitionOfSeveralDevicesComesBackBitForBit() {
    Rasters cameras(std::vector<Size>{{16, 9}, {5, 7}});
    Rasters projectors(std::vector<Size>{{8, 8}, {4, 6}});
    Acquisition before;
    NodeLayout layout(projectors);
    BlockSparseBuilder builder(layout.count(), std::vector<float>(cameras.count(), 1.0f));
    Random random{5};
    for (std::size_t row = 0; row < cameras.count(); ++row)
      builder.add(row, random.below(layout.count()), ColourBlock::Constant(random.uniformFloat()));
    before.transport = TransportMatrix(cameras, projectors, builder.build());
    before.black = CameraStack(randomStack(cameras.count(), 1));
    before.blackVariance = CameraStack(randomStack(cameras.count(), 2));
    before.flood = CameraStack(randomStack(cameras.count(), 3));
    before.floodVariance = CameraStack(randomStack(cameras.count(), 4));
    before.leafVariance = CameraStack(randomStack(cameras.count(), 5));
    for (std::uint64_t seed = 6; seed < 10; ++seed)
      before.residual.push_back(randomStack(cameras.count(), seed));
    before.remeasured = 3;
    before.expected = {31.5, 34.25, 90, 180.0};
    for (std::size_t i = 0; i < cameras.count(); ++i) before.flagged.push_back(i % 7 == 0 ? 1 : 0);
    before.unresolvedEnergy = 1.0 / 3.0;
    before.verificationError = 0.01;
    before.patterns = 805;
    before.exposures = 1551;
    before.findings = {RELUCENT_ENGLISH_MESSAGE("test.room", "the room light changed")};
    before.changed = FoundChange{RELUCENT_ENGLISH_MESSAGE("test.moved", "the camera moved"), true};

    CalibrationFolder folder = CalibrationFolder::create(root_ / "c", {}, {});
    StageResult result = storeAcquisition(folder, "f", before, {});
    Acquisition after = loadAcquisition(result);
    QVERIFY(after.transport == before.transport);
    QVERIFY(after.transport.cameras() == cameras && after.transport.projectors() == projectors);
    QCOMPARE(after.black, before.black);
    QCOMPARE(after.blackVariance, before.blackVariance);
    QCOMPARE(after.flood, before.flood);
    QCOMPARE(after.floodVariance, before.floodVariance);
    QCOMPARE(after.leafVariance, before.leafVariance);
    QVERIFY(after.residual == before.residual);
    QCOMPARE(after.remeasured, before.remeasured);
    QVERIFY(after.expected);
    QCOMPARE(after.expected->now, 31.5);
    QCOMPARE(after.expected->whole, 34.25);
    QCOMPARE(after.expected->photographs, 90);
    QCOMPARE(after.expected->seconds, 180.0);
    QCOMPARE(after.flagged, before.flagged);
    QCOMPARE(after.unresolvedEnergy, before.unresolvedEnergy);
    QCOMPARE(after.verificationError, before.verificationError);
    QCOMPARE(after.patterns, before.patterns);
    QCOMPARE(after.exposures, before.exposures);
    QVERIFY(after.findings == before.findings);
    QVERIFY(after.changed == before.changed);
    QVERIFY(resultFrom<Stage::acquisition>(result).changed == before.changed);
    QVERIFY(!resultFrom<Stage::acquisition>(result).isWhole());

    fs::resize_file(result.folder / "flood-2.exr", 20);
    QVERIFY_EXCEPTION_THROWN(loadAcquisition(result), Error);
  }
};

QTEST_APPLESS_MAIN(TestResults)
#include "test_results.moc"
