// SPDX-License-Identifier: MIT
// Work that answers soon and then exactly.
#include "jobs/refining.h"
#include "relucent/base/message.h"

#include <QSemaphore>
#include <QtTest>
#include <stdexcept>

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Works until it is asked to stop.
void workForEver(const Progress& progress) {
  while (true) progress.checkpoint();
}

}  // namespace

class TestRefining : public QObject {
  Q_OBJECT

  QStringList answers_, failures_;

  Refining<QString>::Report answered() {
    return [this](const QString& answer) { answers_.append(answer); };
  }
  Refining<QString>::Failed failed() {
    return [this](const Failure& failure) { failures_.append(failure.what); };
  }

 private slots:
  void init() {
    answers_.clear();
    failures_.clear();
  }

  void itAnswersSoonAndThenExactly() {
    Refining<QString> refining(answered(), failed());
    refining.ask([](Progress&, const auto& reportSoon) {
      reportSoon("soon");
      return QString("exactly");
    });
    QVERIFY(refining.isBusy());
    QTRY_COMPARE(answers_, QStringList({"soon", "exactly"}));
    QVERIFY(!refining.isBusy());
  }

  void aNewerRequestCancelsTheOneUnderWay() {
    Refining<QString> refining(answered(), failed());
    refining.ask([](Progress& progress, const auto& reportSoon) {
      reportSoon("soon");
      workForEver(progress);
      return QString("never");
    });
    QTRY_COMPARE(answers_, QStringList({"soon"}));
    for (int i = 0; i < 5; ++i)
      refining.ask([i](Progress&, const auto&) { return QString("exactly %1").arg(i); });
    QTRY_VERIFY(!refining.isBusy());
    QCOMPARE(answers_, QStringList({"soon", "exactly 4"}));
    QVERIFY(failures_.isEmpty());
  }

  /// Before it has answered, too, ...
  void itIsCancelledBeforeItHasAnswered() {
    Refining<QString> refining(answered(), failed());
    refining.ask([](Progress& progress, const auto&) {
      workForEver(progress);
      return QString("never");
    });
    refining.ask([](Progress&, const auto&) { return QString("exactly"); });
    QTRY_COMPARE(answers_, QStringList({"exactly"}));
  }

  /// ... but not the next one as well: it answers first, and is cancelled then.
  void ofTwoThatDidNotAnswerYetTheSecondIsSpared() {
    Refining<QString> refining(answered(), failed());
    QSemaphore go, begun;
    refining.ask([&begun](Progress& progress, const auto&) {
      begun.release();
      workForEver(progress);
      return QString("never");
    });
    begun.acquire();
    refining.ask([&](Progress& progress, const auto& reportSoon) {
      begun.release();
      go.acquire();
      progress.checkpoint();
      reportSoon("soon");
      workForEver(progress);
      return QString("never");
    });
    QTRY_COMPARE(begun.available(), 1);
    for (int i = 0; i < 5; ++i)
      refining.ask([i](Progress&, const auto&) { return QString("exactly %1").arg(i); });
    go.release();
    QTRY_COMPARE(answers_, QStringList({"soon", "exactly 4"}));
  }

  void whatIsDroppedSaysNothing() {
    Refining<QString> refining(answered(), failed());
    QSemaphore begun;
    refining.ask([&begun](Progress& progress, const auto& reportSoon) {
      reportSoon("soon");
      begun.release();
      workForEver(progress);
      return QString("never");
    });
    begun.acquire();
    refining.drop();
    QVERIFY(!refining.isBusy());
    refining.ask([](Progress&, const auto&) { return QString("exactly"); });
    QTRY_COMPARE(answers_, QStringList({"exactly"}));
  }

  void aFailureIsToldAndTheNextRequestIsAnswered() {
    Refining<QString> refining(answered(), failed());
    refining.ask([](Progress&, const auto&) -> QString {
      throw Error(ErrorKind::input, Message::plain("it is wrong"), Message::plain("do it again"), {});
    });
    QTRY_COMPARE(failures_, QStringList({"It is wrong."}));
    QVERIFY(!refining.isBusy() && answers_.isEmpty());
    refining.ask([](Progress&, const auto&) { return QString("exactly"); });
    QTRY_COMPARE(answers_, QStringList({"exactly"}));
  }

  void destroyedWhileItWorksItCancelsAndWaits() {
    bool over = false;
    {
      Refining<QString> refining(answered(), failed());
      refining.ask([&over](Progress& progress, const auto& reportSoon) {
        reportSoon("soon");
        try {
          workForEver(progress);
        } catch (...) {
          over = true;
          throw;
        }
        return QString("never");
      });
    }
    QVERIFY(over);
    QCoreApplication::processEvents();
    QVERIFY(answers_.isEmpty());
  }
};

QTEST_GUILESS_MAIN(TestRefining)
#include "test_refining.moc"
