// SPDX-License-Identifier: MIT
#include "remote/status_server.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QTcpSocket>
#include <QXmlStreamReader>
#include <QtTest>

#include "relucent/base/random.h"
#include "remote/status_page.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;

namespace {

QJsonObject health() {
  return {{"state", "playing"},
          {"frames", 123456},
          {"clipped", 0.0125},
          {"strange_fact", "<script>alert(1)</script> & \"more\""},
          {"displays", QJsonArray{QJsonObject{{"connector", "HDMI-1"}, {"shining", true}}}},
          {"nothing", QJsonValue()}};
}

HttpAnswer answer(const QByteArray& head) {
  return statusAnswer(head, "showpc", health());
}

}  // namespace

class TestStatusServer : public QObject {
  Q_OBJECT

  std::unique_ptr<StatusServer> server_;

  std::unique_ptr<QTcpSocket> visitor() const {
    auto socket = std::make_unique<QTcpSocket>();
    socket->connectToHost(server_->place().host, server_->place().port);
    return socket;
  }
  /// All that is answered until the connection ends.
  QByteArray asked(const QByteArray& request) const {
    auto socket = visitor();
    socket->write(request);
    if (!QTest::qWaitFor([&] { return socket->state() == QAbstractSocket::UnconnectedState; }, 5000))
      return "it never ends";
    return socket->readAll();
  }

 private slots:
  void init() {
    server_ = std::make_unique<StatusServer>(NetworkPlace{QHostAddress::LocalHost, 0}, health,
                                             std::chrono::milliseconds(1000));
  }
  void cleanup() { server_.reset(); }

  void thePageIsWellFormedAndHoldsNoScript() {
    const QByteArray page = asked("GET / HTTP/1.1\r\nHost: localhost:80\r\n\r\n");
    QVERIFY(page.startsWith("HTTP/1.0 200 "));
    QVERIFY(page.contains("Content-Security-Policy: default-src 'none'"));
    const QByteArray html = page.mid(page.indexOf("\r\n\r\n") + 4);
    QVERIFY(page.contains("Content-Length: " + QByteArray::number(html.size()) + "\r\n"));
    QVERIFY(!html.contains("<script"));
    QVERIFY(html.contains("&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;"));
    for (const char* part : {"playing", "HDMI-1", "http-equiv=\"refresh\"", "Late frames"})
      QCOMPARE(html.contains(part), QByteArray(part) != "Late frames");
    QVERIFY(html.contains("<th scope=\"row\">Frames</th>"));
    QVERIFY(html.contains("<th scope=\"row\">strange_fact</th>"));
    // Every element is closed: as XML but for the empty ones in its head.
    QXmlStreamReader reader(
        html.mid(html.indexOf("<body>"), html.indexOf("</html>") - html.indexOf("<body>")));
    while (!reader.atEnd()) reader.readNext();
    QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
  }

  void theSummaryIsOfWhatIsSeen_data() {
    QTest::addColumn<QJsonObject>("facts");
    QTest::addColumn<QString>("summary");
    const auto row = [](const char* name, const QJsonObject& facts, const char* summary) {
      QTest::newRow(name) << facts << QString(summary);
    };
    row("playing", {{"state", "playing"}, {"black", false}, {"paused", false}}, "playing");
    row("an older show", {{"state", "playing"}}, "playing");
    row("black", {{"state", "playing"}, {"black", true}, {"paused", true}}, "black, until somebody ends it");
    row("frozen", {{"state", "playing"}, {"paused", true}}, "frozen, until somebody ends it");
    row("a chart", {{"state", "playing"}, {"chart", "grid"}, {"paused", true}}, "test chart");
    const QJsonArray off{QJsonObject{{"shining", false}}},
        one{QJsonObject{{"shining", false}}, QJsonObject{{"shining", true}}};
    row("unplugged", {{"state", "playing"}, {"displays", off}}, "playing, but no display shows it");
    row("one of two unplugged", {{"state", "playing"}, {"displays", one}}, "playing");
    row("out of its hours", {{"state", "resting"}, {"black", true}}, "resting until its hours");
    row("of a later version", {{"state", "<dreaming>"}}, "&lt;dreaming&gt;");
  }
  /// Law: a wall that somebody made black is not called playing.
  void theSummaryIsOfWhatIsSeen() {
    QFETCH(QJsonObject, facts);
    QFETCH(QString, summary);
    const QString html = QString::fromUtf8(StatusPage::html(facts));
    QVERIFY2(html.contains("<h1>Relucent: " + summary + "</h1>"), qPrintable(html));
  }

