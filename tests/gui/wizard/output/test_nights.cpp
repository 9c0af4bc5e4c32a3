// SPDX-License-Identifier: MIT
// What Output tells of the nights. On two screens, see tests/support/with-two-screens.
#include <QComboBox>
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>
#include <limits>

#include "gui/wizard/output/night_history.h"
#include "gui/wizard/simulated_session.h"
#include "output/installation.h"
#include "output/venue_use.h"
#include "wizard/output/nights_dialog.h"
#include "wizard/output/nights_part.h"
#include "wizard/output/output_page.h"

using namespace relucent;
using namespace relucent::gui;
using pipeline::NightRecord;

class TestNights : public QObject {
  Q_OBJECT

  static std::vector<NightRecord> fourWeeks() {
    const QTemporaryDir folder;
    addFourWeeks(folder.path().toStdString());
    return pipeline::nightsOf(folder.path().toStdString());
  }
  static const charts::Curve* curveOf(const NightsChart& chart, const char* style) {
    const auto found = std::ranges::find(chart.curves, std::string(style), &charts::Curve::style);
    return found != chart.curves.end() ? &*found : nullptr;
  }

 private slots:
  /// Law: every night that was photographed is a point at its day, and marks stand at repairs and alarms.
  void everyNightIsDrawn_data() {
    QTest::addColumn<int>("figure");
    QTest::newRow("colour error") << static_cast<int>(NightFigure::colourError);
    QTest::newRow("PSNR") << static_cast<int>(NightFigure::psnr);
  }
  void everyNightIsDrawn() {
    QFETCH(int, figure);
    const NightsChart chart = chartOf(fourWeeks(), static_cast<NightFigure>(figure));
    const charts::Curve* measured = curveOf(chart, "accent");
    QVERIFY(measured != nullptr && measured->line.size() == 26 && measured->points.size() == 26);
    QCOMPARE(measured->line.front().x, -27.0);
    QCOMPARE(measured->line.back().x, 0.0);
    const charts::Curve *repairs = curveOf(chart, "green"), *alarms = curveOf(chart, "red");
    QVERIFY(repairs != nullptr && alarms != nullptr);
    QCOMPARE(repairs->points.size(), 2);
    QCOMPARE(alarms->points.size(), 1);
    QCOMPARE(alarms->points.front().y, chart.y.low);  // nothing was photographed
    for (const charts::Curve& curve : chart.curves)
      for (const std::vector<charts::Point>* points : {&curve.line, &curve.points})
        for (const charts::Point& point : *points)
          QVERIFY(point.x >= chart.x.low && point.x <= chart.x.high && point.y >= chart.y.low &&
                  point.y <= chart.y.high);
    QVERIFY(chart.summary.contains("28") && chart.summary.contains("Repairs: 2. Alarms: 1."));
  }

  void oldNightsAreNotDrawnAndUnreachablePicturesNeither() {
    std::vector<NightRecord> nights = fourWeeks();
    nights.front().when = "2025-01-01T02:00:00Z";
    nights.back().measured->psnr = std::numeric_limits<double>::quiet_NaN();
    QCOMPARE(curveOf(chartOf(nights, NightFigure::colourError), "accent")->points.size(), 25);
    QCOMPARE(curveOf(chartOf(nights, NightFigure::psnr), "accent")->points.size(), 24);
    QCOMPARE(chartOf({}, NightFigure::psnr).curves.size(), 2);  // empty ones
    // Of one night a line would be nothing to see.
    const NightsChart first = chartOf({nights.front()}, NightFigure::psnr);
    QVERIFY(curveOf(first, "information")->marker != charts::Marker::none);
    QCOMPARE(curveOf(first, "information")->points.size(), 1);
  }

  void sentences() {
    NightRecord night;
    night.when = "2026-05-01T02:00:00Z";
    night.skipped = Message::plain("the computer slept");
    QCOMPARE(nightSentence(night), QString("Left out: The computer slept."));
    night.skipped = {};
    night.alarm = Message::plain("the lamp is off");
    night.repair = pipeline::RepairEnd::notBetter;
    night.perfected = 2;
    night.untold = Message::plain("no such file");
    const QString sentence = nightSentence(night);
    for (const char* part : {"Alarm: The lamp is off.", "no better picture", "2", "Nobody was told"})
      QVERIFY2(sentence.contains(part), qPrintable(sentence));
  }

