// SPDX-License-Identifier: MIT
#include <QtTest>
#include <set>

#include "relucent/base/error.h"

using namespace relucent;

class TestError : public QObject {
  Q_OBJECT

 private slots:
  void oneLineSaysWhereWhatAndWhatToDo_data() {
    QTest::addColumn<QString>("advice");
    QTest::addColumn<QString>("context");
    QTest::addColumn<QString>("line");
    QTest::newRow("all") << "plug it in"
                         << "camera"
                         << "camera: it is gone; plug it in.";
    QTest::newRow("no context") << "plug it in"
                                << ""
                                << "it is gone; plug it in.";
    QTest::newRow("no advice") << ""
                               << "camera"
                               << "camera: it is gone.";
  }
  void oneLineSaysWhereWhatAndWhatToDo() {
    QFETCH(QString, advice);
    QFETCH(QString, context);
    QFETCH(QString, line);
    const Error error(ErrorKind::device, Message::plain("it is gone"), Message::plain(advice.toStdString()),
                      context.toStdString());
    QCOMPARE(QString(error.what()), line);
    QVERIFY(error.kind() == ErrorKind::device);
    QVERIFY(error.summary() == Message::plain("it is gone"));
    QCOMPARE(QString::fromStdString(english(error.advice())), advice);
    QCOMPARE(QString::fromStdString(englishSentence(error.sentence())), line);
    QCOMPARE(QString::fromStdString(error.context()), context);
  }

  void contextsNestFromTheOutside() {
    const Error inner(ErrorKind::format, Message::plain("it is cut short"), Message::plain("copy it again"),
                      "a.exr");
    const Error outer = inner.within("shot 3").within("resume");
    QCOMPARE(QString(outer.what()), QString("resume: shot 3: a.exr: it is cut short; copy it again."));
    QVERIFY(outer.kind() == ErrorKind::format);
    QCOMPARE(QString(Error(ErrorKind::disk, Message::plain("it is full"), {}).within("x").what()),
             QString("x: it is full."));
  }

  void everyKindHasItsOwnName() {
    std::set<std::string_view> names;
    for (ErrorKind kind : {ErrorKind::usage, ErrorKind::input, ErrorKind::format, ErrorKind::disk,
                           ErrorKind::memory, ErrorKind::device, ErrorKind::numerics})
      names.insert(toString(kind));
    QCOMPARE(names.size(), std::size_t{7});
    QVERIFY(!names.contains("unknown"));
  }

  void aBreachedContractShowsValuesAndPlace() {
    require(true, "never seen");
    try {
      require(2 > 3, "{} rows must equal {} pixels", 2, 3);
      QFAIL("require() let a breach pass");
    } catch (const std::logic_error& error) {
      const QString text = error.what();
      QVERIFY2(text.contains("2 rows must equal 3 pixels"), error.what());
      QVERIFY2(text.contains("test_error.cpp:"), error.what());
      QVERIFY2(text.contains("aBreachedContract"), error.what());
    }
  }
};

QTEST_APPLESS_MAIN(TestError)
#include "test_error.moc"
