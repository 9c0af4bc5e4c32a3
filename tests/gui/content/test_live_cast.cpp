// SPDX-License-Identifier: MIT
// The picture of a screen under Wayland, by the real xdg-desktop-portal, PipeWire and its session manager;
// what compositors and the person before them do is played by tests/support/desktop_double.h. Runs beside
// them, see tests/support/with-desktop-portal.
#include "content/live_cast.h"

#include <QPainter>
#include <QSettings>
#include <QtTest>

#include "content/cast_choices.h"
#include "content/playlist.h"
#include "support/desktop_double.h"
#include "support/noise_picture.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::test;
using namespace std::chrono_literals;

namespace {

using Answer = DesktopDouble::Answer;
using Order = PictureNode::Order;
using Lie = PictureNode::Lie;
using Phase = LiveState::Phase;
using What = ScreenCastWish::What;

const LivePauses soon{50ms, 200ms, 10'000ms};
constexpr int patience = 15'000;  // milliseconds, on a machine that is busy

/// A show whose time goes on.
class Played {
 public:
  explicit Played(QSize size, Attendance attendance = Attendance::attended, const CastPatience& waits = {},
                  const QString& name = "stage", What what = What::screen)
      : live_(std::make_unique<LiveCast>(what, name, Canvas{size, Fit::fill}, attendance, waits, soon)) {}
  QImage image() { return live_->at(time_ += 1ms).image.convertToFormat(QImage::Format_RGB32); }
  bool shows(const QImage& picture) { return image() == picture; }
  bool isOpaque() { return live_->at(time_).image.format() == QImage::Format_RGBX8888; }
  LiveState state() const { return *live_->live(); }
  std::string problem() const { return english(state().problem); }

 private:
  std::unique_ptr<LiveCast> live_;
  ContentTime time_{0};
};

QImage blackOf(QSize size) {
  QImage black(size, QImage::Format_RGB32);
  black.fill(Qt::black);
  return black;
}

}  // namespace

class TestLiveCast : public QObject {
  Q_OBJECT

  const QSize size_{67, 43};
  const QImage picture_ = noise(size_, 1), other_ = noise(size_, 2);
  std::unique_ptr<DesktopDouble> desktop_;
  std::unique_ptr<PictureNode> node_;

  void give(Order order = Order::bgrx, Lie lie = Lie::none, int unheard = 0) {
    node_ = std::make_unique<PictureNode>(picture_, order, lie, unheard);
    desktop_->node = node_->number();
  }

 private slots:
  void initTestCase() { desktop_ = std::make_unique<DesktopDouble>(); }
  void init() {
    QSettings("relucent", "relucent").clear();
    desktop_->answer = Answer::gives;
    desktop_->takesChoicesAgain = desktop_->remembers = true;
    desktop_->questions = desktop_->withdrawn = 0;
    desktop_->wanted.clear();
  }
  void cleanup() { node_.reset(); }
  void cleanupTestCase() { desktop_.reset(); }

  void everyPixelArrives_data() {
    QTest::addColumn<int>("order");
    QTest::newRow("BGRx") << int(Order::bgrx);
    QTest::newRow("BGRA") << int(Order::bgra);
    QTest::newRow("RGBx") << int(Order::rgbx);
    QTest::newRow("RGBA") << int(Order::rgba);
  }
  void everyPixelArrives() {
    QFETCH(int, order);
    give(static_cast<Order>(order));
    Played played(size_);
    QVERIFY(played.shows(blackOf(size_)));  // at once, without waiting
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    QVERIFY(played.isOpaque());
    QCOMPARE(played.state().phase, Phase::playing);
    QCOMPARE(played.state().address, QString("screen:stage"));
    node_->show(other_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(other_), patience);
    QCOMPARE(desktop_->wanted, std::vector<uint>{1});
    QCOMPARE(desktop_->questions, 1);
  }

  /// A desktop where nothing moves sends one picture, perhaps before anybody hears it.
  void anUnheardFirstPictureIsAskedForAgain() {
    give(Order::bgrx, Lie::none, 1);
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    QCOMPARE(desktop_->questions, 1);
  }

