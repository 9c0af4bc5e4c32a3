// SPDX-License-Identifier: MIT
// Every language says everything that the program says, with nothing lost, and is spoken as soon as it is
// chosen. The sources' sentences are those that lupdate finds.
#include <QDir>
#include <QDirIterator>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QtTest>

#include "app/language.h"
#include "gui/app/translation_file.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/devices/check/check_verdict.h"
#include "text/message_text.h"
#include "views/number_text.h"

using namespace relucent;
using namespace relucent::devices;
using namespace relucent::gui;

namespace {

const QString folder = RELUCENT_SOURCE "/translations";

QString codeOf(QString file) {
  return file.remove("relucent_").remove(".ts");
}

bool runs(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.start(program, arguments);
  return process.waitForFinished(60000) && process.exitCode() == 0;
}

TranslatedSentence sentence(const QString& source, const QStringList& forms, bool finished = true) {
  return {source.contains("{}") ? "area.name" : "Context", source, {}, forms.size() > 1, finished, forms};
}

}  // namespace

class TestTranslations : public QObject {
  Q_OBJECT

  QTemporaryDir own_;
  QList<TranslatedSentence> sources_;

  QStringList files() { return QDir(folder).entryList({"relucent_*.ts"}, QDir::Files, QDir::Name); }

  /// relucent_CODE.qm of two sentences.
  void release(const QString& code, const QString& close, const QString& paused) {
    QFile file(own_.filePath("relucent_" + code + ".ts"));
    QVERIFY(file.open(QIODevice::WriteOnly));
    QString text = QString::fromLatin1(
        R"(<?xml version="1.0" encoding="utf-8"?><!DOCTYPE TS><TS version="2.1" language="CODE">
<context><name>relucent::gui::FailureDialog</name><message><source>Close</source>
<translation>CLOSE</translation></message></context>
<context><name>relucent::gui::AcquirePage</name><message><source>Paused, %1</source>
<translation>PAUSED</translation></message></context></TS>)");
    file.write(text.replace("CODE", code).replace("CLOSE", close).replace("PAUSED", paused).toUtf8());
    file.close();
    QVERIFY(runs(RELUCENT_LRELEASE, {"-silent", file.fileName()}));
  }

 private slots:
  void initTestCase() {
    QString all = own_.filePath("all.ts");
    QVERIFY(runs(
        RELUCENT_LUPDATE,
        {RELUCENT_SOURCE "/core", RELUCENT_SOURCE "/gui", "-locations", "none", "-silent",
         "-tr-function-alias",
         "QT_TRANSLATE_NOOP+=RELUCENT_MESSAGE,QT_TRANSLATE_N_NOOP+=RELUCENT_PLURAL_MESSAGE", "-ts", all}));
    sources_ = sentencesOf(all);
    QVERIFY(sources_.size() > 500);
    qInfo("%d sentences are to be translated", static_cast<int>(sources_.size()));
  }

