// SPDX-License-Identifier: MIT
#include "content/image_sequence.h"

#include <QCollator>
#include <QDir>
#include <algorithm>
#include <cmath>

#include "content/still_image.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

/// A quarter of a second at usual rates: longer than a disk takes to wake up between two of its caches.
constexpr qsizetype picturesAhead = 8;

double checkedRate(double rate) {
  if (rate > 0.0 && rate <= 240.0) return rate;
  throw Error(
      ErrorKind::input,
      RELUCENT_ENGLISH_MESSAGE("content.frame-rate-out-of-range", "{} pictures a second cannot be played")
          .with(rate),
      RELUCENT_ENGLISH_MESSAGE("content.choose-rate-in-range", "choose a rate above 0 and at most 240"));
}

QStringList checkedFiles(const QStringList& files) {
  if (!files.isEmpty()) return files;
  throw Error(
      ErrorKind::input, RELUCENT_MESSAGE("content.sequence-empty", "the sequence has no pictures"),
      RELUCENT_MESSAGE("content.choose-picture-folder", "choose a folder with PNG, JPEG, TIFF or EXR files"));
}

}  // namespace

ImageSequence::ImageSequence(const QStringList& files, double picturesPerSecond, const Canvas& canvas)
    : files_(checkedFiles(files), canvas, picturesAhead, true),
      picturesPerSecond_(checkedRate(picturesPerSecond)) {}

ContentPicture ImageSequence::at(ContentTime time) {
  // A picture's time is rounded to whole microseconds; half of one keeps it from falling before its start.
  double pictures = (static_cast<double>(time.count()) + 0.5) * 1e-6 * picturesPerSecond_;
  qsizetype index =
      std::clamp<qsizetype>(static_cast<qsizetype>(std::floor(pictures)), 0, files_.count() - 1);
  if (index == index_) return frame_;
  index_ = index;
  try {
    frame_ = {files_.picture(index), nextFrameNumber()};
  } catch (const Error&) {
    // One bad picture in a film is not worth a black wall.
    if (frame_.image.isNull()) throw;
  }
  return frame_;
}

std::optional<ContentTime> ImageSequence::length() const {
  return ContentTime(std::llround(1e6 * static_cast<double>(files_.count()) / picturesPerSecond_));
}

const QStringList& pictureEndings() {
  static const QStringList endings{"png", "jpg", "jpeg", "tif", "tiff", "exr", "bmp", "webp"};
  return endings;
}

QStringList picturesIn(const QString& folder) {
  QDir directory(folder);
  QStringList patterns;
  for (const QString& ending : pictureEndings()) patterns << "*." + ending;
  QStringList names = directory.entryList(patterns, QDir::Files);
  if (names.isEmpty())
    throw Error(ErrorKind::input, RELUCENT_MESSAGE("content.no-pictures", "no pictures in this folder"),
                RELUCENT_MESSAGE("content.choose-picture-folder",
                                 "choose a folder with PNG, JPEG, TIFF or EXR files"),
                folder.toStdString());
  QCollator byNumber{QLocale(QLocale::English)};
  byNumber.setNumericMode(true);
  std::sort(names.begin(), names.end(), byNumber);
  QStringList files;
  for (const QString& name : names) files.append(directory.filePath(name));
  return files;
}

}  // namespace relucent::gui
