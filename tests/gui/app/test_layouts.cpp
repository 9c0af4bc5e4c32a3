// SPDX-License-Identifier: MIT
// Every page of the wizard in every language, as it is laid out at 1366x768 in each of its states: nothing
// that is to be read is cut. One small rehearsal is measured, and looked at in all languages where it stands.
#include <QDialog>
#include <QTemporaryDir>
#include <QtTest>

#include "app/help_window.h"
#include "app/wizard_window.h"
#include "gui/app/layout_faults.h"
#include "wizard/frame/failure_dialog.h"

using namespace relucent;

namespace {

constexpr int patience = 120000;  // milliseconds; what is waited for takes seconds
constexpr QSize screen(1366, 768);
constexpr int titleBar = 40;

void settle() {
  // Labels that wrap ask their parents for room, which ask theirs.
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  // Live figures may have come last; what they ask for is not left for later.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
}

}  // namespace

class TestLayouts : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<WizardWindow> wizard_;
  QSet<QString> known_;

  Wizard& steps() { return wizard_->wizard(); }

  /// What was told before, of a part that many pages have, is not told again.
  QStringList faultsOf(const QWidget& window, const QString& language, const QString& where) {
    QStringList faults;
    for (const QString& fault : LayoutFaults::of(window))
      if (!known_.contains(language + fault)) {
        known_.insert(language + fault);
        faults << QString("%1, %2: %3").arg(language, where, fault);
      }
    return faults;
  }
  /// In every language what the function looks at, which has a name.
  void inEveryLanguage(const std::function<QStringList(const QString& language)>& look) {
    QStringList faults;
    for (const QString& language : Language("en").available()) {
      wizard_->preferences().setLanguage(language);
      wizard_->window().resize(screen);
      settle();
      faults << look(language);
    }
    wizard_->preferences().setLanguage("en");
    QVERIFY2(faults.isEmpty(),
             qPrintable(QString("%1 texts are cut\n").arg(faults.size()) + faults.join('\n')));
  }
  QStringList seen(const QString& language, const QString& where) {
    settle();
    const MainWindow& window = wizard_->window();
    QStringList faults = faultsOf(window, language, where);
    if (window.size() != screen) faults << language + ", " + where + ": the window does not fit the screen";
    return faults;
  }
  QStringList seen(QDialog& dialog, const QString& language, const QString& where) {
    settle();
    QStringList faults = faultsOf(dialog, language, where);
    if (dialog.width() > screen.width() || dialog.height() > screen.height() - titleBar)
      faults << language + ", " + where + ": the dialog does not fit the screen";
    return faults;
  }
  /// The pages as they are now.
  void pages(std::initializer_list<std::size_t> wanted, const QString& state) {
    inEveryLanguage([&](const QString& language) {
      QStringList faults;
      for (std::size_t step : wanted) {
        steps().go(step);
        faults << seen(language, QString("step %1, %2").arg(step + 1).arg(state));
      }
      return faults;
    });
  }
  void page(const QString& state) { pages({steps().current()}, state); }

 private slots:
  void initTestCase() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    wizard_ = std::make_unique<WizardWindow>(*settings_, folder_.filePath("cache").toStdString());
    wizard_->preferences().setLanguage("en");
    wizard_->venue().setSizes({{{64, 48}, {48, 36}, "%1"}});
    wizard_->venue().setFolder(folder_.filePath("venues"));
    wizard_->window().resize(screen);
    wizard_->window().show();
    QVERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
    QVERIFY(Language("en").available().size() > 1);
  }

  void faultsAreFound() {
    QWidget window;
    auto* row = new QHBoxLayout(&window);
    auto* label = labelOf("A sentence that has no room at all here");
    auto* button = buttonOf("A button's words");
    auto* wraps = labelOf("Three lines of words are more than one line");
    row->addWidget(label);
    row->addWidget(button);
    row->addWidget(wraps);
    label->setWordWrap(false);
    window.resize(window.sizeHint().expandedTo({900, 60}));
    window.show();
    settle();
    QCOMPARE(LayoutFaults::of(window), QStringList());
    for (QWidget* widget : std::initializer_list<QWidget*>{label, button, wraps})
      widget->setFixedSize(40, 18);
    settle();
    QStringList faults = LayoutFaults::of(window).filter("needs a ");
    QVERIFY2(faults.filter("A sentence").size() == 1 && !faults.filter("A button").isEmpty() &&
                 !faults.filter("Three lines").isEmpty(),
             qPrintable(faults.join('\n')));
    auto* outside = new QLabel("outside", &window);
    outside->setGeometry(window.width() - 20, 0, 100, 20);
    outside->show();
    QCOMPARE(LayoutFaults::of(window).filter("is cut off").size(), 1);
  }

  void beginning() {
    inEveryLanguage([this](const QString& language) {
      QStringList faults;
      for (auto [mode, name] :
           {std::pair(VenuePage::Mode::start, "start"), std::pair(VenuePage::Mode::rehearse, "rehearsal"),
            std::pair(VenuePage::Mode::script, "by script"),
            std::pair(VenuePage::Mode::devices, "devices")}) {
        wizard_->venue().setMode(mode);
        faults << seen(language, name);
      }
      wizard_->venue().setMode(VenuePage::Mode::start);
      return faults;
    });
  }

  void dialogs() {
    inEveryLanguage([this](const QString& language) {
      wizard_->window().showSettings();
      auto* settings = wizard_->window().findChild<QDialog*>("settings");
      QStringList faults = seen(*settings, language, "settings");
      delete settings;
      HelpWindow help(language);
      help.show();
      faults << seen(help, language, "help");
      for (ErrorKind kind : {ErrorKind::device, ErrorKind::disk, ErrorKind::memory, ErrorKind::format,
                             ErrorKind::input, ErrorKind::numerics}) {
        Failure failure{
            kind, "What happened, as long as it takes to say it.", "What to do about that now.", {}};
        Command resume{AcquirePage::tr("Resume"), Icon::play, true, {}, [] {}};
        Command keep{AcquirePage::tr("Stop and keep"), Icon::save, true, {}, [] {}};
        Command goOn{AcquirePage::tr("Continue anyway"), Icon::next, true, {}, [] {}};
        FailureDialog dialog({failure, AcquirePage::tr("Nothing was changed."), resume, keep, goOn},
                             wizard_->acquire().name());
        dialog.show();
        faults << seen(dialog, language, "failure");
      }
      return faults;
    });
  }

  void camera() {
    wizard_->venue().setMode(VenuePage::Mode::rehearse);
    wizard_->venue().chooseVenue(wizard_->venue().venues().size() - 1);
    wizard_->venue().primary().run();
    QTRY_COMPARE_WITH_TIMEOUT(steps().current(), std::size_t{1}, patience);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->camera().tooDarkEverywhere().has_value(), patience);
    page("looking");
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->camera().primary().enabled, patience);
    wizard_->camera().primary().run();
    QTRY_COMPARE_WITH_TIMEOUT(steps().current(), std::size_t{2}, patience);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().busy().isEmpty(), patience);
  }

  void linearization() {
    page("before");
    wizard_->linearize().primary().run();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->linearize().result() && !wizard_->linearize().isMeasuring(), patience);
    page("measured");
    wizard_->linearize().primary().run();
  }

  void acquisition() {
    page("before");
    // As soon as what is watched has its figures: it is over in seconds.
    AcquirePage& acquire = wizard_->acquire();
    QMetaObject::Connection figures =
        connect(&acquire.trace(), &AcquisitionTrace::changed, &acquire, [&acquire, &figures] {
          if (acquire.trace().points().empty()) return;
          disconnect(figures);
          acquire.pause();
        });
    acquire.primary().run();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->acquire().isPaused(), patience);
    page("paused");
    wizard_->acquire().resume();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Stage::acquisition) == StageProgress::done,
                             patience);
    // Whoever measured in many languages says in the last that the devices are free.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().busy().isEmpty(), patience);
    wizard_->acquire().primary().run();
  }

  void decisions() {
    ThresholdPage& threshold = wizard_->threshold();
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept() && threshold.whole(), patience);
    threshold.pick({24, 18});
    QTRY_VERIFY_WITH_TIMEOUT(threshold.footprint() != nullptr, patience);
    threshold.primary().run();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->cluster().result() && !wizard_->cluster().isComputing(), patience);
    wizard_->cluster().primary().run();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->preview().table().size() >= 5 && !wizard_->preview().isComputing(),
                             patience);
    wizard_->preview().primary().run();
    QTRY_COMPARE(steps().current(), std::size_t{7});
    pages({0, 1, 2, 3, 4, 5, 6, 7}, "done");
    threshold.setShareOfRow(true);
    Corners corners = *wizard_->preview().corners();
    std::swap(corners[0], corners[1]);
    wizard_->preview().setCorners(corners);
    QVERIFY(!wizard_->preview().problem().isEmpty());
    pages({4, 6}, "something wrong");
  }

  void output() {
    OutputPage& output = wizard_->output();
    steps().go(7);
    output.setConfigFolder(folder_.filePath("config"));
    output.setStartsWithComputer(true);
    output.open();
    QTRY_VERIFY_WITH_TIMEOUT(output.isOpen(), patience);
    output.verify();
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().proof() != nullptr, patience);
    output.checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().drift().has_value(), patience);
    output.addFiles({"/venues/A film with a long name.mp4", "/venues/Another.png"});
    output.setFrozen(true);
    output.setBlack(true);
    page("playing");
    output.close();
  }

  void whatIsOutOfDate() {
    CalibrateSettings settings = wizard_->session().settings();
    settings.linearization.levels = 9;
    settings.acquisition.relativeThreshold *= 0.5;
    settings.threshold.absolute += 1e-3f;
    settings.clustering.patchRadius += 1.0;
    wizard_->session().changeSettings(settings);
    pages({2, 3, 4, 5, 6}, "out of date");
  }

  void realDevices() {
    ListedCamera good, bad;
    good.address = "gige:192.0.2.17";
    good.model = "A camera";
    good.usable = true;
    bad.model = "Another camera";
    bad.problem = "it sends no frames";
    wizard_->camera().setLister([good, bad] { return CameraList{{}, {good, bad}}; });
    CalibrateSettings settings;
    ScreenRigSettings rig;
    rig.display.connector = "HDMI-1";
    rig.projector = {64, 48};
    settings.rig = rig;
    wizard_->session().begin(folder_.filePath("real").toStdString(), settings);
    steps().go(1);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->camera().isListing() && !wizard_->camera().cameras().cameras.empty(),
                             patience);
    page("choosing");
    wizard_->session().decide(CameraCheckResult{.exposures = {1.0}});
    pages({2}, "asking for consent");
  }

  void cleanupTestCase() { wizard_.reset(); }
};

QTEST_MAIN(TestLayouts)
#include "test_layouts.moc"
