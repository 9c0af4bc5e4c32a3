// SPDX-License-Identifier: MIT
#include "text/written_times.h"

namespace relucent::gui {

QDateTime timeWritten(const std::string& text) {
  return QDateTime::fromString(QString::fromStdString(text), Qt::ISODate);
}

std::string written(const QDateTime& time) {
  return time.toUTC().toString(Qt::ISODate).toStdString();
}

}  // namespace relucent::gui