  /// lupdate files some sentences of free functions without their namespace, where the program never looks.
  void everyContextIsOneThatTheProgramAsksFor() {
    QRegularExpression asked("(?:Q_DECLARE_TR_FUNCTIONS\\(|translate\\(\\s*\")(\\w+)");
    QSet<QString> known;
    QDirIterator files(RELUCENT_SOURCE "/gui", {"*.h", "*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
    while (files.hasNext()) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      auto matches = asked.globalMatch(QString::fromUtf8(file.readAll()));
      while (matches.hasNext()) known.insert(matches.next().captured(1));
    }
    for (const TranslatedSentence& sentence : sources_)
      QVERIFY2(sentence.context.startsWith("relucent::") || known.contains(sentence.context) ||
                   isMessage(sentence),
               qPrintable(sentence.context + ": " + sentence.source));
  }

  /// Messages are told apart by their ids: one pattern each.
  void everyMessageHasAnIdOfItsOwn() {
    QMap<QString, QString> patterns;
    for (const TranslatedSentence& sentence : sources_) {
      if (!isMessage(sentence)) continue;
      QVERIFY2(patterns.value(sentence.context, sentence.source) == sentence.source,
               qPrintable(sentence.context));
      patterns[sentence.context] = sentence.source;
    }
    QVERIFY2(patterns.size() > 250, qPrintable(QString::number(patterns.size())));
  }

  /// What core says is in the user's language, with numbers by the locale and words by the number.
  void messagesOfCoreAreTranslated() {
    Language language("de");
    try {
      readFile("/nowhere/at-all");
      QFAIL("there is no such file");
    } catch (const Error& error) {
      QVERIFY2(fullSentence(error.summary()).startsWith("Kann nicht ge"),
               qPrintable(fullSentence(error.summary())));
    }
    CheckVerdict changes;
    changes.finding = Finding::whiteChanges;
    changes.share = 0.123;
    changes.frame = 0.02;
    const QString white = text(messageOf(changes));
    QVERIFY2(white.contains(QString::fromUtf8("12,3\u202F%")) &&
                 white.contains(QString::fromUtf8("20,00\u202Fms")),
             qPrintable(white));
    auto late = [](int count) {
      CheckVerdict verdict;
      verdict.finding = Finding::picturesLate;
      verdict.count = count;
      return text(messageOf(verdict));
    };
    QVERIFY2(late(1) != late(2).replace('2', '1') && late(1234).contains(QString::fromUtf8("1\u202F234")),
             qPrintable(late(1) + late(2) + late(1234)));
  }

  void everyLanguageIsComplete_data() {
    QTest::addColumn<QString>("file");
    for (const QString& file : files())
      if (codeOf(file) != "en") QTest::newRow(qPrintable(codeOf(file))) << file;
    if (files().size() < 2) QTest::newRow("none") << QString();
  }
  void everyLanguageIsComplete() {
    QFETCH(QString, file);
    if (file.isEmpty())
      QSKIP("there is no language but English: none of translations/relucent_LANGUAGE.ts, see its README");
    QStringList faults = faultsOf(sentencesOf(folder + '/' + file), sources_);
    QVERIFY2(faults.isEmpty(), qPrintable(QString("%1 faults, among them\n").arg(faults.size()) +
                                          faults.mid(0, 20).join('\n')));
  }

  void englishHasAllPlurals() {
    QList<TranslatedSentence> plurals;
    for (const TranslatedSentence& source : sources_)
      if (source.numerus) plurals.append(source);
    QVERIFY(!plurals.isEmpty());
    QCOMPARE(faultsOf(sentencesOf(folder + "/relucent_en.ts"), plurals), QStringList());
  }

  void faultsAreFound_data() {
    QTest::addColumn<QString>("source");
    QTest::addColumn<QStringList>("forms");
    QTest::addColumn<bool>("finished");
    QTest::addColumn<int>("faults");
    QTest::newRow("good") << "%1 of %2" << QStringList{"%2, davon %1"} << true << 0;
    QTest::newRow("unfinished") << "Close" << QStringList{"Zu"} << false << 1;
    QTest::newRow("empty") << "Close" << QStringList{" "} << true << 1;
    QTest::newRow("nothing") << "Close" << QStringList{} << true << 1;
    QTest::newRow("lost placeholder") << "%1 of %2" << QStringList{"%1"} << true << 1;
    QTest::newRow("twice the same") << "%1 of %2" << QStringList{"%1 %1"} << true << 1;
    QTest::newRow("core's placeholder") << "Reading {}" << QStringList{"Lesen"} << true << 1;
    QTest::newRow("core's in another order")
        << "{} sees {}" << QStringList{"{1} wird von {0} gesehen"} << true << 0;
    QTest::newRow("core's twice the same") << "{} sees {}" << QStringList{"{0} sieht {0}"} << true << 1;
    QTest::newRow("core's half in order") << "{} sees {}" << QStringList{"{0} sieht {}"} << true << 1;
    QTest::newRow("core's from one") << "{} sees {}" << QStringList{"{1} sieht {2}"} << true << 1;
    QTest::newRow("accelerator") << "&Open" << QStringList{"Öffnen"} << true << 1;
    QTest::newRow("accelerator in brackets") << "&Open" << QStringList{"開く(&O)"} << true << 0;
    QTest::newRow("an ampersand is none") << "Black && white" << QStringList{"Schwarz und weiß"} << true << 0;
    QTest::newRow("file pattern") << "Films (*.mp4)" << QStringList{"Filme"} << true << 1;
    QTest::newRow("one in words") << "%n item(s)" << QStringList{"ein Ding", "%n Dinge"} << true << 0;
    QTest::newRow("message: one in words")
        << "{} files of {}" << QStringList{"eine Datei von {1}", "{0} Dateien von {1}"} << true << 0;
    QTest::newRow("message: many without number")
        << "{} files of {}" << QStringList{"eine Datei von {1}", "Dateien von {1}"} << true << 1;
    QTest::newRow("message: one twice")
        << "{} files of {}" << QStringList{"{1} Datei von {1}", "{0} Dateien von {1}"} << true << 1;
    QTest::newRow("many without number") << "%n item(s)" << QStringList{"%n Ding", "Dinge"} << true << 1;
  }
  void faultsAreFound() {
    QFETCH(QString, source);
    QFETCH(QStringList, forms);
    QFETCH(bool, finished);
    QFETCH(int, faults);
    TranslatedSentence one = sentence(source, forms, finished);
    QCOMPARE(faultsOf(one).size(), faults);
    QCOMPARE(faultsOf({one}, {one}).size(), faults);
    QCOMPARE(faultsOf({}, {one}).size(), 1);
  }

  void aChosenLanguageIsSpoken() {
    release("de", "Schließen", "Angehalten, %1");
    release("ar", "إغلاق", "%1");
    release("zh_CN", "关闭", "%1");
    auto close = [] { return QCoreApplication::translate("relucent::gui::FailureDialog", "Close"); };
    Language language("de", own_.path());
    QCOMPARE(language.available(), QStringList({"ar", "de", "zh_CN"}));
    QCOMPARE(close(), QString::fromUtf8("Schließen"));
    QCOMPARE(QCoreApplication::translate("relucent::gui::AcquirePage", "Paused, %1").arg(1), "Angehalten, 1");
    QCOMPARE(language.spoken(), "de");
    QCOMPARE(QLocale().decimalPoint(), ",");
    QVERIFY(QGuiApplication::layoutDirection() == Qt::LeftToRight);
    language.choose("ar");
    QCOMPARE(close(), QString::fromUtf8("إغلاق"));
    QVERIFY(QGuiApplication::layoutDirection() == Qt::RightToLeft);
    language.choose("zh_CN");
    QCOMPARE(language.spoken(), "zh_CN");
    QCOMPARE(close(), QString::fromUtf8("关闭"));
    QVERIFY(QGuiApplication::layoutDirection() == Qt::LeftToRight);
    language.choose("sw");  // there is none
    QCOMPARE(language.spoken(), "en");
    QCOMPARE(close(), "Close");
  }

  /// Numbers come from QLocale, from tr() and from QString: all of them with the same digits.
  void numbersHaveTheSameDigits_data() {
    QTest::addColumn<QString>("code");
    for (const QString& file : files()) QTest::newRow(qPrintable(codeOf(file))) << codeOf(file);
    for (const char* code : {"ar_EG", "fa_IR", "ne_NP"}) QTest::newRow(code) << QString(code);
  }
  void numbersHaveTheSameDigits() {
    QFETCH(QString, code);
    Language language(code);
    QTime noon(12, 34);
    for (const QString& text :
         {numberText(1234.5), numberText(7.9e-4), decimalText(-6.78, 2), percentText(0.123), countText(9012),
          bytesText(345000000), exposureText(0.6), QLocale().toString(789), QLocale().toString(0.125, 'f', 3),
          QLocale().toString(noon, QLocale::ShortFormat),
          QLocale().toString(QDateTime(QDate(2026, 11, 21), noon), QLocale::ShortFormat)})
      for (QChar letter : text)
        QVERIFY2(!letter.isDigit() || (letter >= '0' && letter <= '9'), qPrintable(text));
  }

  void qtSpeaksTheSame() {
    if (!QFile::exists(QLibraryInfo::path(QLibraryInfo::TranslationsPath) + "/qtbase_de.qm"))
      QSKIP("Qt's own translations are not installed (qt6-translations-l10n)");
    release("de", "Schließen", "Angehalten, %1");
    Language language("de", own_.path());
    QCOMPARE(QCoreApplication::translate("QPlatformTheme", "Cancel"), "Abbrechen");
  }

  void withoutALanguageItIsEnglish() {
    QVERIFY(Language("en").available().contains("en"));
    Language language("de", own_.filePath("nowhere"));
    QCOMPARE(language.available(), QStringList());
    QCOMPARE(language.spoken(), "en");
  }
};

QTEST_MAIN(TestTranslations)
#include "test_translations.moc"
