// SPDX-License-Identifier: MIT
#include "content/playlist.h"

#include <QJsonDocument>
#include <QTemporaryDir>
#include <QThreadPool>
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "relucent/image/colour.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;
using namespace std::chrono_literals;

namespace {

const Canvas small{{8, 6}, Fit::fill};

int grey(const ContentPicture& frame) {
  return frame.image.isNull() ? -1 : qRed(frame.image.pixel(3, 3));
}

/// As the wall sees it: everything that is being read has been read.
ContentPicture settledAt(Playlist& list, ContentTime time) {
  QThreadPool::globalInstance()->waitForDone();
  return list.at(time);
}

}  // namespace

class TestPlaylist : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QString picture(int value) {
    QString file = folder_.filePath(QString("%1.png").arg(value));
    QImage image(8, 6, QImage::Format_RGB32);
    image.fill(qRgb(value, value, value));
    image.save(file);
    return file;
  }
  PlaylistSettings list(std::initializer_list<int> values, double seconds, double fade) {
    PlaylistSettings settings;
    settings.fadeSeconds = fade;
    for (int value : values)
      settings.items.append({value < 0 ? folder_.filePath("gone.png") : picture(value), seconds});
    return settings;
  }

 private slots:
  void playsInOrderRoundAndRound() {
    Playlist playlist(list({10, 20, 30}, 2.0, 0.0), small);
    for (int round = 0; round < 3; ++round)
      for (int i = 0; i < 3; ++i)
        for (int quarter = 0; quarter < 4; ++quarter) {
          ContentTime time = (6s * round) + (2s * i) + (500ms * quarter);
          QCOMPARE(grey(settledAt(playlist, time)), 10 * (i + 1));
          QCOMPARE(playlist.status().playing, static_cast<qsizetype>(i));
        }
  }

  /// The fade lies at the end of one and the beginning of the next, and mixes light.
  void fadesFromOneToTheNext() {
    Playlist playlist(list({0, 255}, 4.0, 1.0), small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 0);
    QCOMPARE(grey(settledAt(playlist, 2999ms)), 0);
    QCOMPARE(grey(settledAt(playlist, 3s)), 0);
    QCOMPARE(grey(settledAt(playlist, 3500ms)), static_cast<int>(std::lround(255.0 * srgbEncode(0.5))));
    QCOMPARE(grey(settledAt(playlist, 4s)), 255);
    QCOMPARE(grey(settledAt(playlist, 5999ms)), 255);
    QVERIFY(grey(settledAt(playlist, 6500ms)) < 255);
    QCOMPARE(grey(settledAt(playlist, 7s)), 0);
  }

  void aPictureThatStandsIsOneFrame() {
    Playlist playlist(list({10, 20}, 4.0, 1.0), small);
    std::uint64_t number = settledAt(playlist, 0s).number;
    QCOMPARE(settledAt(playlist, 2s).number, number);
    QVERIFY(settledAt(playlist, 3500ms).number != number);
  }

  void withoutLoopTheLastOneStays() {
    PlaylistSettings settings = list({10, 20}, 1.0, 0.0);
    settings.loop = false;
    Playlist playlist(settings, small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    QCOMPARE(grey(settledAt(playlist, 1s)), 20);
    QCOMPARE(grey(settledAt(playlist, 1h)), 20);
  }

  /// At once, if it can be read, and from there on in order.
  void jumpsToAnItem() {
    Playlist playlist(list({10, 20, 30, -1, 40}, 2.0, 0.0), small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    playlist.playItem(2);
    QCOMPARE(grey(playlist.at(100ms)), 10);  // still being read
    QCOMPARE(grey(settledAt(playlist, 200ms)), 30);
    QCOMPARE(playlist.status().playing, qsizetype{2});
    QCOMPARE(grey(settledAt(playlist, 2100ms)), 30);
    playlist.playItem(3);  // which is gone: the one behind it
    playlist.at(2150ms);
    settledAt(playlist, 2160ms);
    QCOMPARE(grey(settledAt(playlist, 2180ms)), 40);
    QCOMPARE(grey(settledAt(playlist, 4100ms)), 40);
    QCOMPARE(grey(settledAt(playlist, 4200ms)), 10);
    QVERIFY_THROWS_EXCEPTION(std::logic_error, playlist.playItem(5));
    QVERIFY_THROWS_EXCEPTION(std::logic_error, playlist.playItem(-1));
  }

  void beginsWithAnItem() {
    Playlist playlist(list({10, 20, 30}, 2.0, 0.0), small, Attendance::attended, 1);
    QCOMPARE(grey(settledAt(playlist, 100s)), 20);
    QCOMPARE(grey(settledAt(playlist, 102s)), 30);
    QCOMPARE(grey(settledAt(playlist, 104s)), 10);
    for (const qsizetype none : {-1, 3})
      QCOMPARE(grey(Playlist(list({10, 20, 30}, 2.0, 0.0), small, Attendance::attended, none).at(0s)), 10);
  }

  /// Also where nothing would come any more.
  void jumpsFromTheEnd() {
    PlaylistSettings once = list({10, 20}, 2.0, 0.0);
    once.loop = false;
    Playlist playlist(once, small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    QCOMPARE(grey(settledAt(playlist, 9s)), 20);
    playlist.playItem(0);
    playlist.at(9100ms);
    QCOMPARE(grey(settledAt(playlist, 9200ms)), 10);
  }

  void goingBackBeginsAnew() {
    Playlist playlist(list({10, 20, 30}, 2.0, 0.0), small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    QCOMPARE(grey(settledAt(playlist, 2s)), 20);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    QCOMPARE(grey(settledAt(playlist, 2s)), 20);
  }

  void whatIsMissingIsSkippedAndNamedAndTriedAgain() {
    Playlist playlist(list({10, -1, 30}, 1.0, 0.0), small);
    QCOMPARE(grey(settledAt(playlist, 0s)), 10);
    settledAt(playlist, 500ms);  // the missing one is found out
    QCOMPARE(grey(settledAt(playlist, 1s)), 30);
    QCOMPARE(playlist.status().skipped.size(), std::size_t{1});
    QVERIFY(english(playlist.status().skipped.front().why).find("gone.png") != std::string::npos);
    // It is there in the next round.
    QImage late(8, 6, QImage::Format_RGB32);
    late.fill(qRgb(77, 77, 77));
    QVERIFY(late.save(folder_.filePath("gone.png")));
    QCOMPARE(grey(settledAt(playlist, 2s)), 10);
    QCOMPARE(grey(settledAt(playlist, 3s)), 77);
    QVERIFY(playlist.status().skipped.empty());
    // What is lost once more is named once more.
    QFile::remove(folder_.filePath("gone.png"));
    for (ContentTime time = 4s; time < 7s; time += 500ms) settledAt(playlist, time);
    QCOMPARE(playlist.status().skipped.size(), std::size_t{1});
  }

  void nothingAtAllIsNothingAndComesBack() {
    Playlist playlist(list({-1, -1}, 1.0, 0.5), small);
    QCOMPARE(grey(settledAt(playlist, 0s)), -1);
    QCOMPARE(grey(settledAt(playlist, 500ms)), -1);
    QImage late(8, 6, QImage::Format_RGB32);
    late.fill(qRgb(88, 88, 88));
    QVERIFY(late.save(folder_.filePath("gone.png")));
    QCOMPARE(grey(settledAt(playlist, 1100ms)), 88);
    QFile::remove(folder_.filePath("gone.png"));
  }

  void oneFilmPlaysAgainAndAgain() {
    QDir(folder_.path()).mkpath("film");
    for (int i = 0; i < 4; ++i) {
      QImage image(8, 6, QImage::Format_RGB32);
      image.fill(qRgb(50 + i, 50 + i, 50 + i));
      QVERIFY(image.save(QString("%1/film/%2.png").arg(folder_.path()).arg(i)));
    }
    PlaylistSettings settings;
    settings.items.append({folder_.filePath("film"), 10.0, 4.0});
    Playlist playlist(settings, small);
    for (int quarter = 0; quarter < 12; ++quarter)
      QCOMPARE(grey(settledAt(playlist, 250ms * quarter + 1ms)), 50 + quarter % 4);
  }

  void isKeptInFiles() {
    PlaylistSettings settings = list({10, 20}, 3.5, 0.25);
    settings.loop = false;
    settings.items[1].picturesPerSecond = 23.976;
    savePlaylist(folder_.filePath("show.playlist"), settings);
    QVERIFY(readPlaylist(folder_.filePath("show.playlist")) == settings);
    QFile file(folder_.filePath("show.playlist"));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVERIFY(!file.readAll().contains(folder_.path().toUtf8()));  // moves with its pictures
  }

  /// Lists that name no sets are read by programs that know none.
  void setsAreKeptAndOlderProgramsReadTheRest() {
    PlaylistSettings settings;
    settings.items = {{picture(1), 3.0}, {picture(2), 4.0, 25.0, "night"}};
    settings.sets = {{{18, 0}, "night"}, {{7, 30}, "school class"}};
    const QString file = folder_.filePath("sets.playlist");
    const auto version = [&] {
      QFile written(file);
      return written.open(QIODevice::ReadOnly) ? QJsonDocument::fromJson(written.readAll())["version"].toInt()
                                               : 0;
    };
    savePlaylist(file, settings);
    QVERIFY(readPlaylist(file) == settings);
    QCOMPARE(version(), 2);
    settings.sets.clear();
    savePlaylist(file, settings);
    QCOMPARE(version(), 2);
    settings.items.back().set.clear();
    savePlaylist(file, settings);
    QCOMPARE(version(), 1);
    QVERIFY(readPlaylist(file) == settings);
  }

  void aSetIsTheLastThatBegan_data() {
    QTest::addColumn<QTime>("now");
    QTest::addColumn<QString>("set");
    QTest::newRow("in the morning, of the evening before") << QTime(0, 0) << "night";
    QTest::newRow("just before") << QTime(7, 29, 59) << "night";
    QTest::newRow("at once") << QTime(7, 30) << "day";
    QTest::newRow("at noon") << QTime(12, 0) << "class";
    QTest::newRow("late") << QTime(23, 59) << "night";
  }
  void aSetIsTheLastThatBegan() {
    QFETCH(QTime, now);
    QFETCH(QString, set);
    const QList<SetTime> times{{{18, 0}, "night"}, {{7, 30}, "day"}, {{10, 0}, "class"}};
    QVERIFY(setAt(times, now) == set);
    QVERIFY(!setAt({}, now));
    for (const SetTime& time : times) QVERIFY(setTimeFrom(textOf(time)) == time);
  }

  void wrongFilesAreRefused_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("part");
    QTest::newRow("no JSON") << QByteArray("#EXTM3U") << "not a playlist";
    QTest::newRow("cut short") << QByteArray("{\"items\": [{\"path\"") << "not a playlist";
    QTest::newRow("another document") << QByteArray("{\"a\": 1}") << "not a playlist";
    QTest::newRow("newer") << QByteArray("{\"version\": 7, \"items\": []}") << "newer version";
    QTest::newRow("empty") << QByteArray("{\"version\": 1, \"items\": []}") << "empty";
    QTest::newRow("no path") << QByteArray("{\"items\": [{}]}") << "names no file";
    QTest::newRow("no time") << QByteArray("{\"items\": [{\"path\": \"a\", \"seconds\": 0}]}")
                             << "more than 0 seconds";
    QTest::newRow("endless fade") << QByteArray("{\"fade_seconds\": 1e9, \"items\": [{\"path\": \"a\"}]}")
                                  << "cross-fade";
    QTest::newRow("a set at no time")
        << QByteArray(R"({"version": 2, "items": [{"path": "a"}], "sets": [{"from": "26:00", "set": "x"}]})")
        << "from a time on";
    QTest::newRow("two sets at a time")
        << QByteArray(R"({"version": 2, "items": [{"path": "a"}], "sets": [)"
                      R"({"from": "08:00", "set": "x"}, {"from": "08:00", "set": "y"}]})")
        << "two sets";
  }
  void wrongFilesAreRefused() {
    QFETCH(QByteArray, text);
    QFETCH(QString, part);
    QFile file(folder_.filePath("wrong.playlist"));
    QVERIFY(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(text);
    file.close();
    QVERIFY(mentions(sentenceOf([&] { readPlaylist(folder_.filePath("wrong.playlist")); }, ErrorKind::format),
                     part.toStdString()));
  }
};

QTEST_GUILESS_MAIN(TestPlaylist)
#include "test_playlist.moc"
