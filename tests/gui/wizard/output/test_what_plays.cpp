// SPDX-License-Identifier: MIT
// What Output says of the show is what is on the projector. On two screens, see
// tests/support/with-two-screens: DUMMY1 is the projector's.
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/two_screens.h"
#include "gui/wizard/output/output_on_venue.h"
#include "output/default_picture.h"
#include "output/venue_use.h"
#include "relucent/base/file.h"
#include "relucent/base/parsed_json.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/settings_json.h"
#include "support/stream_sender.h"
#include "views/image_view.h"
#include "wizard/output/output_inspector.h"
#include "wizard/output/output_page.h"
#include "wizard/output/output_view.h"
#include "wizard/output/playlist_view.h"
#include "wizard/output/set_times_dialog.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;

class TestWhatPlays : public QObject, private OutputOnVenue {
  Q_OBJECT

  static double lightOf(const QImage& picture) {
    double sum = 0.0;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) sum += picture.pixelColor(x, y).green();
    return sum;
  }

 private slots:
  void initTestCase() { measureOnce(); }
  void init() { begin(); }
  void cleanup() { end(); }

  void aStreamWithoutAPictureIsNoStill() {
    page_->addFiles({QString("stream:udp://127.0.0.1:%1").arg(test::freeUdpPort())});
    page_->removeItem(0);
    openOutput();
    QTRY_COMPARE(page_->figures(), OutputPage::tr("No picture has come yet: black"));
    QVERIFY(page_->livePlaying());
    page_->addFiles({defaultPicture()});
    page_->removeItem(0);
    QTRY_VERIFY2(page_->figures().startsWith("still picture"), qPrintable(page_->figures()));
    QVERIFY(!page_->livePlaying());
  }

  void whatIsTooCoarseStartsNoShow_data() {
    QTest::addColumn<int>("stoppedAt");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("as coarse as the projector") << 64 << "before anything was told apart";
    QTest::newRow("in blocks") << 16 << "at blocks of 16 px";
  }
  void whatIsTooCoarseStartsNoShow() {
    QFETCH(int, stoppedAt);
    QFETCH(QString, sentence);
    session().close();
    const std::filesystem::path manifest = own_.path("venue") / CalibrationFolder::manifestName;
    auto json = parsedJson<Json>(readFile(manifest));
    json.at("results").at("acquisition").back().at("values")["stopped_at"] = stoppedAt;
    writeFileAtomically(manifest, json.dump());
    session().open(own_.path("venue"));
    QVERIFY(page_->banner());
    QVERIFY2(page_->banner()->sentence.contains(sentence), qPrintable(page_->banner()->sentence));
  }

  /// Of what is black nothing is on the surface, figures neither.
  void figuresOnTheSurfaceAreTold() {
    openOutput();
    const auto isTold = [this] { return page_->banner() && page_->banner()->sentence.contains("Figures"); };
    page_->projection().setOverlay(true);
    QVERIFY(isTold());
    page_->setBlack(true);
    QVERIFY(!isTold());
    page_->setBlack(false);
    QVERIFY(isTold());
    page_->banner()->command->trigger();
    QVERIFY(!isTold() && !page_->projection().hasOverlay());
  }

  /// An installed show, begun beside the wizard: its pictures are on the projector whatever is said here.
  void aShowOfAnotherProgramIsTold() {
    const auto isTold = [this] {
      return page_->banner() && page_->banner()->sentence.contains("Another program");
    };
    QVERIFY(!isTold());
    for (const bool isOpen : {false, true}) {
      if (isOpen) openOutput();
      {
        const auto show = VenueUse::take(own_.path("venue"), VenueUse::Way::show);
        QTRY_VERIFY_WITH_TIMEOUT(isTold(), patience);
        if (!isOpen) {
          QVERIFY(page_->hint().contains("Another program"));
          QVERIFY(page_->whatIsProjected().contains("Another program"));
          QVERIFY(!page_->status().result.isEmpty());
        } else {
          // Neither is known to be seen.
          QVERIFY(page_->isContested() && page_->status().isHeldUp);
          QCOMPARE(page_->status().result, OutputPage::tr("Two shows at once"));
          QVERIFY2(page_->hint().contains("another program"), qPrintable(page_->hint()));
        }
        QSignalSpy asked(page_.get(), &PageModel::failed);
        page_->banner()->command->trigger();
        QCOMPARE(asked.size(), 1);
        const auto question = asked.front().front().value<FailureReport>();
        QVERIFY(question.isQuestion && question.reason);
        QCOMPARE(question.resume->text(), OutputPage::tr("Let it play"));
        QVERIFY(isOpen || page_->primary() == nullptr);  // another one over it is not what comes next
        question.resume->trigger();
        QVERIFY(!question.reason);  // gone with the answer
      }
      QTRY_VERIFY_WITH_TIMEOUT(!isTold(), patience);
    }
  }

  /// Another set goes onto the projector while it plays, and is what is proved from then on.
  void anotherSetPlaysWithoutClosing() {
    session().changeSets([](CalibrationFolder& folder) {
      for (const char* name : {"day", "night"}) pipeline::saveSet(folder, name);
      pipeline::CalibrateSettings night = pipeline::settingsOf(folder);
      night.content.blackLift = 0.3;
      pipeline::changeSettings(folder, night);
      pipeline::useSet(folder, "day");
    });
    openOutput();
    const QImage byDay = page_->projection().onProjector();
    page_->useSet("night");
    QVERIFY(page_->isOpen() && !page_->playsEarlier());
    QCOMPARE(page_->sets().nameInUse(), std::string("night"));
    QTRY_VERIFY_WITH_TIMEOUT(lightOf(page_->projection().onProjector()) > 1.1 * lightOf(byDay), patience);
    QVERIFY(!page_->projection().onProjector().isNull() && offersProof());
    // What plays is behind its results: first the newest, then another set of it.
    change([](pipeline::CalibrateSettings& settings) { settings.threshold.shareOfRowMax = 0.3f; });
    QVERIFY(page_->playsEarlier() && !page_->whyNoSets().isEmpty());
    page_->useSet("day");
    QCOMPARE(page_->sets().nameInUse(), std::string("night"));
  }

  /// Law: while the page is looked at and plays, the set is that of the time; what somebody chooses stays
  /// until the next time.
  void thePageFollowsTheTimesOfSets() {
    session().changeSets([](CalibrationFolder& folder) {
      for (const char* name : {"day", "night"}) pipeline::saveSet(folder, name);
      pipeline::useSet(folder, "day");
    });
    QTime now(17, 0);
    page_->setClock([&now] { return now; });
    page_->setTimes({{{8, 0}, "day"}, {{18, 0}, "night"}});
    const auto inUse = [this] { return page_->sets().nameInUse(); };
    page_->enter();
    openOutput();
    now = QTime(18, 0);
    QTRY_COMPARE_WITH_TIMEOUT(inUse(), std::string("night"), patience);
    QVERIFY(page_->isOpen() && !page_->playsEarlier());
    const auto at = [&](QTime time) {
      now = time;
      page_->followTimes();
      return inUse();
    };
    // At once, while the other one is being prepared.
    page_->useSet("day");
    QCOMPARE(inUse(), std::string("day"));
    QCOMPARE(at({23, 0}), std::string("day"));
    QCOMPARE(at({8, 0}), std::string("day"));
    QCOMPARE(at({18, 30}), std::string("night"));
    // Whoever works at Preview keeps what is worked on.
    page_->leave();
    QCOMPARE(at({9, 0}), std::string("night"));
    page_->enter();
    QCOMPARE(at({9, 0}), std::string("day"));
  }

  /// Of one time there is one set, and they stand in the order of the day.
  void timesOfSetsAreKeptInThePlaylist() {
    SetTimesDialog dialog({"day", "night"}, {{{18, 0}, "day"}});
    QSignalSpy chosen(&dialog, &SetTimesDialog::chosen);
    const auto add = [&](QTime time, const char* set) {
      auto* typed = dialog.findChild<QLineEdit*>("set-time");
      typed->selectAll();
      QTest::keyClicks(typed, "25");
      QVERIFY(!dialog.findChild<QPushButton*>("add-set-time")->isEnabled());
      typed->selectAll();
      QTest::keyClicks(typed, time.toString("H:mm"));
      dialog.findChild<QComboBox*>("set-of-time")->setCurrentText(set);
      dialog.findChild<QPushButton*>("add-set-time")->click();
    };
    add({18, 0}, "night");
    add({8, 0}, "day");
    add({9, 0}, "night");
    dialog.findChild<QListWidget*>("set-times-list")->setCurrentRow(1);
    dialog.findChild<QPushButton*>("remove-set-time")->click();
    dialog.findChild<QPushButton*>("set-times-do")->click();
    QCOMPARE(chosen.size(), 1);
    const auto times = chosen[0][0].value<QList<SetTime>>();
    QVERIFY((times == QList<SetTime>{{{8, 0}, "day"}, {{18, 0}, "night"}}));
    page_->setTimes(times);
    QVERIFY(readPlaylist(page_->playlist().file()).sets == times);
  }

  void aShowBehindItsResultsSaysSo_data() {
    using Settings = pipeline::CalibrateSettings;
    QTest::addColumn<std::function<void(Settings&)>>("apply");
    QTest::addColumn<bool>("isEarlier");
    const auto row = [](const char* name, bool isEarlier, std::function<void(Settings&)> apply) {
      QTest::newRow(name) << std::move(apply) << isEarlier;
    };
    row("threshold", true, [](Settings& s) { s.threshold.shareOfRowMax = 0.3f; });
    row("clusters", true, [](Settings& s) { s.clustering.patchRadius += 1.0; });
    row("method", true, [](Settings& s) { s.content.method = compensation::Method::none; });
    row("blacks", true, [](Settings& s) { s.content.blackLift = 0.1; });
    row("white", true, [](Settings& s) { s.content.brightness = compensation::Brightness::region; });
    row("nothing", false, [](Settings&) {});
    // Which pictures play is the playlist's.
    row("picture", false, [](Settings& s) { s.content.picture = "another.png"; });
  }
  /// Law: what has become newer than what plays is said, brought onto the projector by the one primary
  /// command, and not proved before that.
  void aShowBehindItsResultsSaysSo() {
    QFETCH(std::function<void(pipeline::CalibrateSettings&)>, apply);
    QFETCH(bool, isEarlier);
    openOutput();
    QVERIFY(!page_->playsEarlier() && offersProof());
    change(apply);
    QCOMPARE(page_->playsEarlier(), isEarlier);
    QCOMPARE(offersProof(), !isEarlier);
    if (!isEarlier) return;
    QCOMPARE(page_->banner()->sentence, OutputPage::tr("The show still plays another correction"));
    QVERIFY(page_->status().isHeldUp && page_->status().result != OutputPage::tr("Playing"));
    page_->verify();
    QVERIFY(page_->isOpen() && page_->proof().work() == OutputProof::Work::none);
    QCOMPARE(page_->primary()->text(), OutputPage::tr("Show the current correction"));
    QVERIFY(page_->primary()->isEnabled());
    page_->primary()->trigger();
    QVERIFY(!page_->isOpen());
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen(), patience);
    QVERIFY(!page_->playsEarlier() && offersProof() && !page_->status().isHeldUp);
    QVERIFY(!page_->banner());
  }

  /// Law: what is on the surface in place of the playlist is said, with the way back to it.
  void aTestChartIsSaid() {
    openOutput();
    PlaylistView list(*page_);
    const auto marked = [&list] {
      return list.item(0)->data(Qt::AccessibleTextRole).toString().endsWith("playing");
    };
    QTRY_VERIFY(marked());
    page_->projection().nextChart();
    QCOMPARE(page_->status().result, OutputPage::tr("Test chart"));
    QCOMPARE(page_->banner()->sentence, OutputPage::tr("A test chart is on the surface"));
    QVERIFY2(page_->hint().contains("T "), qPrintable(page_->hint()));
    QTRY_VERIFY(!marked());
    // Black is what is seen of both.
    page_->setBlack(true);
    QCOMPARE(page_->status().result, OutputPage::tr("Black"));
    QVERIFY(!page_->banner());
    page_->setBlack(false);
    page_->banner()->command->trigger();
    QVERIFY(!page_->showsChart() && !page_->banner());
    QCOMPARE(page_->status().result, OutputPage::tr("Playing"));
    QTRY_VERIFY(marked());
  }

  /// Law: what plays is not interrupted by a change of the list around it.
  void anEditedListPlaysOn() {
    QStringList files;
    for (int grey : {40, 80, 120}) {
      files << QString::fromStdString(own_.path(QString("grey-%1.png").arg(grey)).string());
      QImage picture(16, 12, QImage::Format_RGB32);
      picture.fill(QColor(grey, grey, grey));
      QVERIFY(picture.save(files.back()));
    }
    page_->addFiles({files[0], files[1]});
    openOutput();
    const auto playing = [&] {
      const qsizetype index = page_->projection().playing();
      return index < 0 ? QString() : page_->playlist().settings().items.at(index).path;
    };
    QTRY_VERIFY_WITH_TIMEOUT(!playing().isEmpty(), patience);
    const QString first = playing();
    page_->moveItem(page_->projection().playing(), 1);
    QTRY_COMPARE_WITH_TIMEOUT(page_->projection().playing(), qsizetype{1}, patience);
    QCOMPARE(playing(), first);
    page_->addFiles({files[2]});
    page_->removeItem(0);
    QTRY_COMPARE_WITH_TIMEOUT(page_->projection().playing(), qsizetype{0}, patience);
    QCOMPARE(playing(), first);
    // Nor is it begun anew for another correction.
    page_->moveItem(0, 1);
    QTRY_COMPARE_WITH_TIMEOUT(page_->projection().playing(), qsizetype{1}, patience);
    change([](pipeline::CalibrateSettings& settings) { settings.content.reachablePercentile = 40.0; });
    QVERIFY(page_->playsEarlier());
    // Nor is black lifted, which is said, whatever stands beside it.
    page_->setBlack(true);
    QCOMPARE(page_->status().result, OutputPage::tr("Black"));
    QVERIFY(page_->status().isHeldUp && page_->hint().contains("Black"));
    page_->renew();
    QVERIFY(!page_->isOpen());
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen() && !playing().isEmpty(), patience);
    QCOMPARE(playing(), first);
    QVERIFY(page_->isBlack());
    QCOMPARE(page_->status().result, OutputPage::tr("Black"));
    QTRY_VERIFY(!page_->projection().onProjector().isNull());
  }

  /// Law: the list that is seen is the one that plays, also when a picture comes to it from Preview: what is
  /// marked in it is what is meant.
  void aPictureFromPreviewPlaysAtItsPlace() {
    QFile broken(QString::fromStdString(own_.path("broken.png").string()));
    QVERIFY(broken.open(QIODevice::WriteOnly) && broken.write("no picture") > 0);
    broken.close();
    const QString preferred = QString::fromStdString(own_.path("preferred.png").string());
    QImage picture(16, 12, QImage::Format_RGB32);
    picture.fill(Qt::gray);
    QVERIFY(picture.save(preferred));
    page_->addFiles({broken.fileName()});
    openOutput();
    const auto skipped = [&] {
      const auto all = page_->projection().skipped();
      return all.empty() ? QString() : page_->playlist().settings().items.at(all.front().index).path;
    };
    QTRY_COMPARE_WITH_TIMEOUT(skipped(), broken.fileName(), patience);
    change([&](pipeline::CalibrateSettings& s) { s.content.picture = preferred.toStdString(); });
    QCOMPARE(page_->playlist().settings().items.front().path, preferred);
    QVERIFY(page_->isOpen() && (skipped().isEmpty() || skipped() == broken.fileName()));
    QTRY_COMPARE_WITH_TIMEOUT(skipped(), broken.fileName(), patience);
    QCOMPARE(page_->projection().skipped().front().index, qsizetype{2});
  }

  /// Law: what photographs of the picture have made better is what plays from then on, until it is to be
  /// shown as before, or in another way.
  void aPerfectedPicturePlays() {
    Perfecting& perfecting = page_->perfecting();
    const auto settled = [&] { return page_->isOpen() && page_->projection().statistics().steps >= 0; };
    const auto plays = [&](bool perfected) {
      return settled() && page_->projection().statistics().perfected == perfected;
    };
    openOutput();
    QVERIFY(!perfecting.known() && page_->mayProve());
    page_->perfect();
    QVERIFY(perfecting.isRunning() && !page_->mayProve());
    QTRY_VERIFY_WITH_TIMEOUT(!perfecting.isRunning(), patience);
    QVERIFY(perfecting.outcome() && perfecting.outcome()->kept);
    QVERIFY(perfecting.photographs() > 1);
    const std::vector<pipeline::PictureError> told = perfecting.outcome()->after.views;
    // What came of it is still known when another picture plays by then.
    QVERIFY(perfecting.isOfShown());
    perfecting.lookAt("another.png", {});
    QVERIFY(!perfecting.isOfShown() && perfecting.outcome() && !perfecting.tried().isEmpty());
    QTRY_VERIFY_WITH_TIMEOUT(perfecting.known().has_value(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(plays(true), patience);
    // What is proved is what plays, and measured as what perfecting told of it.
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && isIdle(), patience);
    QVERIFY(page_->proof().proof()->figures.perfected);
    const double measured = page_->proof().proof()->figures.after.measured.deltaE;
    QVERIFY2(std::abs(measured - told.front().deltaE) < 0.1 * told.front().deltaE,
             qPrintable(QString("%1, %2 was told").arg(measured).arg(told.front().deltaE)));
    QTRY_VERIFY_WITH_TIMEOUT(plays(true), patience);
    // Another white is another picture.
    change([](pipeline::CalibrateSettings& s) { s.content.blackLift = 0.1; });
    QTRY_VERIFY_WITH_TIMEOUT(!perfecting.known(), patience);
    change([](pipeline::CalibrateSettings& s) { s.content.blackLift.reset(); });
    QTRY_VERIFY_WITH_TIMEOUT(perfecting.known().has_value(), patience);
    perfecting.forget();
    QVERIFY(!perfecting.known());
    QTRY_VERIFY_WITH_TIMEOUT(plays(false) && page_->projection().statistics().frames > 1, patience);
  }

  /// Law: while another step has the devices, no part of the page says that nothing is projected.
  void devicesInUseAreNoDarkProjector() {
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    const auto says = [&](const char* words) {
      const QList<ImageView*> pictures = stage->findChildren<ImageView*>();
      return std::ranges::any_of(pictures, [&](ImageView* one) { return one->emptyText().contains(words); });
    };
    QVERIFY(says("Nothing is projected"));
    {
      const DeviceLease lease = session().leaseDevices({"acquire", "", "Acquire"}, DeviceWork::measurement);
      QVERIFY(says("in use at Acquire") && !says("Nothing is projected"));
      QVERIFY(!page_->hint().contains("Nothing is projected"));
    }
    QTRY_VERIFY(says("Nothing is projected"));
  }

  /// Law: while patterns stand on the projectors, no part of the window says that nothing does; the rail says
  /// what is done, and it can be stopped.
  void whatIsDoneByPhotographsIsSaid_data() {
    QTest::addColumn<bool>("repairs");
    QTest::newRow("check for drift") << false;
    QTest::newRow("repair") << true;
  }
  void whatIsDoneByPhotographsIsSaid() {
    QFETCH(bool, repairs);
    const PageView view = viewOf(*page_);
    const std::unique_ptr<QWidget> stage(view.stage), inspector(view.inspector);
    const QString nothing = OutputPage::tr("The output is closed. Nothing is projected from here.");
    const auto says = [&](const QString& sentence) {
      const QList<ImageView*> pictures = stage->findChildren<ImageView*>();
      return std::ranges::any_of(pictures, [&](ImageView* one) { return one->emptyText() == sentence; });
    };
    QVERIFY(!page_->isOpen() && says(nothing) && page_->secondary().empty());
    repairs ? page_->repair() : page_->checkDrift();
    QVERIFY(!isIdle() && !says(nothing) && says(page_->whatIsProjected()));
    QCOMPARE(page_->status().state, StepState::busy);
    QCOMPARE(page_->status().result, QString(repairs ? "Repairing" : "Checking for drift"));
    QCOMPARE(page_->secondary().size(), std::size_t{1});
    page_->secondary().front()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(isIdle(), patience);
    QVERIFY(says(nothing) && !page_->proof().drift() && !page_->proof().repair());
  }

  /// Law: a repair that finds the venue as it was leaves nothing of what was found before.
  void whatWasPutRightIsNoDrift() {
    becomes([](venue::Changes& changes) { changes.painted.push_back({{0.45, 0.5}, 0.3}); });
    page_->checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().drift() && isIdle(), patience);
    QVERIFY(page_->proof().drift()->verdict == acquisition::Verdict::remeasure);
    becomes([](venue::Changes& changes) { changes.painted.clear(); });
    QVERIFY(page_->proof().drift().has_value());  // nobody has looked again
    page_->repair();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().repair() && isIdle(), patience);
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::nothingToDo);
    QVERIFY(!page_->proof().drift() && page_->proof().newestDrift() == nullptr);
  }

  /// Law: where nothing is better by it, measuring again is what is left.
  void whatCannotBeRepairedIsMeasuredAgain() {
    openOutput();
    page_->repair();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().repair() && isIdle(), patience);
    QCOMPARE(page_->proof().repair()->end, pipeline::RepairEnd::nothingToDo);
    QVERIFY(page_->isOpen() && !page_->playsEarlier() && !page_->proof().repairNote());
  }

  /// Law: the new measurement's correction is not the earlier one's, and only its own photograph proves it.
  void aNewMeasurementMakesItEarlier() {
    openOutput();
    page_->verify();
    QTRY_VERIFY_WITH_TIMEOUT(page_->proof().proof() && page_->proof().work() == OutputProof::Work::none,
                             patience);
    QVERIFY(!page_->proof().isOutOfDate());
    {
      CalibrationFolder folder =
          CalibrationFolder::open(own_.path("venue"), CalibrationFolder::Access::write);
      pipeline::measureAgain(folder, Stage::acquisition);
    }
    session().reload();
    // Begun is not done: nothing that is shown has changed.
    QVERIFY(session().progress(Stage::acquisition) == StageProgress::stale);
    QVERIFY(!page_->playsEarlier() && !page_->proof().isOutOfDate());
    Progress silent;
    pipeline::resume(own_.path("venue"), own_.path("cache"), silent);
    session().reload();
    QVERIFY(session().progress(Stage::acquisition) == StageProgress::done);
    QVERIFY(page_->playsEarlier() && page_->proof().isOutOfDate());
    QCOMPARE(page_->primary()->text(), OutputPage::tr("Show the current correction"));
    page_->primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen(), patience);
    QCOMPARE(page_->banner()->sentence, OutputPage::tr("The verification photograph is out of date"));
    QVERIFY(offersProof());
  }

  /// Law: which screen is the projector's is decided by a person, not by a cable.
  void aChosenScreenStaysChosen_data() {
    QTest::addColumn<bool>("isPlaying");
    QTest::newRow("while it plays") << true;
    QTest::newRow("while it is closed") << false;
  }
  void aChosenScreenStaysChosen() {
    QFETCH(bool, isPlaying);
    if (isPlaying) openOutput();
    unplug();
    QTRY_VERIFY(!page_->chosen());
    QCOMPARE(page_->missingScreen(), QString("DUMMY1"));
    QCOMPARE(page_->isScreenLost(), isPlaying);
    QVERIFY(!page_->mayProve() || !isPlaying);
    // One voice while it is away.
    if (isPlaying)
      QVERIFY2(!page_->hint().contains("Choose") && page_->banner()->more.contains("by itself"),
               qPrintable(page_->hint()));
    else
      QVERIFY2(page_->hint().contains("DUMMY1"), qPrintable(page_->hint()));
    plug();
    QTRY_VERIFY(page_->chosen());
    QCOMPARE(page_->screens()[*page_->chosen()].identity.connector, QString("DUMMY1"));
    QVERIFY(page_->missingScreen().isEmpty());
    page_->close();
    openOutput();
    QTRY_VERIFY_WITH_TIMEOUT(!allBlack(seenOn("DUMMY1")), patience);
  }

  void aStreamThatIsLostIsTold() {
    test::HttpSender sender;
    page_->addFiles({"stream:" + sender.url().replace("//", "//user:secret@")});
    while (page_->playlist().settings().items.size() > 1) page_->removeItem(0);
    const std::unique_ptr<QWidget> part(playlistPart(*page_));
    part->show();
    auto* told = part->findChild<QLabel*>("streams");
    openOutput();
    QTRY_VERIFY(page_->projection().statistics().liveSeconds > 0.0);
    QTRY_VERIFY(!told->isVisible());
    sender.stop();
    QTRY_VERIFY(told->isVisible() && told->text().contains(sender.url()));
    QVERIFY2(!told->text().contains("secret"), qPrintable(told->text()));
    QCOMPARE(page_->figures(), OutputPage::tr("The live picture is lost: its last one stands"));
    QVERIFY(sender.start());
    QTRY_VERIFY_WITH_TIMEOUT(!told->isVisible(), 10'000);
    page_->close();
  }
};

QTEST_MAIN(TestWhatPlays)
#include "test_what_plays.moc"
