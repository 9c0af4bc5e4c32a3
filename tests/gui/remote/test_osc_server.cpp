// SPDX-License-Identifier: MIT
#include "remote/osc_server.h"

#include <QSignalSpy>
#include <QtTest>

#include "relucent/base/error.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;

class TestOscServer : public QObject {
  Q_OBJECT

  std::chrono::steady_clock::time_point now_{};
  std::unique_ptr<OscServer> server_;
  QUdpSocket client_;
  std::vector<OscMessage> received_;
  QStringList warned_;

  void send(const QByteArray& datagram) {
    QCOMPARE(client_.writeDatagram(datagram, server_->place().host, server_->place().port), datagram.size());
  }
  /// Until all that was sent before has arrived.
  void settle() {
    static int marks = 0;
    const OscMessage mark{"/mark", {static_cast<double>(++marks)}};
    now_ += std::chrono::seconds(1);  // a second of its own
    send(oscDatagram(mark));
    QTRY_VERIFY(!received_.empty() && received_.back() == mark);
    received_.pop_back();
  }

 private slots:
  void init() {
    now_ = {};
    received_.clear();
    warned_.clear();
    server_ = std::make_unique<OscServer>(NetworkPlace{QHostAddress::LocalHost, 0}, [this] { return now_; });
    connect(server_.get(), &OscServer::received, this,
            [this](const OscMessage& message, const NetworkPlace&) { received_.push_back(message); });
    connect(server_.get(), &OscServer::warned, this, [this](const QString& text) { warned_ << text; });
  }

  void receivesAndAnswers() {
    QVERIFY(server_->place().host == QHostAddress(QHostAddress::LocalHost) && server_->place().port != 0);
    connect(server_.get(), &OscServer::received, server_.get(),
            [this](const OscMessage& message, const NetworkPlace& from) { server_->send(message, from); });
    const OscMessage message{"/viewer", {0.5, -1.25, 2.0}};
    send(oscDatagram(message));
    QTRY_COMPARE(received_.size(), std::size_t{1});
    QTRY_VERIFY(client_.hasPendingDatagrams());
    QByteArray answer(client_.pendingDatagramSize(), '\0');
    client_.readDatagram(answer.data(), answer.size());
    QVERIFY(oscMessages(answer)->front() == message && received_.front() == message);
    QVERIFY(warned_.isEmpty());
  }

  void garbageIsToldOnceAMinute() {
    for (int i = 0; i < 50; ++i) send("no OSC");
    settle();
    QVERIFY(received_.empty());
    QCOMPARE(warned_.size(), 1);
    QVERIFY2(warned_.front().contains("127.0.0.1") && warned_.front().contains("no OSC message"),
             qPrintable(warned_.front()));
    now_ += std::chrono::seconds(61);
    send("no OSC");
    settle();
    QCOMPARE(warned_.size(), 2);
  }

  /// The most that arrive in a second are obeyed, one sentence says it, and the next second is a new one.
  void floodsAreCutAndToldOnce() {
    now_ += std::chrono::seconds(1);
    const QByteArray datagram = oscDatagram({"/next", {}});
    // No more at once than the socket's buffer surely holds.
    for (int sent = 0; sent < 3 * OscServer::mostPerSecond; ++sent) {
      send(datagram);
      if (sent % 50 == 49) QCoreApplication::processEvents();
    }
    const auto obeyed = [this] { return static_cast<int>(received_.size()); };
    QTRY_COMPARE(obeyed(), OscServer::mostPerSecond);
    settle();
    QCOMPARE(obeyed(), OscServer::mostPerSecond);
    QCOMPARE(warned_.size(), 1);
    QVERIFY2(warned_.front().contains("1000 OSC messages a second"), qPrintable(warned_.front()));
    now_ += std::chrono::seconds(1);
    send(datagram);
    QTRY_COMPARE(obeyed(), OscServer::mostPerSecond + 1);
  }

  void aTakenPortIsASentence() {
    const NetworkPlace place = server_->place();
    try {
      OscServer second(place);
      QFAIL("two servers at one port");
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::device);
      QVERIFY2(std::string(error.what()).find(std::to_string(place.port)) != std::string::npos, error.what());
    }
  }

  void placesAreRead_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("host");
    QTest::addColumn<int>("port");
    QTest::newRow("four numbers") << "192.168.1.20:9000"
                                  << "192.168.1.20" << 9000;
    QTest::newRow("six") << "[::1]:57120"
                         << "::1" << 57120;
    for (const char* wrong : {"", ":", "9000", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:65536",
                              "desk:9000", "127.0.0.1:-1", "127.0.0.1:9e3"})
      QTest::newRow(wrong) << wrong << QString() << 0;
  }
  void placesAreRead() {
    QFETCH(QString, text);
    QFETCH(QString, host);
    QFETCH(int, port);
    const std::optional<NetworkPlace> place = networkPlaceFrom(text);
    QCOMPARE(place.has_value(), port != 0);
    if (place) QVERIFY(place->host == QHostAddress(host) && place->port == port);
  }
};

QTEST_GUILESS_MAIN(TestOscServer)
#include "test_osc_server.moc"