  void theDialogListsThemAll() {
    NightsDialog dialog(fourWeeks());
    dialog.show();
    const auto* list = dialog.findChild<QListWidget*>("nights-list");
    QCOMPARE(list->count(), 28);
    QVERIFY(list->item(0)->text().contains("Photographed"));
    QVERIFY(list->item(3)->data(Qt::AccessibleTextRole).toString().contains("Alarm"));
    auto* chart = dialog.findChild<LineChart*>("nights-chart");
    const QString ofColours = chart->accessibleDescription();
    auto* figure = dialog.findChild<Segmented*>("nights-figure");
    Q_EMIT figure->chosen(1);
    QVERIFY(chart->accessibleDescription() != ofColours && chart->accessibleDescription().contains("dB"));
    QTest::keyClick(&dialog, Qt::Key_Escape);
    QVERIFY(!dialog.isVisible());
  }

  /// Law: what is chosen is in the installed show at once, and is found there again.
  void anInstalledShowIsToldWhenToLookAfterThePicture() {
    SimulatedSession own;
    QTemporaryDir config;
    OutputPage page(own.session);
    page.setConfigFolder(config.path());
    NightsPart part(page);
    auto* when = part.findChild<QComboBox*>("night-time");
    QVERIFY(!when->isEnabled() || !own.session.isOpen());
    own.begin(scriptedVenue("true {image}", "true {exposure} {output}"));
    QVERIFY(when->isEnabled() && !page.nightAt().isValid());
    const auto installed = [&config] {
      const QString service = installedValue(Start::service, config.path(), "--night");
      return service.isEmpty() ? installedValue(Start::autostart, config.path(), "--night") : service;
    };
    page.install();
    QVERIFY(page.isInstalled() && installed().isEmpty());
    when->setCurrentIndex(when->findData(QTime(3, 0)));
    Q_EMIT when->activated(when->currentIndex());
    QCOMPARE(installed(), QString("03:00"));
    OutputPage again(own.session);
    again.setConfigFolder(config.path());
    QCOMPARE(again.nightAt(), QTime(3, 0));
    // Without anything to play nothing is installed anew.
    again.setNightAt({});
    QCOMPARE(again.nightAt(), QTime(3, 0));
    page.setNightAt({});
    QVERIFY(page.isInstalled() && installed().isEmpty());
  }

  void thePageTellsOfTheLastNight() {
    SimulatedSession own;
    OutputPage page(own.session);
    NightsPart part(page);
    part.show();
    auto* open = part.findChild<QPushButton*>("nights-open");
    const auto says = [&](const QString& text) {
      const QList<QLabel*> labels = part.findChildren<QLabel*>();
      return std::ranges::any_of(labels, [&](const QLabel* label) { return label->text().contains(text); });
    };
    QVERIFY(says("There was no night yet") && !open->isEnabled());
    own.begin();
    QVERIFY(!open->isEnabled());
    // By another program, while somebody looks.
    addFourWeeks(own.session.path());
    QTRY_VERIFY(says("All is well") && open->isEnabled());
    {
      const auto night = VenueUse::take(own.session.path(), VenueUse::Way::night);
      QVERIFY(night);
      QTRY_VERIFY_WITH_TIMEOUT(says("A night is under way") && !says("All is well"), 10'000);
    }
    QTRY_VERIFY_WITH_TIMEOUT(says("All is well"), 10'000);
    NightRecord night;
    night.when = "2026-06-01T02:00:00Z";
    night.alarm = Message::plain("the lamp is off");
    pipeline::addNight(own.session.path(), night);
    part.hide();
    part.show();
    QVERIFY(says("Somebody has to look") && says("The lamp is off."));
    open->click();
    auto* dialog = part.findChild<NightsDialog*>("nights");
    QVERIFY(dialog != nullptr);
    QCOMPARE(dialog->findChild<QListWidget*>("nights-list")->count(), 29);
    dialog->close();
    std::ofstream(own.session.path() / pipeline::nightsName) << "{\n";
    part.hide();
    part.show();
    QVERIFY(says("history") && !open->isEnabled());
  }
};

QTEST_MAIN(TestNights)
#include "test_nights.moc"
