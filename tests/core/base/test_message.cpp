// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"

#include <fmt/format.h>

#include <QtTest>
#include <array>

using namespace relucent;

namespace {

static_assert(detail::isMessageId("disk.cannot-open"));
static_assert(detail::isMessageId("stage.algorithm-1"));
static_assert(!detail::isMessageId("disk"));
static_assert(!detail::isMessageId("disk."));
static_assert(!detail::isMessageId("disk..open"));
static_assert(!detail::isMessageId("Disk.open"));
static_assert(!detail::isMessageId("disk.cannot open"));
static_assert(detail::gapsOf("{} of {}: {output}, {0}") == 2);
// As many arguments as gaps, and an id: what does not hold does not compile.
static_assert(std::is_convertible_v<detail::MessagePattern<0>, Message>);
static_assert(!std::is_convertible_v<detail::MessagePattern<1>, Message>);

Message missing(int count) {
  return RELUCENT_ENGLISH_PLURAL_MESSAGE("test.missing", "{} of {} files are missing",
                                         "{} of {} files is missing")
      .with(count, as::label(7));
}

}  // namespace

class TestMessage : public QObject {
  Q_OBJECT

 private slots:
  void englishIsThePatternFilledIn_data() {
    QTest::addColumn<QString>("written");
    QTest::addColumn<QString>("expected");
    auto row = [](const char* name, const Message& message, const char* expected) {
      QTest::newRow(name) << QString::fromStdString(english(message)) << QString(expected);
    };
    row("no gaps", RELUCENT_ENGLISH_MESSAGE("test.full", "it is full"), "it is full");
    row("text", RELUCENT_ENGLISH_MESSAGE("test.open", "cannot open ({})").with("no such file"),
        "cannot open (no such file)");
    row("count", RELUCENT_ENGLISH_MESSAGE("test.count", "{} frames").with(1234567), "1234567 frames");
    row("number", RELUCENT_ENGLISH_MESSAGE("test.number", "not {}").with(0.125), "not 0.125");
    row("seconds",
        RELUCENT_ENGLISH_MESSAGE("test.seconds", "{} s").with(as::seconds(0.066666, as::digits(4))),
        "0.06667 s");
    row("milliseconds",
        RELUCENT_ENGLISH_MESSAGE("test.milliseconds", "{} ms").with(as::milliseconds(0.02, as::decimals(2))),
        "20.00 ms");
    row("share", RELUCENT_ENGLISH_MESSAGE("test.share", "{} %").with(as::share(0.045, as::decimals(1))),
        "4.5 %");
    row("pixels",
        RELUCENT_ENGLISH_MESSAGE("test.pixels", "{} pixels").with(as::pixels(-1.5, as::decimals(1))),
        "-1.5 pixels");
    row("bytes", RELUCENT_ENGLISH_MESSAGE("test.bytes", "{} bytes").with(as::bytes(std::size_t{1048576})),
        "1048576 bytes");
    row("megabytes", RELUCENT_ENGLISH_MESSAGE("test.mb", "{} MB").with(as::megabytes((3 << 20) - 1)), "2 MB");
    row("decibels", RELUCENT_ENGLISH_MESSAGE("test.db", "{} dB").with(as::decibels(32.06, as::decimals(1))),
        "32.1 dB");
    row("size", RELUCENT_ENGLISH_MESSAGE("test.size", "{} pixels").with(as::size(1024, 768)),
        "1024x768 pixels");
    row("file", RELUCENT_ENGLISH_MESSAGE("test.file", "of {}").with(as::file("/tmp/a.exr")), "of /tmp/a.exr");
    row("a message", RELUCENT_ENGLISH_MESSAGE("test.again", "{}, then again").with(missing(2)),
        "2 of 7 files are missing, then again");
    row("one", missing(1), "1 of 7 files is missing");
    row("none", missing(0), "0 of 7 files are missing");
    row("braces that are no gap",
        RELUCENT_ENGLISH_MESSAGE("test.output", "write it to {output}: {}").with("shoot {output} {}"),
        "write it to {output}: shoot {output} {}");
    row("plain", Message::plain("any {} thing {0}"), "any {} thing {0}");
    row("no message", Message(), "");
  }
  void englishIsThePatternFilledIn() {
    QFETCH(QString, written);
    QFETCH(QString, expected);
    QCOMPARE(written, expected);
  }

  void gapsAreFilledInAnyOrder() {
    const std::array<std::string, 2> parts{"left", "right"};
    QCOMPARE(fillGaps("{} and {}", parts), std::string("left and right"));
    QCOMPARE(fillGaps("{1} and {0}", parts), std::string("right and left"));
    QCOMPARE(fillGaps("{2} and {name} {", parts), std::string("{2} and {name} {"));
  }

  void itKnowsWhatItIsMadeOf() {
    const Message message = missing(3);
    QCOMPARE(message.id(), std::string("test.missing"));
    QCOMPARE(message.arguments().size(), std::size_t{2});
    QVERIFY(message.number() == 3);
    QVERIFY(message == missing(3));
    QVERIFY(message != missing(4));
    QVERIFY(Message().empty() && !message.empty() && Message::plain("").empty());
    QCOMPARE(fmt::format("{}", message), english(message));
    QCOMPARE(englishSentence(message), std::string("3 of 7 files are missing."));
    QCOMPARE(englishSentence(Message::plain("so.")), std::string("so."));
  }

  void argumentsMustFitThePattern() {
    QVERIFY_THROWS_EXCEPTION(std::logic_error, Message("test.two", "{} and {}", "", {Argument(1)}));
  }

  void unitsHaveNames() {
    for (Unit unit : {Unit::none, Unit::seconds, Unit::milliseconds, Unit::share, Unit::pixels, Unit::degrees,
                      Unit::bytes, Unit::megabytes, Unit::decibels})
      QVERIFY(unitNamed(toString(unit)) == unit);
    QVERIFY(!unitNamed("furlongs"));
  }
};

QTEST_APPLESS_MAIN(TestMessage)
#include "test_message.moc"
