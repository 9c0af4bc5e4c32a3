// SPDX-License-Identifier: MIT
// The output of a venue with two projectors, on two screens, see tests/support/with-two-screens. DUMMY0 is
// the operator's: it is given to a projector only when somebody asks for that.
#include <QTemporaryDir>
#include <QtTest>

#include "gui/output/two_screens.h"
#include "relucent/base/file.h"
#include "relucent/calibration/json.h"
#include "relucent/calibration/stage_fingerprint.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/settings_json.h"
#include "wizard/output/output_page.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::pipeline;
using namespace relucent::venue;

namespace {

constexpr int patience = 60000;  // milliseconds; what is waited for takes seconds
constexpr QSize projectorSize(64, 48);

/// A copy of a calibration with all its results, whose devices are no simulation.
void copyAsRecorded(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::copy(from, to, std::filesystem::copy_options::recursive);
  CalibrationFolder::open(to, CalibrationFolder::Access::write)
      .setRig(rigToJson(ReplayRigSettings{"photographs"}));
  const auto inputs = [](const std::filesystem::path& folder, Stage stage) {
    return fingerprintOf(CalibrationFolder::open(folder, CalibrationFolder::Access::read), stage);
  };
  // A later stage's inputs follow from the results of earlier ones.
  for (Stage stage : allValues<Stage>()) {
    const std::filesystem::path manifest = to / CalibrationFolder::manifestName;
    QByteArray text = QByteArray::fromStdString(readFile(manifest));
    text.replace(inputs(from, stage).c_str(), inputs(to, stage).c_str());
    writeFileAtomically(manifest, text.toStdString());
  }
}

QImage withoutAlpha(const QImage& image) {
  return image.convertToFormat(QImage::Format_RGB32);
}

}  // namespace

