// SPDX-License-Identifier: MIT
#include <QtTest>

#include "relucent/base/random.h"
#include "relucent/pjlink/address.h"
#include "relucent/pjlink/protocol.h"

using namespace relucent;
using namespace relucent::pjlink;

namespace {

/// All readers, by what the specification's own examples are to them.
struct Reader {
  const char* name;
  const char* good;
  bool (*reads)(std::string_view text);
};
const Reader readers[]{
    {"greeting", "PJLINK 1 498e4a67", [](std::string_view text) { return greetingFrom(text).has_value(); }},
    {"answer", "%1POWR=1", [](std::string_view text) { return answerFrom(text, "POWR").has_value(); }},
    {"power", "3", [](std::string_view text) { return powerFrom(text).has_value(); }},
    {"shutter", "31", [](std::string_view text) { return shutterFrom(text).has_value(); }},
    {"troubles", "010200", [](std::string_view text) { return troublesFrom(text).has_value(); }},
    {"lamps", "1234 1 99999 0", [](std::string_view text) { return lampsFrom(text).has_value(); }},
    {"input", "31", [](std::string_view text) { return inputFrom(text).has_value(); }},
    {"signal", "1920x1080", [](std::string_view text) { return signalFrom(text).has_value(); }},
    {"number", "99999", [](std::string_view text) { return numberFrom(text).has_value(); }},
    {"found", "%2ACKN=01:23:45:67:89:ab\r",
     [](std::string_view text) { return foundFrom(text).has_value(); }},
    {"notice of power", "%2POWR=0\r", isNotice},
    {"notice of errors", "%2ERST=010200\r", isNotice},
    {"notice of the input", "%2INPT=31\r", isNotice},
    {"notice of the link", "%2LKUP=01:23:45:67:89:ab\r", isNotice},
};

/// One to three places changed, taken away, doubled, or cut off.
std::string damaged(std::string text, Random& random) {
  for (std::uint64_t changes = 1 + random.below(3); changes > 0; --changes) {
    const std::uint64_t at = text.empty() ? 0 : random.below(text.size());
    const char byte = static_cast<char>(random.below(256));
    switch (random.below(5)) {
      case 0:
        if (!text.empty()) text[at] = byte;
        break;
      case 1:
        if (!text.empty()) text.erase(at, 1);
        break;
      case 2:
        text.insert(at, 1, byte);
        break;
      case 3:
        text.resize(at);
        break;
      default:
        text += text;
    }
  }
  return text;
}

}  // namespace

class TestPjlinkProtocol : public QObject {
  Q_OBJECT

 private slots:
  /// Any bytes are read or refused, and what is read is within the specification.
  void damagedTextsAreReadOrRefused_data() {
    QTest::addColumn<int>("which");
    for (int i = 0; i < static_cast<int>(std::size(readers)); ++i) QTest::newRow(readers[i].name) << i;
  }
  void damagedTextsAreReadOrRefused() {
    QFETCH(int, which);
    const Reader& reader = readers[which];
    QVERIFY(reader.reads(reader.good));
    Random random{7, static_cast<std::uint64_t>(which)};
    int refused = 0;
    for (int i = 0; i < 5000; ++i) {
      const std::string text = damaged(reader.good, random);
      if (!reader.reads(text)) ++refused;
      if (const auto lamps = lampsFrom(text)) {
        QVERIFY(!lamps->empty() && lamps->size() <= 8);
        for (const Lamp& lamp : *lamps) QVERIFY(lamp.hours >= 0);
      }
      if (const auto signal = signalFrom(text); signal && signal->kind == Signal::Kind::size)
        QVERIFY(signal->size.width > 0 && signal->size.height > 0);
    }
    QVERIFY2(refused > 1000, qPrintable(QString::number(refused)));
    QVERIFY(!reader.reads(""));
  }

  void theSpecificationsExampleOfADigest() {
    QCOMPARE(digestOf("498e4a67", "JBMIAProjectorLink"), std::string("5d8409bc1c3fa39749434aa3a5c38682"));
  }

  void greetings_data() {
    QTest::addColumn<QString>("line");
    QTest::addColumn<int>("kind");  // -1: none
    QTest::newRow("open") << "PJLINK 0" << static_cast<int>(Greeting::Kind::open);
    QTest::newRow("password") << "PJLINK 1 498e4a67" << static_cast<int>(Greeting::Kind::password);
    QTest::newRow("lower case") << "pjlink 1 498e4a67" << static_cast<int>(Greeting::Kind::password);
    QTest::newRow("class 2's") << "PJLINK 2 00112233445566778899aabbccddeeff"
                               << static_cast<int>(Greeting::Kind::newer);
    QTest::newRow("refused") << "PJLINK ERRA" << static_cast<int>(Greeting::Kind::refused);
    QTest::newRow("no challenge") << "PJLINK 1" << -1;
    QTest::newRow("challenge of no digits") << "PJLINK 1 password" << -1;
    QTest::newRow("another protocol") << "HTTP/1.0 400 Bad Request" << -1;
    QTest::newRow("nothing") << "PJLINK " << -1;
  }
  void greetings() {
    QFETCH(QString, line);
    QFETCH(int, kind);
    const auto greeting = greetingFrom(line.toStdString());
    QCOMPARE(greeting ? static_cast<int>(greeting->kind) : -1, kind);
  }

