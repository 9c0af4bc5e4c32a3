// SPDX-License-Identifier: MIT
#include "wizard/output_page.h"

#include <QGuiApplication>
#include <QMutex>
#include <QScreen>

#include "content/still_image.h"
#include "wizard/preview_page.h"

namespace relucent {
namespace {

/// A canvas of the picture's shape, so that it lies where Preview has put it; larger than this it would only
/// be slower.
constexpr QSize largestCanvas(1920, 1080);

Canvas canvasOf(const QImage& picture) {
  QSize size = picture.size();
  if (size.width() > largestCanvas.width() || size.height() > largestCanvas.height())
    size.scale(largestCanvas, Qt::KeepAspectRatio);
  return {size.expandedTo({1, 1}), Fit::fill};
}

QImage pictureOf(const ContentSettings& settings) {
  if (settings.picture.empty()) return QImage(ownPicture()).convertToFormat(QImage::Format_RGBX8888);
  return readContent(QString::fromStdString(settings.picture));
}

}  // namespace

/// What a player needs, made on another thread.
struct OutputPage::Made {
  std::unique_ptr<FrameRenderer> renderer;
  std::shared_ptr<ContentSource> content;
};

/// Keeps a copy of what went to the first projector, for the operator to see.
class OutputPage::Tap {
 public:
  void put(const QImage& drive) {
    QMutexLocker lock(&guard_);
    drive_ = drive;
  }
  QImage get() const {
    QMutexLocker lock(&guard_);
    return drive_;
  }

 private:
  mutable QMutex guard_;
  QImage drive_;
};

namespace {

/// A renderer that lets somebody look on.
class Tapped : public FrameRenderer {
 public:
  Tapped(std::unique_ptr<FrameRenderer> renderer, std::function<void(const QImage&)> see)
      : renderer_(std::move(renderer)), see_(std::move(see)) {}
  std::vector<QSize> projectors() const override { return renderer_->projectors(); }
  Canvas canvas() const override { return renderer_->canvas(); }
  QString name() const override { return renderer_->name(); }
  RenderedFrame render(const ContentPicture& content, const RenderRequest& request) override {
    RenderedFrame frame = renderer_->render(content, request);
    if (!frame.drives.empty()) see_(frame.drives.front());
    return frame;
  }

