// SPDX-License-Identifier: MIT
// How bright white is where, what becomes of colours out of reach, and how certain a prediction is, as
// Preview offers it.
#include <QLabel>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "theme/controls.h"
#include "views/number_text.h"
#include "wizard/preview/preview_inspector.h"
#include "wizard/preview/preview_page.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

namespace {

double meanOf(const QImage& drive) {
  double sum = 0.0;
  for (int y = 0; y < drive.height(); ++y)
    for (int x = 0; x < drive.width(); ++x) sum += qGray(drive.pixel(x, y));
  return sum / (static_cast<double>(drive.width()) * drive.height());
}

}  // namespace

class TestWhite : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  QTemporaryDir pictures_;
  std::unique_ptr<PreviewPage> page_;
  std::unique_ptr<QWidget> inspector_;

  Session& session() { return own_.session; }
  Segmented* choice(const char* name = "white") const { return inspector_->findChild<Segmented*>(name); }
  QString sentence(const QString& of = "white") const {
    return inspector_->findChild<QLabel*>(of + "-sentence")->text();
  }
  void choose(int index, const char* name = "white") {
    const auto before = page_->preview();
    Q_EMIT choice(name)->chosen(index);
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() != before && !page_->isComputing(), patience);
  }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
    // A dark scene, much of it below the room's black.
    QImage dark(64, 48, QImage::Format_RGB32);
    for (int y = 0; y < dark.height(); ++y)
      for (int x = 0; x < dark.width(); ++x) dark.setPixelColor(x, y, QColor(8 + x / 4, 6 + y / 4, 16));
    QVERIFY(dark.save(pictures_.filePath("dark.png")));
  }
  void init() {
    page_ = std::make_unique<PreviewPage>(session());
    inspector_.reset(previewInspector(*page_));
    session().open(own_.path("venue"));
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() && !page_->isComputing(), patience);
    page_->choosePicture(pictures_.filePath("dark.png"));
    QTRY_VERIFY_WITH_TIMEOUT(page_->pictureName().contains("dark") && !page_->isComputing(), patience);
  }
  void cleanup() {
    inspector_.reset();
    page_.reset();
  }

  /// Law: each of the three is a setting of the content and has a sentence of its own; a dark picture is sent
  /// brighter under a white of its own, and less of it is lost.
  void aDarkPictureIsSentBrighter() {
    QCOMPARE(choice()->current(), 0);
    const auto even = page_->preview();
    QStringList sentences{sentence()};
    for (const auto& [index, way] : {std::pair(1, Brightness::picture), std::pair(2, Brightness::region)}) {
      choose(index);
      QVERIFY(page_->settings().brightness == way);
      QCOMPARE(choice()->current(), index);
      QVERIFY(!sentences.contains(sentence()));
      sentences << sentence();
      QCOMPARE(choice()->accessibleDescription(), sentence());
      const auto own = page_->preview();
      QVERIFY2(
          meanOf(own->sentWith.front()) > 1.1 * meanOf(even->sentWith.front()),
          qPrintable(
              QString("%1 and %2").arg(meanOf(own->sentWith.front())).arg(meanOf(even->sentWith.front()))));
      QVERIFY(own->white > even->white && own->deltaEMean < even->deltaEMean);
    }
    choose(0);
    QCOMPARE(page_->preview()->white, even->white);
    QCOMPARE(page_->preview()->sentWith.front(), even->sentWith.front());
  }

  /// Law: each way of holding colours is a setting of the content and has a sentence of its own; a blue that
  /// the surface cannot show is sent with less of everything, the more the truer it is to be.
  void coloursOutOfReachAreDimmed() {
    QImage blue(64, 48, QImage::Format_RGB32);
    blue.fill(QColor(90, 90, 255));
    QVERIFY(blue.save(pictures_.filePath("blue.png")));
    page_->choosePicture(pictures_.filePath("blue.png"));
    QTRY_VERIFY_WITH_TIMEOUT(page_->pictureName().contains("blue") && !page_->isComputing(), patience);
    pipeline::ContentSettings settings = page_->settings();
    settings.reachablePercentile = 60.0;  // so that most of it is out of reach
    const auto dim = page_->preview();
    page_->setSettings(settings);
    QTRY_VERIFY_WITH_TIMEOUT(page_->preview() != dim && !page_->isComputing(), patience);
    QVERIFY(page_->preview()->reachableShare < 0.7);
    QStringList sentences{sentence("clipping")};
    double brighter = meanOf(page_->preview()->sentWith.front());
    for (const auto& [index, way] : {std::pair(1, Clipping::half), std::pair(2, Clipping::hue)}) {
      choose(index, "clipping");
      QVERIFY(page_->settings().clipping == way);
      QVERIFY(!sentences.contains(sentence("clipping")));
      sentences << sentence("clipping");
      const double dimmer = meanOf(page_->preview()->sentWith.front());
      QVERIFY2(dimmer < brighter, qPrintable(QString("%1 after %2").arg(dimmer).arg(brighter)));
      brighter = dimmer;
    }
  }

  /// Law: how far off the light may be is known of what was measured, is shown.
  void uncertaintyIsShown() {
    const ViewPreview& view = page_->preview()->first();
    QCOMPARE(view.uncertainty.size(), view.inside.size());
    QVERIFY(view.uncertaintyMean > 1e-4 && view.uncertaintyMean < 0.2);
    const auto* row = inspector_->findChild<ValueRow*>("uncertainty");
    QVERIFY(!row->isHidden());
    QVERIFY(row->findChildren<QLabel*>().last()->text().contains(marginText(view.uncertaintyMean)));
  }

  /// Law: it is kept with the calibration when it is accepted.
  void itIsKept() {
    choose(2);
    page_->primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session().settings().content.brightness == Brightness::region, patience);
  }
};

QTEST_MAIN(TestWhite)
#include "test_white.moc"
