// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_thumbnail.h"

#include <QDir>
#include <QFileInfo>

#include "relucent/pipeline/pictures.h"
#include "text/written_times.h"
#include "views/colour_map.h"

namespace relucent::gui {
namespace {

constexpr QSize largest(240, 180);

QString fileIn(const QString& folder) {
  return QDir(folder).filePath("thumbnail.png");
}

bool isNewerThan(const QString& file, const std::string& stored) {
  const QFileInfo found(file);
  return found.exists() && found.lastModified() >= timeWritten(stored);
}

}  // namespace

void keepThumbnail(const Session& session) {
  const auto& stored = session.result(calibration::Stage::acquisition);
  if (!session.isOpen() || !stored || !session.acquisition()) return;
  const QString file = fileIn(QString::fromStdString(session.path().string()));
  if (isNewerThan(file, stored->stored)) return;
  const transport::Acquisition& acquisition = *session.acquisition();
  const image::Image flood = image::imageFromStack(acquisition.flood, acquisition.transport.cameras(), 0);
  pictureOf(flood, pipeline::displayWhite(flood))
      .scaled(largest, Qt::KeepAspectRatio, Qt::SmoothTransformation)
      .save(file, "PNG");
}

QImage thumbnailOf(const QString& folder) {
  return QImage(fileIn(folder));
}

}  // namespace relucent::gui
