// SPDX-License-Identifier: MIT
#pragma once

#include <QImage>
#include <QString>
#include <string>

#include "relucent/compensation/placement.h"

namespace relucent::gui {

/// The format to which all content is converted before it is compensated.
struct Canvas {
  QSize size{1920, 1080};
  compensation::Fit fit = compensation::Fit::fit;
};

/// Reads a picture file: upright; sRGB in Format_RGBX8888, transparent parts on black, converted by the
/// file's colour profile; files with float samples are linear in Format_RGBX32FPx4.
/// Throws: Error{disk} if unreadable, Error{format} if it is not a picture; Error{input} for NaN and
/// infinities.
QImage readContent(const QString& file);

/// The picture scaled to the canvas; bars are black. Its format stays.
/// Contract: neither is empty.
QImage onCanvas(const QImage& picture, const Canvas& canvas);

/// Format_RGBX8888.
QImage blackOn(const Canvas& canvas);

/// See compensation::contentIdentity(). `picture`: the file's size. Empty if the file cannot be read.
std::string identityOf(const QString& file, QSize picture, const Canvas& canvas);

/// (1 - share) from + share to, in linear light, as what projectors add is light.
/// Contract: both of one size.  Format_RGBX8888.
QImage crossFaded(const QImage& from, const QImage& to, double share);

}  // namespace relucent::gui
