// SPDX-License-Identifier: MIT
#include "output/window_projector.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QMutex>
#include <QThread>
#include <QTimer>
#include <QWaitCondition>
#include <cmath>

#include "desktop/awake.h"
#include "desktop/wayland_window.h"
#include "output/projector_window.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(WindowProjector)
};

/// Looks at whether the waiting thread is asked to end, milliseconds.
constexpr int patience = 20;
/// A screen may have another size for so long, milliseconds.
constexpr qint64 longestChange = 2000;
/// And be asleep for so many times as long as it needs to wake.
constexpr int longestSleep = 4;
/// The desktop may put the window elsewhere for so long, milliseconds: some tries.
constexpr qint64 longestStray = 8000;
/// Swaps after the window came up until it is believed to stand where it should: desktops move it about.
constexpr int swapsUntilSettled = 3;

QImage driveOf(const image::Image& encodedDrive) {
  QImage drive(encodedDrive.width(), encodedDrive.height(), QImage::Format_RGB32);
  auto code = [&](int x, int y, int c) {
    return static_cast<int>(std::lround(255.0f * std::clamp(encodedDrive.at(x, y, c), 0.0f, 1.0f)));
  };
  for (int y = 0; y < drive.height(); ++y) {
    auto* line = reinterpret_cast<QRgb*>(drive.scanLine(y));
    for (int x = 0; x < drive.width(); ++x) line[x] = qRgb(code(x, y, 0), code(x, y, 1), code(x, y, 2));
  }
  return drive;
}

/// Returns once the display server has done all that this program asked it to, and has told what it knows:
/// reading a pixel is an answer that comes after all of that.
void syncWithDisplayServer(QScreen* screen) {
  if (screen != nullptr && QGuiApplication::platformName() == "xcb") screen->grabWindow(0, 0, 0, 1, 1);
}

}  // namespace

ScreenIdentity identityOf(const pipeline::ScreenRigSettings::Display& display) {
  return {QString::fromStdString(display.connector), QString::fromStdString(display.manufacturer),
          QString::fromStdString(display.model), QString::fromStdString(display.serialNumber)};
}

pipeline::ScreenRigSettings::Display displayOf(const QScreen& screen) {
  const ScreenIdentity identity = identityOf(screen);
  return {identity.connector.toStdString(), identity.manufacturer.toStdString(), identity.model.toStdString(),
          identity.serialNumber.toStdString()};
}

QString unusableReason(const QScreen& screen) {
  if (canBeExactOn(screen)) return {};
  const double scale = static_cast<double>(nativeSize(screen).width()) / screen.geometry().width();
  return Translated::tr(
             "The desktop scales this screen by %1, which blurs every pixel. Set its scale to 100 %.")
      .arg(QString::number(scale, 'g', 3));
}

/// What the two threads tell each other.
struct WindowProjector::Shared {
  QMutex guard;
  QWaitCondition told;
  quint64 asked = 0;     // number of the last picture that was asked for
  quint64 out = 0;       // and of the last that came out
  bool stands = false;   // the last one, ever since
  quint64 answered = 0;  // questions
  QSize wrongSize;       // of the screen, if it is not the projector's
  QString elsewhere;     // the screen where the desktop puts the window instead
  bool asleep = false;   // the display
};

/// The window's side. All but the constructor runs on the interface's thread.
class WindowProjector::Stage : public QObject {
 public:
  Stage(ScreenIdentity display, QSize size, std::shared_ptr<Shared> shared, std::function<void(bool)> waiting,
        std::chrono::milliseconds waking)
      : display_(std::move(display)),
        size_(size),
        shared_(std::move(shared)),
        waiting_(std::move(waiting)),
        waking_(waking) {}
  /// Nobody waits any more, wherever the screen is.
  ~Stage() override { reportWaiting(false); }

  void present(quint64 number, const QImage& drive) {
    if (!window_) build();
    asked_ = number;
    if (!window_->isShining()) shownAgain();
    wake();
    window_->present(drive);
    if (!window_->isShining()) window_->shine();
    reportWaiting(!window_->isShining());
  }

