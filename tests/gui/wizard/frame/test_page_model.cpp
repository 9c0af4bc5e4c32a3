// SPDX-License-Identifier: MIT
// What any page tells the frame, and when.
#include "wizard/frame/page_model.h"

#include <QSignalSpy>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

class ScriptedPage : public PageModel {
 public:
  ScriptedPage() : PageModel({"page", "", "page"}) {
    go_ = addCommand(Icon::next, [this] { ++runs; }, QKeySequence("Ctrl+G"));
    updateCommands();
  }
  QString subtitle() const override { return {}; }
  StepStatus status() const override { return {}; }
  QString hint() const override { return "because"; }
  PageCommand* primary() const override { return go_; }
  void updateCommands() override { go_->show(text, possible); }
  using PageModel::tellAll;
  using PageModel::tellProgress;
  using PageModel::tellResult;
  using PageModel::tellSettings;
  using PageModel::tellStatus;

  QString text = "Go";
  bool possible = true;
  int runs = 0;

 private:
  PageCommand* go_;
};

/// How often each signal came: status, settings, result, progress.
struct Told {
  explicit Told(PageModel& page)
      : status(&page, &PageModel::statusChanged),
        settings(&page, &PageModel::settingsChanged),
        result(&page, &PageModel::resultChanged),
        progress(&page, &PageModel::progressChanged) {}
  QList<qsizetype> counts() const { return {status.size(), settings.size(), result.size(), progress.size()}; }
  QSignalSpy status, settings, result, progress;
};

}  // namespace

class TestPageModel : public QObject {
  Q_OBJECT

 private slots:
  void eachChangeIsToldByItsOwnSignals_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QList<qsizetype>>("counts");
    QTest::newRow("status") << 0 << QList<qsizetype>{1, 0, 0, 0};
    QTest::newRow("settings") << 1 << QList<qsizetype>{1, 1, 0, 0};
    QTest::newRow("result") << 2 << QList<qsizetype>{1, 0, 1, 0};
    QTest::newRow("progress") << 3 << QList<qsizetype>{0, 0, 0, 1};
    QTest::newRow("all") << 4 << QList<qsizetype>{1, 1, 1, 0};
  }
  void eachChangeIsToldByItsOwnSignals() {
    QFETCH(int, kind);
    ScriptedPage page;
    const Told told(page);
    using Tell = void (ScriptedPage::*)();
    constexpr std::array<Tell, 5> tells{&ScriptedPage::tellStatus, &ScriptedPage::tellSettings,
                                        &ScriptedPage::tellResult, &ScriptedPage::tellProgress,
                                        &ScriptedPage::tellAll};
    (page.*tells[static_cast<std::size_t>(kind)])();
    QTEST(told.counts(), "counts");
  }

  void commandsAreAsThingsAreWhenTheFrameIsTold() {
    ScriptedPage page;
    bool seen = true;
    connect(&page, &PageModel::statusChanged, &page, [&] { seen = page.primary()->isEnabled(); });
    page.possible = false;
    page.tellResult();
    QVERIFY(!seen);
  }

  void aCommandIsDoneIfItIsPossible() {
    ScriptedPage page;
    page.primary()->trigger();
    QCOMPARE(page.runs, 1);
    page.possible = false;
    page.tellStatus();
    page.primary()->trigger();
    QCOMPARE(page.runs, 1);
    QCOMPARE(page.primary()->shortcut(), QKeySequence("Ctrl+G"));
  }

  void whyItIsNotPossibleIsSaidWithIt() {
    ScriptedPage page;
    page.possible = false;
    page.tellStatus();
    QCOMPARE(page.primary()->toolTip(), QString("because"));
    page.possible = true;
    page.tellStatus();
    QVERIFY(page.primary()->toolTip() != "because");
  }

  void anotherLanguageIsTakenOver() {
    ScriptedPage page;
    const Told told(page);
    page.text = "Los";
    page.refresh();
    QCOMPARE(page.primary()->text(), QString("Los"));
    QCOMPARE(told.status.size(), 1);
  }
};

QTEST_MAIN(TestPageModel)
#include "test_page_model.moc"
