// SPDX-License-Identifier: MIT
#pragma once

#include <QFuture>
#include <QImage>
#include <QStringList>
#include <map>

#include "content/canvas.h"
#include "content/outcome.h"

namespace relucent {

/// Pictures of files on the canvas, read on other threads before they are asked for. Bounded: the one that is
/// shown and the few that come next.
class ReadAhead {
 public:
  /// `ahead`: how many beyond the one asked for last; `loop`: after the last comes the first.
  ReadAhead(QStringList files, Canvas canvas, qsizetype ahead, bool loop);
  ~ReadAhead();
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  qsizetype count() const { return files_.size(); }
  /// Waits only if it was not read in time.
  /// Throws: as readContent(), once for each time that the file is asked for.
  QImage picture(qsizetype index);
  /// Whether picture(index) would not wait.
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

}  // namespace relucent
