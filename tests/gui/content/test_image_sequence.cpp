// SPDX-License-Identifier: MIT
#include "content/image_sequence.h"

#include <QTemporaryDir>
#include <QtTest>
#include <cmath>

#include "relucent/base/error.h"
#include "support/sentences.h"

using namespace relucent;
using namespace relucent::compensation;
using namespace relucent::gui;

namespace {

const Canvas small{{8, 6}, Fit::fill};

}  // namespace

class TestImageSequence : public QObject {
  Q_OBJECT

  QTemporaryDir folder_;
  /// Pictures 0 ... count - 1, each of its number's grey.
  QString sequence(const char* name, int count) {
    QDir(folder_.path()).mkpath(name);
    for (int i = 0; i < count; ++i) {
      QImage image(8, 6, QImage::Format_RGB32);
      image.fill(qRgb(i, i, i));
      image.save(QString("%1/%2/frame%3.png").arg(folder_.path(), name).arg(i));
    }
    return folder_.filePath(name);
  }
  static int numberIn(const ContentPicture& frame) { return qRed(frame.image.pixel(3, 3)); }

 private slots:
  void numbersInNamesCount() {
    QStringList files = picturesIn(sequence("numbers", 12));
    for (int i = 0; i < 12; ++i) QVERIFY(files[i].endsWith(QString("frame%1.png").arg(i)));
  }

  void everyPictureHasItsTime_data() {
    QTest::addColumn<double>("rate");
    for (double rate : {24.0, 25.0, 30.0, 60.0, 23.976, 1.0}) QTest::addRow("%g a second", rate) << rate;
  }
  void everyPictureHasItsTime() {
    QFETCH(double, rate);
    constexpr int count = 40;
    ImageSequence film(picturesIn(sequence("film", count)), rate, small);
    std::uint64_t last = 0;
    for (int i = 0; i < count; ++i) {
      // At its start, and a little before the next one.
      auto begin = ContentTime(std::llround(1e6 * i / rate)),
           end = ContentTime(std::llround(1e6 * (i + 1) / rate - 1));
      ContentPicture first = film.at(begin), again = film.at(end);
      QCOMPARE(numberIn(first), i);
      QCOMPARE(again.number, first.number);
      QVERIFY(first.number != last);
      last = first.number;
    }
    QCOMPARE(film.length()->count(), std::llround(1e6 * count / rate));
    QCOMPARE(numberIn(film.at(*film.length() + std::chrono::hours(1))), count - 1);
    QCOMPARE(numberIn(film.at(ContentTime(0))), 0);
  }

  void aBadPictureLeavesTheOneBefore() {
    QString path = sequence("bad", 5);
    QFile::remove(path + "/frame3.png");
    QFile broken(path + "/frame3.png");
    QVERIFY(broken.open(QIODevice::WriteOnly) && broken.write("nothing") > 0);
    broken.close();
    ImageSequence film(picturesIn(path), 10.0, small);
    QCOMPARE(numberIn(film.at(std::chrono::milliseconds(250))), 2);
    QCOMPARE(numberIn(film.at(std::chrono::milliseconds(350))), 2);
    QCOMPARE(numberIn(film.at(std::chrono::milliseconds(450))), 4);
  }

  void nothingToPlayIsSaid() {
    QDir(folder_.path()).mkpath("empty");
    QVERIFY(mentions(sentenceOf([&] { picturesIn(folder_.filePath("empty")); }, ErrorKind::input),
                     "no pictures"));
    for (double rate : {0.0, -1.0, 1000.0, std::nan("")})
      QVERIFY(
          mentions(sentenceOf([&] { ImageSequence({"a.png"}, rate, small); }, ErrorKind::input), "a second"));
  }
};

QTEST_GUILESS_MAIN(TestImageSequence)
#include "test_image_sequence.moc"