  /// Answers after all that the display server knew when it was asked.
  void answer(quint64 question) {
    syncWithDisplayServer(window_ ? window_->screen() : nullptr);
    if (awake_ && wake()) broken();
    QTimer::singleShot(0, this, [this, question] {
      QMutexLocker lock(&shared_->guard);
      shared_->answered = question;
      shared_->told.wakeAll();
    });
  }

  void rest() {
    if (window_) window_->stop();
    awake_.reset();
    reportWaiting(false);
    broken();
  }

 private:
  void build() {
    window_ = std::make_unique<ProjectorWindow>(display_);
    // Whoever measures goes on working in another window.
    window_->setFlag(Qt::WindowDoesNotAcceptFocus);
    window_->comeFirst();
    connect(window_.get(), &ProjectorWindow::frameSwapped, this, [this] { swapped(); });
    connect(window_.get(), &ProjectorWindow::displayLost, this, [this] {
      broken();
      setElsewhere(window_->elsewhere());
      reportWaiting(true);
    });
    connect(window_.get(), &ProjectorWindow::displayFound, this, [this] {
      setElsewhere({});
      shownAgain();
    });
    connect(window_.get(), &ProjectorWindow::displayChanged, this, [this] {
      broken();
      shownAgain();
      window_->update();
    });
  }

  void shownAgain() {
    swaps_ = 0;
    if (!awake_) awake_ = std::make_unique<Awake>(Translated::tr("A venue is being measured"));
  }

  /// Wakes displays that are asleep or have been since this was asked last: whether there were any.
  bool wake() {
    const bool slept = awake_->wakeDisplays();
    if (slept) woken_.start();
    QMutexLocker lock(&shared_->guard);
    shared_->asleep = slept;
    return slept;
  }

  /// Whether light is back after displays were woken.
  bool isAwake() { return !wake() && (!woken_.isValid() || woken_.hasExpired(waking_.count())); }

  /// Of another size than the projector's nothing is pixel for pixel.
  bool hasWrongSize() {
    const QSize now = window_->displaySize();
    const bool wrong = !now.isEmpty() && now != size_;
    QMutexLocker lock(&shared_->guard);
    shared_->wrongSize = wrong ? now : QSize();
    return wrong;
  }

  void swapped() {
    QScreen* screen = findScreen(display_);
    if (!window_->isShining() || !window_->isExposed() || screen == nullptr ||
        window_->geometry() != screen->geometry())
      return;
    if (hasWrongSize()) return;
    if (!isAwake()) {
      swaps_ = 0;
      QTimer::singleShot(patience, window_.get(), [this] { window_->update(); });
      return;
    }
    if (++swaps_ < swapsUntilSettled) return window_->update();
    syncWithDisplayServer(screen);
    reportWaiting(false);
    QMutexLocker lock(&shared_->guard);
    if (shared_->out == asked_) return;  // what came back after it was lost does not stand "ever since"
    shared_->out = asked_;
    shared_->stands = true;
    shared_->told.wakeAll();
  }

  void setElsewhere(const QString& screen) {
    QMutexLocker lock(&shared_->guard);
    shared_->elsewhere = screen;
  }

  void broken() {
    QMutexLocker lock(&shared_->guard);
    shared_->stands = false;
  }

  void reportWaiting(bool waits) {
    if (std::exchange(waits_, waits) != waits && waiting_) waiting_(waits);
  }

  ScreenIdentity display_;
  QSize size_;
  std::shared_ptr<Shared> shared_;
  std::function<void(bool)> waiting_;
  std::chrono::milliseconds waking_;
  QElapsedTimer woken_;  // invalid: the displays were awake from the beginning
  std::unique_ptr<ProjectorWindow> window_;
  std::unique_ptr<Awake> awake_;
  quint64 asked_ = 0;
  int swaps_ = 0;
  bool waits_ = false;
};

