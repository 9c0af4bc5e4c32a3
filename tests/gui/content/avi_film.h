// SPDX-License-Identifier: MIT
#pragma once

#include <QBuffer>
#include <QByteArray>
#include <QFile>
#include <QImage>
#include <QtEndian>
#include <functional>

namespace relucent::gui {

/// A film made by the test, frame by frame: an AVI file of unpacked 4:2:0 samples (BT.601, video range) or of
/// JPEG pictures, with a tone beside it if wanted. Every decoder reads the first bit for bit.
struct AviFilm {
  int width = 32, height = 24, frames = 50, rate = 25;
  bool sound = true;
  /// Y, Cb, Cr of a frame at a place; for JPEG see `jpeg`.
  std::function<std::array<int, 3>(int frame, int x, int y)> samples;
  std::function<QImage(int frame)> jpeg;  // if set, instead
  /// If set, instead: three bytes a pixel, lines from the bottom up.
  std::function<QRgb(int frame, int x, int y)> unpacked;
};

inline QByteArray littleEndian(quint32 value, int bytes = 4) {
  QByteArray text(4, 0);
  qToLittleEndian(value, text.data());
  return text.left(bytes);
}

inline QByteArray chunk(const char* name, const QByteArray& content) {
  return QByteArray(name, 4) + littleEndian(static_cast<quint32>(content.size())) + content +
         QByteArray(content.size() % 2, 0);
}

inline QByteArray frameOf(const AviFilm& film, int frame) {
  if (film.jpeg) {
    QByteArray packed;
    QBuffer buffer(&packed);
    film.jpeg(frame).save(&buffer, "JPEG", 100);
    return packed;
  }
  if (film.unpacked) {
    QByteArray lines;
    for (int y = film.height; y-- > 0;) {
      for (int x = 0; x < film.width; ++x) {
        const QRgb colour = film.unpacked(frame, x, y);
        for (int value : {qBlue(colour), qGreen(colour), qRed(colour)})
          lines.append(static_cast<char>(value));
      }
      lines.append(QByteArray((4 - 3 * film.width % 4) % 4, 0));
    }
    return lines;
  }
  QByteArray planes;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) planes.append(static_cast<char>(film.samples(frame, x, y)[0]));
  for (std::size_t c : {1u, 2u})
    for (int y = 0; y < film.height; y += 2)
      for (int x = 0; x < film.width; x += 2) planes.append(static_cast<char>(film.samples(frame, x, y)[c]));
  return planes;
}

inline QByteArray aviOf(const AviFilm& film) {
  constexpr quint32 soundRate = 8000;
  auto number = [](int value) { return littleEndian(static_cast<quint32>(value)); };
  QByteArray packing = film.jpeg ? "MJPG" : film.unpacked ? QByteArray(4, 0) : "I420";
  QByteArray size = number(film.width) + number(film.height);
  QByteArray main = number(1'000'000 / film.rate) + number(0) + number(0) + number(0x10) +
                    number(film.frames) + number(0) + number(film.sound ? 2 : 1) + number(0) + size +
                    QByteArray(16, 0);
  QByteArray pictures = chunk("strh", "vids" + packing + number(0) + number(0) + number(0) + number(1) +
                                          number(film.rate) + number(0) + number(film.frames) + number(0) +
                                          number(-1) + number(0) + QByteArray(8, 0)) +
                        chunk("strf", number(40) + size + littleEndian(1, 2) +
                                          littleEndian(film.jpeg || film.unpacked ? 24 : 12, 2) + packing +
                                          number(film.width * film.height * 3 / 2) + QByteArray(16, 0));
  QByteArray sound = chunk("strh", "auds" + QByteArray(4, 0) + number(0) + number(0) + number(0) + number(1) +
                                       littleEndian(soundRate) + number(0) +
                                       littleEndian(soundRate * static_cast<quint32>(film.frames) /
                                                    static_cast<quint32>(film.rate)) +
                                       number(0) + number(-1) + number(2) + QByteArray(8, 0)) +
                     chunk("strf", littleEndian(1, 2) + littleEndian(1, 2) + littleEndian(soundRate) +
                                       littleEndian(2 * soundRate) + littleEndian(2, 2) +
                                       littleEndian(16, 2) + littleEndian(0, 2));
  QByteArray header = "hdrl" + chunk("avih", main) + chunk("LIST", "strl" + pictures);
  if (film.sound) header += chunk("LIST", "strl" + sound);

  QByteArray movie = "movi", index;
  auto add = [&](const char* name, const QByteArray& content) {
    index += QByteArray(name, 4) + number(0x10) + number(static_cast<int>(movie.size())) +
             number(static_cast<int>(content.size()));
    movie += chunk(name, content);
  };
  QByteArray tone;
  for (quint32 i = 0; i < soundRate / static_cast<quint32>(film.rate); ++i)
    tone += littleEndian(i % 16 < 8 ? 800 : static_cast<quint32>(-800), 2);
  for (int frame = 0; frame < film.frames; ++frame) {
    add(film.jpeg ? "00dc" : "00db", frameOf(film, frame));
    if (film.sound) add("01wb", tone);
  }
  return chunk("RIFF", "AVI " + chunk("LIST", header) + chunk("LIST", movie) + chunk("idx1", index));
}

inline bool write(const QString& path, const QByteArray& content) {
  QFile file(path);
  return file.open(QIODevice::WriteOnly) && file.write(content) == content.size();
}

}  // namespace relucent::gui
