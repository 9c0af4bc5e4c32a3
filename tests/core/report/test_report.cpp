// SPDX-License-Identifier: MIT

#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>
#include <cmath>
#include <map>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/calibration/json.h"
#include "relucent/image/exr.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/drift_record.h"
#include "relucent/pipeline/evaluate.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/pipeline/prove.h"
#include "relucent/pipeline/stopped_early.h"
#include "relucent/pipeline/stored_settings.h"
#include "relucent/report/number_text.h"
#include "relucent/report/pictures.h"
#include "relucent/report/report.h"
#include "relucent/report/support_bundle.h"
#include "support/stored_zip.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::hdr;
using namespace relucent::image;
using namespace relucent::pipeline;
using namespace relucent::report;

namespace {

constexpr Size size{64, 48};

/// A smooth picture; `seed` moves its waves.
Image waves(double seed, double level) {
  Image image(size, 3);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y, c) = static_cast<float>(level * (0.5 + 0.5 * std::sin(0.1 * x + 0.13 * y + c + seed)));
  return image;
}

CalibrateSettings plainVenue() {
  venue::VenueSettings venue;
  venue.name = "plain";
  venue.projector = {32, 24};
  venue.camera = {24, 18};
  venue.pathsPerPixel = 16;
  CalibrateSettings settings;
  settings.rig = venue;
  settings.linearization.levels = 9;
  return settings;
}

ReportData fullData() {
  ReportData data;
  data.title = "Chapel <niche> & \"altar\"";
  data.venue = "Simulated venue corner: it's glossy";
  data.software = "Relucent 0.1.0";
  data.measured = "2026-01-02T03:04:05Z";
  data.projector = {256, 192};
  data.camera = {160, 120};
  data.result = {805,
                 1551,
                 {41.0, 655.5, 4.25},
                 30123456,
                 2345678,
                 0.012,
                 0.004,
                 0.03,
                 3210000000,
                 {Message::plain("White is <18 %> too bright")}};
  std::vector<double> x, y;
  for (int i = 0; i <= 32; ++i) {
    x.push_back(i / 32.0);
    y.push_back(std::pow(i / 32.0, 2.2));
  }
  ResponseCurve curve(x, y);
  data.responses = {{{curve, ResponseCurve(), curve}}};
  data.additivityError = {0.007};
  data.exposures = {0.25, 0.0625};
  data.flood = waves(0.0, 1.0);
  data.black = waves(1.0, 0.01);
  data.flagged.assign(size.count(), 0);
  data.flagged[100] = 1;
  data.leavesPerLevel = {2000000, 300000, 40000, 5000, 600};
  data.ridge = 0.4;
  data.ridgeCurve = {{0.2, 24.5}, {0.4, 24.75}, {0.8, 24.1}};
  CameraMask inside(size.count(), 1);
  inside[0] = 0;
  data.comparisons = {{"Evening",
                       Method::refined,
                       waves(0.0, 0.5),
                       waves(0.8, 0.4),
                       waves(0.05, 0.5),
                       {0.6f, 0.6f, 0.6f},
                       inside,
                       0.961,
                       true}};
  EvaluateResult evaluation{"corner", {256, 192}, {160, 120}, 0.961, {0.03, 0.02, 0.1, 0.009, 0.02}, {}};
  evaluation.images = {
      {"Evening",
       0.961,
       {{Method::none, 14.2, 13.0, 0.41, 18.9, 0.001}, {Method::refined, 28.2, 26.0, 0.92, 2.6, 0.03}}}};
  data.evaluation = evaluation;
  data.verification = {waves(0.0, 0.5), waves(0.8, 0.4), waves(0.1, 0.5), 18.5, 3.25, "2026-01-02T04:05:06Z"};
  data.libraries = {{"Eigen", "3.4.0"}, {"A & B", "1"}};
  data.settings = {{"Test patterns", "8"}, {"Projector", "<corner>"}};
  return data;
}

/// The files of a .zip by name.
std::map<std::string, std::string> unpacked(const std::filesystem::path& path) {
  const test::ZipMembers members = test::zipMembers(readFile(path));
  return {members.begin(), members.end()};
}

