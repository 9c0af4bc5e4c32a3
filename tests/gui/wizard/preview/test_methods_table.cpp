// SPDX-License-Identifier: MIT
// The comparison of methods follows all that it is computed from.
#include <QTableWidget>
#include <QtTest>

#include "gui/wizard/simulated_session.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/calibrate.h"
#include "views/number_text.h"
#include "wizard/frame/stage_scroll.h"
#include "wizard/preview/methods_card.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/preview_view.h"

using namespace relucent;
using namespace relucent::gui;

class TestMethodsTable : public QObject {
  Q_OBJECT

  SimulatedSession own_;
  std::unique_ptr<PreviewPage> page_;

  Session& session() { return own_.session; }
  bool isComplete() const {
    return page_->isReady() && page_->preview() && !page_->isComputing() && page_->table().size() == 5;
  }
  /// The row of the method in use.
  MethodPreview chosenRow() const { return chosenIn(page_->table()); }
  MethodPreview chosenIn(const std::vector<MethodPreview>& rows) const {
    const auto row = std::ranges::find(rows, page_->settings().method, &MethodPreview::method);
    return row == rows.end() ? MethodPreview() : *row;
  }

 private slots:
  void initTestCase() {
    Progress silent;
    pipeline::calibrate(own_.path("venue"), smallVenue({48, 36}, {40, 30}, 5), own_.path("cache"), silent);
  }
  void init() {
    page_ = std::make_unique<PreviewPage>(session());
    session().open(own_.path("venue"));
    page_->enter();
    QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
  }
  void cleanup() { page_.reset(); }

  void itFollowsItsInputs_data() {
    using Settings = pipeline::CalibrateSettings;
    QTest::addColumn<std::function<void(Settings&)>>("apply");
    const auto row = [](const char* name, std::function<void(Settings&)> apply) {
      QTest::newRow(name) << std::move(apply);
    };
    row("threshold",
        [](Settings& s) { s.threshold.shareOfRowMax = s.threshold.shareOfRowMax > 0 ? 0 : 0.5f; });
    row("clusters", [](Settings& s) { s.clustering.patchCut = 0.8 - 0.5 * s.clustering.patchCut; });
    row("acquisition", [](Settings& s) { s.acquisition.seed += 7; });
  }
  /// Law: no row outlives what it was computed from, and the row of the method in use says what the page
  /// says beside it.
  void itFollowsItsInputs() {
    QFETCH(std::function<void(pipeline::CalibrateSettings&)>, apply);
    const std::vector<MethodPreview> before = page_->table();
    pipeline::CalibrateSettings settings = session().settings();
    apply(settings);
    const bool isMeasuredAnew = settings.acquisition.seed != session().settings().acquisition.seed;
    const bool isCut = settings.threshold.shareOfRowMax > session().settings().threshold.shareOfRowMax;
    const MethodPreview uncut = chosenIn(before);
    session().changeSettings(settings);
    if (isMeasuredAnew) {
      QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
      Progress silent;
      pipeline::resume(own_.path("venue"), own_.path("cache"), silent);
      session().reload();
    }
    QVERIFY(page_->table().empty());
    QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
    QCOMPARE(chosenRow().deltaE, page_->preview()->deltaEMean);
    // Light that the solve does not know of shines all the same: half of the strongest is far too much to
    // cut.
    if (isCut)
      QVERIFY2(chosenRow().psnr < uncut.psnr - 1.0,
               qPrintable(QString("%1 dB, %2 dB uncut").arg(chosenRow().psnr).arg(uncut.psnr)));
    const auto isSame = [](const MethodPreview& a, const MethodPreview& b) { return a.deltaE == b.deltaE; };
    QVERIFY(!std::ranges::equal(page_->table(), before, isSame));
  }

  /// Law: nothing that another method exceeds is called a limit.
  void aLimitIsNotExceeded() {
    using compensation::Method;
    const auto note = [](double refined, double optimum) {
      return noteOf(Method::optimum,
                    {{Method::mix, 20.0}, {Method::refined, refined}, {Method::optimum, optimum}});
    };
    QCOMPARE(note(33.0, 34.0), QString("limit of this venue"));
    QVERIFY(!note(34.0, 33.0).contains("limit"));
  }

  /// Law: another method is another row, not another table.
  void aMethodIsChosenFromIt() {
    pipeline::ContentSettings content = page_->settings();
    content.method = compensation::Method::mix;
    page_->setSettings(content);
    QCOMPARE(page_->table().size(), std::size_t{5});
    QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
    QCOMPARE(chosenRow().deltaE, page_->preview()->deltaEMean);
  }

  void theMethodInUseIsSelected_data() {
    QTest::addColumn<Qt::LayoutDirection>("direction");
    QTest::newRow("from the left") << Qt::LeftToRight;
    QTest::newRow("from the right") << Qt::RightToLeft;
  }
  void theMethodInUseIsSelected() {
    QFETCH(Qt::LayoutDirection, direction);
    QGuiApplication::setLayoutDirection(direction);
    MethodsCard card(*page_);
    const auto* table = card.findChild<QTableWidget*>("methods");
    const QModelIndexList rows = table->selectionModel()->selectedRows();
    QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    QCOMPARE(rows.size(), 1);
    QCOMPARE(page_->table()[static_cast<std::size_t>(rows.front().row())].method, page_->settings().method);
  }

