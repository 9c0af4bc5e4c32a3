// SPDX-License-Identifier: MIT
// A venue with two projectors, from its measurement to what each of them is to show.
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <filesystem>

#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/measured_venue.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/standard_images.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::venue;
namespace fs = std::filesystem;

class TestTwoProjectors : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }
  fs::path cache() const { return root() / "cache"; }
  fs::path content() const { return root() / "content.png"; }

 private slots:
  void initTestCase() {
    VenueSettings venue;
    venue.name = "relief";
    venue.projector = {40, 30};
    venue.camera = {28, 21};
    venue.pathsPerPixel = 32;
    CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 9;
    Progress silent;
    calibrate(root() / "relief", settings, cache(), silent);
    writePng(content(), standardImages({40, 30}).front().linear, 8);
  }

  void bothAreInTheCalibration() {
    Progress silent;
    MeasuredCalibration measured =
        loadCalibration(CalibrationFolder::open(root() / "relief", CalibrationFolder::Access::read), silent);
    QCOMPARE(measured.linearization.projectors.size(), std::size_t{2});
    QCOMPARE(measured.linearization.additivityError.size(), std::size_t{2});
    QCOMPARE(measured.venue.transport.projectors(), Rasters({{40, 30}, {40, 30}}));
    QCOMPARE(measured.inverse.projectors(), measured.venue.transport.projectors());
  }

  void whatWasMeasuredIsTheTruth() {
    Progress silent;
    EvaluateSettings evaluating;
    evaluating.fewImages = true;  // of others, parts are darker than the room
    evaluating.methods = {compensation::Method::refined};
    evaluating.blended = true;
    EvaluateResult result = evaluate(root() / "relief", evaluating, cache(), silent);
    // As large as for venues of one projector: see test_pipeline.
    QVERIFY2(result.transport.frobenius < 0.2, qPrintable(QString::number(result.transport.frobenius)));
    QVERIFY2(result.transport.relightNatural < 0.02,
             qPrintable(QString::number(result.transport.relightNatural)));
    QVERIFY2(result.reachable > 0.9, qPrintable(QString::number(result.reachable)));
    // Each has a shadow of its own, which the other fills.
    for (const ImageScore& image : result.images) {
      QCOMPARE(image.alone.size(), std::size_t{2});
      for (const AloneScore& alone : image.alone) {
        QVERIFY2(alone.reachable < image.reachable, qPrintable(QString::number(alone.reachable)));
        QVERIFY(alone.optimum->psnrReachable < image.methods.front().psnrReachable);
      }
      QVERIFY(image.alone[0].reachable + image.alone[1].reachable < 2.0 * image.reachable);
    }
  }

  void eachHasAPictureOfItsOwn() {
    CompensateSettings settings;
    settings.image = content();
    settings.out = root() / "out";
    Progress silent;
    compensate(root() / "relief", settings, silent);
    Image first = readPicture(settings.out / "pattern.png").encoded;
    Image second = readPicture(settings.out / "pattern-2.png").encoded;
    QVERIFY((first.size() == Size{40, 30}) && (second.size() == Size{40, 30}));
    QVERIFY(first != second);
    for (const Image& picture : {first, second})
      QVERIFY(*std::max_element(picture.data().begin(), picture.data().end()) > 0.2f);
  }

  void aPhotographOfBothProvesIt() {
    ProveSettings settings;
    settings.image = content();
    settings.out = root() / "proof";
    Progress silent;
    ProveResult result = proveCalibration(root() / "relief", settings, cache(), silent);
    QVERIFY2(
        result.after.measured.deltaE < 0.5 * result.before.measured.deltaE,
        qPrintable(QString("%1 %2").arg(result.after.measured.deltaE).arg(result.before.measured.deltaE)));
  }
};

QTEST_APPLESS_MAIN(TestTwoProjectors)
#include "test_two_projectors.moc"
