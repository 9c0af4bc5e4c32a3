// SPDX-License-Identifier: MIT
#include <QTranslator>
#include <QtTest>

#include "relucent/base/message.h"
#include "relucent/devices/check/check_verdict.h"
#include "text/message_text.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::gui;

namespace {

CheckVerdict verdictOf(Finding finding) {
  return {finding, 0.123, 7, 0.0456, 1.0 / 50.0, "Stage (HDMI-1)", "Foyer (HDMI-2)"};
}

/// Spaces that break no line are the interface's alone.
QString plain(QString text) {
  return text.replace(QChar(0x202F), ' ');
}

class Shouting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char*, int) const override {
    return QString(context).startsWith("check.") ? QString::fromUtf8(text).toUpper() : QString();
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
    const Message message = messageOf(verdictOf(static_cast<Finding>(number)));
    QVERIFY(!message.empty());
    QCOMPARE(plain(text(message)), QString::fromStdString(english(message)));
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
    row(Finding::pictureOut, {"46 MS"});
    row(Finding::whiteChanges, {"12,3 %", "20,00 MS"});
    row(Finding::lightUnsteady, {"12,3 %"});
    row(Finding::lampFlickers, {"12 %", "45,6 MS", "20,00 MS"});
    row(Finding::colourWheel, {"12 %", "45,6 MS", "20,00 MS"});
    row(Finding::rollingShutter, {"12 %", "20,00 MS"});
    row(Finding::dithering, {"12 %"});
  }
  void numbersAndNamesSurviveTranslation() {
    QFETCH(int, number);
    QFETCH(QStringList, told);
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    Shouting translator;
    QCoreApplication::installTranslator(&translator);
    const QString shown = plain(text(messageOf(verdictOf(static_cast<Finding>(number)))));
    QCoreApplication::removeTranslator(&translator);
    QVERIFY2(shown.contains("CAMERA") || shown.contains("PICTURE") || shown.contains("FRAMES"),
             qPrintable(shown));
    for (const QString& part : told)
      QVERIFY2(shown.contains(part), qPrintable(part + " is not in: " + shown));
  }
};

QTEST_GUILESS_MAIN(TestVerdictText)
#include "test_verdict_text.moc"