  /// Law: what is seen of the methods depends on the width, not on how many of them are computed.
  void columnsStayWhileItIsComputed() {
    QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
    MethodsCard card(*page_);
    card.show();
    auto* table = card.findChild<QTableWidget*>("methods");
    const auto hidden = [table] {
      QList<bool> all;
      for (int column = 0; column < table->columnCount(); ++column) all << table->isColumnHidden(column);
      return all;
    };
    pipeline::ContentSettings content = page_->settings();
    for (int width = 400; width <= 1000; width += 60) {
      card.resize(width, card.height());
      QCoreApplication::processEvents();
      const QList<bool> complete = hidden();
      QVERIFY(!complete.front());
      content.blackLift = content.blackLift == 0.0 ? 0.01 : 0.0;
      page_->setSettings(content);
      QVERIFY(!isComplete());
      while (!isComplete()) {
        QCOMPARE(hidden(), complete);
        QTest::qWait(5);
      }
    }
  }

  /// Law: where there is little height the picture has it, without scrolling; the comparison is one click
  /// away, and folded it says which method is used and how well.
  void thePictureHasTheRoom_data() {
    QTest::addColumn<int>("height");
    QTest::addColumn<bool>("isFolded");
    QTest::newRow("960x540") << 330 << true;
    QTest::newRow("1366x768, under a banner") << 480 << true;
    QTest::newRow("1366x768") << 560 << false;
    QTest::newRow("1920x1080") << 870 << false;
  }
  void thePictureHasTheRoom() {
    QFETCH(int, height);
    QFETCH(bool, isFolded);
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> inspector(view.inspector);
    const std::unique_ptr<QScrollArea> scroll(stageScroll(view.stage));
    scroll->resize(700, height);
    scroll->show();
    auto* card = scroll->findChild<MethodsCard*>("methods-card");
    auto* table = scroll->findChild<QTableWidget*>("methods");
    auto* compare = scroll->findChild<QPushButton*>("compare-methods");
    const auto* picture = scroll->findChild<QWidget*>("preview-view");
    const auto scrolls = [&] { return scroll->widget()->height() > scroll->viewport()->height(); };
    QCoreApplication::processEvents();
    QCOMPARE(card->isFolded(), isFolded);
    QCOMPARE(table->isVisible(), !isFolded);
    QCOMPARE(compare->isVisible(), isFolded);
    QTRY_VERIFY(!scrolls());
    QVERIFY2(picture->height() >= 180, qPrintable(QString::number(picture->height())));
    if (!isFolded) return;
    const QString said = card->findChild<ElidedLabel*>()->text();
    QVERIFY2(said.contains(decimalText(chosenRow().psnr, 1) + " dB"), qPrintable(said));
    const int before = picture->height();
    QTest::mouseClick(compare, Qt::LeftButton);
    QCoreApplication::processEvents();
    QVERIFY(table->isVisible() && picture->height() >= 180);
    QTest::mouseClick(compare, Qt::LeftButton);
    QTRY_COMPARE(picture->height(), before);
    QVERIFY(!table->isVisible() && !scrolls());
  }

  /// Law: Acquire and this page speak of different pictures, and it is said what each comes to.
  void whatAcquireExpectedIsSaidBesideIt() {
    const double expected = page_->expectedOfOthers().value();
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> inspector(view.inspector), stage(view.stage);
    const auto* said = inspector->findChild<QLabel*>("expected-of-others");
    for (double decibels : {expected, chosenRow().psnr})
      QVERIFY2(said->text().contains(decimalText(decibels, 1) + " dB"), qPrintable(said->text()));
  }

  /// Law: what is out of date is said, with the reason; a show that plays is not denied.
  void whatIsOutOfDateIsSaid() {
    page_->primary()->trigger();
    QVERIFY(!page_->banner() && page_->status().state == StepState::done);
    pipeline::CalibrateSettings settings = session().settings();
    settings.threshold.energyKept = 0.9f;
    session().changeSettings(settings);
    QTRY_VERIFY_WITH_TIMEOUT(isComplete(), patience);
    QCOMPARE(page_->status().state, StepState::outOfDate);
    QVERIFY(page_->banner() && page_->banner()->sentence.contains("threshold"));
    page_->primary()->trigger();
    QVERIFY(!page_->banner() && page_->status().state == StepState::done);
    QVERIFY(page_->hint().contains("Nothing is projected"));
    session().setShowing(true);
    QVERIFY2(!page_->hint().contains("Nothing is projected"), qPrintable(page_->hint()));
    session().setShowing(false);
  }
};

QTEST_MAIN(TestMethodsTable)
#include "test_methods_table.moc"
