// SPDX-License-Identifier: MIT
// Freeing the disk of what a venue does not need, by the window that asks.
#include "wizard/venue/venue_tidy.h"

#include <QProgressBar>
#include <QTemporaryDir>
#include <QtTest>
#include <map>

#include "gui/wizard/simulated_session.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/calibrate.h"
#include "relucent/pipeline/measured_again.h"
#include "relucent/pipeline/measuring.h"
#include "relucent/venue/venue.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/tidy_dialog.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_view.h"

using namespace relucent;
using namespace relucent::calibration;
using namespace relucent::gui;
using namespace relucent::pipeline;
namespace fs = std::filesystem;

namespace {

using State = VenueTidy::State;

CalibrateSettings tiny() {
  return smallVenue({24, 18}, {20, 16}, 5);
}

/// Every file by its name within the folder.
std::map<std::string, std::string> contentOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = readFile(entry.path());
  return files;
}

QString textsOf(const QWidget& window) {
  QStringList texts;
  for (const QLabel* label : window.findChildren<QLabel*>())
    if (label->isVisible()) texts << label->text();
  return texts.join('\n');
}

}  // namespace

Q_DECLARE_METATYPE(KeptPhotographs)

class TestVenueTidy : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<SimulatedSession> own_;  // of one test
  Session* session_ = nullptr;
  std::unique_ptr<VenuePage> page_;
  std::unique_ptr<QWidget> window_;

  fs::path measured() const { return folder_.filePath("measured").toStdString(); }
  fs::path venue() const { return own_->path("Old chapel"); }
  QPushButton* entry() const { return window_->findChild<QPushButton*>("tidy"); }
  TidyDialog* dialog() const { return window_->findChild<TidyDialog*>(); }
  static QPushButton* button(const TidyDialog& dialog, const char* name) {
    return dialog.findChild<QPushButton*>(name);
  }
  /// The page that lists the venue, which is open, and its window's dialog once that has looked.
  TidyDialog* ask() {
    entry()->click();
    if (dialog() == nullptr) return nullptr;
    return QTest::qWaitFor([&] { return dialog()->tidy().state() == State::choosing; }, patience) ? dialog()
                                                                                                  : nullptr;
  }
  void show() {
    session_->open(venue());
    window_.reset(viewOf(*page_).stage);
    window_->resize(1200, 700);
    window_->show();
    QVERIFY(QTest::qWaitForWindowExposed(window_.get()));
    QVERIFY(entry() != nullptr);
  }

 private slots:
  /// Its photographs of the light transport were set aside, as where it is measured again.
  void initTestCase() {
    Progress progress;
    calibrate(measured(), tiny(), folder_.filePath("cache").toStdString(), progress);
    setShotsAside(CalibrationFolder::open(measured(), CalibrationFolder::Access::write), Stage::acquisition);
  }
  void init() {
    own_ = std::make_unique<SimulatedSession>();
    session_ = &own_->session;
    fs::copy(measured(), venue(), fs::copy_options::recursive);
    page_ = std::make_unique<VenuePage>(*session_, RecentVenues(own_->settings));
  }
  void cleanup() {
    window_.reset();
    page_.reset();
    own_.reset();
  }

  /// Law: what it says is what it frees, and nothing goes before somebody has agreed.
  void whatItSaysIsWhatItFrees_data() {
    QTest::addColumn<KeptPhotographs>("kept");
    QTest::addColumn<QString>("afterwards");
    QTest::newRow("of the latest measurement") << KeptPhotographs::latest << "everything stays possible";
    QTest::newRow("results only") << KeptPhotographs::results << "have to photograph everything again";
  }
  void whatItSaysIsWhatItFrees() {
    QFETCH(KeptPhotographs, kept);
    QFETCH(QString, afterwards);
    show();
    const auto before = contentOf(venue());
    Progress progress;
    const TidiedCalibration expected = pipeline::tidy({venue()}, {kept, true}, progress).calibrations.front();
    QVERIFY(expected.photographs.files > 0);

    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    const std::string name = "tidy-" + std::string(nameOf(kept));
    auto* choice = dialog->findChild<Choice*>(QString::fromStdString(name));
    QVERIFY(choice != nullptr && choice->isVisible());
    choice->click();
    QVERIFY(textsOf(*dialog).contains(bytesText(expected.freed())));
    QPushButton* primary = button(*dialog, "tidy-primary");
    QVERIFY(primary->isEnabled() && primary->text().contains(bytesText(expected.freed())));
    primary->click();
    QVERIFY(dialog->tidy().state() == State::asking);
    QVERIFY(textsOf(*dialog).contains(QString::number(expected.photographs.files)));
    QVERIFY2(textsOf(*dialog).contains(afterwards), qPrintable(textsOf(*dialog)));
    QVERIFY(contentOf(venue()) == before);

    // Back, and on again.
    button(*dialog, "tidy-back")->click();
    QVERIFY(dialog->tidy().state() == State::choosing);
    primary->click();
    primary->click();
    QVERIFY(!session_->areDevicesFree());  // no measurement begins meanwhile
    QTRY_VERIFY_WITH_TIMEOUT(dialog->tidy().state() == State::done, patience);
    QVERIFY(session_->areDevicesFree());
    std::uint64_t bytes = 0;
    const auto after = contentOf(venue());
    for (const auto& [file, content] : before)
      if (!after.contains(file)) bytes += content.size();
    QCOMPARE(bytes, expected.photographs.bytes);
    QCOMPARE(dialog->tidy().freed().freed(), expected.freed());
    QVERIFY(textsOf(*dialog).contains(bytesText(expected.freed())));
    QVERIFY(textsOf(*dialog).contains(afterwards));
    QCOMPARE(session_->werePhotographsRemoved(), kept == KeptPhotographs::results);
    button(*dialog, "tidy-close")->click();
    QTRY_VERIFY(this->dialog() == nullptr);
  }

  void withNothingToFreeThereIsNothingToAgreeTo() {
    show();
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    QVERIFY(dialog->tidy().kept() == KeptPhotographs::everything);  // as it was begun
    QCOMPARE(dialog->tidy().freedBy(KeptPhotographs::everything).freed(), std::uint64_t{0});
    QVERIFY(!button(*dialog, "tidy-primary")->isEnabled());
    QVERIFY(textsOf(*dialog).contains("nothing to free"));
    button(*dialog, "tidy-close")->click();
    QTRY_VERIFY(this->dialog() == nullptr);
  }

  void whatIsNotMeasuredToTheEndKeepsItsPhotographs() {
    fs::remove_all(venue());
    beginCalibration(venue(), tiny());
    show();
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr && !dialog->tidy().isComplete());
    QVERIFY(textsOf(*dialog).contains("not measured to the end"));
  }

  void stoppedAtOnceItHasRemovedNothing() {
    show();
    const auto before = contentOf(venue());
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    dialog->tidy().choose(KeptPhotographs::results);
    dialog->tidy().ask();
    {
      // Nothing is drawn: the work still opens the folder when it is told.
      const QSignalBlocker quiet(dialog->tidy());
      dialog->tidy().free();
    }
    button(*dialog, "tidy-close")->click();
    QTRY_VERIFY_WITH_TIMEOUT(dialog->tidy().state() == State::stopped, patience);
    QVERIFY(contentOf(venue()) == before);
    QVERIFY(textsOf(*dialog).contains("stopped"));
    QVERIFY(session_->areDevicesFree());
  }
  void closedWhileItLooksItGoes() {
    show();
    entry()->click();
    QVERIFY(dialog() != nullptr && dialog()->findChild<QProgressBar*>()->isVisible());
    button(*dialog(), "tidy-close")->click();
    QTRY_VERIFY_WITH_TIMEOUT(dialog() == nullptr, patience);
  }

  void failuresSayWhatIsSafe() {
    show();
    const auto before = contentOf(venue());
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    dialog->tidy().choose(KeptPhotographs::results);
    dialog->tidy().ask();
    {
      // Somebody else is writing.
      CalibrationFolder folder = CalibrationFolder::open(venue(), CalibrationFolder::Access::write);
      dialog->tidy().free();
      QTRY_VERIFY_WITH_TIMEOUT(dialog->tidy().state() == State::failed, patience);
    }
    QVERIFY(textsOf(*dialog).contains(dialog->tidy().failure().what));
    QVERIFY(textsOf(*dialog).contains("Nothing that is needed is lost"));
    QVERIFY(contentOf(venue()) == before);
  }

  /// A measurement that runs needs its photographs.
  void notWhileSomethingIsAtWork() {
    show();
    QVERIFY(entry()->isEnabled());
    DeviceLease lease = session_->leaseDevices({"camera", "relucent::gui::CameraPage", "Camera"});
    QTRY_VERIFY(!entry()->isEnabled());
    QVERIFY2(entry()->toolTip().contains("Camera is at work"), qPrintable(entry()->toolTip()));
    lease.release();
    QTRY_VERIFY(entry()->isEnabled());
    // Begun just before somebody agrees.
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    dialog->tidy().choose(KeptPhotographs::results);
    dialog->tidy().ask();
    const auto before = contentOf(venue());
    lease = session_->leaseDevices({"camera", "relucent::gui::CameraPage", "Camera"});
    dialog->tidy().free();
    QVERIFY(dialog->tidy().state() == State::failed && contentOf(venue()) == before);
    QVERIFY(session_->devicesUserName() == "Camera");
  }

  /// It is another venue that is open: that one's devices are none of its business.
  void aVenueThatIsNotOpenIsTidiedToo() {
    show();
    session_->close();
    TidyDialog* dialog = ask();
    QVERIFY(dialog != nullptr);
    dialog->tidy().choose(KeptPhotographs::results);
    dialog->tidy().ask();
    dialog->tidy().free();
    QVERIFY(session_->areDevicesFree());
    QTRY_VERIFY_WITH_TIMEOUT(dialog->tidy().state() == State::done, patience);
    QVERIFY(dialog->tidy().freed().photographs.files > 0);
  }
};

QTEST_MAIN(TestVenueTidy)
#include "test_venue_tidy.moc"