class TestTwoOutputs : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<OutputPage> page_;

  std::filesystem::path path(const char* name) const { return folder_.filePath(name).toStdString(); }
  std::size_t screen(const QString& connector) const {
    std::size_t index = 0;
    while (page_->screens().at(index).identity.connector != connector) ++index;
    return index;
  }
  /// What stands in the middle of a screen, where a projector's pixels are.
  static QImage inTheMiddle(const QString& connector) {
    QImage seen = seenOn(connector);
    QRect place(QPoint(), projectorSize);
    place.moveTopLeft(
        {(seen.width() - projectorSize.width()) / 2, (seen.height() - projectorSize.height()) / 2});
    return seen.copy(place);
  }

 private slots:
  void initTestCase() {
    VenueSettings venue;
    venue.name = "relief";
    venue.projector = {projectorSize.width(), projectorSize.height()};
    venue.camera = {40, 30};
    venue.pathsPerPixel = 32;
    CalibrateSettings settings;
    settings.rig = venue;
    settings.linearization.levels = 9;
    Progress silent;
    calibrate(path("relief"), settings, path("cache"), silent);
    copyAsRecorded(path("relief"), path("recorded"));
    session_ = std::make_unique<Session>(path("cache"));
    page_ = std::make_unique<OutputPage>(*session_);
    connect(page_.get(), &PageModel::failed, page_.get(),
            [](const FailureReport& report) { qWarning("%s", qPrintable(report.failure.details)); });
    session_->open(path("recorded"));
    QVERIFY(noise({320, 240}, 3).save(folder_.filePath("content.png")));
    page_->addFiles({folder_.filePath("content.png")});
  }
  void cleanupTestCase() {
    page_.reset();
    session_.reset();
  }

  /// The operator's screen is not taken unasked.
  void everyProjectorNeedsAScreen() {
    QCOMPARE(page_->projectors(), std::size_t{2});
    QCOMPARE(page_->screenOf(0), std::optional(screen("DUMMY1")));
    QVERIFY(!page_->screenOf(1));
    QVERIFY(!page_->primary()->isEnabled());
    QCOMPARE(page_->hint(), OutputPage::tr("Choose a screen for projector %1.").arg(2));
    page_->open();
    QVERIFY(!page_->projection().isOpening() && !page_->isOpen());
  }

  void tooFewScreensAreSaidToBe() {
    unplug();
    QTRY_COMPARE(page_->screens().size(), std::size_t{1});
    QVERIFY(!page_->primary()->isEnabled());
    QCOMPARE(page_->hint(),
             OutputPage::tr("Each of the %n projector(s) needs a screen of its own. Plug in another one.",
                            nullptr, 2));
    plug();
    QTRY_COMPARE(page_->screens().size(), std::size_t{2});
    QCOMPARE(page_->screenOf(0), std::optional(screen("DUMMY1")));
  }

  /// A screen is one projector's: whoever had it gets the other one's.
  void screensAreExchanged() {
    page_->showProjector(1);
    page_->choose(screen("DUMMY0"));
    QCOMPARE(page_->chosen(), std::optional(screen("DUMMY0")));
    QVERIFY(page_->primary()->isEnabled());
    page_->choose(screen("DUMMY1"));
    QCOMPARE(page_->screenOf(0), std::optional(screen("DUMMY0")));
    QCOMPARE(page_->screenOf(1), std::optional(screen("DUMMY1")));
  }

  void eachScreenShowsItsProjectorsPicture() {
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen(), patience);
    const OutputProjection& projection = page_->projection();
    QTRY_VERIFY_WITH_TIMEOUT(!projection.onProjector(1).isNull(), patience);
    QCOMPARE(projection.onProjector(0).size(), projectorSize);
    QVERIFY(projection.onProjector(2).isNull());
    QTRY_COMPARE_WITH_TIMEOUT(inTheMiddle("DUMMY0"), withoutAlpha(projection.onProjector(0)), patience);
    QTRY_COMPARE_WITH_TIMEOUT(inTheMiddle("DUMMY1"), withoutAlpha(projection.onProjector(1)), patience);
    QVERIFY(inTheMiddle("DUMMY0") != inTheMiddle("DUMMY1"));
  }

  void theMirrorIsOfTheShownProjector() {
    OutputProjection& projection = page_->projection();
    projection.watch(this, projectorSize);
    for (std::size_t projector : {std::size_t{0}, std::size_t{1}}) {
      page_->showProjector(projector);
      QVERIFY(projection.mirror().isNull() || projector == 1);
      QTRY_COMPARE_WITH_TIMEOUT(withoutAlpha(projection.mirror()),
                                withoutAlpha(projection.onProjector(projector)), patience);
    }
    projection.watch(this, {});
  }

  /// Law: who looks on is who asked last; one that goes when the next is there already, as in another
  /// language, takes nothing from it.
  void aViewThatGoesLeavesTheMirrorToTheNext() {
    QObject former, next;
    OutputProjection& projection = page_->projection();
    page_->close();
    projection.watch(&former, projectorSize);
    projection.watch(&next, projectorSize);
    projection.watch(&former, {});
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(!projection.mirror().isNull(), patience);
    projection.watch(&next, {});
  }

  void theInstalledShowKnowsBothScreens() {
    QString config = folder_.filePath("config");
    page_->setConfigFolder(config);
    QVERIFY(page_->isInstallable() && !page_->isInstalled());
    page_->install();
    QVERIFY(page_->isInstalled());
    // Done is done: doing it again is not what is offered first.
    QVERIFY(!page_->primary() || page_->primary()->text() != "Install again");
    QDirIterator files(config, QDir::Files, QDirIterator::Subdirectories);
    QVERIFY(files.hasNext());
    QFile file(files.next());
    QVERIFY(file.open(QIODevice::ReadOnly));
    QString text = QString(file.readAll()).remove('"');
    QVERIFY2(text.contains("--screen DUMMY0 --screen DUMMY1"), qPrintable(text));
  }

  void blackAndTheEndAreForBoth() {
    page_->setBlack(true);
    QTRY_VERIFY(allBlack(inTheMiddle("DUMMY0")) && allBlack(inTheMiddle("DUMMY1")));
    page_->setBlack(false);
    QTRY_VERIFY(!allBlack(inTheMiddle("DUMMY0")) && !allBlack(inTheMiddle("DUMMY1")));
    page_->close();
    QVERIFY(!page_->isOpen());
    QTRY_VERIFY(allBlack(inTheMiddle("DUMMY0")) && allBlack(inTheMiddle("DUMMY1")));
    QVERIFY(page_->projection().onProjector(1).isNull());
  }

  /// Law: an installed show is removed at any time, from any venue, with nothing projected.
  void theInstalledShowIsRemoved() {
    using InstalledShow = OutputPage::InstalledShow;
    QVERIFY(page_->isInstalled() && !page_->isOpen());
    session_->open(path("relief"));
    QCOMPARE(page_->installedShow(), InstalledShow::anotherVenues);
    page_->removeInstalled();
    QCOMPARE(page_->installedShow(), InstalledShow::none);
    QVERIFY(!QDirIterator(folder_.filePath("config"), QDir::Files, QDirIterator::Subdirectories).hasNext());
    session_->open(path("recorded"));
    QVERIFY(!page_->isInstalled() && page_->status().state == StepState::open);
  }

  /// Law: what is simulated shines into no room unless somebody says where, and is not installed.
  void aRehearsalStaysOnThePage() {
    session_->open(path("relief"));
    for (std::size_t projector : {std::size_t{0}, std::size_t{1}}) {
      QVERIFY(page_->screenOf(projector));
      QVERIFY(page_->screens()[*page_->screenOf(projector)].isPageOnly);
    }
    QVERIFY2(page_->hint().contains("this page only"), qPrintable(page_->hint()));
    page_->addFiles({folder_.filePath("content.png")});
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(!page_->projection().onProjector(1).isNull(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(page_->projection().statistics().frames > 0, patience);
    QVERIFY(allBlack(inTheMiddle("DUMMY0")) && allBlack(inTheMiddle("DUMMY1")));
    QVERIFY(!session_->underWay().isNothing());
    page_->install();
    QCOMPARE(page_->installedShow(), OutputPage::InstalledShow::none);
    for (const PageCommand* command : page_->secondary())
      QVERIFY2(!command->text().startsWith("Install"), qPrintable(command->text()));
    page_->close();
    QVERIFY(session_->underWay().isNothing());
    page_->showProjector(1);
    page_->choose(screen("DUMMY1"));
    QVERIFY(!page_->screens()[*page_->screenOf(1)].isPageOnly);
    QVERIFY(page_->screens()[*page_->screenOf(0)].isPageOnly);
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->projection().onProjector(1).isNull(), patience);
    QTRY_COMPARE_WITH_TIMEOUT(inTheMiddle("DUMMY1"), withoutAlpha(page_->projection().onProjector(1)),
                              patience);
    QVERIFY(allBlack(inTheMiddle("DUMMY0")));
    page_->close();
  }

  /// Law: what was told of one show is not shown of the next.
  void figuresAreOfTheShowThatPlays() {
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(!page_->projection().frameTimes().empty(), patience);
    page_->close();
    QVERIFY(page_->projection().frameTimes().empty());
  }

  /// Law: rail and sentence say the same of the show.
  void oneStateIsTold() {
    page_->open();
    QTRY_VERIFY_WITH_TIMEOUT(page_->isOpen(), patience);
    for (auto [set, word] : {std::pair(&OutputPage::setFrozen, "Frozen"), {&OutputPage::setBlack, "Black"}}) {
      (page_.get()->*set)(true);
      QCOMPARE(page_->status().result, QString(word));
      QVERIFY2(page_->hint().startsWith(word), qPrintable(page_->hint()));
      (page_.get()->*set)(false);
      QCOMPARE(page_->status().result, QString("Playing"));
      QVERIFY2(!page_->hint().startsWith(word), qPrintable(page_->hint()));
    }
    page_->close();
  }
};

QTEST_MAIN(TestTwoOutputs)
#include "test_two_outputs.moc"
