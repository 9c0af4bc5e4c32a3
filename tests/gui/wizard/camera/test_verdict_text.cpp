// SPDX-License-Identifier: MIT
#include "wizard/camera/verdict_text.h"

#include <QTranslator>
#include <QtTest>

using namespace relucent;

namespace {

CheckVerdict verdictOf(Finding finding) {
  return {finding, 0.123, 7, 0.0456, 1.0 / 50.0, "Stage (HDMI-1)", "Foyer (HDMI-2)"};
}

/// Spaces that break no line, and the two forms of a number, are the interface's alone.
QString plain(QString text) {
  return text.replace(QChar(0x202F), ' ').replace("(s)", "s");
}

class Shouting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char*, int) const override {
    return qstrcmp(context, "CheckVerdict") == 0 ? QString::fromUtf8(text).toUpper().replace("%N", "%n")
                                                 : QString();
  }
};

}  // namespace

class TestVerdictText : public QObject {
  Q_OBJECT

 private slots:
  void init() { QLocale::setDefault(QLocale(QLocale::English, QLocale::UnitedStates)); }

  void inEnglishItIsCoresSentence_data() {
    QTest::addColumn<int>("number");
    for (std::size_t i = 0; i < allFindings.size(); ++i)
      QTest::addRow("%zu", i) << static_cast<int>(allFindings[i]);
  }
  void inEnglishItIsCoresSentence() {
    QFETCH(int, number);
    const CheckVerdict verdict = verdictOf(static_cast<Finding>(number));
    QVERIFY(!verdictText(verdict).isEmpty());
    QCOMPARE(plain(verdictText(verdict)), QString::fromStdString(sentence(verdict)));
  }

  /// What was measured is told in every language.
  void numbersAndNamesSurviveTranslation_data() {
    QTest::addColumn<int>("number");
    QTest::addColumn<QStringList>("told");
    auto row = [](Finding finding, const QStringList& told) {
      QTest::addRow("%d", static_cast<int>(finding)) << static_cast<int>(finding) << told;
    };
    row(Finding::screenSeen, {"Stage (HDMI-1)", "12 %"});
    row(Finding::picturesLate, {"7"});
    row(Finding::otherScreenSeen, {"Stage (HDMI-1)", "Foyer (HDMI-2)"});
    row(Finding::screenNotSeen, {"Stage (HDMI-1)"});
    row(Finding::pictureOut, {"7", "46 ms"});
    row(Finding::whiteChanges, {"12,3 %", "20,00 ms"});
    row(Finding::lightUnsteady, {"12,3 %"});
    row(Finding::lampFlickers, {"12 %", "45,6 ms", "20,00 ms"});
    row(Finding::colourWheel, {"12 %", "45,6 ms", "20,00 ms"});
    row(Finding::rollingShutter, {"12 %", "20,00 ms"});
    row(Finding::dithering, {"12 %"});
  }
  void numbersAndNamesSurviveTranslation() {
    QFETCH(int, number);
    QFETCH(QStringList, told);
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    Shouting translator;
    QCoreApplication::installTranslator(&translator);
    const QString text = plain(verdictText(verdictOf(static_cast<Finding>(number))));
    QCoreApplication::removeTranslator(&translator);
    QVERIFY2(text.contains("CAMERA") || text.contains("PICTURE") || text.contains("FRAMES"),
             qPrintable(text));
    for (const QString& part : told) QVERIFY2(text.contains(part), qPrintable(part + " is not in: " + text));
  }
};

QTEST_GUILESS_MAIN(TestVerdictText)
#include "test_verdict_text.moc"
