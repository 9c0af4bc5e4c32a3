// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>

namespace relucent {

/// The wheel scrolls what a slider, a list or a number stands on, and never turns them in passing: they
/// listen to it only while they have the focus, and it does not give them that. For all widgets of the
/// program.
class QuietWheel : public QObject {
 public:
  explicit QuietWheel(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace relucent
