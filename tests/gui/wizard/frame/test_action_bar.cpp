// SPDX-License-Identifier: MIT
// The buttons of the frame, which any page's commands come to.
#include "wizard/frame/action_bar.h"

#include <QGuiApplication>
#include <QLabel>
#include <QProgressBar>
#include <QStyleHints>
#include <QtTest>

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Its primary command makes room for the next one, as opening the output does for photographing and that for
/// installing.
class ScriptedPage : public PageModel {
 public:
  ScriptedPage() : PageModel({"page", "", "page"}) {
    for (const char* text : {"Open", "Photograph the surface", "Install"}) {
      auto* command = addCommand(Icon::next, [this, text] {
        done << text;
        step = std::min(step + 1, 2);
        tellStatus();
      });
      command->show(text);
      primaries_.push_back(command);
    }
    hold_ = addCommand(Icon::pause, [this] {
      isHeld = !isHeld;
      tellStatus();
    });
    dark_ = addCommand(Icon::black, [this] {
      isDark = !isDark;
      tellStatus();
    });
    end_ = addCommand(Icon::stop, [this] {
      isEnded = true;
      tellStatus();
    });
    updateCommands();
  }
  QString subtitle() const override { return {}; }
  StepStatus status() const override { return {}; }
  QString hint() const override { return sentence; }
  bool hasRemedy() const override { return isRemediable; }
  PageCommand* primary() const override { return primaries_[static_cast<std::size_t>(step)]; }
  std::vector<PageCommand*> secondary() const override {
    return isEnded ? std::vector<PageCommand*>() : std::vector{hold_, dark_, end_};
  }
  void updateCommands() override {
    hold_->show(isHeld ? "Go on with all of it" : "Hold");
    dark_->show(isDark ? "Make it visible again" : "Dark");
    end_->showUnless(whyNoEnd, "End");
  }

  QStringList done;
  QString sentence, whyNoEnd;
  int step = 0;
  bool isHeld = false, isDark = false, isEnded = false, isRemediable = false;

 private:
  std::vector<PageCommand*> primaries_;
  PageCommand *hold_, *dark_, *end_;
};

class StyleCount : public QObject {
 public:
  int changes = 0;
  bool eventFilter(QObject*, QEvent* event) override {
    changes += event->type() == QEvent::StyleChange;
    return false;
  }
};

}  // namespace

class TestActionBar : public QObject {
  Q_OBJECT

  std::unique_ptr<Session> session_;
  std::unique_ptr<Wizard> wizard_;
  std::unique_ptr<ScriptedPage> page_;
  std::unique_ptr<ActionBar> bar_;
  quint64 now_ = 1'000'000;  // ms