QString html(const ReportData& data) {
  return QString::fromStdString(reportHtml(data));
}

}  // namespace

class TestReport : public QObject {
  Q_OBJECT

 private slots:
  /// Law: the black level is told from the floodlight image: it is as bright as it is said to be beside that.
  void theBlackLevelIsShownOnATellingScale_data() {
    QTest::addColumn<float>("share");
    QTest::addColumn<QString>("told");
    QTest::newRow("a third of a hundredth")
        << 0.0033f << "shown 200 times as bright as in the floodlight image";
    QTest::newRow("three hundredths") << 0.03f << "shown 20 times as bright as in the floodlight image";
    QTest::newRow("half") << 0.5f << "shown 2 times as bright as in the floodlight image";
    QTest::newRow("a bright room") << 0.9f << "as bright as in the floodlight image";
  }
  void theBlackLevelIsShownOnATellingScale() {
    QFETCH(float, share);
    QFETCH(QString, told);
    ReportData data = fullData();
    data.comparisons.clear();
    data.black = data.flood;
    for (float& value : data.black.data()) value *= share;
    const QString html = QString::fromStdString(reportHtml(data));
    QVERIFY2(html.contains(told), qPrintable(html.mid(html.indexOf("Black level"), 300)));
    QCOMPARE(html.contains("times as bright"), told.contains("times"));
    if (share != 0.5f) return;
    // Twice as bright as half of the light is that light.
    static const QRegularExpression picture(
        "<img src=\"([^\"]*)\"[^>]*alt=\"(Floodlight image|Black level):");
    auto found = picture.globalMatch(html);
    QCOMPARE(found.next().captured(1), found.next().captured(1));
  }

  /// Law: a client reads what was done to what was measured, and when; no repair is taken for a measurement.
  void aRepairIsTold() {
    ReportData data = fullData();
    data.result.exposures = 654;
    QVERIFY(!QString::fromStdString(reportHtml(data)).contains("Repaired"));
    data.repaired = {
        "2026-01-02T03:04:05Z",
        {RELUCENT_MESSAGE("repair.surface-changed",
                          "{} % of what the cameras see is brighter, darker or of another colour than "
                          "it was")
             .with(as::share(0.048, as::decimals(1)))},
        5.04,
        2.53,
        {.seconds = 75.0, .patterns = 60, .exposures = 317}};
    const QString html = QString::fromStdString(reportHtml(data));
    const QString when = QString::fromStdString(localTime(data.repaired->when));
    QVERIFY(html.contains("Repaired " + when) && !html.contains("Measured " + when));
    QVERIFY(html.contains("Repaired on " + when));
    QVERIFY(html.contains("4.8 % of what the cameras see") && html.contains("from 5.0 to 2.5"));
    // It is among what was done, and in the sums.
    QVERIFY(html.contains("60 patterns, 317 photographs") && html.contains("971"));
  }

  void numbersAsTheyAreRead() {
    QCOMPARE(percent(-0.00001), std::string("0 %"));
    QCOMPARE(percent(0.0003), std::string("0.03 %"));
    QCOMPARE(percent(1.0), std::string("100 %"));
    QCOMPARE(smallPercent(3.16e-5), std::string("0.0032 %"));
    QCOMPARE(exposureTime(0.00559), std::string("1/179 s"));
    QCOMPARE(exposureTime(0.5), std::string("0.5 s"));
    QCOMPARE(duration(0.000339), std::string("0.339 ms"));
    QCOMPARE(duration(3.612), std::string("3.61 s"));
    QCOMPARE(stageDuration(1.38), std::string("1 s"));
    QCOMPARE(stageDuration(0.2), std::string("1 s"));
    QCOMPARE(stageDuration(75.4), std::string("1 min 15 s"));
    QCOMPARE(stageDuration(16.1), std::string("16 s"));
    QCOMPARE(percent(-0.012), std::string("-1.2 %"));
    qputenv("TZ", "Etc/GMT-1");
    tzset();
    QCOMPARE(localTime("2026-01-02T23:30:05Z"), std::string("3 January 2026, 00:30"));
    QCOMPARE(localTime("long ago"), std::string("long ago"));
    QVERIFY(html(fullData()).contains("2 January 2026, 04:04"));
    qunsetenv("TZ");
    tzset();
  }

