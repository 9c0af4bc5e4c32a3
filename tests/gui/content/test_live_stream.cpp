// SPDX-License-Identifier: MIT
// Real senders on the loopback network, see tests/support/stream_sender.h.
#include "content/live_stream.h"

#include <QElapsedTimer>
#include <QFile>
#include <QTemporaryDir>
#include <QtTest>
#include <chrono>

#include "content/playlist.h"
#include "support/sentences.h"
#include "support/stream_sender.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::test;
using namespace std::chrono_literals;

namespace {

using Phase = LiveState::Phase;

const Canvas canvas{{32, 24}, Fit::fill};
const StreamPatience soon{4'000ms, 400ms};
const LivePauses short_{50ms, 200ms, 10'000ms};
const Samples red{81, 90, 240}, green{145, 54, 34};

/// A show whose time goes on.
class Played {
 public:
  explicit Played(const QString& which, const StreamPatience& patience = soon,
                  const LivePauses& pauses = short_)
      : stream_(std::make_unique<LiveStream>(streamAddressFrom(which), canvas, patience, pauses)) {}
  ContentPicture picture() { return stream_->at(time_ += 1ms); }
  /// Largest difference of a code in the middle; JPEG at quality 95 and MPEG-2 at many bits stay below 6.
  int from(const QColor& colour) {
    const QColor seen = picture().image.pixelColor(16, 12);
    return std::max({std::abs(seen.red() - colour.red()), std::abs(seen.green() - colour.green()),
                     std::abs(seen.blue() - colour.blue())});
  }
  bool shows(const QColor& colour) { return from(colour) <= 8; }
  LiveState state() const { return *stream_->live(); }
  std::string problem() const { return english(state().problem); }
  bool isReady() const { return stream_->isReady(); }
  ContentPicture standing() { return stream_->at(time_); }
  void end() { stream_.reset(); }

 private:
  std::unique_ptr<LiveStream> stream_;
  ContentTime time_{0};
};

QByteArray film(int pictures, int greenFrom) {
  TransportStream stream;
  QByteArray bytes;
  for (int i = 0; i < pictures; ++i) bytes += stream.picture({64, 48}, i < greenFrom ? red : green);
  return bytes;
}

bool isBlack(const ContentPicture& picture) {
  QImage black(picture.image.size(), picture.image.format());
  black.fill(Qt::black);
  return picture.image == black;
}

}  // namespace

class TestLiveStream : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    for (const char* proxy : {"http_proxy", "https_proxy", "all_proxy", "HTTP_PROXY"}) qunsetenv(proxy);
  }

