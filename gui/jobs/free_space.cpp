// SPDX-License-Identifier: MIT
#include "jobs/free_space.h"

#include <QDir>
#include <QFileInfo>
#include <QStorageInfo>
#include <algorithm>

namespace relucent::gui {

std::uint64_t freeBytesAt(const QString& folder) {
  QString existing = folder;
  while (!QFileInfo::exists(existing) && existing != QDir(existing).absolutePath().section('/', 0, 0))
    existing = QFileInfo(existing).path();
  return static_cast<std::uint64_t>(std::max<qint64>(0, QStorageInfo(existing).bytesAvailable()));
}

}  // namespace relucent::gui
