// SPDX-License-Identifier: MIT
#include <QtTest>

#include "content/content_address.h"
#include "content/playlist.h"
#include "content/stream_address.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::gui;

class TestStreamAddress : public QObject {
  Q_OBJECT

 private slots:
  void isTakenApart_data() {
    QTest::addColumn<QString>("which");
    QTest::addColumn<QString>("url");
    QTest::addColumn<QString>("host");
    QTest::addColumn<bool>("black");
    QTest::newRow("rtsp") << "rtsp://camera/live"
                          << "rtsp://camera/live"
                          << "camera" << false;
    QTest::newRow("last") << "rtsp://camera/live#hold=last"
                          << "rtsp://camera/live"
                          << "camera" << false;
    QTest::newRow("black") << "http://10.0.0.7:8080/a?b=c#hold=black"
                           << "http://10.0.0.7:8080/a?b=c"
                           << "10.0.0.7" << true;
    QTest::newRow("user") << "rtsp://user:pa@ss@camera:554/"
                          << "rtsp://user:pa@ss@camera:554/"
                          << "camera" << false;
    QTest::newRow("IPv6") << "http://[fe80::1]:80/"
                          << "http://[fe80::1]:80/"
                          << "fe80::1" << false;
    QTest::newRow("any sender") << "udp://:5004"
                                << "udp://:5004"
                                << "" << false;
    QTest::newRow("another mark") << "http://a/b#part"
                                  << "http://a/b#part"
                                  << "a" << false;
    QTest::newRow("capitals") << "RTSP://Camera/"
                              << "RTSP://Camera/"
                              << "Camera" << false;
  }
  void isTakenApart() {
    QFETCH(QString, which);
    const StreamAddress address = streamAddressFrom(which);
    QTEST(address.url, "url");
    QTEST(address.host, "host");
    QTEST(address.hold == StreamAddress::Hold::black, "black");
    QCOMPARE(addressOf("stream:" + which).kind, ContentAddress::Kind::stream);
    QCOMPARE(addressOf("stream:" + which).which, which);
  }

  void whatIsNoneIsRefusedWithoutItsPassword_data() {
    QTest::addColumn<QString>("which");
    QTest::addColumn<QString>("part");
    QTest::newRow("empty") << ""
                           << "no address of a stream";
    QTest::newRow("a file") << "file:///etc/passwd"
                            << "no address of a stream";
    QTest::newRow("a list of files") << "concat:/etc/passwd|/b"
                                     << "no address of a stream";
    QTest::newRow("no scheme") << "user:secret@camera/live"
                               << "no address of a stream";
    QTest::newRow("no host") << "rtsp://user:secret@/live"
                             << "host";
    QTest::newRow("no port") << "udp://239.0.0.1"
                             << "port";
    QTest::newRow("port too large") << "http://user:secret@a:65536/"
                                    << "port";
    QTest::newRow("a slash in the password") << "rtsp://user:sec/ret@camera/live"
                                             << "host";
    QTest::newRow("hold") << "rtsp://user:secret@camera/#hold=white"
                          << "#hold=black";
  }
  void whatIsNoneIsRefusedWithoutItsPassword() {
    QFETCH(QString, which);
    QFETCH(QString, part);
    const std::string sentence = sentenceOf([&] { streamAddressFrom(which); }, ErrorKind::input);
    QVERIFY(mentions(sentence, part.toStdString()));
    for (const char* hidden : {"secret", "sec/", "ret@"})
      QVERIFY2(sentence.find(hidden) == std::string::npos, sentence.c_str());
  }

  void isShownWithoutWhatIsSecret_data() {
    QTest::addColumn<QString>("path");
    QTest::addColumn<QString>("shown");
    QTest::newRow("as it is") << "stream:rtsp://camera:554/live"
                              << "rtsp://camera:554/live";
    QTest::newRow("user") << "stream:rtsp://user:secret@camera/live"
                          << "rtsp://camera/live";
    QTest::newRow("at in it") << "stream:rtsp://user:s@ecret@camera/live"
                              << "rtsp://camera/live";
    QTest::newRow("mark in it") << "stream:rtsp://user:s#ecret@camera/live"
                                << "rtsp://\u2026";
    QTest::newRow("slash in it") << "stream:rtsp://user:sec/ret@camera/live"
                                 << "rtsp://\u2026";
    QTest::newRow("digits and a slash") << "stream:rtsp://user:1/secret@camera/live"
                                        << "rtsp://user:1/\u2026";
    QTest::newRow("query") << "stream:srt://camera:9000?passphrase=secret"
                           << "srt://camera:9000?\u2026";
    QTest::newRow("hold") << "stream:http://a/b#hold=black"
                          << "http://a/b";
    QTest::newRow("IPv6") << "stream:http://user:secret@[::1]:80/"
                          << "http://[::1]:80/";
    QTest::newRow("none") << "stream:secret"
                          << "\u2026";
    QTest::newRow("lines") << "stream:rtsp://user:sec\nret@camera/live"
                           << "rtsp://camera/live";
    QTest::newRow("a file") << "/a/user:secret@b.png"
                            << "/a/user:secret@b.png";
  }
  void isShownWithoutWhatIsSecret() {
    QFETCH(QString, path);
    QTEST(shownPath(path), "shown");
  }

  /// As typed: who keeps a list keeps the password.
  void aPlaylistKeepsThemAsTyped() {
    QTemporaryDir folder;
    const QString file = folder.filePath("show.playlist");
    PlaylistSettings settings;
    settings.items = {{"stream:rtsp://user:secret@camera/live#hold=black"}};
    savePlaylist(file, settings);
    QCOMPARE(readPlaylist(file), settings);
    settings.items[0].seconds = -1.0;
    for (const Message& problem : problems(settings))
      QVERIFY2(english(problem).find("secret") == std::string::npos, english(problem).c_str());
  }
};

QTEST_GUILESS_MAIN(TestStreamAddress)
#include "test_stream_address.moc"
