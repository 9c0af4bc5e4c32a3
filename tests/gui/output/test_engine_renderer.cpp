// SPDX-License-Identifier: MIT
// What a show sends to its projectors against what the pipeline computes, on a small simulated venue.
#include "output/engine_renderer.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <filesystem>

#include "relucent/calibration/calibration_folder.h"
#include "relucent/image/picture_files.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/compensate.h"
#include "relucent/pipeline/pictures.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::engine;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::venue;
namespace fs = std::filesystem;

namespace {

constexpr Size contentSize{64, 48};

/// Saturated and dark colours: where the light of one camera pixel has more than one colour mixing they tell.
QImage colours() {
  QImage image(contentSize.width, contentSize.height, QImage::Format_RGBX8888);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.setPixelColor(x, y,
                          QColor::fromHsv((23 * (x / 8)) % 360, 40 * (y / 8), 60 + 24 * ((x + y) / 16)));
  return image;
}

}  // namespace

class TestEngineRenderer : public QObject {
  Q_OBJECT

  QTemporaryDir temporary_;
  fs::path root() const { return temporary_.path().toStdString(); }

  RenderedFrame rendered(const char* venue, const Outdated& outdated) {
    Progress silent;
    EngineRenderer renderer(root() / venue, {{contentSize.width, contentSize.height}, Fit::fit}, false,
                            silent, {}, BackendChoice::cpu);
    RenderRequest request;
    request.thorough = true;
    return renderer.render({colours(), 1}, request, outdated);
  }
  /// The pipeline's drive by the same method, as a picture.
  Image compensated(const char* venue) {
    Progress silent;
    colours().save(QString::fromStdString((root() / "colours.png").string()));
    CompensateSettings settings;
    settings.image = root() / "colours.png";
    settings.out = root() / (std::string(venue) + "-out");
    settings.target = targetOf(ContentSettings());
    compensate(root() / venue, settings, silent);
    return readPicture(settings.out / "pattern.png").encoded;
  }

 private slots:
  void initTestCase() {
    Progress silent;
    for (const char* name : {"corner", "plain"}) {
      VenueSettings venue;
      venue.name = name;
      venue.projector = {40, 30};
      venue.camera = {28, 21};
      venue.pathsPerPixel = 32;
      CalibrateSettings settings;
      settings.rig = venue;
      settings.linearization.levels = 9;
      calibrate(root() / name, settings, root() / "cache", silent);
    }
  }

  void aPictureThatStandsIsThePipelines_data() {
    QTest::addColumn<QString>("venue");
    QTest::newRow("corner") << "corner";
    QTest::newRow("plain") << "plain";
  }
  void aPictureThatStandsIsThePipelines() {
    QFETCH(QString, venue);
    QByteArray name = venue.toUtf8();
    RenderedFrame frame = rendered(name, [] { return false; });
    Image wanted = compensated(name);
    QCOMPARE(frame.drives.size(), std::size_t{1});
    QCOMPARE(frame.drives[0].size(), QSize(wanted.width(), wanted.height()));
    const QImage drive = frame.drives[0].image();
    // The one is the nearest code, the other one of the two about the same light.
    for (int y = 0; y < wanted.height(); ++y)
      for (int x = 0; x < wanted.width(); ++x)
        for (int c = 0; c < 3; ++c) {
          int code = drive.constScanLine(y)[4 * x + c];
          QVERIFY2(std::abs(code - std::lround(255.0f * wanted.at(x, y, c))) <= 1,
                   qPrintable(QString("%1, %2: %3").arg(x).arg(y).arg(code)));
        }
  }

  void outdatedItIsAFrameInHaste() {
    RenderedFrame solved = rendered("corner", [] { return false; });
    RenderedFrame inHaste = rendered("corner", [] { return true; });
    QVERIFY(!inHaste.drives.empty());
    QVERIFY(inHaste.drives[0].image() != solved.drives[0].image());
    QVERIFY(inHaste.steps < solved.steps);
  }
};

QTEST_GUILESS_MAIN(TestEngineRenderer)
#include "test_engine_renderer.moc"
