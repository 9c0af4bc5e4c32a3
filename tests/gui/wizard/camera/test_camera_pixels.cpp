// SPDX-License-Identifier: MIT
// Which of the camera's pixels are used: what is offered, what it costs, what is kept.
#include <QComboBox>
#include <QTemporaryDir>
#include <QtTest>

#include "relucent/venue/venue.h"
#include "wizard/camera/camera_page.h"
#include "wizard/camera/camera_view.h"
#include "wizard/camera/pixel_use_view.h"

using namespace relucent;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::reduction;
using namespace relucent::venue;

namespace {

constexpr int patience = 120'000;  // ms for a small venue on a busy machine

CalibrateSettings simulated(Size camera) {
  VenueSettings venue;
  venue.name = "plain";
  venue.projector = {24, 18};
  venue.camera = camera;
  venue.pathsPerPixel = 16;
  CalibrateSettings settings;
  settings.rig = venue;
  return settings;
}

}  // namespace

class TestCameraPixels : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    folder_ = std::make_unique<QTemporaryDir>();
    session_ = std::make_unique<Session>(std::filesystem::path(folder_->filePath("cache").toStdString()));
  }

  void aLargeCameraOffersFewerPixels() {
    session_->begin(folder_->filePath("venue").toStdString(), simulated({96, 72}));
    CameraPage page(*session_);
    const std::unique_ptr<QWidget> view(pixelUseView(page));
    auto* box = view->findChild<QComboBox*>("camera-pixels");
    QVERIFY(box != nullptr && view->isHidden());
    page.enter();
    QTRY_VERIFY_WITH_TIMEOUT(!page.pixelForecasts().empty(), patience);
    const std::vector<PixelForecast>& offered = page.pixelForecasts();
    QCOMPARE(offered.size(), std::size_t{5});
    QVERIFY(offered[1].used == (Size{96, 72}));
    for (const PixelForecast& forecast : offered) {
      QVERIFY(forecast.camera == (Size{96, 72}));
      // Fewer pixels take less of everything that they are made of.
      for (const PixelForecast& other : offered)
        if (forecast.used.count() < other.used.count()) {
          QVERIFY(forecast.work.memoryBytes < other.work.memoryBytes);
          QVERIFY(forecast.work.diskBytes < other.work.diskBytes);
        }
    }
    QVERIFY(offered[0].used.count() < offered[1].used.count());
    QVERIFY(!view->isHidden());
    QCOMPARE(box->count(), 5);
    QCOMPARE(box->currentIndex(), 0);

    page.choosePixels({PixelUse::Kind::binned, 3});
    QVERIFY(session_->settings().pixels == (PixelUse{PixelUse::Kind::binned, 3}));
    QCOMPARE(box->currentIndex(), 3);
    page.undoStack().undo();
    QVERIFY(session_->settings().pixels == PixelUse());
    QCOMPARE(box->currentIndex(), 0);
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isLooking(), patience);
  }

  void aSmallCameraLeavesNothingToChoose() {
    session_->begin(folder_->filePath("venue").toStdString(), simulated({22, 16}));
    CameraPage page(*session_);
    const std::unique_ptr<QWidget> view(pixelUseView(page));
    page.enter();
    QTRY_VERIFY_WITH_TIMEOUT(page.look().has_value(), patience);
    QVERIFY(page.pixelForecasts().empty() && view->isHidden());
    page.finish();
    QTRY_VERIFY_WITH_TIMEOUT(!page.isLooking(), patience);
  }

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::unique_ptr<Session> session_;
};

QTEST_MAIN(TestCameraPixels)
#include "test_camera_pixels.moc"
