// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/devices/shutter_speed.h"

using namespace relucent;
using namespace relucent::devices;

namespace {

/// A camera's list in thirds of a stop, with what else stands in such lists.
ShutterList thirds() {
  return ShutterList({"Auto",  "bulb",   "30",     "25",     "20",     "15",    "13",    "10.3",
                      "8",     "6.3",    "5",      "4",      "3.2",    "2.5",   "2",     "1.6",
                      "1.3",   "1",      "0.8",    "0.6",    "0.5",    "0.4",   "0.3",   "1/4",
                      "1/5",   "1/6",    "1/8",    "1/10",   "1/13",   "1/15",  "1/20",  "1/25",
                      "1/30",  "1/40",   "1/50",   "1/60",   "1/80",   "1/100", "1/125", "1/250",
                      "1/500", "1/1000", "1/2000", "1/4000", "1/8000", "Time",  "x 200"});
}

}  // namespace

class TestShutterSpeed : public QObject {
  Q_OBJECT

 private slots:
  void wordsBecomeSeconds_data() {
    QTest::addColumn<QString>("word");
    QTest::addColumn<double>("seconds");
    auto row = [](const char* word, double seconds) { QTest::newRow(word) << QString(word) << seconds; };
    row("1/125", 1.0 / 125.0);
    row("1/8000", 1.0 / 8000.0);
    row("0.5", 0.5);
    row("0,5", 0.5);
    row("1/1,3", 1.0 / 1.3);
    row("30", 30.0);
    row("0.0080s", 0.008);
    row("0,0080s", 0.008);
    row("1.3 s", 1.3);
    row("2 sec", 2.0);
    row("4/10", 0.4);
    row("13/10", 1.3);
    row("30\"", 30.0);
    row("0\"5", 0.5);
    row("1\"3", 1.3);
    row("2\u2033", 2.0);
    row(" 1 / 60 ", 1.0 / 60.0);
    row("1/125 s", 1.0 / 125.0);
    row("1/100''", 0.01);
  }
  void wordsBecomeSeconds() {
    QFETCH(QString, word);
    QFETCH(double, seconds);
    const std::optional<double> found = secondsFromShutter(word.toStdString());
    QVERIFY2(found, qPrintable(word));
    QVERIFY(std::abs(*found - seconds) <= 1e-12 * seconds);
  }

  void whatIsNoTimeIsNone() {
    for (const char* word : {"",
                             " ",
                             "bulb",
                             "Bulb",
                             "Time",
                             "auto",
                             "x 200",
                             "1/0",
                             "0",
                             "0/5",
                             "-1",
                             "1/",
                             "/2",
                             "1/2/3",
                             "nan",
                             "inf",
                             "1e3",
                             "1.2.3",
                             "Unknown value 0013",
                             "s",
                             "\"",
                             "1-2"})
      QVERIFY2(!secondsFromShutter(word), word);
  }

  void bulbIsKnown() {
    for (const char* word :
         {"bulb", "Bulb", "BULB", " Bulb (B)", "Langzeitbelichtung", "Pose B", "\u30d0\u30eb\u30d6"})
      QVERIFY2(isBulb(word), word);
    for (const char* word : {"", "30", "Time", "auto", "a bulb"}) QVERIFY2(!isBulb(word), word);
  }

  /// No other entry of the list is nearer by ratio, and what stands in the list is found again.
  void theNearestIsChosen() {
    const ShutterList list = thirds();
    QCOMPARE(list.shortest(), 1.0 / 8000.0);
    QCOMPARE(list.longest(), 30.0);
    QCOMPARE(*list.bulb(), std::string("bulb"));
    QCOMPARE(list.nearest(0.5).word, std::string("0.5"));
    QCOMPARE(list.nearest(0.0088).word, std::string("1/125"));
    QCOMPARE(list.nearest(1e-9).word, std::string("1/8000"));
    QCOMPARE(list.nearest(1e9).word, std::string("30"));
    // In the middle of a full stop, by ratio and not by difference: sqrt(2) / 500 and a bit.
    QCOMPARE(list.nearest(1.001 * std::sqrt(2.0) / 500.0).word, std::string("1/250"));
    QCOMPARE(list.nearest(0.999 * std::sqrt(2.0) / 500.0).word, std::string("1/500"));
    for (double seconds = 1e-4; seconds < 40.0; seconds *= 1.07) {
      const double chosen = list.nearest(seconds).seconds;
      QVERIFY(chosen / seconds < 1.5 && seconds / chosen < 1.5);  // a full stop's half is 1.41
    }
  }

  void bulbIsForWhatIsLongerThanTheList() {
    const ShutterList list = thirds();
    QVERIFY(!list.needsBulb(30.0));
    QVERIFY(!list.needsBulb(32.0));
    QVERIFY(list.needsBulb(34.0));
    QVERIFY(!ShutterList({"1/60", "1"}).needsBulb(60.0));
    QVERIFY(ShutterList({"Bulb"}).needsBulb(0.1));
    QVERIFY(!ShutterList({"1", "Bulb"}).needsBulb(1.0));
    QVERIFY(ShutterList({"1", "Bulb"}).needsBulb(1.1));
  }

  void listsMayBeEmptyOrFullOfWords() {
    QVERIFY(ShutterList().empty());
    const ShutterList words({"Auto", "", "Time"});
    QVERIFY(words.empty());
    QVERIFY(!words.bulb());
    QVERIFY(!words.needsBulb(1.0));
    QVERIFY_EXCEPTION_THROWN(words.nearest(1.0), std::logic_error);
    QVERIFY_EXCEPTION_THROWN(thirds().nearest(0.0), std::logic_error);
  }

  void repeatedTimesAreTheFirstOfThem() {
    QCOMPARE(ShutterList({"0.5", "1/2", "1"}).nearest(0.5).word, std::string("0.5"));
  }
};

QTEST_GUILESS_MAIN(TestShutterSpeed)
#include "test_shutter_speed.moc"