  void playsWhatIsSent_data() {
    QTest::addColumn<QString>("way");
    for (const char* way : {"mjpeg", "ts", "udp", "rtp", "rtsp"}) QTest::newRow(way) << way;
  }
  void playsWhatIsSent() {
    QFETCH(QString, way);
    std::unique_ptr<HttpSender> http;
    std::unique_ptr<DatagramSender> datagrams;
    std::unique_ptr<RtspSender> rtsp;
    QString url;
    SentPicture* sent = nullptr;
    if (way == "udp" || way == "rtp") {
      const quint16 port = freeUdpPort();
      datagrams = std::make_unique<DatagramSender>(port, way == "rtp");
      url = QString("%1://127.0.0.1:%2").arg(way).arg(port);
      sent = &datagrams->sent;
    } else if (way == "rtsp") {
      rtsp = std::make_unique<RtspSender>();
      url = rtsp->url();
      sent = &rtsp->sent;
    } else {
      http = std::make_unique<HttpSender>();
      url = http->url(way);
      sent = &http->sent;
    }
    Played played(url);
    QVERIFY(isBlack(played.picture()));  // at once, without waiting
    QCOMPARE(played.picture().image.size(), canvas.size);
    QTRY_VERIFY_WITH_TIMEOUT(played.isReady(), 10'000);
    QVERIFY2(played.shows(Qt::red), qPrintable(QString::number(played.from(Qt::red))));
    QCOMPARE(played.state().size, sent->size);
    QCOMPARE(played.state().losses, 0);
    sent->colour = Qt::green;
    sent->samples = green;
    QTRY_VERIFY(played.shows(Qt::green));
    QCOMPARE(played.state().losses, 0);
  }

  void playsWhatIsSentBySrt() {
    if (!SrtSender::isThere()) QSKIP("FFmpeg was built without SRT");
    const quint16 port = freeUdpPort();
    SrtSender sender(port);
    Played played(QString("srt://127.0.0.1:%1").arg(port));
    QTRY_VERIFY_WITH_TIMEOUT(played.shows(Qt::red), 10'000);
    sender.isGreen = true;
    QTRY_VERIFY(played.shows(Qt::green));
  }

  void goesOnInAnotherSize_data() {
    QTest::addColumn<QString>("path");
    QTest::newRow("Motion JPEG") << "mjpeg";
    QTest::newRow("transport stream") << "ts";
  }
  void goesOnInAnotherSize() {
    QFETCH(QString, path);
    HttpSender sender;
    Played played(sender.url(path));
    QTRY_VERIFY(played.shows(Qt::red));
    sender.sent = {{96, 64}, Qt::green, green};
    QTRY_VERIFY(played.shows(Qt::green));
    QTRY_COMPARE(played.state().size, QSize(96, 64));
    QCOMPARE(played.picture().image.size(), canvas.size);
    // Odd sizes have chroma of their own at their ends.
    sender.sent = {{71, 53}, Qt::red, red};
    if (path == "mjpeg") QTRY_COMPARE(played.state().size, QSize(71, 53));
    QTRY_VERIFY(played.shows(Qt::red));
  }

  void isLostAndComesBack_data() {
    QTest::addColumn<QString>("hold");
    QTest::addColumn<bool>("black");
    QTest::newRow("last picture") << "#hold=last" << false;
    QTest::newRow("without a word") << "" << false;
    QTest::newRow("black") << "#hold=black" << true;
  }
  void isLostAndComesBack() {
    QFETCH(QString, hold);
    QFETCH(bool, black);
    HttpSender sender;
    Played played(sender.url() + hold);
    QTRY_VERIFY(played.shows(Qt::red));
    sender.stop();
    QTRY_COMPARE(played.state().phase, Phase::lost);
    QVERIFY(played.shows(black ? Qt::black : Qt::red));
    QTRY_VERIFY2(mentions(played.problem(), "refused"), played.problem().c_str());  // by the next attempt
    QCOMPARE(played.state().losses, 1);
    sender.sent.colour = Qt::blue;
    QVERIFY(sender.start());
    QTRY_VERIFY(played.shows(Qt::blue));
    QCOMPARE(played.state().phase, Phase::playing);
    QCOMPARE(played.state().losses, 1);
  }

  void saysWhatIsWrong_data() {
    QTest::addColumn<SenderWay>("way");
    QTest::addColumn<QString>("part");
    QTest::newRow("silent") << SenderWay::silent << "no picture came within 0.5 s";
    QTest::newRow("garbage") << SenderWay::garbage << "no video";
    QTest::newRow("a web page") << SenderWay::text << "no video";
    QTest::newRow("password") << SenderWay::wantsPassword << "user name and password";
  }
  void saysWhatIsWrong() {
    QFETCH(SenderWay, way);
    QFETCH(QString, part);
    HttpSender sender(way);
    Played played(sender.url(), {500ms, 400ms});
    QTRY_COMPARE(played.state().phase, Phase::lost);
    QVERIFY(mentions(played.problem(), part.toStdString()));
    QVERIFY(mentions(played.problem(), "; "));  // and what to do
    QVERIFY(!played.isReady() && isBlack(played.picture()));
    QTRY_VERIFY(sender.visits() >= 2);  // it is tried again
    sender.way = SenderWay::plays;
    QTRY_VERIFY(played.isReady());
  }

  /// Its own last try must not be in the way of the next one.
  void whatNobodySendsIsSilentEachTime_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"udp", "rtp"}) QTest::newRow(kind) << kind;
  }
  void whatNobodySendsIsSilentEachTime() {
    QFETCH(QString, kind);
    const QString url = QString("%1://127.0.0.1:%2").arg(kind).arg(freeUdpPort());
    Played played(url, {300ms, 400ms});
    QElapsedTimer watched;
    for (watched.start(); watched.elapsed() < 3'000; played.picture()) {
      if (!played.problem().empty())
        QVERIFY2(mentions(played.problem(), "no picture came"), played.problem().c_str());
      QTest::qWait(20);
    }
    QVERIFY(!played.problem().empty());
    // Nor that of a show that is opened again.
    Played again(url, {300ms, 400ms});
    played.end();
    for (watched.start(); watched.elapsed() < 2'000; again.picture()) {
      if (!again.problem().empty())
        QVERIFY2(mentions(again.problem(), "no picture came"), again.problem().c_str());
      QTest::qWait(20);
    }
  }

  void anUnknownHostIsNamedSo() {
    Played played("http://nowhere.invalid/live", {20'000ms, 400ms});
    QTRY_COMPARE_WITH_TIMEOUT(played.state().phase, Phase::lost, 20'000);
    QVERIFY(mentions(played.problem(), "host is not found"));
  }

  void oneThatStandsStillIsLost() {
    HttpSender sender(SenderWay::frozen);
    Played played(sender.url());
    QTRY_VERIFY(played.isReady());
    QTRY_COMPARE(played.state().phase, Phase::lost);
    QVERIFY(mentions(played.problem(), "no picture has come for 0.4 s"));
    QVERIFY(played.shows(Qt::red));
    QTRY_VERIFY(sender.visits() >= 2);
  }

  /// A show is closed by somebody who waits for it.
  void endsWithoutWaiting_data() {
    QTest::addColumn<SenderWay>("way");
    QTest::newRow("while it plays") << SenderWay::plays;
    QTest::newRow("while nobody answers") << SenderWay::silent;
  }
  void endsWithoutWaiting() {
    QFETCH(SenderWay, way);
    HttpSender sender(way);
    Played played(sender.url(), {60'000ms, 60'000ms});
    QTRY_COMPARE(sender.visitors(), 1);
    QElapsedTimer clock;
    clock.start();
    played.end();
    QVERIFY2(clock.elapsed() < 50, qPrintable(QString::number(clock.elapsed())));
    QTRY_COMPARE(sender.visitors(), 0);  // and nothing is left of it
  }

  /// Each time later than before, up to a bound.
  void triesAgainLessAndLessOften() {
    HttpSender sender(SenderWay::text);
    QList<qint64> visits;
    QElapsedTimer clock;
    clock.start();
    Played played(sender.url(), soon, {100ms, 300ms, 10'000ms});
    while (visits.size() < 6 && clock.elapsed() < 10'000) {
      QTest::qWait(1);
      if (sender.visits() > visits.size()) visits.append(clock.elapsed());
    }
    QCOMPARE(visits.size(), 6);
    const QList<qint64> least{100, 200, 300, 300, 300};
    // A millisecond or two, as visits are seen by looking.
    for (qsizetype i = 0; i < least.size(); ++i)
      QVERIFY2(visits[i + 1] - visits[i] >= least[i] - 20,
               qPrintable(QString("%1: %2 ms").arg(i).arg(visits[i + 1] - visits[i])));
  }

  void passwordsAreSentAndNotTold() {
    HttpSender sender(SenderWay::wantsPassword);
    const QString place = QString("127.0.0.1:%1").arg(sender.port());
    Played played("http://user:pa%3Ass%40%2Fword@" + place + "/mjpeg");
    QTRY_VERIFY(played.isReady());
    QCOMPARE(played.state().address, "http://" + place + "/mjpeg");
    Played wrong("http://user:wrongword@" + place + "/mjpeg");
    QTRY_COMPARE(wrong.state().phase, Phase::lost);
    QVERIFY(wrong.problem().find("wrongword") == std::string::npos);
    QVERIFY(!wrong.state().address.contains("wrongword"));

    RtspSender camera;
    camera.wantsPassword = true;
    Played rtsp(camera.url("user:secret"));
    QTRY_VERIFY_WITH_TIMEOUT(rtsp.isReady(), 10'000);
    QCOMPARE(rtsp.state().address, camera.url());
    Played without(camera.url());
    QTRY_COMPARE(without.state().phase, Phase::lost);
    QVERIFY(mentions(without.problem(), "user name and password"));
  }

  /// A stranger's server names a file of this computer, which holds a film that could be played.
  void anAnswerOpensNoFile_data() {
    QTest::addColumn<bool>("isFile");
    QTest::newRow("of this computer") << true;
    QTest::newRow("of the server") << false;
  }
  void anAnswerOpensNoFile() {
    QFETCH(bool, isFile);
    QTemporaryDir folder;
    HttpSender sender(SenderWay::list);
    sender.film = film(50, 50);
    QFile file(folder.filePath("film.ts"));
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(sender.film) == sender.film.size());
    file.close();
    sender.piece = isFile ? "file://" + file.fileName() : sender.url("film.ts");
    Played played(sender.url("list.m3u8"), {1'500ms, 400ms});
    QTRY_VERIFY(played.isReady() || played.state().phase == Phase::lost);
    QCOMPARE(played.isReady(), !isFile);
  }

  /// A film is there long before it is to be seen: one second of red, then green.
  void aFilmIsShownAtItsOwnPace() {
    HttpSender sender;
    sender.film = film(50, 25);
    Played played(sender.url("film.ts"));
    QTRY_VERIFY(played.shows(Qt::red));
    QElapsedTimer clock;
    clock.start();
    QTRY_VERIFY(played.shows(Qt::green));
    // It may have begun a moment before it was seen.
    QVERIFY2(clock.elapsed() > 700 && clock.elapsed() < 3'000, qPrintable(QString::number(clock.elapsed())));
  }

  void standsWhileTimeStands() {
    HttpSender sender;
    Played played(sender.url());
    QTRY_VERIFY(played.shows(Qt::red));
    const std::uint64_t number = played.standing().number;
    sender.sent.colour = Qt::blue;
    QTRY_VERIFY(sender.visits() == 1 && !played.state().size.isEmpty());
    QTest::qWait(200);  // several pictures have come meanwhile
    QCOMPARE(played.standing().number, number);
    QVERIFY(played.shows(Qt::blue));
  }

  void tellsWhenAPictureArrived() {
    HttpSender sender;
    const auto before = std::chrono::steady_clock::now();
    Played played(sender.url());
    QTRY_VERIFY(played.isReady());
    const ContentPicture picture = played.picture();
    QVERIFY(picture.arrived && *picture.arrived > before &&
            *picture.arrived < std::chrono::steady_clock::now());
    QVERIFY(!played.state().senderSeconds);  // of which Motion JPEG says nothing
  }

  /// The sender's clock runs behind by so much; what the loopback network takes comes on top of it.
  void tellsHowLongItWasUnderWay() {
    RtspSender camera;
    camera.clockIsBehind = 300ms;
    Played played(camera.url());
    QTRY_VERIFY_WITH_TIMEOUT(played.state().senderSeconds.has_value(), 10'000);
    const double way = *played.state().senderSeconds;
    QVERIFY2(way >= 0.3 && way < 2.0, qPrintable(QString::number(way)));
  }

  void aListWaitsForItAndSkipsIt() {
    QTemporaryDir folder;
    QImage white(32, 24, QImage::Format_RGB32);
    white.fill(Qt::white);
    QVERIFY(white.save(folder.filePath("white.png")));
    HttpSender dead, sender;
    dead.stop();
    PlaylistSettings settings;
    settings.fadeSeconds = 0.0;
    settings.items = {{folder.filePath("white.png"), 5.0},
                      {"stream:" + QString(dead.url()).replace("//", "//user:secret@"), 5.0},
                      {"stream:" + sender.url(), 5.0}};
    Playlist list(settings, canvas);
    const auto codeAt = [&](ContentTime time) { return list.at(time).image.pixelColor(16, 12); };
    QTRY_COMPARE(codeAt(0s), QColor(Qt::white));
    QTRY_VERIFY((codeAt(0s), !list.status().live.empty()));
    // Its picture's time is over, and the next one is not there: it stays.
    QTRY_COMPARE(list.status().live.front().phase, Phase::lost);
    QCOMPARE(codeAt(6s), QColor(Qt::white));
    QCOMPARE(list.status().skipped.size(), 0u);
    codeAt(11s);
    QCOMPARE(list.status().skipped.size(), 1u);
    const std::string sentence = english(list.status().skipped.front().why);
    QVERIFY(mentions(sentence, dead.url().toStdString()) && mentions(sentence, "refused"));
    QVERIFY(sentence.find("secret") == std::string::npos);
    ContentTime time = 11s;
    QTRY_COMPARE((codeAt(time += 1ms), list.status().playing), qsizetype(2));
    QVERIFY(list.at(time).image.pixelColor(16, 12).red() > 240);
  }

  /// Nothing else is there to be shown: black, until it comes.
  void aListOfOneStreamWaitsInTheDark() {
    HttpSender sender;
    sender.stop();
    PlaylistSettings settings;
    settings.items = {{"stream:" + sender.url()}};
    Playlist list(settings, canvas);
    ContentTime time{0};
    QElapsedTimer clock;
    clock.start();
    QVERIFY(isBlack(list.at(time)));
    QVERIFY(clock.elapsed() < 500);
    QTRY_VERIFY((list.at(time += 1ms), !list.status().live.empty()));
    QTRY_COMPARE(list.status().live.front().phase, Phase::lost);
    QVERIFY(sender.start());
    QTRY_VERIFY_WITH_TIMEOUT(list.at(time += 1ms).image.pixelColor(16, 12).red() > 240, 10'000);
    QCOMPARE(list.status().skipped.size(), 0u);
  }

  void aListSaysWhichAddressIsNone() {
    QVERIFY(mentions(sentenceOf([] { openContent({"stream:file:///etc/passwd"}, canvas); }, ErrorKind::input),
                     "no address of a stream"));
  }
};

QTEST_GUILESS_MAIN(TestLiveStream)
#include "test_live_stream.moc"
