// SPDX-License-Identifier: MIT
#include "content/read_ahead.h"

#include <algorithm>
#include <set>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::gui {

ReadAhead::ReadAhead(QStringList files, Canvas canvas, qsizetype ahead, bool loop)
    : files_(std::move(files)), canvas_(canvas), ahead_(ahead), loop_(loop) {
  require(!files_.isEmpty() && ahead >= 0, "{} files, {} ahead", files_.size(), ahead);
}

ReadAhead::~ReadAhead() {
  for (auto& [index, future] : reading_) future.waitForFinished();
}

void ReadAhead::prepare(qsizetype index) {
  if (reading_.contains(index)) return;
  reading_.emplace(index, startedInBackground([file = files_[index], canvas = canvas_] {
                     return onCanvas(readContent(file), canvas);
                   }));
}

bool ReadAhead::isReady(qsizetype index) const {
  auto found = reading_.find(index);
  return found != reading_.end() && found->second.isFinished();
}

QImage ReadAhead::picture(qsizetype index) {
  require(index >= 0 && index < count(), "picture {} of {}", index, count());
  std::set<qsizetype> wanted{index};
  for (qsizetype next = index + 1; next <= index + ahead_; ++next) {
    if (next < count())
      wanted.insert(next);
    else if (loop_)
      wanted.insert(next % count());
  }
  // What is still being read is let finish: it cannot be stopped, and may be wanted again.
  std::erase_if(reading_, [&](const auto& entry) {
    return !wanted.contains(entry.first) && entry.second.isFinished();
  });
  for (qsizetype next : wanted) prepare(next);
  try {
    return resultOf(reading_.at(index));
  } catch (const Error&) {
    reading_.erase(index);  // the file may be there the next time
    throw;
  }
}

}  // namespace relucent::gui
