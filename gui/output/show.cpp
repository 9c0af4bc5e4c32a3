// SPDX-License-Identifier: MIT
#include "output/show.h"

#include <QDateTime>
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/stopwatch.h"

namespace relucent {
namespace {

constexpr int healthInterval = 10'000;      // milliseconds
constexpr int shortestPause = 1'000;        // before it is tried again, doubled with every failure ...
constexpr int longestPause = 60'000;        // ... up to here
constexpr int forgivenAfter = 10 * 60'000;  // of playing without one

}  // namespace

Show::Show(ShowSettings settings, MakeRenderer make, QObject* parent)
    : QObject(parent),
      settings_(std::move(settings)),
      make_(std::move(make)),
      log_(settings_.folder),
      awake_(tr("A show is playing.")) {
  for (const QString& problem : awake_.problems()) log_.warn(problem);
  health_.setInterval(healthInterval);
  connect(&health_, &QTimer::timeout, this, [this] { tellHealth(state_); });
  again_.setSingleShot(true);
  connect(&again_, &QTimer::timeout, this, [this] {
    try {
      open();
      start();
    } catch (const Error& error) {
      tryAgain(error.what());
    }
  });
  open();
}

Show::~Show() {
  stop();
}

void Show::open() {
  std::unique_ptr<FrameRenderer> renderer = make_();
  renderer_ = renderer->name();
  player_.reset();
  if (windows_.empty()) {
    for (const ScreenIdentity& display : displaysFor(renderer->projectors(), settings_.displays)) {
      auto window = std::make_unique<ProjectorWindow>(display);
      QString name = display.connector;
      connect(window.get(), &ProjectorWindow::displayLost, this, [this, name] {
        log_.warn("display lost: " + name);
        tellHealth(state_);
      });
      connect(window.get(), &ProjectorWindow::displayFound, this, [this, name] {
        log_.tell("display back: " + name);
        tellHealth(state_);
      });
      windows_.push_back(std::move(window));
    }
  }
  content_ = std::make_shared<Playlist>(settings_.content, settings_.canvas);
  toldSkipped_ = 0;
  std::vector<ProjectorWindow*> windows;
  for (const auto& window : windows_) windows.push_back(window.get());
  player_ = std::make_unique<Player>(std::move(renderer), content_, std::move(windows));
  connect(player_.get(), &Player::failed, this, &Show::tryAgain, Qt::QueuedConnection);
}

void Show::start() {
  for (const auto& window : windows_) window->shine();
  player_->start();
  log_.tell(QString("playing %1 items on %2").arg(settings_.content.items.size()).arg(renderer_));
  health_.start();
  tellHealth("playing");
  QTimer::singleShot(forgivenAfter, player_.get(), [this] { failures_ = 0; });
}

void Show::tryAgain(const QString& sentence) {
  log_.warn(sentence);
  int pause = std::min(longestPause, shortestPause << std::min(failures_, 10));
  ++failures_;
  log_.tell(QString("trying again in %1 s").arg(pause / 1000));
  tellHealth("failed");
  again_.start(pause);
}

void Show::stop() {
  again_.stop();
  health_.stop();
  if (player_) player_->stop();
  for (const auto& window : windows_) window->stop();
  if (std::string_view(state_) == "stopped") return;
  log_.tell("stopped");
  tellHealth("stopped");
}

void Show::tellHealth(const char* state) {
  state_ = state;
  Playlist::Status content = content_->status();
  const QStringList& skipped = content.skipped;
  for (; toldSkipped_ < skipped.size(); ++toldSkipped_) log_.warn("skipped: " + skipped[toldSkipped_]);

  QJsonArray displays;
  for (const auto& window : windows_)
    displays.append(
        QJsonObject{{"connector", window->display().connector}, {"shining", window->isShining()}});
  PlayerStatistics statistics = player_ ? player_->statistics() : PlayerStatistics{};
  QJsonObject health{{"state", state},
                     {"updated", QDateTime::currentDateTime().toString(Qt::ISODate)},
                     {"renderer", renderer_},
                     {"frames", static_cast<qint64>(statistics.frames)},
                     {"late", static_cast<qint64>(statistics.late)},
                     {"frames_per_second", statistics.framesPerSecond},
                     {"frame_milliseconds", 1e3 * statistics.frameSeconds},
                     {"clipped", statistics.clipped},
                     {"steps", statistics.steps},
                     {"item", static_cast<qint64>(content.playing)},
                     {"skipped", skipped.size()},
                     {"failures", failures_},
                     {"peak_memory_bytes", static_cast<qint64>(peakMemoryBytes())},
                     {"displays", displays}};
  try {
    writeFileAtomically(QDir(settings_.folder).filePath("health.json").toStdString(),
                        QJsonDocument(health).toJson().toStdString());
  } catch (const Error& error) {
    log_.warn(error.what());  // a full disk is no reason for a dark wall
  }
}

}  // namespace relucent
