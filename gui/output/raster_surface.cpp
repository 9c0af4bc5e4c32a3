// SPDX-License-Identifier: MIT
#include "output/raster_surface.h"

#include <QPainter>

namespace relucent::gui {
namespace {

QImage centred(const QImage& picture, QSize native) {
  QImage all(native, QImage::Format_RGB32);
  all.fill(Qt::black);
  if (!picture.isNull()) QPainter(&all).drawImage(middleOf(native, picture.size()).topLeft(), picture);
  return all;
}

}  // namespace

RasterSurface::RasterSurface(QWindow& window) : window_(window), store_(&window) {
  window_.setSurfaceType(QSurface::RasterSurface);
}

void RasterSurface::draw(const DrivePicture& drive, const QImage& overlay) {
  const QImage picture = drive.image();
  QSize native = nativeSize(window_);
  QImage all = picture.size() == native ? picture : centred(picture, native);
  if (!overlay.isNull())
    QPainter(&all).drawImage(middleOf(native, picture.isNull() ? native : picture.size()).topLeft(), overlay);
  // Pixel for pixel on desktops that scale, too.
  all.setDevicePixelRatio(window_.devicePixelRatio());
  QRect place(QPoint(), window_.size());
  if (store_.size() != place.size()) store_.resize(place.size());
  store_.beginPaint(place);
  {
    QPainter painter(store_.paintDevice());
    painter.setCompositionMode(QPainter::CompositionMode_Source);
    painter.fillRect(place, Qt::black);
    painter.drawImage(QPoint(), all);
  }
  store_.endPaint();
  store_.flush(place);
}

}  // namespace relucent::gui
