// SPDX-License-Identifier: MIT
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <QImage>

namespace relucent::gui {

/// A picture in VTK's format, with opacity, last line first.
inline vtkSmartPointer<vtkImageData> vtkImageOf(const QImage& picture) {
  QImage bytes = picture.convertToFormat(QImage::Format_RGBA8888);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(bytes.width(), bytes.height(), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* to = static_cast<unsigned char*>(image->GetScalarPointer());
  auto line = static_cast<std::size_t>(bytes.width()) * 4;
  for (int y = 0; y < bytes.height(); ++y)
    std::copy_n(bytes.constScanLine(bytes.height() - 1 - y), line, to + static_cast<std::size_t>(y) * line);
  return image;
}

}  // namespace relucent::gui
