// SPDX-License-Identifier: MIT
#include "content/video.h"
#include "relucent/base/message.h"

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QThreadPool>
#include <QtTest>
#include <cmath>

#include "avi_film.h"
#include "content/playlist.h"
#include "relucent/image/colour.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;
using namespace relucent::image;
using namespace std::chrono_literals;

namespace {

/// Frame n is the grey of luma 16 + 4 n.
AviFilm counting() {
  AviFilm film;
  film.samples = [](int frame, int, int) { return std::array{16 + 4 * frame, 128, 128}; };
  return film;
}

int codeOf(double light) {
  return static_cast<int>(std::lround(255.0 * srgbEncode(light)));
}

/// Which frame of counting() a picture is.
int frameIn(const ContentPicture& picture) {
  int shown = qGreen(picture.image.pixel(3, 3));
  int nearest = 0;
  auto distance = [&](int frame) { return std::abs(codeOf(std::pow(4.0 * frame / 219.0, 2.4)) - shown); };
  for (int frame = 0; frame < 50; ++frame)
    if (distance(frame) < distance(nearest)) nearest = frame;
  return nearest;
}

}  // namespace

class TestVideo : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  QString film(const AviFilm& film, const char* name = "film.avi") {
    QString path = folder_.filePath(name);
    write(path, aviOf(film));
    return path;
  }
  static Canvas canvasOf(const AviFilm& film) { return {{film.width, film.height}, Fit::fill}; }

 private slots:
  void samplesBecomeTheLightThatTheyMean_data() {
    QTest::addColumn<QSize>("size");
    QTest::addColumn<bool>("sound");
    for (QSize size : {QSize(32, 24), QSize(33, 17), QSize(31, 24), QSize(2, 2), QSize(641, 481)})
      QTest::addRow("%dx%d", size.width(), size.height()) << size << (size.width() != 33);
  }
  /// The left half is red, the right one a grey; BT.601 at video range, on a display of BT.1886.
  void samplesBecomeTheLightThatTheyMean() {
    QFETCH(QSize, size);
    QFETCH(bool, sound);
    AviFilm made;
    made.width = size.width();
    made.height = size.height();
    made.frames = 10;
    made.sound = sound;
    int middle = 2 * (size.width() / 4);
    // 75 % red as BT.601 has it: Y = 16 + 219 * 0.75 * 0.299, ...
    made.samples = [middle](int, int x, int) {
      return x < middle ? std::array{65, 100, 212} : std::array{126, 128, 128};
    };
    Video video(film(made), canvasOf(made));
    QImage shown = video.at(0s).image;
    QCOMPARE(shown.size(), size);
    QCOMPARE(shown.format(), QImage::Format_RGBX8888);
    int grey = codeOf(std::pow(110.0 / 219.0, 2.4)), red = codeOf(std::pow(0.75, 2.4));
    for (int y = 0; y < size.height(); ++y)
      for (int x = 0; x < size.width(); ++x) {
        QRgb pixel = shown.pixel(x, y);
        if (x >= middle) QCOMPARE(pixel & 0xffffff, qRgb(grey, grey, grey) & 0xffffff);
        // Rounded samples: see test_video_colour.
        if (x < middle) QVERIFY(std::abs(qRed(pixel) - red) <= 3 && qGreen(pixel) <= 2 && qBlue(pixel) <= 2);
      }
  }

  /// JPEG is full range, and its codes are those of sRGB.
  void jpegPicturesKeepTheirCodes() {
    AviFilm made;
    made.frames = 10;
    made.jpeg = [&](int) {
      QImage picture(made.width, made.height, QImage::Format_RGB32);
      picture.fill(qRgb(200, 120, 40));
      return picture;
    };
    Video video(film(made), canvasOf(made));
    QRgb seen = video.at(0s).image.pixel(10, 10);
    // JPEG's own rounding: a code of Y and chroma each, times 1.772 at most.
    QVERIFY2(std::abs(qRed(seen) - 200) <= 3 && std::abs(qGreen(seen) - 120) <= 3 &&
                 std::abs(qBlue(seen) - 40) <= 3,
             qPrintable(QString::number(seen, 16)));
  }

  /// Unpacked pictures lie from the bottom up. Law: they are shown as they are, or refused in a sentence, and
  /// never read beyond their memory.
  void unpackedPicturesAreRightOrRefused_data() {
    QTest::addColumn<int>("width");
    for (int width : {32, 33, 128}) QTest::addRow("%d wide", width) << width;
  }
  void unpackedPicturesAreRightOrRefused() {
    QFETCH(int, width);
    AviFilm made;
    made.width = width;
    made.unpacked = [&](int, int, int y) {
      return y < made.height / 2 ? qRgb(200, 120, 40) : qRgb(20, 60, 180);
    };
    const QString file = film(made);
    try {
      Video video(file, canvasOf(made));
      const QImage shown = video.at(0s).image;
      for (const auto& [y, wanted] :
           {std::pair(2, qRgb(200, 120, 40)), std::pair(made.height - 3, qRgb(20, 60, 180))}) {
        const QRgb seen = shown.pixel(width / 2, y);
        QVERIFY2(std::abs(qRed(seen) - qRed(wanted)) <= 3 && std::abs(qGreen(seen) - qGreen(wanted)) <= 3 &&
                     std::abs(qBlue(seen) - qBlue(wanted)) <= 3,
                 qPrintable(QString::number(seen, 16)));
      }
    } catch (const Error& error) {
      QVERIFY(error.kind() == ErrorKind::format);
      QVERIFY2(QString(error.what()).contains("do not lie as"), error.what());
    }
  }

  void tellsItsLength() {
    AviFilm made = counting();
    Video video(film(made), canvasOf(made));
    QVERIFY(std::chrono::abs(*video.length() - 2s) <= 50ms);
  }

  /// The time that it is asked for rules: it runs, jumps back, and stands.
  void followsTheTimeItIsAskedFor() {
    AviFilm made = counting();
    Video video(film(made), canvasOf(made));
    QCOMPARE(frameIn(video.at(0s)), 0);
    QElapsedTimer real;
    auto playedTo = [&](int frame, ContentTime begin) {
      real.start();
      return [&video, &real, frame, begin] {
        ContentTime now =
            begin + std::chrono::duration_cast<ContentTime>(std::chrono::nanoseconds(real.nsecsElapsed()));
        int expected = static_cast<int>(now.count() * 25 / 1'000'000);
        return expected >= frame && std::abs(frameIn(video.at(now)) - expected) <= 5;
      };
    };
    auto ran = playedTo(20, 0s);
    QTRY_VERIFY_WITH_TIMEOUT(ran(), 1900);
    auto again = playedTo(10, 0s);  // once more from its beginning
    QTRY_VERIFY_WITH_TIMEOUT(again(), 1900);
    QTRY_VERIFY(std::abs(frameIn(video.at(1600ms)) - 40) <= 4);  // stands
    auto onward = playedTo(30, 1s);
    QTRY_VERIFY_WITH_TIMEOUT(onward(), 900);
    QTRY_VERIFY(frameIn(video.at(1h)) >= 45);  // its end stays
    QTRY_VERIFY(frameIn(video.at(0s)) <= 4);
  }

  void whatIsNoFilmIsNamed_data() {
    QTest::addColumn<QByteArray>("content");
    AviFilm made = counting();
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("text") << QByteArray("no film at all, but some words about one");
    QTest::newRow("only its head") << aviOf(made).left(200);
  }
  void whatIsNoFilmIsNamed() {
    QFETCH(QByteArray, content);
    QVERIFY(write(folder_.filePath("wrong.mp4"), content));
    QVERIFY(mentions(sentenceOf([&] { Video(folder_.filePath("wrong.mp4"), {}); }, ErrorKind::format),
                     "wrong.mp4"));
  }
  void aMissingFilmIsNamed() {
    QVERIFY(
        mentions(sentenceOf([&] { Video(folder_.filePath("gone.mp4"), {}); }, ErrorKind::disk), "gone.mp4"));
  }

  void playlistsPlayFilmsAndSkipBrokenOnes() {
    AviFilm made = counting();
    film(made);
    QVERIFY(write(folder_.filePath("broken.mp4"), "nothing"));
    PlaylistSettings settings;
    settings.fadeSeconds = 0.0;
    settings.items = {{folder_.filePath("broken.mp4")}, {folder_.filePath("film.avi")}};
    Playlist playlist(settings, canvasOf(made));
    QTRY_COMPARE(playlist.at(0s).image.size(), canvasOf(made).size);
    QCOMPARE(playlist.status().playing, qsizetype{1});
    QVERIFY(english(playlist.status().skipped.front().why).find("broken.mp4") != std::string::npos);
    QThreadPool::globalInstance()->waitForDone();
  }
};

QTEST_GUILESS_MAIN(TestVideo)
#include "test_video.moc"
