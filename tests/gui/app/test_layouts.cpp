// SPDX-License-Identifier: MIT
// Every page of the wizard in every language, as it is laid out at 1366x768 in each of its states: nothing
// that is to be read is cut. One small rehearsal is measured, and looked at in all languages where it stands.
#include <QDialog>
#include <QTemporaryDir>
#include <QtTest>
#include <algorithm>
#include <utility>

#include "app/help_window.h"
#include "app/wizard_window.h"
#include "gui/app/layout_faults.h"
#include "gui/app/naming_faults.h"
#include "gui/wizard/output/night_history.h"
#include "relucent/base/message.h"
#include "relucent/devices/check/check_verdict.h"
#include "theme/accessible_role.h"
#include "theme/controls.h"
#include "wizard/acquire/acquire_page.h"
#include "wizard/camera/camera_page.h"
#include "wizard/cluster/cluster_page.h"
#include "wizard/devices/flash_consent.h"
#include "wizard/devices/nudge_dialog.h"
#include "wizard/frame/failure_dialog.h"
#include "wizard/linearize/linearize_page.h"
#include "wizard/output/nights_dialog.h"
#include "wizard/output/output_page.h"
#include "wizard/output/stream_dialog.h"
#include "wizard/preview/preview_page.h"
#include "wizard/threshold/threshold_page.h"
#include "wizard/venue/tidy_dialog.h"
#include "wizard/venue/venue_page.h"

using namespace relucent;
using namespace relucent::acquisition;
using namespace relucent::calibration;
using namespace relucent::compensation;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::pipeline;

namespace {

constexpr int patience = 120000;  // milliseconds; what is waited for takes seconds
constexpr QSize screen(1366, 768);
constexpr QSize halfOfFullHd(960, 540);  // on a desktop that scales by two
constexpr int titleBar = 40;
constexpr QSize underTitleBar(1366, 720);  // what a panel or a tall title bar leaves

void settle() {
  // Labels that wrap ask their parents for room, which ask theirs.
  for (int i = 0; i < 3; ++i) QCoreApplication::processEvents();
  // Live figures may have come last; what they ask for is not left for later.
  QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
}

}  // namespace

/// What is missing of a widget in the window, or of as much of it as its scroll areas have room for.
QString hiddenOf(const QWidget& widget) {
  QSize room = widget.size();
  for (const QWidget* around = widget.parentWidget(); around != nullptr; around = around->parentWidget())
    if (const auto* scroll = qobject_cast<const QScrollArea*>(around))
      room = room.boundedTo(scroll->viewport()->size());
  const QSize seen = widget.visibleRegion().boundingRect().size();
  if (seen == room) return {};
  return QString("%1x%2 of %3x%4 in sight")
      .arg(seen.width())
      .arg(seen.height())
      .arg(room.width())
      .arg(room.height());
}