WindowProjector::WindowProjector(ScreenIdentity display, Size size, std::function<void(bool)> waiting,
                                 std::chrono::milliseconds waking)
    : name_((display.model.isEmpty() ? display.connector : display.model + " (" + display.connector + ")")
                .toStdString()),
      size_(size),
      waking_(waking),
      shared_(std::make_shared<Shared>()),
      stage_(new Stage(std::move(display), {size.width, size.height}, shared_, std::move(waiting), waking)) {
  stage_->moveToThread(qGuiApp->thread());
}

WindowProjector::~WindowProjector() {
  if (QThread::currentThread() == stage_->thread())
    delete stage_;
  else
    stage_->deleteLater();
}

template <typename Done>
void WindowProjector::waitFor(Done done) {
  require(QThread::currentThread() != stage_->thread(), "the interface would wait for itself");
  // Desktops pass through other sizes when a screen is plugged in, and displays take their time to wake.
  QElapsedTimer wrong, asleep, elsewhere;
  auto lasts = [](QElapsedTimer& timer, bool holds, qint64 longest) {
    if (!holds)
      timer.invalidate();
    else if (!timer.isValid())
      timer.start();
    return timer.isValid() && timer.hasExpired(longest);
  };
  QMutexLocker lock(&shared_->guard);
  while (!done()) {
    if (QThread::currentThread()->isInterruptionRequested()) throw Cancelled();
    if (lasts(wrong, !shared_->wrongSize.isEmpty(), longestChange))
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("show.screen-size-changed",
                           "the projector's screen has {} pixels now and {} were calibrated")
              .with(as::size(shared_->wrongSize.width(), shared_->wrongSize.height()), as::size(size_)),
          RELUCENT_MESSAGE("show.restore-resolution",
                           "set its resolution back in the desktop's settings, then try again"),
          name_);
    if (lasts(asleep, shared_->asleep, longestSleep * waking_.count()))
      throw Error(
          ErrorKind::device,
          RELUCENT_MESSAGE("show.screen-asleep", "the projector's screen is asleep and does not wake"),
          RELUCENT_MESSAGE(
              "show.switch-off-power-saving",
              "switch off its power saving and the screen saver in the desktop's settings, then try again"),
          name_);
    if (lasts(elsewhere, !shared_->elsewhere.isEmpty(), longestStray))
      throw Error(ErrorKind::device,
                  RELUCENT_MESSAGE("show.window-elsewhere",
                                   "the desktop puts the projector's picture on the screen {} instead")
                      .with(shared_->elsewhere.toStdString()),
                  RELUCENT_MESSAGE(
                      "show.no-xwayland",
                      "in a Wayland session, take QT_QPA_PLATFORM=xcb out of the environment; else take away "
                      "the desktop's rules for windows of Relucent, then try again"),
                  name_);
    shared_->told.wait(&shared_->guard, patience);
  }
}

void WindowProjector::show(const image::Image& encodedDrive) {
  require(encodedDrive.size() == size_ && encodedDrive.channels() == 3,
          "a picture of {}x{} pixels for a projector of {}x{}", encodedDrive.width(), encodedDrive.height(),
          size_.width, size_.height);
  quint64 number = 0;
  {
    QMutexLocker lock(&shared_->guard);
    number = ++shared_->asked;
    shared_->stands = false;
    shared_->wrongSize = QSize();
  }
  QMetaObject::invokeMethod(
      stage_, [stage = stage_, number, drive = driveOf(encodedDrive)] { stage->present(number, drive); },
      Qt::QueuedConnection);
  waitFor([&] { return shared_->out >= number; });
}

bool WindowProjector::stayedVisible() {
  quint64 question = 0;
  {
    QMutexLocker lock(&shared_->guard);
    question = ++shared_->asked;
  }
  QMetaObject::invokeMethod(
      stage_, [stage = stage_, question] { stage->answer(question); }, Qt::QueuedConnection);
  bool stands = false;
  waitFor([&] {
    stands = shared_->stands;
    return shared_->answered >= question;
  });
  return stands;
}

void WindowProjector::rest() {
  QMetaObject::invokeMethod(stage_, [stage = stage_] { stage->rest(); }, Qt::QueuedConnection);
}

}  // namespace relucent::gui