  void proofsAreSaidFirst() {
    ReportData data = fullData();
    data.result.findings.clear();
    QVERIFY(!html(data).contains("Photographed on"));  // nobody kept how it was judged
    data.verification->deltaEPredicted = 3.0;
    data.verification->isAsPredicted = true;
    data.drift = ReportDrift{Verdict::stillGood, 0.031, 0.03, 0.004, "2026-01-03T04:05:06Z"};
    QString page = html(data);
    QVERIFY(page.contains("the surface looks as predicted") && page.contains("the measurement still holds"));
    QVERIFY(page.contains("within 3.1 %, when measured 3.0 %; 0.4 % of the view changed"));
    QVERIFY(page.contains("Nothing stands out") && !page.contains("note amber"));
    data.verification->isAsPredicted = false;
    data.drift->verdict = Verdict::remeasure;
    page = html(data);
    QCOMPARE(page.count("note amber"), 2);
    QVERIFY(!page.contains("Nothing stands out") && page.contains("should be repaired"));
    data.drift->verdict = Verdict::startAgain;
    QVERIFY(html(data).contains("hardly anything fits"));
    // A photograph from before that is no praise of what is now.
    data.verification->isAsPredicted = true;
    page = html(data);
    QVERIFY(page.contains("looked as predicted then") && !page.contains("looks as predicted"));
    // Of what is no longer shown: it says so where it is and before.
    data.drift.reset();
    data.verification->isAsPredicted.reset();
    data.verification->isOutOfDate = true;
    page = html(data);
    QCOMPARE(page.count("note amber"), 1);
    QCOMPARE(page.count("measured or chosen anew"), 2);
  }

  /// The error before and after of a perfected picture, and of each night what came of it, the last one
  /// first; its alarm is what everybody reads first.
  void upkeepIsTold() {
    ReportData data = fullData();
    data.result.findings.clear();
    QVERIFY(!html(data).contains("Upkeep"));
    data.perfected.push_back({"hills <1>.png",
                              "2026-01-02T03:04:05Z",
                              {{{30.0, 3.25}, {30.0, 9.0}}, {{31.0, 1.5}, {30.0, 8.75}}, 8}});
    pipeline::NightRecord night;
    night.when = "2026-01-03T02:00:00Z";
    night.repair = pipeline::RepairEnd::repaired;
    night.what = {Message::plain("somebody painted the wall")};
    night.measured = night.predicted = pipeline::PictureError{30.0, 2.5};
    data.nights.push_back(night);
    QString page = html(data);
    QVERIFY(page.contains("hills &lt;1&gt;.png") && page.contains("<td>9.0</td><td>8.8</td><td>8</td>"));
    QVERIFY(page.contains("fits the venue again; somebody painted the wall") &&
            page.contains("<td>2.5</td>"));
    QVERIFY(!page.contains("note amber"));
    night.alarm = Message::plain("the lamp is off");
    data.nights.push_back(night);
    page = html(data);
    QVERIFY(page.contains("Alarm of the night of") && page.count("note amber") == 1);
    QVERIFY(page.indexOf("Alarm: the lamp is off") < page.lastIndexOf("again; somebody painted the wall."));
    night.alarm = {};
    night.skipped = Message::plain("the computer slept");
    data.nights.push_back(night);
    QVERIFY(html(data).contains("skipped: the computer slept."));
  }

