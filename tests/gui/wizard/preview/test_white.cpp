// SPDX-License-Identifier: MIT
// How bright white is where, as Preview offers it.
#include <QLabel>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/pipeline/calibrate.h"
#include "theme/controls.h"
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
  Segmented* choice() const { return inspector_->findChild<Segmented*>("white"); }
  QString sentence() const { return inspector_->findChild<QLabel*>("white-sentence")->text(); }
  void choose(int index) {
    const auto before = page_->preview();
    Q_EMIT choice()->chosen(index);
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

  /// Law: it is kept with the calibration when it is accepted.
  void itIsKept() {
    choose(2);
    page_->primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(session().settings().content.brightness == Brightness::region, patience);
  }
};

QTEST_MAIN(TestWhite)
#include "test_white.moc"
