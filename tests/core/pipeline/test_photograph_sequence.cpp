// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <QtTest>

#include "relucent/base/message.h"
#include "relucent/pipeline/photograph_sequence.h"

using namespace relucent;
using namespace relucent::pipeline;

namespace {

/// "A0 B3 C6": names and seconds; "A B": without times.
std::vector<TakenPhotograph> photographs(const QString& text) {
  std::vector<TakenPhotograph> list;
  for (const QString& word : text.split(' ', Qt::SkipEmptyParts)) {
    std::optional<std::time_t> taken;
    if (word.size() > 1) taken = 1'000'000 + word.mid(1).toInt();
    list.push_back({word.left(1).toStdString(), taken});
  }
  return list;
}

QString namesOf(const std::vector<TakenPhotograph>& list) {
  QString names;
  for (const TakenPhotograph& photograph : list) names += QString::fromStdString(photograph.path.string());
  return names;
}

}  // namespace

class TestPhotographSequence : public QObject {
  Q_OBJECT

 private slots:
  void photographsAreInOrder_data() {
    QTest::addColumn<QString>("given");
    QTest::addColumn<QString>("order");
    QTest::addColumn<bool>("isTold");
    QTest::newRow("none") << ""
                          << "" << false;
    QTest::newRow("by name") << "B C A"
                             << "ABC" << false;
    QTest::newRow("names as times") << "C6 A0 B3"
                                    << "ABC" << false;
    QTest::newRow("counted over") << "A6 B9 X0 Y3"
                                  << "XYAB" << true;
    QTest::newRow("one has no time") << "A6 B X0 Y3"
                                     << "ABXY" << false;
    QTest::newRow("same second") << "B5 A5 D5 C5"
                                 << "ABCD" << false;
    QTest::newRow("same second, counted over") << "B5 A5 Z4 Y4"
                                               << "YZAB" << true;
  }
  void photographsAreInOrder() {
    QFETCH(QString, given);
    QFETCH(QString, order);
    QFETCH(bool, isTold);
    const PhotographSequence sequence = inOrder(photographs(given));
    QCOMPARE(namesOf(sequence.photographs), order);
    QCOMPARE(!sequence.finding.empty(), isTold);
    if (isTold)
      QVERIFY(english(sequence.finding)
                  .find(fmt::format("from {} to {}", order.front().toLatin1(), order.back().toLatin1())) !=
              std::string::npos);
  }

  void aWrongNumberIsOneSentence_data() {
    QTest::addColumn<QString>("given");
    QTest::addColumn<int>("patterns");
    QTest::addColumn<QString>("what");
    QTest::newRow("one too few, no times")
        << "A B C" << 4 << "there are 4 patterns but 3 photographs: 1 is missing";
    QTest::newRow("some too few") << "A B" << 5 << "there are 5 patterns but 2 photographs: 3 are missing";
    QTest::newRow("one too many") << "A B C" << 2 << "there are 2 patterns but 3 photographs: 1 is too many";
    QTest::newRow("a gap")
        << "A0 B3 C6 D12 E15 F18" << 7
        << "there are 7 patterns but 6 photographs: 1 is missing, judging by the camera's clock after C";
    QTest::newRow("two gaps")
        << "A0 B3 C9 D12 E15 F21 G24" << 9
        << "there are 9 patterns but 7 photographs: 2 are missing, judging by the camera's clock after B, E";
    QTest::newRow("no gap") << "A0 B3 C6 D9 E12" << 6
                            << "there are 6 patterns but 5 photographs: 1 is missing";
    // An interval of 3.3 s looks like 3 or 4, once in a while.
    QTest::newRow("uneven seconds") << "A0 B3 C7 D10 E13 F17" << 7
                                    << "there are 7 patterns but 6 photographs: 1 is missing";
    QTest::newRow("one too soon")
        << "A0 B5 C10 D11 E15 F20" << 5
        << "there are 5 patterns but 6 photographs: 1 is too many, judging by the camera's clock these: D";
    QTest::newRow("too fast to tell")
        << "A0 B1 C2 D4 E5" << 6 << "there are 6 patterns but 5 photographs: 1 is missing";
    QTest::newRow("no rhythm") << "A0 B2 C4 D6 E8 F90 G180 H270 I360 J450" << 11
                               << "there are 11 patterns but 10 photographs: 1 is missing";
    QTest::newRow("no photographs but one")
        << "A0" << 3 << "there are 3 patterns but 1 photographs: 2 are missing";
  }
  void aWrongNumberIsOneSentence() {
    QFETCH(QString, given);
    QFETCH(int, patterns);
    QFETCH(QString, what);
    const CountProblem problem = countProblem(photographs(given), static_cast<std::size_t>(patterns));
    QCOMPARE(QString::fromStdString(english(problem.what)), what);
    QVERIFY(!problem.advice.empty());
  }
};

QTEST_GUILESS_MAIN(TestPhotographSequence)
#include "test_photograph_sequence.moc"