  /// Law: every view has its photographs, by name; with one view there is no name.
  void everyViewIsProved() {
    ReportData data = fullData();
    data.result.findings.clear();
    QVERIFY(!html(data).contains("As camera 1 sees it") && html(data).contains("Projector 256"));
    const ReportVerification& shown = *data.verification;
    data.verification->others = {{shown.wanted, shown.before, shown.after, 12.5, 4.75, 4.5}};
    data.projectors = 4;
    data.cameras = 2;
    data.verification->deltaEPredicted = 3.0;
    data.verification->isAsPredicted = false;
    data.verification->viewThatDiffers = 1;
    const QString page = html(data);
    QVERIFY(page.contains("As camera 1 sees it") && page.contains("As camera 2 sees it"));
    QVERIFY(page.contains("ΔE 4.8, predicted 4.5") || page.contains("ΔE 4.7, predicted 4.5"));
    QVERIFY(page.contains("4 projectors, the first 256") && page.contains("2 cameras, the first 160"));
    QVERIFY(page.contains("for camera 2 the surface does not look as predicted"));
  }

  /// Law: errors that nobody overlooks are no plain success, however well they were predicted.
  void aCoarsePredictionIsNoSuccess_data() {
    QTest::addColumn<double>("deltaE");
    QTest::addColumn<bool>("isGood");
    QTest::newRow("fine") << 2.0 << true;
    QTest::newRow("visible side by side") << 4.9 << true;
    QTest::newRow("plain to see") << 5.0 << false;
    QTest::newRow("coarse") << 8.9 << false;
  }
  void aCoarsePredictionIsNoSuccess() {
    QFETCH(double, deltaE);
    QFETCH(bool, isGood);
    ReportData data = fullData();
    data.result.findings.clear();
    data.verification->isAsPredicted = true;
    data.verification->deltaEAfter = data.verification->deltaEPredicted.emplace(deltaE);
    const QString page = html(data);
    QVERIFY(page.contains("looks as predicted"));
    QCOMPARE(page.contains("plain to see. The correction"), !isGood);
    QCOMPARE(page.count("note amber"), isGood ? 0 : 1);
  }

  /// Law: a simulation is called one.
  void aSimulationIsCalledOne() {
    ReportData data = fullData();
    data.verification->isAsPredicted = true;
    QVERIFY(html(data).contains("Projected in the venue"));
    data.isSimulated = true;
    const QString page = html(data);
    QVERIFY(!page.contains("Projected in the venue") && page.contains("A simulation: projected"));
    QVERIFY(page.contains("Photographed in the simulation on"));
  }

  /// Law: the steps' counts are those of their pages, and add up to the whole.
  void everyCountSaysWhatItCounts() {
    ReportData data = fullData();
    data.linearizationPatterns = 29;
    data.result.linearizationExposures = 30;
    const QString page = html(data);
    for (const char* expected : {"41 s, 29 patterns, 30 photographs", "776 patterns, 1\u202f521 photographs",
                                 "805 patterns, 1\u202f551 photographs"})
      QVERIFY2(page.contains(QString::fromUtf8(expected)), expected);
  }

  /// Law: a client is not told what to do in the program.
  void whatWasStoppedIsSaidForAClient() {
    ReportData data = fullData();
    data.stoppedAt = 4;
    data.result.findings = {stoppedEarly(4, std::nullopt)};
    const QString page = html(data);
    QVERIFY(page.contains("blocks of 4 × 4 pixels") && !page.contains("go on measuring"));
  }

  /// Law: what cannot be reached is said to be what it is: below black as well as above white.
  void whatCannotBeReachedIsDarkerOrBrighter() {
    ReportData data = fullData();
    data.comparisons.front().reachable = 0.4;
    QVERIFY(html(data).contains("stays darker than it should"));
    data.comparisons.front().unreachable = {.tooDark = 0.5, .tooBright = 0.1};
    QVERIFY(html(data).contains("stays darker than it should"));
    data.comparisons.front().unreachable = {.tooDark = 0.1, .tooBright = 0.5};
    QVERIFY(html(data).contains("stays brighter than it should"));
  }