 private:
  std::unique_ptr<FrameRenderer> renderer_;
  std::function<void(const QImage&)> see_;
};

}  // namespace

OutputPage::OutputPage(Session& session, QObject* parent)
    : PageModel(parent), session_(session), tap_(std::make_shared<Tap>()) {
  connect(&session_, &Session::opened, this, [this] { close(); });
  connect(&session_, &Session::changed, this, &OutputPage::changed);
  connect(&job_, &Job::progressed, this, &OutputPage::changed);
  connect(&job_, &Job::ended, this, &OutputPage::opened);
  connect(qApp, &QGuiApplication::screenAdded, this, &OutputPage::listScreens);
  connect(qApp, &QGuiApplication::screenRemoved, this, &OutputPage::listScreens);
  often_.setInterval(500);
  connect(&often_, &QTimer::timeout, this, &OutputPage::changed);
  listScreens();
}

OutputPage::~OutputPage() {
  close();
}

void OutputPage::listScreens() {
  std::optional<ScreenIdentity> before;
  if (chosen_) before = screens_[*chosen_].identity;
  screens_.clear();
  chosen_.reset();
  for (QScreen* screen : QGuiApplication::screens())
    screens_.push_back(
        {identityOf(*screen), nativeSize(*screen), screen == QGuiApplication::primaryScreen()});
  for (std::size_t i = 0; i < screens_.size(); ++i)
    if ((before && screens_[i].identity == *before) || (!before && !chosen_ && !screens_[i].operators))
      chosen_ = i;
  Q_EMIT changed();
}

void OutputPage::choose(std::size_t index) {
  if (isOpen()) close();
  chosen_ = index;
  Q_EMIT changed();
}

void OutputPage::enter() {
  listScreens();
}

StepStatus OutputPage::status() const {
  if (isOpen()) return {StepState::busy, isBlack() ? tr("Black") : isFrozen() ? tr("Frozen") : tr("Playing")};
  return {};
}

QString OutputPage::hint() const {
  if (job_.isRunning()) return job_.stage();
  if (screens_.size() < 2 && !isOpen())
    return tr("There is one screen only. The output will cover it; Esc closes the output.");
  if (!chosen_) return tr("Choose the projector's screen.");
  if (isOpen()) return tr("Playing. At the projector, C compares, space freezes, B is black, Esc closes.");
  return tr("Nothing is projected before you open the output.");
}

Command OutputPage::primary() const {
  auto* self = const_cast<OutputPage*>(this);
  if (isOpen()) return {tr("Close output"), Icon::stop, true, {}, [self] { self->close(); }};
  return {tr("Open output"),
          Icon::play,
          chosen_.has_value() && !job_.isRunning() && session_.busy().isEmpty(),
          {},
          [self] { self->open(); }};
}

std::vector<Command> OutputPage::secondary() const {
  auto* self = const_cast<OutputPage*>(this);
  if (!isOpen()) return {};
  return {{isFrozen() ? tr("Play") : tr("Freeze"), isFrozen() ? Icon::play : Icon::pause, true,
           QKeySequence("Ctrl+P"), [self] { self->setFrozen(!self->isFrozen()); }},
          {isBlack() ? tr("Show again") : tr("Black"), Icon::black, true, QKeySequence("Ctrl+B"),
           [self] { self->setBlack(!self->isBlack()); }}};
}

std::optional<double> OutputPage::progress() const {
  return job_.isRunning() ? std::optional(job_.fraction()) : std::nullopt;
}

void OutputPage::open() {
  if (isOpen() || job_.isRunning() || !chosen_) return;
  wanted_ = true;
  made_ = std::make_shared<Made>();
  job_.start([made = made_, tap = tap_, path = session_.path(),
              settings = session_.settings().content](Progress& progress) {
    Progress preparing = progress.part(1.0, tr("Preparing the engine").toStdString());
    QImage picture = pictureOf(settings);
    Canvas canvas = canvasOf(picture);
    made->content = std::make_shared<StillImage>(onCanvas(picture, canvas), canvas);
    auto engine = std::make_unique<EngineRenderer>(path, canvas, false, preparing);
    made->renderer =
        std::make_unique<Tapped>(std::move(engine), [tap](const QImage& drive) { tap->put(drive); });
  });
  Q_EMIT changed();
}

void OutputPage::opened() {
  if (job_.state() == Job::State::failed)
    Q_EMIT failed({job_.failure(), tr("The calibration is as it was."), {}, {}});
  if (job_.state() == Job::State::done && chosen_ && wanted_) {
    try {
      engine_ = made_->renderer->name();
      window_ = std::make_unique<ProjectorWindow>(screens_[*chosen_].identity);
      player_ = std::make_unique<Player>(std::move(made_->renderer), made_->content,
                                         std::vector<ProjectorWindow*>{window_.get()});
      connect(window_.get(), &ProjectorWindow::keyPressed, this, [this](int key) {
        if (key == Qt::Key_Escape)
          QMetaObject::invokeMethod(
              this, [this] { close(); }, Qt::QueuedConnection);
        else
          player_->handleKey(key);
        Q_EMIT changed();
      });
      connect(player_.get(), &Player::failed, this, [this](const QString& sentence) {
        QMetaObject::invokeMethod(
            this, [this] { close(); }, Qt::QueuedConnection);
        Q_EMIT failed({{ErrorKind::device, sentence, tr("Open the output again."), sentence},
                       tr("The calibration is as it was."),
                       {},
                       {}});
      });
      connect(player_.get(), &Player::shown, this, &OutputPage::changed);
      awake_.emplace(tr("Relucent is projecting"));
      window_->shine();
      player_->start();
      often_.start();
    } catch (...) {
      close();
      Q_EMIT failed({failureOf(std::current_exception()), tr("The calibration is as it was."), {}, {}});
    }
  }
  made_ = nullptr;
  Q_EMIT changed();
}

void OutputPage::close() {
  wanted_ = false;
  often_.stop();
  job_.cancel();
  if (player_) player_->stop();
  if (window_) window_->stop();
  player_ = nullptr;
  window_ = nullptr;
  awake_.reset();
  tap_->put({});
  Q_EMIT changed();
}

void OutputPage::setBlack(bool black) {
  if (player_) player_->setBlack(black);
  Q_EMIT changed();
}

void OutputPage::setFrozen(bool frozen) {
  if (player_) player_->setFrozen(frozen);
  Q_EMIT changed();
}

void OutputPage::setCompensated(bool compensated) {
  if (player_) player_->setCompensated(compensated);
  Q_EMIT changed();
}

QImage OutputPage::onProjector() const {
  if (!player_) return {};
  QImage drive = tap_->get();
  if (isBlack() && !drive.isNull()) drive.fill(Qt::black);
  return drive;
}

}  // namespace relucent