class TestLayouts : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  std::unique_ptr<QSettings> settings_;
  std::unique_ptr<WizardWindow> wizard_;
  QSet<QString> known_;
  QStringList languages_;
  int turn_ = 0;
  bool isBackwards_ = false;

  Wizard& steps() { return wizard_->wizard(); }

  /// What was told before, of a part that many pages have, is not told again.
  QStringList faultsOf(const QWidget& window, const QString& language, const QString& where) {
    QStringList faults;
    for (const QString& fault : LayoutFaults::of(window) + NamingFaults::of(window))
      if (!known_.contains(language + fault)) {
        known_.insert(language + fault);
        faults << QString("%1, %2: %3").arg(language, where, fault);
      }
    return faults;
  }
  /// The longest words and the other direction; the other languages take turns, one at a time. All of them if
  /// $RELUCENT_ALL_ROWS is set, as tests/long has it.
  QStringList languagesNow() {
    if (qEnvironmentVariableIsSet("RELUCENT_ALL_ROWS")) return languages_;
    QStringList others = languages_;
    for (const char* always : {"de", "ar"}) others.removeAll(always);
    return {"de", others[turn_++ % others.size()], "ar"};
  }
  /// In every language what the function looks at, which has a name. The window is made anew for each, which
  /// takes most of this test's time: there and back in turns, so that one language is not made twice.
  void inEveryLanguage(const std::function<QStringList(const QString& language)>& look) {
    QStringList faults, languages = languagesNow();
    if (std::exchange(isBackwards_, !isBackwards_)) std::ranges::reverse(languages);
    for (const QString& language : languages) {
      wizard_->preferences().setLanguage(language);
      wizard_->window().resize(screen);
      settle();
      faults << look(language);
    }
    QVERIFY2(faults.isEmpty(),
             qPrintable(QString("%1 texts are cut or missing\n").arg(faults.size()) + faults.join('\n')));
  }
  QStringList seen(const QString& language, const QString& where) {
    settle();
    const MainWindow& window = wizard_->window();
    QStringList faults = faultsOf(window, language, where);
    if (window.size() != screen) faults << language + ", " + where + ": the window does not fit the screen";
    for (const auto* scroll : window.findChildren<QScrollArea*>("stage"))
      if (scroll->isVisible() && (scroll->widget()->size() != scroll->viewport()->size()))
        faults << language + ", " + where + ": the stage does not fit the screen";
    return faults;
  }
  QStringList seen(QDialog& dialog, const QString& language, const QString& where) {
    settle();
    QStringList faults = faultsOf(dialog, language, where);
    if (dialog.width() > screen.width() || dialog.height() > screen.height() - titleBar)
      faults << language + ", " + where + ": the dialog does not fit the screen";
    // Where the screen has room, nothing of it has to be scrolled to.
    for (const auto* scroll : dialog.findChildren<QScrollArea*>("stage"))
      if (scroll->widget()->height() > scroll->viewport()->height())
        faults << QString("%1, %2: %3 px are cut at the bottom")
                      .arg(language, where)
                      .arg(scroll->widget()->height() - scroll->viewport()->height());
    return faults;
  }
  /// What may open on any page.
  QStringList dialogs(const QString& language) {
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
      PageCommand resume(Icon::play, nullptr), keep(Icon::save, nullptr), goOn(Icon::next, nullptr),
          repair(Icon::camera, nullptr);
      resume.show(AcquirePage::tr("Resume"));
      keep.show(AcquirePage::tr("Stop and keep"));
      goOn.show(AcquirePage::tr("Continue anyway"));
      repair.show(AcquirePage::tr("Put the camera back"));
      FailureDialog dialog(
          {failure, AcquirePage::tr("Nothing was changed."), &resume, &keep, &goOn, false, &repair},
          wizard_->page<AcquirePage>().name());
      dialog.show();
      // On a busy computer the screen's answer, its size among it, comes late.
      if (!QTest::qWaitForWindowExposed(&dialog, patience)) faults << language + ": no failure is shown";
      faults << seen(dialog, language, "failure");
    }
    return faults;
  }
  /// What the disk could be freed of, which is asked on the first page.
  QStringList tidying(const QString& language) {
    steps().go(0);
    wizard_->window().findChild<QPushButton*>("tidy")->click();
    auto* dialog = wizard_->window().findChild<TidyDialog*>();
    VenueTidy& tidy = dialog->tidy();
    QStringList faults = seen(*dialog, language, "tidying, looking");
    if (!QTest::qWaitFor([&] { return tidy.state() == VenueTidy::State::choosing; }, patience))
      return faults << language + ": nothing to choose from";
    faults << seen(*dialog, language, "tidying, choosing");
    tidy.choose(KeptPhotographs::results);
    tidy.ask();
    faults << seen(*dialog, language, "tidying, asking");
    delete dialog;
    return faults;
  }
  QStringList pagesIn(const QString& language, std::initializer_list<std::size_t> wanted,
                      const QString& state) {
    QStringList faults;
    for (std::size_t step : wanted) {
      steps().go(step);
      faults << seen(language, QString("step %1, %2").arg(step + 1).arg(state));
    }
    return faults;
  }
  /// The pages as they are now.
  void pages(std::initializer_list<std::size_t> wanted, const QString& state) {
    inEveryLanguage([&](const QString& language) { return pagesIn(language, wanted, state); });
  }
  void page(const QString& state) { pages({steps().current()}, state); }
  /// The page as it is now, by Tab from one end to the other: whatever has the focus is in sight.
  QStringList notReached(const QString& where) {
    MainWindow& window = wizard_->window();
    QStringList faults;
    if (window.size() != halfOfFullHd) faults << where + ": the window does not fit";
    for (const char* name : {"primary", "back", "hint"}) {
      const auto* part = window.findChild<QWidget*>(name);
      if (part->isVisibleTo(&window) && !hiddenOf(*part).isEmpty())
        faults << QString("%1: %2, %3").arg(where, name, hiddenOf(*part));
    }
    for (const auto* scroll : window.findChildren<QScrollArea*>())
      if (scroll->isVisible() && scroll->widget()->width() > scroll->viewport()->width())
        faults << where + ": it is too wide, and scrolls across";
    constexpr int mostStops = 300;
    QSet<QWidget*> reached;
    for (int i = 0; i < mostStops; ++i) {
      QTest::keyClick(&window, Qt::Key_Tab);
      QCoreApplication::processEvents();
      QWidget* focus = window.focusWidget();
      reached.insert(focus);
      if (!hiddenOf(*focus).isEmpty())
        faults << QString("%1: %2 %3, %4")
                      .arg(where, focus->metaObject()->className(), focus->objectName(), hiddenOf(*focus));
    }
    for (QWidget* widget : window.findChildren<QWidget*>())
      if (widget->isVisible() && widget->isEnabled() && (widget->focusPolicy() & Qt::TabFocus) != 0 &&
          widget->focusProxy() == nullptr && !reached.contains(widget) &&
          qobject_cast<QAbstractButton*>(widget) == nullptr)
        faults << QString("%1: %2 %3 is not reached")
                      .arg(where, widget->metaObject()->className(), widget->objectName());
    faults.removeDuplicates();
    return faults;
  }
  /// What is not wholly in sight without scrolling where a title bar takes some of the height.
  QStringList notInSight(const QList<const QWidget*>& wanted, const QString& where) {
    wizard_->window().resize(underTitleBar);
    settle();
    QStringList faults;
    if (wizard_->window().size() != underTitleBar) faults << where + ": the window has another size";
    for (const QWidget* widget : wanted)
      if (!hiddenOf(*widget).isEmpty())
        faults << QString("%1: %2 %3, %4")
                      .arg(where, widget->metaObject()->className(), widget->objectName(), hiddenOf(*widget));
    wizard_->window().resize(screen);
    return faults;
  }
  /// Law: nothing goes on without consent, so that it is asked for in sight, with the sentence that says so.
  QStringList consentNotInSight(const QString& where) {
    QList<const QWidget*> wanted{wizard_->window().findChild<QWidget*>("hint")};
    for (const auto* consent : wizard_->window().findChildren<FlashConsent*>())
      if (consent->isVisible()) wanted << consent;
    if (wanted.size() != 2 || wizard_->wizard().currentPage().primary()->isEnabled())
      return {where + ": no consent is asked for"};
    return notInSight(wanted, where);
  }
  /// Law: every check's verdict is in sight while somebody aims the camera.
  QStringList verdictsNotInSight(const QString& where, qsizetype least) {
    QList<const QWidget*> verdicts;
    for (const auto* verdict : wizard_->window().findChildren<QWidget*>())
      if ((qobject_cast<const Remark*>(verdict) != nullptr || verdict->objectName() == "device-verdicts") &&
          verdict->isVisible())
        verdicts << verdict;
    if (verdicts.size() < least) return {where + ": verdicts are missing"};
    return notInSight(verdicts, where);
  }
  /// Half of Full HD is enough.
  void reachesAll(std::initializer_list<std::size_t> wanted) {
    wizard_->preferences().setLanguage("en");
    wizard_->window().resize(halfOfFullHd);
    wizard_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&wizard_->window()));
    QStringList faults;
    for (std::size_t step : wanted) {
      steps().go(step);
      settle();
      faults << notReached(QString("step %1").arg(step + 1));
    }
    wizard_->window().resize(screen);
    QVERIFY2(faults.isEmpty(), qPrintable(faults.join('\n')));
  }

 private slots:
  void initTestCase() {
    settings_ = std::make_unique<QSettings>(folder_.filePath("settings.ini"), QSettings::IniFormat);
    wizard_ = std::make_unique<WizardWindow>(*settings_, folder_.filePath("cache").toStdString());
    wizard_->preferences().setLanguage("en");
    wizard_->page<VenuePage>().setSizes({{{64, 48}, {48, 36}, "%1"}});
    wizard_->page<VenuePage>().setFolder(folder_.filePath("venues"));
    wizard_->window().resize(screen);
    wizard_->window().show();
    QVERIFY(QTest::qWaitForWindowExposed(&wizard_->window()));
    languages_ = Language("en").available();
    QVERIFY(languages_.size() > 1);
  }

  void whatHasNoNameIsFound() {
    QWidget window;
    auto* row = new QHBoxLayout(&window);
    auto* line = new QLineEdit;
    auto* own = new QWidget;
    own->setFocusPolicy(Qt::StrongFocus);
    auto* table = new QTableWidget(1, 2);
    table->setAccessibleName("Table");
    table->setItem(0, 0, new QTableWidgetItem("said"));
    for (QWidget* widget : std::initializer_list<QWidget*>{line, own, table}) row->addWidget(widget);
    window.show();
    settle();
    QCOMPARE(NamingFaults::of(window).size(), 3);
    line->setAccessibleName("Line");
    own->setAccessibleName("Own");
    QCOMPARE(NamingFaults::of(window).filter("filler").size(), 1);
    table->setItem(0, 1, new QTableWidgetItem("said too"));
    setAccessibleRole(own, QAccessible::Graphic);
    QVERIFY2(NamingFaults::of(window).isEmpty(), qPrintable(NamingFaults::of(window).join('\n')));
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
    VenuePage& venue = wizard_->page<VenuePage>();
    venue.setMode(VenuePage::Mode::devices);
    for (const ScreenChoice& choice : venue.screensToChoose())
      if (choice.refusal.isEmpty() && venue.projectors().empty()) venue.chooseScreen(choice);
    QVERIFY(venue.projectors().size() == 1 && venue.needsConsent());
    // By script, too, it is a screen: its size is its own, which is said.
    for (const ScreenChoice& choice : venue.screensToChoose())
      if (choice.refusal.isEmpty()) venue.chooseScriptScreen(choice);
    inEveryLanguage([this](const QString& language) {
      QStringList faults;
      for (auto [mode, name] :
           {std::pair(VenuePage::Mode::start, "start"), std::pair(VenuePage::Mode::rehearse, "rehearsal"),
            std::pair(VenuePage::Mode::script, "by script"),
            std::pair(VenuePage::Mode::devices, "devices")}) {
        wizard_->page<VenuePage>().setMode(mode);
        faults << seen(language, name);
        if (wizard_->page<VenuePage>().needsConsent())
          faults << consentNotInSight(QString("%1, %2").arg(language, name));
      }
      wizard_->page<VenuePage>().setMode(VenuePage::Mode::start);
      return faults + dialogs(language);
    });
  }

  void camera() {
    wizard_->page<VenuePage>().setMode(VenuePage::Mode::rehearse);
    wizard_->page<VenuePage>().chooseVenue(wizard_->page<VenuePage>().venues().size() - 1);
    wizard_->page<VenuePage>().primary()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(steps().current(), std::size_t{1}, patience);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<CameraPage>().tooDarkEverywhere().has_value(), patience);
    inEveryLanguage([this](const QString& language) {
      return seen(language, "looking") + verdictsNotInSight(language, 4);
    });
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<CameraPage>().primary()->isEnabled(), patience);
    wizard_->page<CameraPage>().primary()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(steps().current(), std::size_t{2}, patience);
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().areDevicesFree(), patience);
  }

  void linearization() {
    page("before");
    wizard_->page<LinearizePage>().primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(
        wizard_->page<LinearizePage>().result() && !wizard_->page<LinearizePage>().isMeasuring(), patience);
    // With the page that follows, before anything is done there.
    pages({2, 3}, "measured");
    steps().go(2);
    wizard_->page<LinearizePage>().primary()->trigger();
    QCOMPARE(steps().current(), std::size_t{3});
  }

  void acquisition() {
    // As soon as what is watched has its figures: it is over in seconds.
    AcquirePage& acquire = wizard_->page<AcquirePage>();
    QMetaObject::Connection figures =
        connect(&acquire.trace(), &AcquisitionTrace::changed, &acquire, [&acquire, &figures] {
          if (acquire.trace().points().empty()) return;
          disconnect(figures);
          acquire.pause();
        });
    acquire.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<AcquirePage>().isPaused(), patience);
    page("paused");
    reachesAll({3});
    wizard_->page<AcquirePage>().resume();
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().progress(Stage::acquisition) == StageProgress::done,
                             patience);
    // Whoever measured in many languages says in the last that the devices are free.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->session().areDevicesFree(), patience);
    wizard_->page<AcquirePage>().primary()->trigger();
  }

  void decisions() {
    ThresholdPage& threshold = wizard_->page<ThresholdPage>();
    QTRY_VERIFY_WITH_TIMEOUT(threshold.kept() && threshold.whole(), patience);
    threshold.pick({24, 18});
    QTRY_VERIFY_WITH_TIMEOUT(threshold.footprint() != nullptr, patience);
    threshold.primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(
        wizard_->page<ClusterPage>().result() && !wizard_->page<ClusterPage>().isComputing(), patience);
    wizard_->page<ClusterPage>().primary()->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(
        wizard_->page<PreviewPage>().table().size() >= 5 && !wizard_->page<PreviewPage>().isComputing(),
        patience);
    wizard_->page<PreviewPage>().primary()->trigger();
    QTRY_COMPARE(steps().current(), std::size_t{7});
    inEveryLanguage([this](const QString& language) {
      return pagesIn(language, {0, 1, 2, 3, 4, 5, 6, 7}, "done") + tidying(language);
    });
    reachesAll({0, 1, 2, 3, 4, 5, 6, 7});
    threshold.setShareOfPixel(true);
    Corners corners = *wizard_->page<PreviewPage>().corners();
    std::swap(corners[0], corners[1]);
    wizard_->page<PreviewPage>().setCorners(corners);
    QVERIFY(!wizard_->page<PreviewPage>().problem().isEmpty());
    pages({4, 6}, "something wrong");
  }

  void output() {
    OutputPage& output = wizard_->page<OutputPage>();
    steps().go(7);
    output.setConfigFolder(folder_.filePath("config"));
    output.open();
    QTRY_VERIFY_WITH_TIMEOUT(output.isOpen(), patience);
    output.verify();
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().proof() != nullptr, patience);
    output.checkDrift();
    QTRY_VERIFY_WITH_TIMEOUT(output.proof().drift().has_value(), patience);
    output.addFiles({"/venues/A film with a long name.mp4", "/venues/Another.png"});
    output.setFrozen(true);
    output.setBlack(true);
    addFourWeeks(wizard_->session().path());
    inEveryLanguage([&](const QString& language) {
      QStringList faults = seen(language, "playing");
      output.pushBack();
      QPointer<NudgeDialog> dialog = wizard_->window().findChild<NudgeDialog*>();
      const auto* nudge = dialog->findChild<Nudge*>();
      if (!QTest::qWaitFor([&] { return nudge->sight().has_value(); }, patience))
        faults << language + ": the camera sees nothing";
      faults << seen(*dialog, language, "pushing the camera back");
      dialog->reject();
      if (!QTest::qWaitFor([&] { return dialog.isNull(); }, patience)) faults << language + ": it stays open";
      NightsDialog nights(pipeline::nightsOf(wizard_->session().path()), &wizard_->window());
      nights.show();
      faults << seen(nights, language, "weeks of nights");
      StreamDialog stream(&wizard_->window());
      stream.show();
      // Else the size that it is shown with may be told after the one that it grows to.
      if (!QTest::qWaitForWindowExposed(&stream)) faults << language + ": no dialog for a stream's address";
      stream.findChild<QLineEdit*>("stream-address")->setText("rtsp://camera:port/live");
      stream.findChild<QPushButton*>("stream-add")->click();
      faults << seen(stream, language, "a stream's address");
      return faults;
    });
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
    good.model = Message::plain("A camera");
    good.usable = true;
    bad.model = Message::plain("Another camera");
    bad.problem = Message::plain("it sends no frames");
    wizard_->page<CameraPage>().setLister([good, bad] { return CameraList{{}, {good, bad}}; });
    CalibrateSettings settings;
    ScreenRigSettings rig;
    rig.display.connector = "HDMI-1";
    rig.projector = {64, 48};
    settings.rig = rig;
    wizard_->session().begin(folder_.filePath("real").toStdString(), settings);
    steps().go(1);
    QTRY_VERIFY_WITH_TIMEOUT(!wizard_->page<CameraPage>().isListing() &&
                                 !wizard_->page<CameraPage>().foundCameras().cameras.empty(),
                             patience);
    page("choosing");
    // What is decided now is shown by windows that are made after it.
    wizard_->preferences().setLanguage("en");

    rig.cameraAddress = "genicam:40012345";
    rig.camera = {48, 36};
    settings.rig = rig;
    wizard_->session().begin(folder_.filePath("aimed").toStdString(), settings);
    const CheckVerdict sees{.finding = Finding::screenSeen, .share = 0.4, .screen = "HDMI-1"};
    const CheckVerdict late{.finding = Finding::pictureOut, .count = 2, .seconds = 0.083, .frame = 1.0 / 60};
    wizard_->session().decide(CameraCheckResult{
        {1.0, 0.1}, late.seconds, {messageOf(sees), messageOf(late), messageOf({Finding::lightEven})}});
    steps().go(1);
    // Until it is known that the camera does not answer, it is looked for.
    QTRY_VERIFY_WITH_TIMEOUT(wizard_->page<CameraPage>().isKept(), patience);
    inEveryLanguage([this](const QString& language) {
      steps().go(1);
      QStringList faults = seen(language, "checked before") + verdictsNotInSight(language, 2);
      steps().go(2);
      return faults + seen(language, "asking for consent") + consentNotInSight(language);
    });
  }

  void cleanupTestCase() { wizard_.reset(); }
};

QTEST_MAIN(TestLayouts)
#include "test_layouts.moc"
