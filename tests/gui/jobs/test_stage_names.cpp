// SPDX-License-Identifier: MIT
#include "jobs/stage_names.h"

#include <QDirIterator>
#include <QRegularExpression>
#include <QTranslator>
#include <QtTest>
#include <algorithm>

using namespace relucent;

namespace {

/// The names that a file of core gives to parts of its progress, "{}" where something is put in.
QStringList namesIn(const QString& source) {
  // No raw strings: the meta-object compiler loses its way in their quotes.
  static const QRegularExpression part("\\.part\\(([^;]*)\\);",
                                       QRegularExpression::DotMatchesEverythingOption);
  static const QRegularExpression joined("\"\\s*\\+\\s*[\\w.]+\\s*\\+\\s*\"");
  static const QRegularExpression literal("\"([^\"]*)\"(\\s*\\+\\s*[\\w.]+)?");
  QStringList names;
  for (const QRegularExpressionMatch& match : part.globalMatch(source)) {
    QString arguments = match.captured(1).replace(joined, "{}");
    QRegularExpressionMatch name = literal.match(arguments);
    if (!name.hasMatch() || name.captured(1).startsWith("{}")) continue;  // data's own names
    names << name.captured(1) + (name.captured(2).isEmpty() ? "" : "{}");
  }
  return names;
}

class Shouting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char*, int) const override {
    QString loud = QString::fromLatin1(text).toUpper();
    return qstrcmp(context, "Stage") == 0 ? loud.replace("%N", "%n") : QString();
  }
};

}  // namespace

class TestStageNames : public QObject {
  Q_OBJECT

 private slots:
  void everyStageOfCoreIsInTheTable() {
    std::span<const char* const> known = knownStages();
    int found = 0;
    for (QDirIterator files(RELUCENT_CORE, {"*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
         files.hasNext();) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      for (const QString& name : namesIn(QString::fromUtf8(file.readAll()))) {
        ++found;
        bool there =
            std::any_of(known.begin(), known.end(), [&](const char* stage) { return name == stage; });
        QVERIFY2(
            there,
            qPrintable(QString("'%1' of %2 is not in gui/jobs/stage_names.cpp").arg(name, file.fileName())));
      }
    }
    QVERIFY2(found > 50, qPrintable(QString::number(found)));
  }

  void namesAreTranslatedAndFilledIn_data() {
    QTest::addColumn<QString>("stage");
    QTest::addColumn<QString>("text");
    QTest::newRow("plain") << "Linearizing"
                           << "LINEARIZING";
    QTest::newRow("one name") << "Measuring the brightness curves of the projector"
                              << "MEASURING THE BRIGHTNESS CURVES OF THE PROJECTOR";
    QTest::newRow("numbers") << "level 3 of 8: 24 patterns"
                             << "LEVEL 3 OF 8: 24 PATTERN(S)";
    QTest::newRow("one") << "measuring 1 flagged pixels again"
                         << "MEASURING 1 FLAGGED PIXEL(S) AGAIN";
    QTest::newRow("a name of the user's") << "Reading chapel"
                                          << "READING chapel";
    QTest::newRow("a page's own") << "Opening the devices"
                                  << "Opening the devices";
    QTest::newRow("nothing") << ""
                             << "";
  }
  void namesAreTranslatedAndFilledIn() {
    QFETCH(QString, stage);
    QFETCH(QString, text);
    Shouting translator;
    QCoreApplication::installTranslator(&translator);
    QCOMPARE(stageText(stage.toStdString()), text);
    QCoreApplication::removeTranslator(&translator);
    QString plain = stage;
    QCOMPARE(stageText(stage.toStdString()),
             plain.replace(" patterns", " pattern(s)").replace(" pixels ", " pixel(s) "));
  }
};

QTEST_GUILESS_MAIN(TestStageNames)
#include "test_stage_names.moc"
