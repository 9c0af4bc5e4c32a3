// SPDX-License-Identifier: MIT
#include "remote/osc_message.h"

#include <QtTest>
#include <limits>

#include "relucent/base/random.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

QByteArray bundleOf(const QList<QByteArray>& parts) {
  QByteArray bundle("#bundle\0\0\0\0\0\0\0\0\1", 16);
  for (const QByteArray& part : parts) {
    const auto size = static_cast<char>(part.size());
    bundle += QByteArray("\0\0\0", 3) + size + part;
  }
  return bundle;
}

}  // namespace

class TestOscMessage : public QObject {
  Q_OBJECT

 private slots:
  /// What OSC 1.0's own text gives as bytes.
  void theSpecificationsExamples() {
    const QByteArray frequency("/oscillator/4/frequency\0,f\0\0\x43\xdc\0\0", 32);
    const auto read = oscMessages(frequency);
    QVERIFY(read && read->size() == 1);
    QVERIFY((read->front() == OscMessage{"/oscillator/4/frequency", {440.0}}));
    const QByteArray foo(
        "/foo\0\0\0\0,iisff\0\0\0\0\x03\xe8\xff\xff\xff\xffhello\0\0\0\x3f\x9d\xf3\xb6\x40\xb5\xb2\x2d", 40);
    const auto several = oscMessages(foo);
    QVERIFY(several && several->size() == 1 && several->front().arguments.size() == 5);
    QCOMPARE(std::get<double>(several->front().arguments[1]), -1.0);
    QCOMPARE(std::get<QString>(several->front().arguments[2]), QString("hello"));
    QCOMPARE(static_cast<float>(std::get<double>(several->front().arguments[4])), 5.678f);
  }

  void whatIsWrittenIsRead_data() {
    QTest::addColumn<QString>("address");
    QTest::addColumn<QVariantList>("arguments");
    QTest::newRow("nothing") << "/next" << QVariantList{};
    QTest::newRow("a position") << "/viewer" << QVariantList{0.5, -3.25, 1.5};
    QTest::newRow("whole numbers") << "/item" << QVariantList{0, -2147483646, 7};
    QTest::newRow("text") << "/chart" << QVariantList{"grid", QString::fromUtf8("größer"), ""};
    QTest::newRow("both") << "/error" << QVariantList{"a sentence", 1, 2.5};
  }
  void whatIsWrittenIsRead() {
    QFETCH(QString, address);
    QFETCH(QVariantList, arguments);
    OscMessage message{address, {}};
    for (const QVariant& argument : arguments) {
      if (argument.typeId() == QMetaType::QString)
        message.arguments.emplace_back(argument.toString());
      else
        message.arguments.emplace_back(argument.toDouble());
    }
    const QByteArray datagram = oscDatagram(message);
    QCOMPARE(datagram.size() % 4, 0);
    const auto read = oscMessages(datagram);
    QVERIFY(read && read->size() == 1 && read->front() == message);
    // Twice in a bundle, and that in another, with something behind it.
    const auto bundled = oscMessages(bundleOf({bundleOf({datagram, datagram}), datagram}));
    QVERIFY(bundled && (*bundled == std::vector<OscMessage>(3, message)));
  }

  void trueAndFalseAreNumbers() {
    const auto read = oscMessages(QByteArray("/black\0\0,TF\0", 12));
    QVERIFY(read && (read->front() == OscMessage{"/black", {1.0, 0.0}}));
  }

  void garbageIsNone_data() {
    QTest::addColumn<QByteArray>("datagram");
    const QByteArray good = oscDatagram({"/viewer", {1.0, 2.5}});
    QTest::newRow("nothing") << QByteArray();
    QTest::newRow("text") << QByteArray("GET / HTTP/1.1\r\n\r\n");
    QTest::newRow("no whole words") << good.chopped(1);
    QTest::newRow("cut off") << good.chopped(4);
    QTest::newRow("too long") << good + QByteArray(4, '\0');
    QTest::newRow("no end of the address") << QByteArray("/viewer/");
    QTest::newRow("no end of the types") << QByteArray("/v\0\0,fff", 8);
    QTest::newRow("a type that there is not") << QByteArray("/v\0\0,Q\0\0\0\0\0\0", 12);
    QTest::newRow("a blob") << QByteArray("/v\0\0,b\0\0\0\0\0\1x\0\0\0", 16);
    QTest::newRow("a bundle's name alone") << QByteArray("#bundle\0", 8);
    QTest::newRow("a bundle of too long a part")
        << QByteArray("#bundle\0\0\0\0\0\0\0\0\1\x7f\xff\xff\xff", 20) + good;
    QTest::newRow("a bundle of a negative part")
        << QByteArray("#bundle\0\0\0\0\0\0\0\0\1\xff\xff\xff\xfc", 20) + good;
    QTest::newRow("a bundle with garbage behind it") << bundleOf({good}) + QByteArray("ab");
    QByteArray deep = good;
    for (int depth = 0; depth < 5; ++depth) deep = bundleOf({deep});
    QTest::newRow("too many bundles in each other") << deep;
  }
  void garbageIsNone() {
    QFETCH(QByteArray, datagram);
    QVERIFY(!oscMessages(datagram));
  }

  /// Nothing that arrives harms: for a sanitizer to judge. What is understood can be said again.
  void anyBytes() {
    const QByteArray good =
        bundleOf({oscDatagram({"/viewer", {1.0, 2.5, 3.0}}), oscDatagram({"/chart", {QString("grid")}})});
    int understood = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
      Random random{seed};
      QByteArray datagram =
          good.left(static_cast<qsizetype>(random.below(static_cast<std::uint32_t>(good.size() + 1))));
      for (std::uint32_t change = random.below(6); change > 0 && !datagram.isEmpty(); --change)
        datagram[static_cast<qsizetype>(random.below(static_cast<std::uint32_t>(datagram.size())))] =
            static_cast<char>(random.below(256));
      const auto read = oscMessages(datagram);
      if (!read) continue;
      ++understood;
      for (const OscMessage& message : *read) QVERIFY(!oscDatagram(message).isEmpty());
    }
    QVERIFY(understood > 100 && understood < 15000);
  }
};

QTEST_GUILESS_MAIN(TestOscMessage)
#include "test_osc_message.moc"
