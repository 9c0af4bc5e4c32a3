// SPDX-License-Identifier: MIT
#include "text/message_text.h"

#include <QTranslator>
#include <QtTest>

#include "jobs/failure.h"
#include "relucent/base/error.h"
#include "text/local_digits.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

/// Speaks loudly; some sentences in another order. Has two forms for a number, as English.
class Shouting : public QTranslator {
 public:
  bool isEmpty() const override { return false; }
  QString translate(const char*, const char* pattern, const char* singular, int number) const override {
    if (qstrcmp(pattern, "the camera sees {}, not {}") == 0) return "NOT {1} BUT {0}";
    if (qstrcmp(pattern, "{}.") == 0) return "{}!";
    return QString::fromUtf8(number == 1 ? singular : pattern).toUpper();
  }
};

/// While it lives.
class Spoken {
 public:
  Spoken() { QCoreApplication::installTranslator(&translator_); }
  ~Spoken() { QCoreApplication::removeTranslator(&translator_); }

 private:
  Shouting translator_;
};

Message sees(const char* one, const char* other) {
  return RELUCENT_ENGLISH_MESSAGE("test.sees", "the camera sees {}, not {}").with(one, other);
}

Message changes(double share) {
  return RELUCENT_ENGLISH_MESSAGE("test.changes", "{} % of the view of camera {} look different from before")
      .with(as::share(share, as::decimals(1)), as::label(2));
}

Message patterns(int count) {
  return RELUCENT_ENGLISH_PLURAL_MESSAGE("test.patterns", "level {} of {}: {} patterns",
                                         "level {} of {}: {} pattern")
      .with(as::label(3), as::label(8), count);
}

QString withNarrow(const char* text) {
  return QString::fromUtf8(text).replace('_', narrowSpace);
}

}  // namespace

Q_DECLARE_METATYPE(relucent::Message)

