// SPDX-License-Identifier: MIT
#include "jobs/job.h"

#include <QSemaphore>
#include <QSignalSpy>
#include <QTranslator>
#include <QtTest>

#include "jobs/latest.h"
#include "jobs/live_rig.h"
#include "relucent/base/error.h"
#include "relucent/devices/check/screen_proof.h"
#include "relucent/devices/command/shell_command.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::gui;
using namespace relucent::image;
using namespace relucent::rig;

namespace {

class CountingProjector : public Projector {
 public:
  std::string name() const override { return "counting"; }
  Size size() const override { return {2, 2}; }
  int bits() const override { return 8; }
  void show(const Image& drive) override {
    brightest = *std::max_element(drive.data().begin(), drive.data().end());
    shown.release();
  }
  float brightest = -1.0f;
  QSemaphore shown;
};

}  // namespace

class TestJob : public QObject {
  Q_OBJECT

 private slots:
  /// Only what stopped answering is called so.
  void aCameraThatSeesSomethingElseIsNoDeviceThatStopped() {
    const auto told = [](const auto& error) { return failureOf(std::make_exception_ptr(error)); };
    const Failure unseen = told(ScreenNotSeen(
        ErrorKind::device, Message::plain("the camera sees DP-1, not DP-2"), Message::plain("aim it")));
    QVERIFY(!unseen.heading.isEmpty());
    QCOMPARE(unseen.what, QString("The camera sees DP-1, not DP-2."));
    QVERIFY(unseen.kind == ErrorKind::device);
    QVERIFY(told(Error(ErrorKind::device, Message::plain("the camera does not answer"),
                       Message::plain("plug it in")))
                .heading.isEmpty());
  }

  /// Law: which command ended how, and where another is typed.
  void aCommandThatFailsIsNamed() {
    std::exception_ptr thrown;
    try {
      devices::runShellCommand("echo no lamp; exit 3", std::chrono::seconds(30), "projector command");
    } catch (...) {
      thrown = std::current_exception();
    }
    const Failure failure = failureOf(thrown);
    QVERIFY(failure.heading.contains("program"));
    QVERIFY2(failure.what.contains("status 3") && failure.what.contains("no lamp"), qPrintable(failure.what));
    QVERIFY2(
        failure.advice.contains("echo no lamp; exit 3") && failure.advice.contains("Change the programs"),
        qPrintable(failure.advice));
  }

