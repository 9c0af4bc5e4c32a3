// SPDX-License-Identifier: MIT
#include "content/stream_turn.h"

#include <condition_variable>
#include <mutex>
#include <set>

namespace relucent::gui {
namespace {

using namespace std::chrono_literals;

struct Listening {
  std::mutex guard;
  std::condition_variable ended;
  std::set<QString> urls;
};

/// Never destroyed: connections may end after what is static.
Listening& listening() {
  static auto* all = new Listening;
  return *all;
}

bool isListenedTo(const QString& url) {
  return url.startsWith("udp://", Qt::CaseInsensitive) || url.startsWith("rtp://", Qt::CaseInsensitive) ||
         (url.startsWith("srt://", Qt::CaseInsensitive) && url.contains("mode=listener"));
}

}  // namespace

StreamTurn::StreamTurn(const QString& url, const std::function<void()>& check) {
  if (!isListenedTo(url)) return;
  Listening& all = listening();
  std::unique_lock lock(all.guard);
  while (!all.urls.insert(url).second) {
    check();
    all.ended.wait_for(lock, 10ms);
  }
  url_ = url;
}

StreamTurn::~StreamTurn() {
  if (url_.isEmpty()) return;
  Listening& all = listening();
  const std::lock_guard lock(all.guard);
  all.urls.erase(url_);
  all.ended.notify_all();
}

}  // namespace relucent::gui