  QPushButton* button(const char* name) const { return bar_->findChild<QPushButton*>(name); }
  /// `after`: the press before, ms.
  void click(const char* name, quint64 after, QEvent::Type press = QEvent::MouseButtonPress) {
    now_ += after;
    QPushButton* const target = button(name);
    const QPointF at = target->rect().center();
    for (QEvent::Type type : {press, QEvent::MouseButtonRelease}) {
      QMouseEvent event(type, at, target->mapToGlobal(at), Qt::LeftButton,
                        type == press ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
      event.setTimestamp(now_);
      QCoreApplication::sendEvent(target, &event);
    }
  }

 private slots:
  void init() {
    session_ = std::make_unique<Session>(std::filesystem::path());
    wizard_ = std::make_unique<Wizard>(*session_);
    page_ = std::make_unique<ScriptedPage>();
    wizard_->add(*page_);
    bar_ = std::make_unique<ActionBar>(*wizard_);
    bar_->resize(1000, bar_->height());
    bar_->show();
    now_ += 10'000;
  }
  void cleanup() {
    bar_.reset();
    wizard_.reset();
  }

  /// Law: what stays as it is, is not styled again: a measurement tells of itself several times a second.
  void whatStaysIsNotStyledAgain() {
    StyleCount count;
    bar_->findChild<QProgressBar*>()->installEventFilter(&count);
    for (int times = 0; times < 5; ++times) Q_EMIT wizard_->progressChanged();
    QCOMPARE(count.changes, 0);
  }

  /// Law: of a double click at one place, or of more clicks in quick succession, one action comes.
  void quickClicksAreForOneAction_data() {
    QTest::addColumn<int>("clicks");
    QTest::addColumn<int>("apart");
    QTest::addColumn<QStringList>("done");
    const int interval = QGuiApplication::styleHints()->mouseDoubleClickInterval();
    QTest::newRow("a click") << 1 << 0 << QStringList{"Open"};
    QTest::newRow("a double click") << 2 << interval / 2 << QStringList{"Open"};
    QTest::newRow("impatience") << 5 << interval - 1 << QStringList{"Open"};
    QTest::newRow("one after the other")
        << 3 << interval + 1 << QStringList{"Open", "Photograph the surface", "Install"};
  }
  void quickClicksAreForOneAction() {
    QFETCH(int, clicks);
    QFETCH(int, apart);
    QFETCH(QStringList, done);
    for (int i = 0; i < clicks; ++i) {
      const bool isDouble = i % 2 == 1 && apart < QGuiApplication::styleHints()->mouseDoubleClickInterval();
      click("primary", static_cast<quint64>(apart),
            isDouble ? QEvent::MouseButtonDblClick : QEvent::MouseButtonPress);
    }
    QCOMPARE(page_->done, done);
  }

  /// Law: what stands at another place is not held up.
  void anotherPlaceIsAnotherAction() {
    click("primary", 0);
    click("secondary-1", 10);
    QVERIFY(page_->isDark);
    click("secondary-0", 10);
    QVERIFY(page_->isHeld);
    // What a double click has made visible stays so.
    click("secondary-1", 10'000);
    click("secondary-1", 10, QEvent::MouseButtonDblClick);
    QVERIFY(!page_->isDark);
  }

  /// Law: who gives a command by keys that goes with it, stands at what comes next.
  void keysStayWhereTheyWere() {
    QWidget whole;
    auto* column = new QVBoxLayout(&whole);
    column->addWidget(new QPushButton("Of the rail"));
    column->addWidget(bar_.get());
    whole.show();
    button("secondary-2")->setFocus();
    QTest::keyClick(button("secondary-2"), Qt::Key_Space);
    QVERIFY(page_->isEnded);
    QCOMPARE(whole.focusWidget(), button("primary"));
    bar_->setParent(nullptr);
  }

  /// Law: no word of the reason is cut, whatever the width, and however wide the buttons have become.
  void theReasonIsNeverCut() {
    page_->sentence = "Rehearsed to the end. A simulated venue is not installed. Hold A to compare.";
    // Wide once, and kept as wide since.
    click("primary", 1000);
    click("primary", 1000);
    QCOMPARE(button("primary")->text(), QString("Install"));
    const auto* hint = bar_->findChild<QLabel*>("hint");
    for (int width = 560; width <= 1400; width += 20) {
      bar_->resize(width, bar_->height());
      bar_->layout()->activate();
      QCoreApplication::sendPostedEvents();
      QVERIFY2(hint->height() >= hint->heightForWidth(hint->width()),
               qPrintable(QString("%1: %2 of %3")
                              .arg(width)
                              .arg(hint->height())
                              .arg(hint->heightForWidth(hint->width()))));
    }
  }

  void aSecondaryActionSaysWhyItIsNotPossible_data() {
    QTest::addColumn<int>("width");  // of the bar, beside the rail, in windows of 1366 and 960 pixels
    QTest::newRow("1366") << 1142;
    QTest::newRow("960") << 896;
  }
  /// Law: the reason stands in the bar, once, and is told; the bar is as high as without it.
  void aSecondaryActionSaysWhyItIsNotPossible() {
    QFETCH(int, width);
    const auto heightNow = [&] {
      page_->refresh();
      bar_->resize(width, bar_->height());
      bar_->layout()->activate();
      QCoreApplication::sendPostedEvents();
      return bar_->height();
    };
    page_->sentence = "Measured in 5 minutes";
    const int before = heightNow();
    page_->whyNoEnd = "To end it, confirm that the room is clear.";
    QCOMPARE(heightNow(), before);
    const auto* hint = bar_->findChild<QLabel*>("hint");
    QCOMPARE(hint->text(), page_->sentence + '\n' + page_->whyNoEnd);
    QVERIFY(hint->height() >= hint->heightForWidth(hint->width()));
    QVERIFY(!button("secondary-2")->isEnabled());
    QCOMPARE(button("secondary-2")->accessibleDescription(), page_->whyNoEnd);
    // The page says it itself.
    page_->sentence = page_->whyNoEnd;
    heightNow();
    QCOMPARE(hint->text(), page_->whyNoEnd);
    page_->whyNoEnd.clear();
    page_->sentence = "Measured in 5 minutes";
    heightNow();
    QCOMPARE(hint->text(), page_->sentence);
    QVERIFY(button("secondary-2")->isEnabled() && button("secondary-2")->accessibleDescription().isEmpty());
  }

  /// Law: where what the hint asks for is on the page, one button leads there, by keys too; its words are not
  /// cut for it.
  void whatTheHintAsksForIsShown() {
    auto* remedy = button("remedy");
    QVERIFY(!remedy->isVisible());
    page_->sentence =
        "Confirm that the room is clear before any of the patterns is projected, which flash quickly.";
    page_->isRemediable = true;
    page_->refresh();
    QVERIFY(remedy->isVisible());
    QSignalSpy wanted(page_.get(), &PageModel::remedyWanted);
    QTest::keyClick(remedy, Qt::Key_Space);
    QCOMPARE(wanted.size(), 1);
    const auto* hint = bar_->findChild<QLabel*>("hint");
    for (int width = 700; width <= 1400; width += 20) {
      bar_->resize(width, bar_->height());
      bar_->layout()->activate();
      QCoreApplication::sendPostedEvents();
      QVERIFY2(hint->height() >= hint->heightForWidth(hint->width()), qPrintable(QString::number(width)));
      QVERIFY2(bar_->rect().contains(
                   remedy->geometry().translated(remedy->parentWidget()->mapTo(bar_.get(), QPoint()))),
               qPrintable(QString::number(width)));
    }
  }

  /// Law: once all was shown, nothing moves under the pointer.
  void buttonsKeepTheirPlaces() {
    const auto places = [this] {
      QList<QRect> all;
      bar_->layout()->activate();
      QCoreApplication::sendPostedEvents();
      for (const char* name : {"secondary-0", "secondary-1", "secondary-2", "primary"}) {
        const QPushButton* shown = button(name);
        all << QRect(shown->mapTo(bar_.get(), QPoint(0, 0)), shown->size());
      }
      return all;
    };
    // The widest of each is seen once.
    click("secondary-0", 1000);
    click("secondary-1", 1000);
    click("primary", 1000);
    const QList<QRect> before = places();
    click("secondary-0", 1000);
    QCOMPARE(places(), before);
    click("secondary-1", 1000);
    QCOMPARE(places(), before);
    click("primary", 1000);
    QCOMPARE(button("primary")->text(), QString("Install"));
    QCOMPARE(places(), before);
  }
};

QTEST_MAIN(TestActionBar)
#include "test_action_bar.moc"
