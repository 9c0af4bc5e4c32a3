// SPDX-License-Identifier: MIT
#include "jobs/core_sentences.h"

#include <QDirIterator>
#include <QHash>
#include <QRegularExpression>
#include <QTranslator>
#include <QtTest>
#include <algorithm>

#include "base/error.h"
#include "jobs/failure.h"
#include "jobs/local_digits.h"
#include "jobs/quantities.h"
#include "jobs/sentence_table.h"

using namespace relucent;

namespace {

/// What a gap holds where that is words of core's own.
const QHash<QString, QStringList> spelledOut{
    {"cannot {} ({})",
     {"cannot open ({})", "cannot read ({})", "cannot write ({})", "cannot create the folder ({})"}},
    {"the command {}{}",
     {"the command failed with status {}", "the command failed with status {}, saying \"{}\"",
      "the command was killed by signal {}", "the command was killed by signal {}, saying \"{}\""}},
    {"the command took longer than {} s{}",
     {"the command took longer than {} s", "the command took longer than {} s, saying \"{}\""}},
    {"the command ended well but {}, not {}",
     {"the command ended well but wrote nothing, not {}", "the command ended well but wrote {}, not {}"}},
    {"the light of the room became {}",
     {"the light of the room became brighter", "the light of the room became darker"}},
    {"{} safe",
     {"every photograph before the light transport is safe",
      "every photograph up to the check before is safe"}},
    {"two halves of a picture are {} % {} than the whole",
     {"two halves of a picture are {} % brighter than the whole",
      "two halves of a picture are {} % darker than the whole"}},
    {"the video device's automatic {} cannot be switched off",
     {"the video device's automatic exposure cannot be switched off",
      "the video device's automatic white balance cannot be switched off",
      "the video device's automatic focus cannot be switched off"}},
};

/// Where the text goes on behind the bracket that opens before `at`; past strings with brackets in them.
qsizetype closedAt(const QString& source, qsizetype at) {
  int depth = 1;
  bool quoted = false;
  for (; at < source.size() && depth > 0; ++at) {
    QChar letter = source[at];
    if (quoted && letter == '\\')
      ++at;
    else if (letter == '"')
      quoted = !quoted;
    else if (!quoted)
      depth += QString("({").contains(letter) ? 1 : QString(")}").contains(letter) ? -1 : 0;
  }
  return at - 1;
}

/// The arguments of a call, the text between its brackets given.
QStringList argumentsOf(const QString& call) {
  QStringList arguments;
  qsizetype begin = 0;
  bool quoted = false;
  for (qsizetype at = 0; at < call.size(); ++at) {
    QChar letter = call[at];
    if (letter == '"') quoted = !quoted;
    if (quoted && letter == '\\') ++at;
    if (quoted) continue;
    if (QString("({").contains(letter)) at = closedAt(call, at + 1);
    if (letter != ',') continue;
    arguments << call.mid(begin, at - begin);
    begin = at + 1;
  }
  return arguments << call.mid(begin);
}

/// One with what is written in it as formats, "{:.1f}", and as code, "\"".
QString unformatted(QString format) {
  static const QRegularExpression gap("\\{[^{}]*\\}");
  return format.replace("{{", "<").replace("}}", ">").replace(gap, "{}").replace('<', '{').replace('>', '}');
}

/// The sentences of an argument: one, none, several to choose from, or parts put together with `+`.
QStringList sentencesOf(QString argument) {
  static const QRegularExpression seam("\"\\s+\"");
  static const QRegularExpression literal("(\\+\\s*)?\"((?:[^\"\\\\]|\\\\.)*)\"(\\s*\\+)?");
  argument.replace(seam, "");
  QString text = argument;
  const QString format = "fmt::format(";
  qsizetype end = 0;
  QStringList sentences;
  auto add = [&](const QRegularExpressionMatch& match, bool isFormat) {
    QString sentence = match.captured(2).replace("\\\"", "\"");
    if (isFormat) sentence = unformatted(sentence);
    sentences << (match.captured(1).isEmpty() ? "" : "{}") + sentence +
                     (match.captured(3).isEmpty() ? "" : "{}");
  };
  for (;;) {
    QRegularExpressionMatch next = literal.match(argument, end);
    if (!next.hasMatch()) return sentences;
    qsizetype call = argument.indexOf(format, end);
    bool isFormat = call >= 0 && call < next.capturedStart();
    add(next, isFormat);
    end = isFormat ? closedAt(argument, call + format.size()) : next.capturedEnd();
  }
}

/// What a source has for people of failures of devices and disks, and of alarms.
QStringList sentencesIn(const QString& source) {
  static const QRegularExpression call(
      "(?:\\b(?:Error|ScreenNotSeen)\\(\\s*(?=ErrorKind::(?:device|disk))|\\balarm\\((?=AlarmKind::)|\\{(?="
      "AlarmKind::)|"
      "\\b(?:CameraLost|refuse)\\((?=\\s*(?:\"|fmt::)))");
  QStringList sentences;
  for (const QRegularExpressionMatch& match : call.globalMatch(source)) {
    qsizetype begin = match.capturedEnd();
    QStringList arguments = argumentsOf(source.mid(begin, closedAt(source, begin) - begin));
    // The kind comes first, the place last.
    bool hasKind = arguments.first().contains("Kind::");
    bool isFinding = match.captured().startsWith('{');
    for (const QString& argument : arguments.mid(hasKind ? 1 : 0, isFinding ? 3 : 2))
      sentences << sentencesOf(argument);
  }
  static const QRegularExpression returned("return (\"[a-z][^\"]* [^\"]*\");");
  if (source.contains("adviceFor(int code) {") || source.contains("reasonOf(ArvBufferStatus"))
    for (const QRegularExpressionMatch& match : returned.globalMatch(source))
      sentences << sentencesOf(match.captured(1));
  return sentences;
}

/// What a source has for people of cameras: remarks, and why this build does not know their kind.
QStringList remarksIn(const QString& source) {
  static const QRegularExpression call("\\bremarks\\.(?:push_back|emplace_back)\\(|\\bwish\\((?=\")");
  static const QRegularExpression lacking("\"[^\"]*: this build lacks [^?]*?(?=\\})");
  QStringList sentences;
  for (const QRegularExpressionMatch& match : call.globalMatch(source)) {
    qsizetype begin = match.capturedEnd();
    QString arguments = source.mid(begin, closedAt(source, begin) - begin);
    // A wish names settings before it.
    sentences << sentencesOf(match.captured() == "wish(" ? argumentsOf(arguments).last() : arguments);
  }
  for (const QRegularExpressionMatch& match : lacking.globalMatch(source))
    sentences << sentencesOf(match.captured());
  return sentences;
}

/// What a source has for people of what was found while measuring: "device: what; advice." by its parts.
QStringList findingsIn(const QString& source) {
  static const QRegularExpression call(
      "\\bfindings\\.(?:push_back|emplace_back)\\(|\\bfinding = (?=fmt::format\\()");
  QStringList sentences;
  for (const QRegularExpressionMatch& match : call.globalMatch(source)) {
    const qsizetype begin = match.capturedEnd();
    const qsizetype end =
        match.captured().endsWith('(') ? closedAt(source, begin) : source.indexOf(";\n", begin);
    for (QString sentence : sentencesOf(source.mid(begin, end - begin))) {
      if (sentence.startsWith("{}: ")) sentence.remove(0, 4);
      if (sentence.endsWith('.')) sentence.chop(1);
      sentences << sentence.split("; ");
    }
  }
  return sentences;
}

/// The table's sentences that a source fills numbers into with a format of their own, "{:.1f}", and where.
QList<std::pair<QString, QList<bool>>> formattedIn(QString source) {
  static const QRegularExpression seam("\"\\s+\"");
  static const QRegularExpression literal("\"((?:[^\"\\\\]|\\\\.)*\\{:(?:[^\"\\\\]|\\\\.)*)\"");
  static const QRegularExpression gap("\\{[^{}]*\\}");
  QList<std::pair<QString, QList<bool>>> found;
  for (const QRegularExpressionMatch& match : literal.globalMatch(source.replace(seam, ""))) {
    QList<bool> formatted;
    for (const QRegularExpressionMatch& one : gap.globalMatch(match.captured(1)))
      formatted << one.captured().startsWith("{:");
    found.append({unformatted(match.captured(1)), formatted});
  }
  return found;
}

/// Speaks loudly; some sentences in another order.
class Shouting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char*, int) const override {
    if (qstrcmp(context, "Core") != 0) return {};
    if (qstrcmp(text, "the camera sees {}, not {}") == 0) return "NOT {1} BUT {0}";
    if (qstrcmp(text, "{}.") == 0) return "{}!";
    return QString::fromLatin1(text).toUpper();
  }
};