  /// Law: a client reads words and units, no names of variables.
  void settingsAreWords_data() {
    QTest::addColumn<CalibrateSettings>("settings");
    CalibrateSettings venue, screen, commands;
    venue.rig = venue::VenueSettings{};
    ScreenRigSettings display;
    display.display = {"HDMI-1", "Maker", "Model 3", ""};
    display.cameraAddress = "gige:192.0.2.17";
    screen.rig = display;
    screen.threshold.absolute = 0.001f;
    screen.pixels = {reduction::PixelUse::Kind::binned, 2};
    commands.rig = CommandRigSettings{};
    commands.acquisition = settingsOf(acquisition::AcquisitionMode::adaptive);
    commands.threshold.shareOfRowMax = 0.01f;
    commands.content.picture = "/home/user/Evening hills.png";
    QTest::newRow("simulated") << venue;
    QTest::newRow("a screen") << screen;
    QTest::newRow("programs") << commands;
  }
  void settingsAreWords() {
    QFETCH(CalibrateSettings, settings);
    static const QRegularExpression key("[a-z]_[a-z]|^[a-z]|[a-z]\\.[a-z]"),
        noWord("^(true|false|null|\\{|\\[)");
    const std::vector<NamedText> list = settingsInWords(settings);
    QVERIFY(list.size() > 8);
    for (const NamedText& line : list) {
      QVERIFY2(!QString::fromStdString(line.name).contains(key), line.name.c_str());
      QVERIFY2(!line.value.empty() && !QString::fromStdString(line.value).contains(noWord),
               line.value.c_str());
      QVERIFY2(!QString::fromStdString(line.value).contains(QRegularExpression("[0-9]e-[0-9]")),
               line.value.c_str());
    }
  }

  /// Law: what a client would see is told; what nobody measured is not made up.
  void whatStandsOutIsSaid() {
    ReportData data = fullData();
    data.result.findings.clear();
    QVERIFY(html(data).contains("Nothing stands out"));
    data.comparisons.front().reachable = 0.914;
    QVERIFY(!html(data).contains("Nothing stands out"));
    QVERIFY(html(data).contains("8.6 % of “Evening” cannot be reached"));
    QVERIFY(html(data).contains("Most memory used"));
    data.result.peakMemoryBytes = 0;
    QVERIFY(!html(data).contains("Most memory used"));
  }

  /// Law: how far off a prediction may be is told where it is known, and only there.
  void uncertaintyIsTold() {
    ReportData data = fullData();
    QVERIFY(!html(data).contains("95 of 100 pixels"));
    data.comparisons.front().uncertainty = 0.0123;
    QVERIFY(html(data).simplified().contains("95 of 100 pixels come within ± 1.2 % of white"));
  }

  void nothingIsFetchedFromAnywhere() {
    QString page = html(fullData());
    for (const char* forbidden : {"http:", "https:", "<script", "<link", "@import", "url("})
      QVERIFY2(!page.contains(forbidden), forbidden);
    QRegularExpression sources("(?:src|href)=\"([^\"]{0,30})");
    for (const auto& match : sources.globalMatch(page))
      QVERIFY2(match.captured(1).startsWith("data:image/png;base64,"), qPrintable(match.captured(1)));
  }

  void everyTextIsEscaped() {
    QString page = html(fullData());
    QVERIFY(page.contains("Chapel &lt;niche&gt; &amp; &quot;altar&quot;"));
    QVERIFY(page.contains("White is &lt;18 %&gt; too bright"));
    QVERIFY(page.contains("&lt;corner&gt;"));
    QVERIFY(page.contains("it&apos;s glossy"));
    QVERIFY(!page.contains("<niche>"));
    QVERIFY(!page.contains("<18"));
  }

  /// Every element is closed in its order: a browser has nothing to guess.
  void theMarkupIsWellFormed() {
    for (const ReportData& data : {fullData(), ReportData{}}) {
      QString page = html(data);
      page.remove(0, page.indexOf("<html"));
      page.replace(QRegularExpression("<(meta|img|br)([^>]*)>"), "<\\1\\2/>");
      QXmlStreamReader reader(page);
      while (!reader.atEnd()) reader.readNext();
      QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
    }
  }

