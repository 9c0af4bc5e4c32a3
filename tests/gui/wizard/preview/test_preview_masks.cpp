// SPDX-License-Identifier: MIT
// Masks in Preview: drawn, seen in the prediction, taken back, kept with the calibration.
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSlider>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "theme/controls.h"
#include "wizard/preview/mask_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/preview_view.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

class TestPreviewMasks : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  std::unique_ptr<PreviewPage> page_;
  PageView shown_{};

  template <typename Widget>
  Widget* part(const char* name) const {
    return shown_.inspector->findChild<Widget*>(name);
  }
  MaskView* view() const {
    return qobject_cast<MaskView*>(shown_.stage->findChild<QWidget*>("preview-view"));
  }
  void settle(const std::shared_ptr<const ContentPreview>& before) {
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() != before && !page_->isComputing(), patience);
  }
  void draw(const std::vector<std::array<double, 2>>& points) {
    part<QPushButton>("draw-mask")->click();
    QVERIFY(view()->isDrawing());
    for (const auto& point : points) {
      const QPointF at(point[0] * view()->picture().width(), point[1] * view()->picture().height());
      QTest::mouseClick(view(), Qt::LeftButton, {}, view()->widgetFromPicture(at).toPoint());
    }
    QTest::keyClick(view(), Qt::Key_Return);
  }
  /// Mean light of the prediction within 0.45 to 0.55 of the view.
  double lightInside() const {
    const image::Image& with = page_->preview()->first().with;
    double sum = 0.0, count = 0.0;
    for (int y = 0; y < with.height(); ++y)
      for (int x = 0; x < with.width(); ++x) {
        if (std::abs((x + 0.5) / with.width() - 0.5) > 0.05 ||
            std::abs((y + 0.5) / with.height() - 0.5) > 0.05)
          continue;
        sum += static_cast<double>(with.at(x, y, 1));
        count += 1.0;
      }
    return sum / count;
  }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
    page_ = std::make_unique<PreviewPage>(own_.session);
    shown_ = viewOf(*page_);
    shown_.stage->resize(700, 600);
    shown_.stage->show();
    own_.session.open(own_.path("venue"));
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() && !page_->isComputing(), patience);
  }
  void cleanupTestCase() {
    delete shown_.stage;
    delete shown_.inspector;
    page_.reset();
  }

  void drawingSaysHowItIsDoneAndEnded() {
    auto* draw = part<QPushButton>("draw-mask");
    draw->click();
    QVERIFY(page_->masks().isDrawing() && !part<QWidget>("how-to-draw")->isHidden());
    QCOMPARE(draw->text(), QString("Stop drawing"));
    draw->click();
    QVERIFY(!page_->masks().isDrawing() && part<QWidget>("how-to-draw")->isHidden());
    QCOMPARE(draw->text(), QString("Draw a mask"));
  }

  void aMaskDarkensItsPlaceAndIsTakenBack() {
    const auto before = page_->preview();
    const double light = lightInside();
    QVERIFY(part<QListWidget>("masks")->isHidden() && part<QWidget>("mask-feather")->isHidden());
    draw({{0.38, 0.38}, {0.62, 0.38}, {0.62, 0.62}, {0.38, 0.62}});
    QCOMPARE(static_cast<int>(page_->settings().masks.size()), 1);
    settle(before);
    QVERIFY2(lightInside() < 0.4 * light, qPrintable(QString("%1 of %2").arg(lightInside()).arg(light)));
    QVERIFY(!part<QListWidget>("masks")->isHidden());
    QCOMPARE(part<QListWidget>("masks")->item(0)->text(), QString("Mask 1"));
    QVERIFY(page_->masks().chosen() == std::size_t{0} && !page_->masks().isDrawing());

    part<QSlider>("mask-feather")->setValue(100);
    QCOMPARE(page_->settings().masks[0].feather, 0.1);
    Q_EMIT part<Segmented>("mask-outline")->chosen(1);
    QVERIFY(page_->settings().masks[0].outline == Outline::curve);
    const pipeline::ContentSettings kept = page_->settings();
    part<QPushButton>("remove-mask")->click();
    QVERIFY(page_->settings().masks.empty());
    page_->undoStack().undo();
    QVERIFY(page_->settings() == kept);
    while (page_->undoStack().canUndo()) page_->undoStack().undo();
    QVERIFY(page_->settings().masks.empty());
  }

  void whatIsNoMaskIsRefused() {
    const pipeline::ContentSettings before = page_->settings();
    draw({{0.3, 0.3}, {0.7, 0.7}, {0.7, 0.3}, {0.3, 0.7}});
    QVERIFY(page_->settings() == before && !page_->masks().isDrawing());
    QCOMPARE(page_->masks().problem(), QString("This is no mask: its outline crosses itself."));
    QVERIFY(!part<QWidget>("mask-problem")->isHidden());
    draw({{0.3, 0.3}});
    QCOMPARE(page_->masks().problem(), QString("This is no mask: its outline needs three points at least."));
    part<QPushButton>("draw-mask")->click();
    QVERIFY(page_->masks().problem().isEmpty());
    QTest::keyClick(view(), Qt::Key_Escape);
    QVERIFY(!page_->masks().isDrawing() && !part<QPushButton>("draw-mask")->isChecked());
  }

  void itIsKeptWithTheCalibration() {
    const auto before = page_->preview();
    draw({{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}});
    settle(before);
    page_->primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(own_.session.settings().content.masks.size() == 1, patience);
    const std::vector<Mask> masks = own_.session.settings().content.masks;
    own_.session.open(own_.path("venue"));
    QVERIFY(own_.session.settings().content.masks == masks && page_->settings().masks == masks);
  }
};

QTEST_MAIN(TestPreviewMasks)
#include "test_preview_masks.moc"