  void requestsAreTheSpecifications() {
    QCOMPARE(requestOf(1, "POWR", "?"), std::string("%1POWR ?\r"));
    QCOMPARE(requestOf(2, "INNM", "?31"), std::string("%2INNM ?31\r"));
  }

  void answers() {
    QCOMPARE(answerFrom("%1POWR=1", "POWR")->value, std::string("1"));
    QCOMPARE(answerFrom("%2powr=1", "POWR")->value, std::string("1"));
    QCOMPARE(answerFrom("%1NAME=", "NAME")->value, std::string());
    QVERIFY(!answerFrom("%1LAMP=1 1", "POWR"));
    QVERIFY(answerFrom("%1POWR=ERR3", "POWR")->refusal == Refusal::unavailable);
    QVERIFY(!answerFrom("%1POWR=ERR5", "POWR")->refusal);
  }

  void values() {
    QVERIFY(powerFrom("2") == Power::cooling);
    QVERIFY(!powerFrom("4") && !powerFrom("11") && !powerFrom("-1"));
    QVERIFY((shutterFrom("11") == Shutter{true, false}));
    QVERIFY((shutterFrom("21") == Shutter{false, true}));
    QVERIFY((shutterFrom("31") == Shutter{true, true}));
    QVERIFY((shutterFrom("30") == Shutter{false, false}));
    QVERIFY((*troublesFrom("010200") == std::vector<Trouble>{{Part::lamp, false}, {Part::cover, true}}));
    QVERIFY((*lampsFrom("1234 1 20 0") == std::vector<Lamp>{{1234, true}, {20, false}}));
    QVERIFY(!lampsFrom("1234") && !lampsFrom("1234 2") && !lampsFrom("-1 1"));
    QVERIFY(!lampsFrom("1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1"));
    QVERIFY((*signalFrom("1920x1200") == Signal{Signal::Kind::size, {1920, 1200}}));
    QVERIFY(signalFrom("-")->kind == Signal::Kind::none);
    QVERIFY(!signalFrom("0x0") && !signalFrom("1920x") && !signalFrom("999999x2"));
    QVERIFY(!inputFrom("30") && !inputFrom("71") && inputFrom("3A"));
  }

  void addresses_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("host");  // empty: none
    QTest::addColumn<int>("port");
    QTest::addColumn<QString>("again");
    QTest::newRow("number") << "192.168.1.50"
                            << "192.168.1.50" << 4352 << "192.168.1.50";
    QTest::newRow("name and port") << "left.venue:4353"
                                   << "left.venue" << 4353 << "left.venue:4353";
    QTest::newRow("the standard port") << "left:4352"
                                       << "left" << 4352 << "left";
    QTest::newRow("long") << "[fe80::1%eth0]:4400"
                          << "fe80::1%eth0" << 4400 << "[fe80::1%eth0]:4400";
    QTest::newRow("long alone") << "fe80::1"
                                << "fe80::1" << 4352 << "[fe80::1]:4352";
    for (const char* wrong : {"", ":4352", "left:", "left:0", "left:65536", "left:x", "a b", "a/b",
                              "[fe80::1", "left:1 ", "user@left", "[]:1", "left;rm"})
      QTest::newRow(wrong) << wrong << QString() << 0 << QString();
  }
  void addresses() {
    QFETCH(QString, text);
    QFETCH(QString, host);
    QFETCH(int, port);
    QFETCH(QString, again);
    const auto address = addressFrom(text.toStdString());
    QCOMPARE(address.has_value(), !host.isEmpty());
    if (!address) return;
    QCOMPARE(QString::fromStdString(address->host), host);
    QCOMPARE(address->port, port);
    QCOMPARE(QString::fromStdString(toString(*address)), again);
    QVERIFY(addressFrom(toString(*address)) == address);
  }

  void aPasswordIsNoPartOfAnAddress() { QCOMPARE(toString({"left", 4352, "secret"}), std::string("left")); }
};

QTEST_APPLESS_MAIN(TestPjlinkProtocol)
#include "test_pjlink_protocol.moc"