class TestMessageText : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QLocale::setDefault(QLocale::c()); }

  void numbersAreTheLocales_data() {
    QTest::addColumn<Message>("message");
    QTest::addColumn<QString>("german");
    auto row = [](const char* name, const Message& message, const char* german) {
      QTest::newRow(name) << message << withNarrow(german);
    };
    row("share", changes(0.045), "4,5_% of the view of camera 2 look different from before");
    row("bytes",
        RELUCENT_ENGLISH_MESSAGE("test.bytes", "a file has {} bytes instead of {}")
            .with(as::bytes(1234567), as::bytes(23456)),
        "a file has 1_234_567 bytes instead of 23_456");
    row("count", RELUCENT_ENGLISH_MESSAGE("test.count", "{} patterns").with(4711), "4_711 patterns");
    row("pair",
        RELUCENT_ENGLISH_MESSAGE("test.pair", "shifted by {}, {} pixels and turned by {} degrees")
            .with(as::pixels(-1.5, as::decimals(1)), as::pixels(2.3, as::decimals(1)),
                  as::degrees(0.12, as::decimals(2))),
        "shifted by -1,5, 2,3 pixels and turned by 0,12 degrees");
    row("three digits",
        RELUCENT_ENGLISH_MESSAGE("test.exposure", "asked to expose {} s and keeps to {} s")
            .with(as::seconds(1.0 / 15, as::digits(4)), as::seconds(1.0 / 30, as::digits(4))),
        "asked to expose 0,0667_s and keeps to 0,0333_s");
    row("range",
        RELUCENT_ENGLISH_MESSAGE("test.range", "exposures of {} to {} s")
            .with(as::seconds(2.5e-5, as::digits(4)), as::seconds(1.25, as::digits(4))),
        "exposures of 2,5 × 10⁻⁵ to 1,25_s");
    row("gain", RELUCENT_ENGLISH_MESSAGE("test.gain", "choose a gain from {} to {}").with(0.0, 23.5),
        "choose a gain from 0 to 23,5");
    row("milliseconds",
        RELUCENT_ENGLISH_MESSAGE("test.frame", "multiples of {} ms")
            .with(as::milliseconds(0.02, as::decimals(2))),
        "multiples of 20,00_ms");
    row("memory",
        RELUCENT_ENGLISH_MESSAGE("test.memory", "reaches {} MB at once where {} MB are needed")
            .with(as::megabytes(1024 << 20), as::megabytes(std::int64_t{2500} << 20)),
        "reaches 1_024_MB at once where 2_500_MB are needed");
    row("a sentence within",
        RELUCENT_ENGLISH_MESSAGE("test.attempts", "{} attempts failed: {}").with(3, changes(0.025)),
        "3 attempts failed: 2,5_% of the view of camera 2 look different from before");
    row("size", RELUCENT_ENGLISH_MESSAGE("test.size", "it has {} pixels").with(as::size(1920, 1080)),
        "it has 1920x1080 pixels");
    row("label", RELUCENT_ENGLISH_MESSAGE("test.label", "pattern {}").with(as::label(1234)), "pattern 1234");
    row("what looks like a number", RELUCENT_ENGLISH_MESSAGE("test.model", "no camera but {}").with("1.5"),
        "no camera but 1.5");
    row("plain", Message::plain("the cat weighs {} 4.5 kg"), "the cat weighs {} 4.5 kg");
  }
  void numbersAreTheLocales() {
    QFETCH(Message, message);
    QFETCH(QString, german);
    QLocale::setDefault(QLocale(QLocale::German));
    QCOMPARE(text(message), german);
  }

  void messagesAreTranslatedAndFilledIn_data() {
    QTest::addColumn<Message>("message");
    QTest::addColumn<QString>("loud");
    auto row = [](const char* name, const Message& message, const char* loud) {
      QTest::newRow(name) << message << withNarrow(loud);
    };
    row("plain pattern", RELUCENT_ENGLISH_MESSAGE("test.busy", "the camera stays busy"),
        "THE CAMERA STAYS BUSY");
    row("numbers", changes(0.045), "4.5_% OF THE VIEW OF CAMERA 2 LOOK DIFFERENT FROM BEFORE");
    row("another order", sees("HDMI-1", "DP-2"), "NOT DP-2 BUT HDMI-1");
    row("the system's words",
        RELUCENT_ENGLISH_MESSAGE("test.write", "cannot write ({})").with("No space left on device"),
        "CANNOT WRITE (No space left on device)");
    row("a sentence in another", RELUCENT_ENGLISH_MESSAGE("test.failed", "failed: {}").with(sees("a", "b")),
        "FAILED: NOT b BUT a");
    row("braces of the user's",
        RELUCENT_ENGLISH_MESSAGE("test.run", "find out why: {}").with("shoot {output} {0}; {}"),
        "FIND OUT WHY: shoot {output} {0}; {}");
    row("many", patterns(24), "LEVEL 3 OF 8: 24 PATTERNS");
    row("one", patterns(1), "LEVEL 3 OF 8: 1 PATTERN");
    row("in no language", Message::plain("the cat sits on the projector"), "the cat sits on the projector");
    row("none", Message(), "");
  }
  void messagesAreTranslatedAndFilledIn() {
    QFETCH(Message, message);
    QFETCH(QString, loud);
    QString english = QString::fromStdString(relucent::english(message));
    QCOMPARE(text(message).replace(narrowSpace, ' '), english);
    Spoken loudly;
    QCOMPARE(text(message), loud);
  }

  void sentencesAreWhole() {
    QCOMPARE(fullSentence(sees("a", "b")), "The camera sees a, not b.");
    for (const char* end : {".", "?", "!"})
      QCOMPARE(fullSentence(Message::plain(std::string("it is so") + end)), QString("It is so") + end);
    QCOMPARE(fullSentence(Message::plain("{} is so")), "{} is so.");
    QCOMPARE(fullSentence(Message::plain("genicam:RL01: it is off")), "genicam:RL01: it is off.");
    QCOMPARE(fullSentence(Message()), QString());
    Spoken loudly;
    QCOMPARE(fullSentence(patterns(1)), "LEVEL 3 OF 8: 1 PATTERN!");
    QCOMPARE(fullSentence(Message::plain("it is so")), "It is so.");
  }

  void failuresAreWholeSentencesOfTheLanguage() {
    Spoken loudly;
    Failure failure = failureOf(std::make_exception_ptr(
        Error(ErrorKind::device, RELUCENT_ENGLISH_MESSAGE("test.stream", "the camera sends no stream"),
              RELUCENT_ENGLISH_MESSAGE("test.cable", "check its cable and its power"), "left")));
    QCOMPARE(failure.what, "THE CAMERA SENDS NO STREAM!");
    QCOMPARE(failure.advice, "CHECK ITS CABLE AND ITS POWER!");
    QCOMPARE(failure.details,
             "device: left: the camera sends no stream; check its cable and its power.");  // for who helps
  }
};

QTEST_GUILESS_MAIN(TestMessageText)
#include "test_message_text.moc"