  void theFactsAsJson() {
    const QByteArray said = asked("GET /health.json HTTP/1.0\r\n\r\n");
    QCOMPARE(QJsonDocument::fromJson(said.mid(said.indexOf("\r\n\r\n") + 4)).object(), health());
    QVERIFY(said.contains("Content-Type: application/json\r\n"));
  }

  void onlyTheHeadOfIt() {
    const QByteArray said = asked("HEAD / HTTP/1.0\r\n\r\n");
    QVERIFY(said.startsWith("HTTP/1.0 200 ") && said.endsWith("\r\n\r\n"));
  }

  void requests_data() {
    QTest::addColumn<QByteArray>("head");
    QTest::addColumn<int>("status");
    const auto row = [](const char* name, const char* head, int status) {
      QTest::newRow(name) << QByteArray(head) << status;
    };
    row("by number", "GET / HTTP/1.1\r\nHost: 192.168.1.20:8080", 200);
    row("by long number", "GET / HTTP/1.1\r\nHost: [::1]:8080", 200);
    row("by its name", "GET / HTTP/1.1\r\nHost: ShowPC", 200);
    row("by its local name", "GET / HTTP/1.1\r\nhost: showpc.local:8080", 200);
    row("by a stranger's name", "GET / HTTP/1.1\r\nHost: rebound.example", 403);
    row("with a query", "GET /?a=b HTTP/1.1", 200);
    row("elsewhere", "GET /../etc/passwd HTTP/1.1", 404);
    row("writing", "POST / HTTP/1.1", 405);
    row("nonsense", "hello", 400);
    row("another protocol", "GET / FTP/1.0", 400);
    row("nothing", "", 400);
  }
  void requests() {
    QFETCH(QByteArray, head);
    QFETCH(int, status);
    QCOMPARE(answer(head).status, status);
  }

  void whatIsTooLongIsRefused() {
    QVERIFY(asked(QByteArray(3 * StatusServer::longestRequest, 'a')).startsWith("HTTP/1.0 400 "));
  }

  void whoSaysNothingIsSentAway() {
    auto socket = visitor();
    QTRY_COMPARE(server_->visitors(), 1);
    QTRY_COMPARE_WITH_TIMEOUT(server_->visitors(), 0, 5000);
    QTRY_COMPARE(socket->state(), QAbstractSocket::UnconnectedState);
  }

  /// Beyond its bound visitors are turned away, and afterwards it answers as before.
  void aCrowdIsTurnedAway() {
    std::vector<std::unique_ptr<QTcpSocket>> crowd;
    for (int i = 0; i < 3 * StatusServer::mostVisitors; ++i) crowd.push_back(visitor());
    QTRY_VERIFY(server_->visitors() > 0);
    QTRY_COMPARE(std::ranges::count_if(
                     crowd, [](const auto& one) { return one->state() == QAbstractSocket::ConnectedState; }),
                 StatusServer::mostVisitors);
    QVERIFY(server_->visitors() <= StatusServer::mostVisitors);
    crowd.clear();
    QTRY_COMPARE(server_->visitors(), 0);
    QVERIFY(asked("GET / HTTP/1.0\r\n\r\n").startsWith("HTTP/1.0 200 "));
  }

  /// Any bytes end in an answer.
  void garbageIsAnswered() {
    Random random{26};
    for (int i = 0; i < 2000; ++i) {
      QByteArray head = "GET /health.json HTTP/1.1\r\nHost: localhost";
      for (std::uint64_t changes = random.below(5); changes > 0; --changes)
        head[static_cast<qsizetype>(random.below(static_cast<std::uint64_t>(head.size())))] =
            static_cast<char>(random.below(256));
      const int status = answer(head).status;
      QVERIFY2(status == 200 || (status >= 400 && status < 406), head.toPercentEncoding().constData());
    }
  }

  void aPortThatIsTakenIsASentence() {
    QVERIFY(mentions(sentenceOf([&] { StatusServer(server_->place(), health); }, ErrorKind::device),
                     "choose another port with --status"));
  }
};

QTEST_GUILESS_MAIN(TestStatusServer)
#include "test_status_server.moc"
