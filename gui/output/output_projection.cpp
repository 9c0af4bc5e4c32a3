// SPDX-License-Identifier: MIT
#include "output/output_projection.h"

#include <QGuiApplication>
#include <QImageReader>
#include <algorithm>

#include "output/output_playlist.h"
#include "output/output_tap.h"
#include "output/shared_gl.h"
#include "relucent/base/error.h"
#include "text/message_text.h"

namespace relucent::gui {
namespace {

/// Larger than this a canvas would only be slower.
constexpr QSize largestCanvas(1920, 1080);
constexpr int sampleInterval = 500;  // milliseconds
constexpr std::size_t frameTimesKept = 120;
constexpr int mirrorInterval = 67;  // milliseconds: 15 pictures a second show what moves

}  // namespace

/// What a player needs, made on another thread.
struct OutputProjection::Made {
  std::unique_ptr<FrameRenderer> renderer;
  std::shared_ptr<Playlist> content;
  Wanted::Beginning beginning;
};

OutputProjection::OutputProjection(QObject* parent)
    : QObject(parent),
      tap_(std::make_shared<OutputTap>()),
      scaling_(
          [this](QImage scaled) {
            if (!isOpen()) return;
            mirror_ = std::move(scaled);
            Q_EMIT mirrored();
          },
          [this](const Failure& failure) { Q_EMIT failed(failure); }) {
  connect(&job_, &Job::progressed, this, &OutputProjection::progressed);
  connect(&job_, &Job::ended, this, &OutputProjection::opened);
  sampling_.setInterval(sampleInterval);
  connect(&sampling_, &QTimer::timeout, this, &OutputProjection::sample);
  reflecting_.setInterval(mirrorInterval);
  connect(&reflecting_, &QTimer::timeout, this, &OutputProjection::reflect);
}

OutputProjection::~OutputProjection() {
  disconnect();
  close();
}

Canvas OutputProjection::canvasFor(const PlaylistSettings& list, compensation::Fit fit) {
  QSize size = OutputPlaylist::isStill(list.items.front()) ? QImageReader(list.items.front().path).size()
                                                           : largestCanvas;
  if (!size.isValid()) size = largestCanvas;  // core's own formats
  if (size.width() > largestCanvas.width() || size.height() > largestCanvas.height())
    size.scale(largestCanvas, Qt::KeepAspectRatio);
  return {size.expandedTo({8, 8}), fit};
}

void OutputProjection::open(const Wanted& wanted) {
  require(!isOpen() && !isOpening() && !wanted.list.items.isEmpty(), "there is nothing to open");
  wanted_ = true;
  screens_ = wanted.screens;
  made_ = std::make_shared<Made>();
  // Made on the windows' thread.
  auto host = std::make_shared<std::unique_ptr<engine::GlHost>>();
  if (hasGraphicsCard() && SharedGl::instance() != nullptr) *host = SharedGl::instance()->host();
  job_.start([made = made_, tap = tap_, host, wanted](Progress& progress) {
    Progress preparing =
        progress.part(1.0, RELUCENT_MESSAGE("stage.preparing-engine", "Preparing the engine"));
    Canvas canvas = canvasFor(wanted.list, wanted.fit);
    made->beginning = wanted.beginning;
    made->content =
        std::make_shared<Playlist>(wanted.list, canvas, Attendance::attended, wanted.beginning.item);
    made->renderer = std::make_unique<TappedRenderer>(
        std::make_unique<EngineRenderer>(RendererSettings{wanted.calibration, canvas}, preparing,
                                         engine::FallbackBackend::Notify(),
                                         [host] { return std::move(*host); }),
        [tap](const std::vector<DrivePicture>& drives) { tap->put(drives); });
  });
  Q_EMIT changed();
}

void OutputProjection::opened() {
  if (job_.state() == Job::State::failed) Q_EMIT failed(job_.failure());
  if (job_.state() == Job::State::done && wanted_) {
    try {
      play();
    } catch (...) {
      close();
      Q_EMIT failed(failureOf(std::current_exception()));
    }
  }
  made_ = nullptr;
  Q_EMIT changed();
}

void OutputProjection::play() {
  engine_ = made_->renderer->name();
  canvas_ = made_->renderer->canvas();
  content_ = std::exchange(made_->content, nullptr);
  std::vector<ProjectorWindow*> windows;
  for (const std::optional<ScreenIdentity>& screen : screens_)
    windows.push_back(
        windows_.emplace_back(std::make_unique<ProjectorWindow>(screen.value_or(ScreenIdentity()))).get());
  for (ProjectorWindow* window : windows) window->takeKeysOnlyIfAlone();
  const bool isSeen = std::ranges::any_of(screens_, [](const auto& screen) { return screen.has_value(); });
  bool keepStep = std::all_of(windows.begin(), windows.end(),
                              [](const ProjectorWindow* window) { return window->surface().keepsStep(); });
  if (isSeen && !keepStep) engine_ = tr("%1, shown without OpenGL").arg(engine_);
  player_ = std::make_unique<Player>(std::move(made_->renderer), content_, windows);
  player_->setBlack(made_->beginning.isBlack);
  player_->setOverlay(made_->beginning.hasOverlay);
  // What these lead to ends the objects that tell it: later, when they are done telling.
  auto closeLater = [this] { QMetaObject::invokeMethod(this, [this] { close(); }, Qt::QueuedConnection); };
  // The player itself looks at the projectors' other keys.
  for (const auto& window : windows_)
    connect(window.get(), &ProjectorWindow::keyPressed, this, [this, closeLater](int key) {
      if (key == Qt::Key_Escape) closeLater();
      Q_EMIT changed();
    });
  connect(player_.get(), &Player::setFailed, this, [this](const std::string&, const Message& sentence) {
    Q_EMIT failed({ErrorKind::input, fullSentence(sentence), tr("The output goes on as before."),
                   QString::fromStdString(englishSentence(sentence))});
    Q_EMIT setRefused();
  });
  connect(player_.get(), &Player::failed, this, [this, closeLater](const Message& sentence) {
    closeLater();
    Q_EMIT failed({ErrorKind::device, fullSentence(sentence), tr("Open the output again."),
                   QString::fromStdString(englishSentence(sentence))});
  });
  if (isSeen) {
    awake_.emplace(tr("Relucent is projecting"));
    awake_->wakeDisplays();
  }
  for (std::size_t i = 0; i < windows_.size(); ++i)
    if (screens_[i]) windows_[i]->shine();
  player_->start();
  sampling_.start();
  if (!within_.isEmpty()) reflecting_.start();
}

void OutputProjection::sample() {
  PlayerStatistics now = statistics();
  // Of a picture that stands, the time of one is no frame's.
  frameTimes_.push_back(now.framesPerSecond > 0.0 ? 1000.0 * now.frameSeconds : 0.0);
  if (frameTimes_.size() > frameTimesKept) frameTimes_.pop_front();
  Q_EMIT progressed();
}

void OutputProjection::close() {
  wanted_ = false;
  sampling_.stop();
  reflecting_.stop();
  job_.cancel();
  if (player_) player_->stop();
  for (const auto& window : windows_) window->stop();
  player_ = nullptr;
  windows_.clear();
  content_ = nullptr;
  awake_.reset();
  tap_->put({});
  frameTimes_.clear();
  mirror_ = {};
  reflected_ = 0;
  Q_EMIT mirrored();
  Q_EMIT changed();
}

void OutputProjection::setList(const PlaylistSettings& list) {
  if (!isOpen()) return;
  content_ = std::make_shared<Playlist>(list, canvas_);
  player_->setContent(content_);
}

void OutputProjection::changeList(const PlaylistSettings& list) {
  if (!isOpen()) return;
  qsizetype first = content_->status().playing;
  if (first >= 0) {
    const PlaylistItem& playing = content_->settings().items[first];
    const bool isInPlace = first < list.items.size() && list.items[first] == playing;
    if (const qsizetype now = list.items.indexOf(playing); !isInPlace && now >= 0) first = now;
  }
  content_ = std::make_shared<Playlist>(list, canvas_, Attendance::attended, first);
  player_->setContent(content_);
}

void OutputProjection::setBlack(bool black) {
  if (player_) player_->setBlack(black);
  Q_EMIT changed();
}

void OutputProjection::setFrozen(bool frozen) {
  if (player_) player_->setFrozen(frozen);
  Q_EMIT changed();
}

void OutputProjection::setOverlay(bool overlay) {
  if (player_) player_->setOverlay(overlay);
  Q_EMIT changed();
}

void OutputProjection::nextChart() {
  if (player_) player_->handleKey(Qt::Key_T);
  Q_EMIT changed();
}

void OutputProjection::endChart() {
  if (player_) player_->setChart(std::nullopt);
  Q_EMIT changed();
}

void OutputProjection::setCompensated(bool compensated) {
  if (player_) player_->setCompensated(compensated);
  Q_EMIT changed();
}

qsizetype OutputProjection::playing() const {
  return isOpen() && content_ ? content_->status().playing : -1;
}

std::vector<Playlist::Skipped> OutputProjection::skipped() const {
  return isOpen() && content_ ? content_->status().skipped : std::vector<Playlist::Skipped>();
}

std::vector<LiveState> OutputProjection::live() const {
  return isOpen() && content_ ? content_->status().live : std::vector<LiveState>();
}

QImage OutputProjection::onProjector(std::size_t projector) const {
  if (!player_) return {};
  QImage drive = tap_->get(projector).image();
  if (isBlack() && !drive.isNull()) drive.fill(Qt::black);
  return drive;
}

void OutputProjection::mirrorProjector(std::size_t projector) {
  if (std::exchange(mirrored_, projector) == projector) return;
  mirror_ = {};
  reflected_ = 0;
  Q_EMIT mirrored();
}

void OutputProjection::watch(const QObject* view, QSize within) {
  // One that is hidden when another one is seen already says nothing of that.
  if (within.isEmpty() && view != view_) return;
  view_ = view;
  within_ = within;
  reflected_ = 0;
  if (isOpen() && !within_.isEmpty())
    reflecting_.start();
  else
    reflecting_.stop();
}

void OutputProjection::reflect() {
  if (scaling_.isBusy()) return;
  DrivePicture drive = tap_->get(mirrored_);
  if (drive.isNull()) return;
  bool black = isBlack();
  // A picture that stands is scaled once. Keys of pictures are positive.
  qint64 picture = black ? -drive.key() : drive.key();
  if (std::exchange(reflected_, picture) == picture) return;
  scaling_.ask([drive = std::move(drive), black, within = within_] {
    QSize size = drive.size();
    if (size.width() > within.width() || size.height() > within.height())
      size.scale(within, Qt::KeepAspectRatio);
    if (!black)
      return drive.image().scaled(size.expandedTo({1, 1}), Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    QImage dark(size.expandedTo({1, 1}), QImage::Format_RGB32);
    dark.fill(Qt::black);
    return dark;
  });
}

}  // namespace relucent::gui
