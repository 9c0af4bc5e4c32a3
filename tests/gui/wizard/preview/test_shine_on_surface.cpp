// SPDX-License-Identifier: MIT
// The previewed picture on the surface, from Preview itself. On two screens, see
// tests/support/with-two-screens: DUMMY1 is the projector's.
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/two_screens.h"
#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "wizard/preview/preview_page.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

constexpr QSize projectorSize(48, 36);

/// What stands in the middle of the projector's screen, where its pixels are.
QImage onSurface() {
  const QImage seen = seenOn("DUMMY1");
  QRect place(QPoint(), projectorSize);
  place.moveTopLeft(
      {(seen.width() - projectorSize.width()) / 2, (seen.height() - projectorSize.height()) / 2});
  return seen.copy(place);
}

QImage opaque(const QImage& image) {
  return image.convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestShineOnSurface : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  std::unique_ptr<PreviewPage> page_;

  PageCommand* shine() const { return page_->secondary().back(); }
  Session& session() { return own_.session; }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
  }
  void init() {
    page_ = std::make_unique<PreviewPage>(session());
    session().open(own_.path("venue"));
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() && !page_->isComputing() && session().areDevicesFree(),
                             patience);
  }
  void cleanup() { page_.reset(); }

  /// Law: nothing shines unasked; then the corrected picture, the uncorrected one to compare, and what is
  /// changed on the page, at once, until it is told to stop.
  void thePictureIsShownAsLongAsItIsWanted() {
    QVERIFY(!page_->isShining() && shine()->isEnabled());
    QVERIFY(page_->preview()->sentWith != page_->preview()->sentWithout);
    shine()->trigger();
    QVERIFY(page_->isShining());
    QTRY_COMPARE_WITH_TIMEOUT(onSurface(), opaque(page_->preview()->sentWith.front()), patience);
    QVERIFY(session().devicesUser() == PreviewPage::stepName);  // no measurement begins meanwhile
    page_->secondary().front()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(onSurface(), opaque(page_->preview()->sentWithout.front()), patience);
    page_->secondary().front()->trigger();
    const auto before = page_->preview();
    pipeline::ContentSettings settings = page_->settings();
    settings.blackLift = 0.2;
    page_->setSettings(settings);
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() != before, patience);
    QTRY_COMPARE_WITH_TIMEOUT(onSurface(), opaque(page_->preview()->sentWith.front()), patience);
    shine()->trigger();
    QVERIFY(!page_->isShining() && session().areDevicesFree());
    QTRY_VERIFY_WITH_TIMEOUT(allBlack(onSurface()), patience);
  }

  /// Law: a rehearsal, which shines nowhere by itself, says which screen it would light.
  void aRehearsalNamesTheScreen() {
    QVERIFY(session().isSimulated());
    QCOMPARE(shine()->text(), PreviewPage::tr("Shine on %1").arg("DUMMY1"));
    QVERIFY2(shine()->toolTip().contains("DUMMY1"), qPrintable(shine()->toolTip()));
    shine()->trigger();
    QCOMPARE(shine()->text(), PreviewPage::tr("Stop shining"));
    page_->stopShining();
  }

  /// Law: whoever leaves the page leaves the surface dark.
  void leavingEndsIt() {
    shine()->trigger();
    QVERIFY(page_->isShining());
    page_->leave();
    QVERIFY(!page_->isShining() && session().areDevicesFree());
  }

  /// Law: a measurement under way is not disturbed: it keeps the devices, and the reason is said.
  void aMeasurementIsNotDisturbed() {
    DeviceLease measuring =
        session().leaseDevices({"acquire", "relucent::gui::AcquirePage", "Acquire"}, DeviceWork::measurement);
    QVERIFY(!shine()->isEnabled());
    QVERIFY2(shine()->toolTip().contains("Acquire"), qPrintable(shine()->toolTip()));
    page_->shine();
    QVERIFY(!page_->isShining() && session().isMeasuring());
  }

  /// Law: what the output shows there stays.
  void theOutputsWindowIsNotCovered() {
    ProjectorWindow output(identityOf(*screenOn("DUMMY1")));
    output.shine();
    QTRY_VERIFY(output.isShining());
    page_->refresh();
    QVERIFY(!shine()->isEnabled());
    output.stop();
    page_->refresh();
    QVERIFY(shine()->isEnabled());
  }

  /// Law: without the projector's screen nothing shines, on the operator's least of all; one that is
  /// unplugged meanwhile shows the picture again when it is back.
  void theScreenMayBeMissing() {
    shine()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(onSurface(), opaque(page_->preview()->sentWith.front()), patience);
    unplug();
    QTRY_VERIFY(page_->hint().contains("unplugged"));
    plug();
    QTRY_COMPARE_WITH_TIMEOUT(onSurface(), opaque(page_->preview()->sentWith.front()), patience);
    page_->stopShining();
    unplug();
    QTRY_VERIFY(!shine()->isEnabled() && shine()->toolTip().contains("not there"));
    page_->shine();
    QVERIFY(!page_->isShining());
    plug();
    QTRY_VERIFY(shine()->isEnabled());
  }
};

QTEST_MAIN(TestShineOnSurface)
#include "test_shine_on_surface.moc"