  void everyPictureAndChartSaysWhatItShows() {
    QString page = html(fullData());
    QVERIFY(page.count("<img") >= 9);
    QCOMPARE(page.count(QRegularExpression("<img[^>]* alt=\"[^\"]+\"")), page.count("<img"));
    QVERIFY(page.count("<svg") >= 5);
    QCOMPARE(page.count(QRegularExpression("<svg[^>]* aria-label=\"[^\"]+\"")), page.count("<svg"));
    QCOMPARE(page.count("<h1>"), 1);
    QVERIFY(page.contains("<html lang=\"en\">"));
  }

  void whatWasMeasuredIsSaid() {
    QString page = html(fullData());
    for (const char* expected :
         {"28.2 dB", "14.2 dB", "ΔE", "96.1 %", "11 min 41 s", "1/4 s", "Test patterns", "24.75 dB",
          "Floodlight image", "Reachable light", "3210 MB"})
      QVERIFY2(page.contains(expected), expected);
    // Means over one picture are its own; the best method is marked.
    QVERIFY(page.contains("<tr class=\"best\"><th scope=\"row\">refined"));
  }

  void verificationAndVersionsAreSaid() {
    QString page = html(fullData());
    const std::string taken = localTime(fullData().verification->taken);
    for (const char* expected :
         {"Photograph, compensated", "ΔE 3.2", taken.c_str(), "Eigen 3.4.0", "A &amp; B 1"})
      QVERIFY2(page.contains(expected), expected);
  }