bool isKnown(const QString& sentence) {
  std::span<const char* const> known = knownCoreSentences();
  return std::any_of(known.begin(), known.end(), [&](const char* one) { return sentence == one; });
}

}  // namespace

class TestCoreSentences : public QObject {
  Q_OBJECT

 private slots:
  void everyFailureAndAlarmIsInTheTable_data() {
    QTest::addColumn<QString>("folder");
    QTest::addColumn<int>("least");
    QTest::newRow("importing") << "core/importing" << 4;
    QTest::newRow("sentinels") << "core/sentinels" << 14;
    QTest::newRow("base") << "core/base" << 5;
    QTest::newRow("calibration") << "core/calibration" << 8;
    QTest::newRow("devices") << "core/devices" << 100;
    QTest::newRow("linearization") << "core/linearization" << 2;
    QTest::newRow("pipeline") << "core/pipeline" << 2;
    QTest::newRow("content") << "gui/content" << 6;
    QTest::newRow("handover") << "gui/handover" << 2;
    QTest::newRow("output") << "gui/output" << 9;
    QTest::newRow("views") << "gui/views" << 2;
  }
  void everyFailureAndAlarmIsInTheTable() {
    QFETCH(QString, folder);
    QFETCH(int, least);
    int found = 0;
    for (QDirIterator files(QString(RELUCENT_SOURCE "/") + folder, {"*.h", "*.cpp"}, QDir::Files,
                            QDirIterator::Subdirectories);
         files.hasNext();) {
      QFile file(files.next());
      if (file.fileName().endsWith("pipeline/import.cpp")) continue;  // a command's alone
      QVERIFY(file.open(QIODevice::ReadOnly));
      for (const QString& sentence : sentencesIn(QString::fromUtf8(file.readAll())))
        for (const QString& each : spelledOut.value(sentence, {sentence})) {
          ++found;
          QVERIFY2(isKnown(each), qPrintable(QString("'%1' of %2 is not in gui/jobs/core_sentence_list.cpp")
                                                 .arg(each, file.fileName())));
        }
    }
    QVERIFY2(found >= least, qPrintable(QString::number(found)));
    qInfo("%d sentences", found);
  }

