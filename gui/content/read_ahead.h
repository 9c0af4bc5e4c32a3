// SPDX-License-Identifier: MIT
#pragma once

#include <QFuture>
#include <QImage>
#include <QStringList>
#include <map>

#include "content/canvas.h"
#include "content/outcome.h"

namespace relucent::gui {

/// Picture files on the canvas, read on other threads before they are needed. Bounded: the present one and
/// the next few.
class ReadAhead {
 public:
  /// `ahead`: number of pictures beyond the last requested one; `loop`: the first follows the last.
  ReadAhead(QStringList files, Canvas canvas, qsizetype ahead, bool loop);
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  qsizetype count() const { return files_.size(); }
  /// Waits only if it was not read in time.
  /// Throws: as readContent(), once for each time that the file is asked for.
  QImage picture(qsizetype index);
  /// Whether picture(index) returns without waiting.
  bool isReady(qsizetype index) const;
  /// Starts reading it.
  void prepare(qsizetype index);

 private:
  QStringList files_;
  Canvas canvas_;
  qsizetype ahead_;
  bool loop_;
  std::map<qsizetype, QFuture<Outcome<QImage>>> reading_;
};

}  // namespace relucent::gui