  /// What a client is shown is what the show shows: another white, other figures.
  void picturesAreJudgedAsContentIsShown() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    CalibrateSettings settings = plainVenue();
    Progress silent;
    calibrate(path / "venue", settings, path / "cache", silent);
    const auto reported = [&] {
      const auto page = QString::fromStdString(
          readFile(makeReport(path / "venue", {}, path / "cache", silent).files.front()));
      static const QRegularExpression quality("[0-9.]+ dB");
      QStringList figures;
      for (auto match = quality.globalMatch(page); match.hasNext();) figures += match.next().captured();
      return figures;
    };
    const QStringList before = reported();
    QVERIFY(before.size() > 5);
    QCOMPARE(reported(), before);
    settings.content.reachablePercentile = 60.0;
    {
      CalibrationFolder calibration =
          CalibrationFolder::open(path / "venue", CalibrationFolder::Access::write);
      changeSettings(calibration, settings);
    }
    QVERIFY(reported() != before);
  }

  /// Law: maps of errors are for who adapts to the picture's own white, as the table's figures are.
  void errorsAreOfTheWhiteThatPicturesHave() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    CalibrateSettings settings = plainVenue();
    settings.content.brightness = compensation::Brightness::picture;
    Progress silent;
    calibrate(path / "venue", settings, path / "cache", silent);
    const auto page = QString::fromStdString(
        readFile(makeReport(path / "venue", {}, path / "cache", silent).files.front()));
    EvaluateSettings evaluation;
    evaluation.fewImages = true;
    evaluation.target = targetOf(settings.content);
    const EvaluateResult truth = evaluate(path / "venue", evaluation, path / "cache", silent);
    static const QRegularExpression caption("mean colour error ΔE ([0-9.]+)\\.");
    QList<double> told;
    for (auto match = caption.globalMatch(page); match.hasNext();)
      told += match.next().captured(1).toDouble();
    // Said of each picture twice: to be read, and to be heard.
    QCOMPARE(told.size(), 4 * static_cast<qsizetype>(truth.images.size()));
    for (std::size_t image = 0; image < truth.images.size(); ++image)
      for (const MethodScore& score : truth.images[image].methods) {
        const bool isCompensated = score.method == compensation::Method::refined;
        if (!isCompensated && score.method != compensation::Method::none) continue;
        const double said = told[4 * static_cast<qsizetype>(image) + (isCompensated ? 2 : 0)];
        // Rounded to a tenth; pixels that are not usable are in one mean and not in the other.
        QVERIFY2(std::abs(said - score.deltaE) < 0.06,
                 qPrintable(QString("%1, %2").arg(said).arg(score.deltaE)));
      }
  }

  /// Law: what a check for drift found is said until a later photograph has answered it.
  void aLaterPhotographAnswersWhatWasFoundBefore() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    Progress silent;
    calibrate(path / "venue", plainVenue(), path / "cache", silent);
    const std::string measured = CalibrationFolder::open(path / "venue", CalibrationFolder::Access::read)
                                     .latest(Stage::acquisition)
                                     ->stored;
    ProveSettings proof;
    proof.out = path / "venue" / "verification";
    proof.image = path / "picture.exr";
    writeExr(proof.image, waves(1.0, 0.5), ExrType::half);
    saveDriftRecord(
        {.checked = "2026-01-03T04:05:06Z", .measurement = measured, .verdict = Verdict::remeasure},
        proof.out);
    const auto isDoubted = [&] {
      return QString::fromStdString(
                 readFile(makeReport(path / "venue", {}, path / "cache", silent).files.front()))
          .contains("should be repaired");
    };
    QVERIFY(isDoubted());
    const ProveResult figures = proveCalibration(path / "venue", proof, path / "cache", silent);
    const auto photographed = [&](const std::string& taken, const std::string& measurement) {
      saveProofRecord({.taken = taken, .measurement = measurement, .content = {}, .figures = figures},
                      proof.out);
    };
    photographed("2026-01-03T04:05:05Z", measured);  // the moment before
    QVERIFY(isDoubted());
    photographed("2026-01-03T04:05:07Z", measured);
    QVERIFY(!isDoubted());
    photographed("2026-01-03T04:05:07Z", "of a repair that was undone");
    QVERIFY(isDoubted());
  }

  /// Law: a photograph of before a repair is called out of date, not left out in silence.
  void whatWasPhotographedBeforeARepairIsOutOfDate() {
    QTemporaryDir folder;
    const std::filesystem::path path = folder.path().toStdString();
    Progress silent;
    calibrate(path / "venue", plainVenue(), path / "cache", silent);
    ProveSettings proof;
    proof.out = path / "venue" / "verification";
    proof.image = path / "picture.exr";
    writeExr(proof.image, waves(1.0, 0.5), ExrType::half);
    const ProveResult figures = proveCalibration(path / "venue", proof, path / "cache", silent);
    std::filesystem::last_write_time(
        proof.out / "after.png",
        std::filesystem::last_write_time(proof.out / "after.png") - std::chrono::hours(24));
    const auto saysOutOfDate = [&] {
      return QString::fromStdString(
                 readFile(makeReport(path / "venue", {}, path / "cache", silent).files.front()))
          .contains("is out of date");
    };
    std::filesystem::remove(proof.out / "proof.json");
    QVERIFY(!saysOutOfDate());  // nobody knows of what it was
    saveProofRecord(
        {.taken = "2026-01-03T04:05:06Z", .measurement = "before", .content = {}, .figures = figures},
        proof.out);
    QVERIFY(saysOutOfDate());
  }

  void aBundleShowsNothingOfTheVenueUnlessAsked() {
    QTemporaryDir folder;
    std::filesystem::path path = folder.path().toStdString();
    CalibrationFolder::create(path / "venue", {{"kind", "test"}}, {});
    std::filesystem::create_directories(path / "venue/verification");
    std::filesystem::create_directories(path / "venue/shots");
    writeFileAtomically(path / "venue/verification/after.png", "a photograph");
    writeFileAtomically(path / "venue/shots/a.shot", "a shot");
    writeFileAtomically(path / "show.log", "a log");
    ReportSettings settings;
    settings.bundle = path / "bundle.zip";
    settings.attachments = {path / "show.log", path / "missing.log"};
    writeSupportBundle(path / "venue", fullData(), settings);
    std::map<std::string, std::string> quiet = unpacked(settings.bundle);
    QCOMPARE(quiet.size(), std::size_t{5});
    QCOMPARE(quiet["attached/show.log"], std::string("a log"));
    QVERIFY(quiet["versions.txt"].find("Eigen 3.4.0") != std::string::npos);
    QVERIFY(quiet["calibration.relucent"] == readFile(path / "venue/calibration.relucent"));
    QVERIFY(quiet["report.html"].find("data:image") == std::string::npos);
    QVERIFY(quiet["report.html"].find("Test patterns") != std::string::npos);
    std::string bytes = readFile(settings.bundle);
    writeSupportBundle(path / "venue", fullData(), settings);
    QVERIFY(readFile(settings.bundle) == bytes);

    settings.photographs = true;
    writeSupportBundle(path / "venue", fullData(), settings);
    std::map<std::string, std::string> asked = unpacked(settings.bundle);
    QCOMPARE(asked["verification/after.png"], std::string("a photograph"));
    QVERIFY(asked["report.html"].find("data:image") != std::string::npos);
    QVERIFY(asked.count("shots/a.shot") == 0);
    settings.bundle = "/nowhere/bundle.zip";
    QVERIFY_EXCEPTION_THROWN(writeSupportBundle(path / "venue", fullData(), settings), Error);
  }

  void whatIsMissingIsLeftOut() {
    ReportData data;
    data.title = "empty";
    QString page = html(data);
    QVERIFY(!page.contains("<img"));
    QVERIFY(!page.contains("Methods compared"));
    QVERIFY(!page.contains("nan"));
    QVERIFY(page.contains("Nothing stands out"));
  }

  void picturesOfDifferentSizesAreABreach() {
    ReportData data = fullData();
    data.comparisons[0].compensated = Image({8, 8}, 3);
    QVERIFY_EXCEPTION_THROWN(reportHtml(data), std::logic_error);
  }

  void isWrittenWhole() {
    QTemporaryDir folder;
    std::filesystem::path path = folder.filePath("report.html").toStdString();
    writeReport(path, fullData());
    QCOMPARE(readFile(path), reportHtml(fullData()));
    QVERIFY_EXCEPTION_THROWN(writeReport("/nowhere/report.html", fullData()), Error);
    // For people who want to look at it.
    if (qEnvironmentVariableIsSet("RELUCENT_REPORT"))
      writeReport(qEnvironmentVariable("RELUCENT_REPORT").toStdString(), fullData());
  }

  /// RFC 4648, section 10.
  void base64_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("0") << QByteArray("") << QByteArray("");
    QTest::newRow("1") << QByteArray("f") << QByteArray("Zg==");
    QTest::newRow("2") << QByteArray("fo") << QByteArray("Zm8=");
    QTest::newRow("3") << QByteArray("foo") << QByteArray("Zm9v");
    QTest::newRow("6") << QByteArray("foobar") << QByteArray("Zm9vYmFy");
    QTest::newRow("high bytes") << QByteArray("\xff\xfe\x00", 3) << QByteArray("//4A");
  }
  void base64() {
    QFETCH(QByteArray, bytes);
    QFETCH(QByteArray, text);
    QCOMPARE(QByteArray::fromStdString(relucent::report::base64(bytes.toStdString())), text);
  }

  void errorMapsAreZeroForEqualPicturesAndEmptyOutside() {
    CameraMask inside(size.count(), 1);
    inside[5] = 0;
    Image map = deltaEMap(waves(0, 0.5), waves(0, 0.5), {1, 1, 1}, inside);
    for (std::size_t i = 0; i < map.pixels(); ++i)
      QVERIFY(i == 5 ? std::isnan(map.data()[i]) : map.data()[i] == 0.0f);
    Image other = deltaEMap(waves(0, 0.5), waves(1, 0.5), {1, 1, 1}, inside);
    QVERIFY(*std::max_element(other.data().begin() + 6, other.data().end()) > 5.0f);
  }

  void reachableLightIsThatOfTheHardestColour() {
    Image flood({1, 1}, 3, {0.8f, 0.4f, 0.1f});
    Image black({1, 1}, 3, {0.0f, 0.1f, 0.1f});
    QCOMPARE(reachableLight(flood, black, {1.0f, 1.0f, 0.1f}).data()[0], 0.5f);
  }
};

QTEST_APPLESS_MAIN(TestReport)
#include "test_report.moc"