  /// Law: what is under way is called so in the language that the user has, from the moment he chooses it.
  void theStageFollowsTheLanguage() {
    struct Shouted : QTranslator {
      QString translate(const char*, const char* source, const char*, int) const override {
        return QString(source).toUpper();
      }
      bool isEmpty() const override { return false; }
    } other;
    Job job;
    QSemaphore mayEnd;
    job.start([&mayEnd](Progress& progress) {
      Progress part = progress.part(1.0, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
      part.report(0.5);
      mayEnd.acquire();
    });
    QTRY_COMPARE(job.stage(), QString("Opening the devices"));
    QCoreApplication::installTranslator(&other);
    const QString then = job.stage();
    QCoreApplication::removeTranslator(&other);
    mayEnd.release();
    QCOMPARE(then, QString("OPENING THE DEVICES"));
  }

  /// Law: what work held is free when it has ended, while the job stays: a camera, for another venue.
  void whatWorkHoldsIsLetGoOf() {
    auto held = std::make_shared<int>(7);
    const std::weak_ptr<int> watched = held;
    Job job;
    job.start([held = std::move(held)](Progress&) {});
    QTRY_COMPARE(job.state(), Job::State::done);
    QVERIFY(watched.expired());
  }

  void endsInOneWay_data() {
    QTest::addColumn<int>("ending");
    QTest::addColumn<int>("state");
    QTest::newRow("done") << 0 << static_cast<int>(Job::State::done);
    QTest::newRow("cancelled") << 1 << static_cast<int>(Job::State::cancelled);
    QTest::newRow("failure of the world") << 2 << static_cast<int>(Job::State::failed);
    QTest::newRow("mistake of the program") << 3 << static_cast<int>(Job::State::failed);
  }
  void endsInOneWay() {
    QFETCH(int, ending);
    QFETCH(int, state);
    Job job;
    QSignalSpy ended(&job, &Job::ended);
    job.start([ending](Progress& progress) {
      progress.report(0.5);
      if (ending == 1) throw Cancelled();
      if (ending == 2)
        throw Error(ErrorKind::device, Message::plain("the camera is gone"), Message::plain("plug it in"));
      if (ending == 3) throw std::logic_error("1 is not 2");
    });
    QVERIFY(job.isRunning());
    QTRY_COMPARE(ended.size(), 1);
    QCOMPARE(static_cast<int>(job.state()), state);
    if (ending == 2) {
      QCOMPARE(job.failure().what, QString("The camera is gone."));
      QCOMPARE(job.failure().advice, QString("Plug it in."));
      QVERIFY(job.failure().kind == ErrorKind::device);
    }
    if (ending == 3) QVERIFY(job.failure().details.contains("1 is not 2"));
  }

  void aCancelReachesTheWork() {
    Job job;
    QSemaphore begun;
    job.start([&begun](Progress& progress) {
      begun.release();
      while (true) progress.checkpoint();
    });
    begun.acquire();
    job.cancel();
    QTRY_VERIFY(job.state() == Job::State::cancelled);
  }

  void stopAndKeepIsNoCancel() {
    Job job;
    QSemaphore begun;
    job.start([&begun](Progress& progress) {
      begun.release();
      while (!progress.stopAndKeep()) progress.checkpoint();
    });
    begun.acquire();
    job.stopAndKeep();
    QVERIFY(job.isStopping());
    QTRY_VERIFY(job.state() == Job::State::done);
  }

  void ofManyReportsTheLastCountsAndTheInterfaceIsNotFlooded() {
    Job job;
    QSignalSpy progressed(&job, &Job::progressed), expected(&job, &Job::expected);
    job.start([](Progress& progress) {
      Progress part = progress.part(1.0, Message::plain("counting"));
      for (int i = 0; i <= 100000; ++i) part.report(i / 100000.0);
      WorkLeft left;
      left.shots = 7;
      part.expect(left);
    });
    job.wait();
    QTRY_VERIFY(job.state() == Job::State::done);
    QCOMPARE(job.fraction(), 1.0);
    QCOMPARE(job.stage(), QString("Counting"));
    QCOMPARE(expected.size(), 1);
    QVERIFY(progressed.size() < 10);
  }

  void destroyedWhileItWorksItWaits() {
    bool over = false;
    {
      Job job;
      job.start([&over](Progress& progress) {
        try {
          while (true) progress.checkpoint();
        } catch (...) {
          over = true;
          throw;
        }
      });
    }
    QVERIFY(over);
  }

  void ofManyRequestsTheNewestIsAnswered() {
    QSemaphore go;
    QList<int> answers;
    Latest<int> latest([&answers](int answer) { answers.append(answer); }, [](const Failure&) {});
    latest.ask([&go] {
      go.acquire();
      return 0;
    });
    for (int i = 1; i < 10; ++i) latest.ask([i] { return i; });
    go.release();
    QTRY_COMPARE(answers, QList<int>({0, 9}));
  }

  void aPauseHoldsTheRigInTheDark() {
    auto live = std::make_shared<LiveRig>(0);
    auto owned = std::make_unique<CountingProjector>();
    CountingProjector& projector = *owned;
    Rig rig;
    rig.projectors.push_back(std::move(owned));
    rig = watched(std::move(rig), live);
    live->pause();
    QVERIFY(live->isPaused());
    Job job;
    job.start([&rig](Progress&) { rig.projectors[0]->show(Image({2, 2}, 3, 1.0f)); });
    projector.shown.acquire();
    QCOMPARE(projector.brightest, 0.0f);
    QVERIFY(job.isRunning());
    live->resume();
    projector.shown.acquire();
    QCOMPARE(projector.brightest, 1.0f);
    QTRY_VERIFY(job.state() == Job::State::done);
    QCOMPARE(live->pictures().pattern, Image({2, 2}, 3, 1.0f));
  }
};

QTEST_GUILESS_MAIN(TestJob)
#include "test_job.moc"
