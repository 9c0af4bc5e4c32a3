// SPDX-License-Identifier: MIT
#include "projectors/projector_watch.h"

#include <QNetworkDatagram>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "relucent/pjlink/protocol.h"

namespace relucent::gui {
namespace {

/// Of a projector with a name instead of a number anybody may be it: a look costs little.
bool mayBe(const pjlink::Address& address, const QHostAddress& sender) {
  const QHostAddress number(QString::fromStdString(address.host));
  return number.isNull() || number.isEqual(sender, QHostAddress::TolerantConversion);
}

}  // namespace

/// One projector's thread.
class ProjectorWatch::Watcher {
 public:
  using Take = std::function<void(pjlink::Kept)>;

  Watcher(WatchedProjector projector, const pjlink::Wanted& wanted, Take take)
      : address_(projector.address),
        betweenNotices_(projector.settings.soon),
        keeper_(std::move(projector.address), std::move(projector.settings)),
        take_(std::move(take)),
        wanted_(wanted),
        thread_([this] { watch(); }) {}
  ~Watcher() {
    {
      const std::lock_guard lock(guard_);
      ends_ = true;
    }
    stop_.ask(StopRequest::Kind::cancel);
    changed_.notify_all();
    thread_.join();
  }

  void want(const pjlink::Wanted& wanted) {
    {
      const std::lock_guard lock(guard_);
      wanted_ = wanted;
    }
    changed_.notify_all();
  }
  /// It may have changed.
  void notice(const QHostAddress& sender) {
    if (!mayBe(address_, sender)) return;
    {
      const std::lock_guard lock(guard_);
      noticed_ = true;
    }
    changed_.notify_all();
  }

 private:
  struct NoSink : ProgressSink {
    void progressed(double, const Message&) override {}
  };

  void watch() {
    const Progress progress(sink_, stop_);
    std::unique_lock lock(guard_);
    while (!ends_) {
      const pjlink::Wanted wanted = wanted_;
      noticed_ = false;
      lock.unlock();
      std::chrono::milliseconds pause{};
      try {
        pjlink::Kept kept = keeper_.keep(wanted, std::chrono::steady_clock::now(), progress);
        pause = kept.pause;
        take_(std::move(kept));
      } catch (const Cancelled&) {
        return;
      }
      lock.lock();
      const auto isCalled = [&] { return ends_ || wanted_ != wanted; };
      // Whoever floods it with notices has it look no oftener than that.
      const std::chrono::milliseconds deaf = std::min(pause, betweenNotices_);
      if (!changed_.wait_for(lock, deaf, isCalled))
        changed_.wait_for(lock, pause - deaf, [&] { return noticed_ || isCalled(); });
    }
  }

  const pjlink::Address address_;
  const std::chrono::milliseconds betweenNotices_;
  pjlink::Keeper keeper_;
  Take take_;
  NoSink sink_;
  StopRequest stop_;
  std::mutex guard_;
  std::condition_variable changed_;
  pjlink::Wanted wanted_;
  bool noticed_ = false;
  bool ends_ = false;
  std::thread thread_;  // last: it uses the others
};

ProjectorWatch::ProjectorWatch(std::vector<WatchedProjector> projectors, const pjlink::Wanted& wanted,
                               int blackFor, quint16 noticesAt, QObject* parent)
    : QObject(parent), wanted_(wanted), closes_(wanted.black) {
  black_.setSingleShot(true);
  black_.setInterval(blackFor);
  connect(&black_, &QTimer::timeout, this, [this] {
    closes_ = true;
    pass();
  });
  for (const WatchedProjector& one : projectors)
    states_.push_back({QString::fromStdString(one.settings.label),
                       QString::fromStdString(toString(one.address)), false, std::nullopt, Message()});
  for (WatchedProjector& one : projectors)
    watchers_.push_back(std::make_unique<Watcher>(
        std::move(one), wanted, [this, index = watchers_.size()](pjlink::Kept kept) {
          QMetaObject::invokeMethod(
              this, [this, index, kept = std::move(kept)] { take(index, kept); }, Qt::QueuedConnection);
        }));
  connect(&notices_, &QUdpSocket::readyRead, this, &ProjectorWatch::readNotices);
  notices_.bind(QHostAddress::Any, noticesAt, QUdpSocket::ShareAddress | QUdpSocket::ReuseAddressHint);
}

ProjectorWatch::~ProjectorWatch() = default;

void ProjectorWatch::pass() {
  for (const auto& watcher : watchers_) watcher->want({wanted_.on, closes_});
}

void ProjectorWatch::want(const pjlink::Wanted& wanted) {
  const pjlink::Wanted before = std::exchange(wanted_, wanted);
  if (wanted == before) return;
  if (!wanted.black) {
    black_.stop();
    closes_ = false;
  } else if (!before.black) {
    black_.start();
  }
  pass();
}

void ProjectorWatch::readNotices() {
  while (notices_.hasPendingDatagrams()) {
    const QNetworkDatagram datagram = notices_.receiveDatagram(pjlink::longestLine);
    const QByteArray bytes = datagram.data();
    if (!pjlink::isNotice({bytes.constData(), static_cast<std::size_t>(bytes.size())})) continue;
    for (const auto& watcher : watchers_) watcher->notice(datagram.senderAddress());
  }
}

void ProjectorWatch::take(std::size_t index, const pjlink::Kept& kept) {
  ProjectorState& state = states_[index];
  state.wasAsked = true;
  state.report = kept.report;
  state.problem = kept.problem;
  for (const Message& sentence : kept.told) Q_EMIT told(sentence);
  for (const Message& sentence : kept.warned) Q_EMIT warned(sentence);
  Q_EMIT changed();
}

}  // namespace relucent::gui