  void anUnheardFirstPictureOfAnotherSizeIsAskedForAgain() {
    give();
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    node_->showUnheard(noise(2 * size_, 3));
    QTRY_COMPARE_WITH_TIMEOUT(played.state().size, 2 * size_, patience);
    QCOMPARE(played.state().losses, 0);
    QCOMPARE(desktop_->questions, 1);
  }

  void sizeAndOrderMayChange() {
    give();
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    QImage larger(2 * size_, QImage::Format_RGB32);
    larger.fill(QColor(10, 200, 30));
    QImage seen(size_, QImage::Format_RGB32);
    seen.fill(QColor(10, 200, 30));
    node_->show(larger);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(seen), patience);
    QCOMPARE(played.state().size, larger.size());
    node_->show(other_, Order::rgbx);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(other_), patience);
    QCOMPARE(played.state().losses, 0);
  }

  void whatWasChosenIsNotAskedAgain() {
    give();
    {
      Played wizard(size_);
      QTRY_VERIFY_WITH_TIMEOUT(wizard.shows(picture_), patience);
    }
    const QString token = castChoice("screen:stage");
    QVERIFY(!token.isEmpty());
    desktop_->answer = Answer::waits;  // it would not be given if it were asked
    {
      Played show(size_, Attendance::unattended);
      QTRY_VERIFY_WITH_TIMEOUT(show.shows(picture_), patience);
    }
    QCOMPARE(desktop_->questions, 1);
    QVERIFY(!castChoice("screen:stage").isEmpty());
    // Another name is another choice.
    Played other(size_, Attendance::attended, {}, "foyer");
    QTRY_COMPARE_WITH_TIMEOUT(other.state().phase, Phase::asking, patience);
    QCOMPARE(desktop_->questions, 2);
  }

  void aRefusedChoiceLeadsToTheDialog_data() {
    QTest::addColumn<QString>("token");
    QTest::newRow("forgotten") << "0f0e0d0c-0b0a-4908-8706-050403020100";
    QTest::newRow("no token at all") << "rubbish";
  }
  void aRefusedChoiceLeadsToTheDialog() {
    QFETCH(QString, token);
    give();
    keepCastChoice("screen:stage", token);
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    QCOMPARE(desktop_->questions, 1);
    QVERIFY(castChoice("screen:stage") != token);
  }

  /// It says so, closes the dialog, and plays when the choice is taken again.
  void whereNobodyIsItIsToldInstead() {
    give();
    keepCastChoice("screen:stage", "0f0e0d0c-0b0a-4908-8706-050403020100");
    desktop_->answer = Answer::waits;
    Played show(size_, Attendance::unattended, {60'000ms, 1'500ms, 300ms});
    QTRY_COMPARE_WITH_TIMEOUT(show.state().phase, Phase::lost, patience);
    QVERIFY2(mentions(show.problem(), "no longer gives what was chosen"), show.problem().c_str());
    QVERIFY(mentions(show.problem(), "wizard"));
    QVERIFY(show.shows(blackOf(size_)));
    QTRY_VERIFY_WITH_TIMEOUT(desktop_->withdrawn > 0, patience);
    desktop_->answer = Answer::gives;
    QTRY_VERIFY_WITH_TIMEOUT(show.shows(picture_), patience);
  }

  void refusalsAreTold_data() {
    QTest::addColumn<int>("answer");
    QTest::addColumn<bool>("isUnattended");
    QTest::addColumn<QString>("sentence");
    QTest::newRow("no") << int(Answer::refuses) << false << "it was refused in the desktop's dialog";
    QTest::newRow("nobody there") << int(Answer::waits) << true << "nobody has chosen";
  }
  void refusalsAreTold() {
    QFETCH(int, answer);
    QFETCH(bool, isUnattended);
    QFETCH(QString, sentence);
    give();
    desktop_->answer = static_cast<Answer>(answer);
    Played played(size_, isUnattended ? Attendance::unattended : Attendance::attended, {300ms, 300ms, 300ms});
    QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::lost, patience);
    QVERIFY2(mentions(played.problem(), sentence.toStdString()), played.problem().c_str());
    // And not asked again and again.
    desktop_->answer = Answer::gives;
    QTest::qWait(500);
    QCOMPARE(desktop_->questions, 1);
    QVERIFY(played.shows(blackOf(size_)));
  }

  void aDialogTakesAsLongAsItTakes() {
    give();
    desktop_->answer = Answer::waits;
    {
      Played played(size_);
      QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::asking, patience);
    }
    // And goes with whoever wanted it.
    QTRY_COMPARE_WITH_TIMEOUT(desktop_->withdrawn, 1, patience);
  }

  void lossesAreToldAndEnd_data() {
    QTest::addColumn<QString>("way");
    QTest::newRow("by the desktop") << "session";
    QTest::newRow("its pictures only") << "node";
  }
  void lossesAreToldAndEnd() {
    QFETCH(QString, way);
    give();
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
    if (way == "session") {
      desktop_->takesChoicesAgain = false;
      desktop_->answer = Answer::waits;
      desktop_->endAll();
      QTRY_VERIFY_WITH_TIMEOUT(played.state().losses == 1, patience);
      desktop_->takesChoicesAgain = true;
      QVERIFY(played.shows(picture_));  // its last one
    } else {
      node_.reset();
      QTRY_VERIFY_WITH_TIMEOUT(played.state().losses == 1, patience);
      QVERIFY(played.shows(picture_));
      give();
    }
    QVERIFY2(mentions(played.problem(), "ended"), played.problem().c_str());
  }

  void picturesThatAreNotWhatTheyClaim_data() {
    QTest::addColumn<int>("lie");
    QTest::newRow("less data") << int(Lie::shortData);
    QTest::newRow("longer lines") << int(Lie::longLines);
    QTest::newRow("backward lines") << int(Lie::backwardLines);
    QTest::newRow("beyond the end") << int(Lie::beyondEnd);
  }
  void picturesThatAreNotWhatTheyClaim() {
    QFETCH(int, lie);
    give(Order::bgrx, static_cast<Lie>(lie));
    Played played(size_);
    QTRY_VERIFY_WITH_TIMEOUT(played.state().losses > 0, patience);
    QVERIFY2(mentions(played.problem(), "no picture that can be shown"), played.problem().c_str());
    node_->tell(Lie::none);
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(picture_), patience);
  }

  /// PipeWire tells nobody that both sides have nothing in common: they are not joined.
  void picturesOfAnotherKindDoNotCome() {
    give(Order::bgrx, Lie::strangeFormat);
    Played played(size_, Attendance::attended, {60'000ms, 10'000ms, 300ms, 1'000ms});
    QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::lost, patience);
    QVERIFY(!played.problem().empty());
    QVERIFY(played.shows(blackOf(size_)));
  }

  void playlistsNameThem() {
    give();
    QVERIFY(isGivenByPortal());
    const std::unique_ptr<ContentSource> source = openContent({"window:slides"}, {size_, Fit::fill});
    QTRY_VERIFY_WITH_TIMEOUT(source->isReady(), patience);
    QCOMPARE(desktop_->wanted, std::vector<uint>{2});
    QCOMPARE(source->live()->address, QString("window:slides"));
    QCOMPARE(unusedCast("window:", {"window:1"}), QString("window:2"));
    keepCastChoice("window:2", "chosen");
    QCOMPARE(unusedCast("window:", {"window:1"}), QString("window:3"));
  }

  /// The last ones: what is missing does not come back.
  void whatIsMissingIsNamed() {
    give();
    {
      desktop_.reset();
      Played played(size_);
      QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::lost, patience);
      QVERIFY2(mentions(played.problem(), "no portal"), played.problem().c_str());
      QVERIFY(mentions(played.problem(), "xdg-desktop-portal"));
      QVERIFY(played.shows(blackOf(size_)));
    }
    qputenv("PIPEWIRE_REMOTE", "/nowhere/pipewire");
    desktop_ = std::make_unique<DesktopDouble>();
    desktop_->node = node_->number();
    Played played(size_);
    QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::lost, patience);
    QVERIFY2(mentions(played.problem(), "PipeWire"), played.problem().c_str());
    qunsetenv("PIPEWIRE_REMOTE");
  }
};

QTEST_GUILESS_MAIN(TestLiveCast)
#include "test_live_cast.moc"
