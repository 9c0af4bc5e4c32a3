// SPDX-License-Identifier: MIT
#include "relucent/base/message.h"
#include "relucent/calibration/message_json.h"

#include <QtTest>

using namespace relucent;
using namespace relucent::calibration;

namespace {

Message flickers() {
  return RELUCENT_ENGLISH_MESSAGE("test.flickers", "the light flickers by {} %")
      .with(as::share(0.045, as::decimals(1)));
}

}  // namespace

Q_DECLARE_METATYPE(relucent::Message)

class TestMessageJson : public QObject {
  Q_OBJECT

 private slots:
  void writtenAndReadItIsTheSame_data() {
    QTest::addColumn<Message>("message");
    QTest::newRow("no gaps") << Message(RELUCENT_ENGLISH_MESSAGE("test.full", "it is full"));
    QTest::newRow("every kind of argument")
        << RELUCENT_ENGLISH_MESSAGE("test.all", "{} {} {} {} {} {} {} {} {} {} {} {} {} {}")
               .with(3, as::label(4), 1.0 / 3.0, as::seconds(0.1, as::digits(4)), as::milliseconds(0.02),
                     as::pixels(-1.5), as::degrees(0.1), as::bytes(12345), as::megabytes(1 << 20),
                     as::decibels(32.1), as::size(1024, 768), "some {} text", as::file("/tmp/a.exr"),
                     flickers());
    QTest::newRow("plural") << RELUCENT_ENGLISH_PLURAL_MESSAGE("test.files", "{} files", "{} file").with(1);
    QTest::newRow("plain") << Message::plain("simulated projector {1}");
    QTest::newRow("none") << Message();
  }
  void writtenAndReadItIsTheSame() {
    QFETCH(Message, message);
    const Json written = message;
    QVERIFY(Json::parse(written.dump()).get<Message>() == message);
    // A text without an id is the string that earlier versions wrote.
    QCOMPARE(written.is_string(), message.id().empty());
    QCOMPARE((written.is_string() ? written : written.at("english")).get<std::string>(), english(message));
  }

  void theDocumentCanBeReadByOthers() {
    QCOMPARE(Json(flickers()).dump(),
             std::string(
                 R"({"id":"test.flickers","pattern":"the light flickers by {} %",)"
                 R"("arguments":[{"share":0.045,"decimals":1}],"english":"the light flickers by 4.5 %"})"));
  }

  void aStringIsAPlainText() {
    const auto old = Json::parse(R"(["White is 18 % too bright.", "left {}"])").get<std::vector<Message>>();
    QCOMPARE(old.size(), std::size_t{2});
    QVERIFY(old[0] == Message::plain("White is 18 % too bright."));
    QCOMPARE(english(old[1]), std::string("left {}"));
  }

  /// Of a later version, or changed by hand.
  void whatCannotBeFilledInIsItsEnglish_data() {
    QTest::addColumn<QString>("arguments");
    QTest::newRow("another kind") << R"([{"furlongs": 3}])";
    QTest::newRow("too few") << "[]";
    QTest::newRow("too many") << R"([{"count": 3}, {"count": 4}])";
    QTest::newRow("no object") << "[3]";
    QTest::newRow("empty") << "[{}]";
  }
  void whatCannotBeFilledInIsItsEnglish() {
    QFETCH(QString, arguments);
    const Json json = Json::parse(R"({"id": "test.far", "pattern": "it is {} away", "arguments": )" +
                                  arguments.toStdString() + R"(, "english": "it is far away"})");
    QVERIFY(json.get<Message>() == Message::plain("it is far away"));
  }

  /// Of a stranger's file: it is shown with the digits that a number can have.
  void digitsAreThoseOfANumber_data() {
    QTest::addColumn<QString>("argument");
    QTest::addColumn<QString>("shown");
    QTest::newRow("negative decimals") << R"({"share": 0.045, "decimals": -1})"
                                       << "it is 4 away";
    QTest::newRow("no significant digit") << R"({"number": 0.25, "significant": 0})"
                                          << "it is 0.2 away";
    QTest::newRow("negative significant digits") << R"({"number": 0.25, "significant": -2147483648})"
                                                 << "it is 0.2 away";
    QTest::newRow("a billion decimals") << R"({"number": 0.25, "decimals": 1000000000})"
                                        << "it is 0.25000000000000000 away";
  }
  void digitsAreThoseOfANumber() {
    QFETCH(QString, argument);
    QFETCH(QString, shown);
    const Json json = Json::parse(R"({"id": "test.far", "pattern": "it is {} away", "arguments": [)" +
                                  argument.toStdString() + R"(], "english": "it is far away"})");
    QCOMPARE(QString::fromStdString(english(json.get<Message>())), shown);
  }

  void anythingElseIsRefused_data() {
    QTest::addColumn<QString>("json");
    QTest::newRow("number") << "3";
    QTest::newRow("list") << "[]";
    QTest::newRow("nothing of it") << "{}";
    QTest::newRow("wrong type")
        << R"({"id": "a.b", "pattern": "{}", "arguments": [{"count": "three"}], "english": ""})";
  }
  void anythingElseIsRefused() {
    QFETCH(QString, json);
    QVERIFY_THROWS_EXCEPTION(Json::exception, Json::parse(json.toStdString()).get<Message>());
  }
};

QTEST_APPLESS_MAIN(TestMessageJson)
#include "test_message_json.moc"