  void everyRemarkOnACameraIsInTheTable() {
    int found = 0;
    for (QDirIterator files(RELUCENT_SOURCE "/core/devices", {"*.cpp"}, QDir::Files); files.hasNext();) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      for (const QString& remark : remarksIn(QString::fromUtf8(file.readAll()))) {
        ++found;
        QVERIFY2(isKnown(remark), qPrintable(QString("'%1' of %2 is not in gui/jobs/core_sentence_list.cpp")
                                                 .arg(remark, file.fileName())));
      }
    }
    QVERIFY2(found >= 17, qPrintable(QString::number(found)));
  }

  void everyFindingIsInTheTable_data() {
    QTest::addColumn<QString>("folder");
    QTest::addColumn<int>("least");
    QTest::newRow("linearization") << "linearization" << 15;
    QTest::newRow("acquisition") << "acquisition" << 4;
    QTest::newRow("importing") << "importing" << 5;
    QTest::newRow("pipeline") << "pipeline" << 3;
  }
  void everyFindingIsInTheTable() {
    QFETCH(QString, folder);
    QFETCH(int, least);
    int found = 0;
    for (QDirIterator files(RELUCENT_SOURCE "/core/" + folder, {"*.cpp"}, QDir::Files); files.hasNext();) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      for (const QString& finding : findingsIn(QString::fromUtf8(file.readAll())))
        for (const QString& each : spelledOut.value(finding, {finding})) {
          ++found;
          QVERIFY2(isKnown(each), qPrintable(QString("'%1' of %2 is not in gui/jobs/core_sentence_list.cpp")
                                                 .arg(each, file.fileName())));
        }
    }
    QVERIFY2(found >= least, qPrintable(QString::number(found)));
  }

  /// What core rounds is measured, not a name.
  void everyRoundedNumberIsAQuantity() {
    int found = 0;
    for (QDirIterator files(RELUCENT_SOURCE "/core", {"*.cpp"}, QDir::Files, QDirIterator::Subdirectories);
         files.hasNext();) {
      QFile file(files.next());
      QVERIFY(file.open(QIODevice::ReadOnly));
      for (const auto& [sentence, formatted] : formattedIn(QString::fromUtf8(file.readAll()))) {
        if (!isKnown(sentence)) continue;
        QList<bool> quantities = quantitiesIn(sentence);
        QCOMPARE(quantities.size(), formatted.size());
        for (qsizetype i = 0; i < quantities.size(); ++i) {
          found += formatted[i];
          QVERIFY2(!formatted[i] || quantities[i], qPrintable(sentence));
        }
      }
    }
    QVERIFY2(found >= 15, qPrintable(QString::number(found)));
  }

  void quantitiesAreTheLocales_data() {
    QTest::addColumn<QString>("english");
    QTest::addColumn<QString>("german");
    auto row = [](const char* name, const char* english, const char* german) {
      QTest::newRow(name) << QString(english) << QString::fromUtf8(german).replace('_', QChar(0x202F));
    };
    row("share", "4.5 % of the view of camera 2 look different than before",
        "4,5_% of the view of camera 2 look different than before");
    row("thousands", "a file of the calibration's inverse has 1234567 bytes instead of 23456",
        "a file of the calibration's inverse has 1_234_567 bytes instead of 23_456");
    row("one of several", "a photograph of 1024x768 pixels as Mono12 came with 1048576 of 1572864 bytes",
        "a photograph of 1024x768 pixels as Mono12 came with 1_048_576 of 1_572_864 bytes");
    row("pair",
        "a camera or projector has moved: the view of camera 1 is shifted by -1.5, 2.3 pixels and turned by "
        "0.12 degrees",
        "a camera or projector has moved: the view of camera 1 is shifted by -1,5, 2,3 pixels and turned by "
        "0,12 degrees");
    row("three digits", "the camera was asked to expose 0.06667 s and keeps to 0.03333 s",
        "the camera was asked to expose 0,0667_s and keeps to 0,0333_s");
    row("range", "the camera claims exposures of 2.5e-05 to 1.25 s",
        "the camera claims exposures of 2,5 × 10⁻⁵ to 1,25_s");
    row("gain", "the camera can do 0 to 23.5", "the camera can do 0 to 23,5");
    row("remark", "was asked for a gain of 12.5 and keeps to 11.75",
        "was asked for a gain of 12,5 and keeps to 11,8");
    row("memory", "the graphics card reaches 1024 MB at once where 2500 MB are needed",
        "the graphics card reaches 1_024_MB at once where 2_500_MB are needed");
    row("in a sentence within", "3 attempts at a photograph failed: no photograph came within 2.5 s",
        "3 attempts at a photograph failed: no photograph came within 2,5_s");
    row("size", "the projector's screen has 1920x1080 pixels now and 1024x768 were calibrated",
        "the projector's screen has 1920x1080 pixels now and 1024x768 were calibrated");
    row("serial number", "no GenICam camera '40012345' answers", "no GenICam camera '40012345' answers");
    row("address", "no GenICam camera '192.168.0.12' answers", "no GenICam camera '192.168.0.12' answers");
    row("port", "name one by its port: gphoto2:1.5 or gphoto2:2.5",
        "name one by its port: gphoto2:1.5 or gphoto2:2.5");
    row("file", "the command ended well but wrote 2024.5, not 2025.5",
        "the command ended well but wrote 2024.5, not 2025.5");
    row("folder", "/tmp/1.5: cannot write (No space left on device 2.5)",
        "/tmp/1.5: cannot write (No space left on device 2.5)");
    row("sensitivity", "ISO 12800 is wanted and the camera does not have it",
        "ISO 12800 is wanted and the camera does not have it");
    row("sensitivity that stays", "was asked for ISO 12800 and keeps to ISO 6400",
        "was asked for ISO 12800 and keeps to ISO 6400");
    row("status", "the command failed with status 1234", "the command failed with status 1234");
    row("code", "the camera refuses (1234: 5.5)", "the camera refuses (1234: 5.5)");
    row("script", "run it in a terminal to find out why: 1.5", "run it in a terminal to find out why: 1.5");
    row("model", "no camera of this name is plugged in, but 1.5",
        "no camera of this name is plugged in, but 1.5");
    row("no number", "no photograph came within 1.5.2 s", "no photograph came within 1.5.2_s");
    row("of nobody's", "the cat weighs 4.5 kg", "the cat weighs 4.5 kg");
  }
  void quantitiesAreTheLocales() {
    QFETCH(QString, english);
    QFETCH(QString, german);
    QLocale::setDefault(QLocale(QLocale::German));
    QString text = coreSentence(english.toStdString());
    QLocale::setDefault(QLocale::c());
    QCOMPARE(text, german);
  }

  void sentencesAreTranslatedAndFilledIn_data() {
    QTest::addColumn<QString>("english");
    QTest::addColumn<QString>("text");
    auto row = [](const char* name, const char* english, const char* text) {
      QTest::newRow(name) << QString(english) << QString::fromUtf8(text);
    };
    row("plain", "the camera stays busy", "THE CAMERA STAYS BUSY");
    row("numbers", "4.5 % of the view of camera 2 look different than before",
        "4.5\u202F% OF THE VIEW OF CAMERA 2 LOOK DIFFERENT THAN BEFORE");
    row("another order", "the camera sees HDMI-1, not DP-2", "NOT DP-2 BUT HDMI-1");
    row("the system's words", "cannot write (No space left on device)",
        "CANNOT WRITE (No space left on device)");
    row("the plainest of those that fit", "the video device's automatic focus cannot be switched off",
        "THE VIDEO DEVICE'S AUTOMATIC FOCUS CANNOT BE SWITCHED OFF");
    row("a sentence in another", "3 attempts at a photograph failed: no photograph came within 2 s",
        "3 ATTEMPTS AT A PHOTOGRAPH FAILED: NO PHOTOGRAPH CAME WITHIN 2 S");
    row("what a script lacks", "the projector's command does not say {image}",
        "THE PROJECTOR'S COMMAND DOES NOT SAY {image}");
    row("an impossible size", "a camera of 4x3 pixels is impossible: each side is 8 to 8192",
        "A CAMERA OF 4X3 PIXELS IS IMPOSSIBLE: EACH SIDE IS 8 TO 8192");
    row("a finding about a device",
        "Projector 1: white is 18 % brighter than red, green and blue together; switch off the white segment "
        "(often called brilliant colour or bright mode) and choose a picture mode for video or sRGB",
        "Projector 1: WHITE IS 18\u202F% BRIGHTER THAN RED, GREEN AND BLUE TOGETHER; SWITCH OFF THE WHITE "
        "SEGMENT (OFTEN CALLED BRILLIANT COLOUR OR BRIGHT MODE) AND CHOOSE A PICTURE MODE FOR VIDEO OR SRGB");
    row("an alarm within a finding",
        "put up with before pattern 121: 4.5 % of the view of camera 2 look different than before",
        "PUT UP WITH BEFORE PATTERN 121: 4.5\u202F% OF THE VIEW OF CAMERA 2 LOOK DIFFERENT THAN BEFORE");
    row("advice that goes on", "check its cable and its power, then go on: every photograph so far is kept",
        "CHECK ITS CABLE AND ITS POWER, THEN GO ON: EVERY PHOTOGRAPH SO FAR IS KEPT");
    row("an alarm that nobody heard",
        "put it back to within half a pixel, then retry by resuming the calibration; every photograph up to "
        "the check before is safe",
        "PUT IT BACK TO WITHIN HALF A PIXEL, THEN RETRY BY RESUMING THE CALIBRATION; EVERY PHOTOGRAPH UP TO "
        "THE CHECK BEFORE IS SAFE");
    row("what and advice", "the camera sends no stream; check its cable and its power",
        "THE CAMERA SENDS NO STREAM; CHECK ITS CABLE AND ITS POWER");
    row("of a device", "genicam:left: the camera sends no stream",
        "genicam:left: THE CAMERA SENDS NO STREAM");
    row("of a device with advice", "DP-1: the engine lost its device; start the show again",
        "DP-1: THE ENGINE LOST ITS DEVICE; START THE SHOW AGAIN");
    row("what in brackets",
        "the raw file cannot be read (it is empty) (copy it again, or take the photograph again; a camera "
        "newer than this LibRaw needs DNG files)",
        "THE RAW FILE CANNOT BE READ (IT IS EMPTY) (COPY IT AGAIN, OR TAKE THE PHOTOGRAPH AGAIN; A CAMERA "
        "NEWER THAN THIS LIBRAW NEEDS DNG FILES)");
    row("braces of the user's", "run it in a terminal to find out why: shoot {output} {0}; {}",
        "RUN IT IN A TERMINAL TO FIND OUT WHY: shoot {output} {0}; {}");
    row("half known", "the camera sends no stream; blow on it", "the camera sends no stream; blow on it");
    row("unknown", "the cat sits on the projector", "the cat sits on the projector");
    row("nothing", "", "");
  }
  void sentencesAreTranslatedAndFilledIn() {
    QFETCH(QString, english);
    QFETCH(QString, text);
    QCOMPARE(coreSentence(english.toStdString()).replace(narrowSpace, ' '), english);
    Shouting translator;
    QCoreApplication::installTranslator(&translator);
    QString loud = coreSentence(english.toStdString());
    QCoreApplication::removeTranslator(&translator);
    QCOMPARE(loud, text);
  }

  void everySentenceOfTheTableIsFoundAgain() {
    std::span<const char* const> known = knownCoreSentences();
    SentenceTable table(known);
    for (const char* sentence : known) {
      qsizetype gaps = QString(sentence).count("{}");
      QStringList parts;
      for (qsizetype i = 0; i < gaps; ++i) parts << QString::number(11 * (i + 1));
      auto match = table.find(filledIn(sentence, parts));
      QVERIFY2(match, sentence);
      QCOMPARE(QString(match->sentence), QString(sentence));
      QCOMPARE(match->parts, parts);
    }
  }

  /// A quoted script has very many places where two sentences could be joined.
  void longTextsTakeNoTime() {
    QString script = "run it in a terminal to find out why: ";
    for (int i = 0; i < 60; ++i) script += "echo: a (b); ";
    QCOMPARE(coreSentence(script.toStdString()), script);
  }

  void failuresAreWholeSentencesOfTheLanguage() {
    Shouting translator;
    QCoreApplication::installTranslator(&translator);
    Failure known = failureOf(std::make_exception_ptr(
        Error(ErrorKind::device, "the camera sends no stream", "check its cable and its power", "left")));
    Failure unknown =
        failureOf(std::make_exception_ptr(Error(ErrorKind::input, "there is a cat", "feed it.")));
    QCoreApplication::removeTranslator(&translator);
    QCOMPARE(known.what, "THE CAMERA SENDS NO STREAM!");
    QCOMPARE(known.advice, "CHECK ITS CABLE AND ITS POWER!");
    QCOMPARE(known.details,
             "device: left: the camera sends no stream; check its cable and its power.");  // for who helps
    QCOMPARE(unknown.what, "There is a cat.");
    QCOMPARE(unknown.advice, "Feed it.");
  }
};

QTEST_GUILESS_MAIN(TestCoreSentences)
#include "test_core_sentences.moc"
