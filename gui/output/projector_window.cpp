// SPDX-License-Identifier: MIT
#include "output/projector_window.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QScreen>
#include <algorithm>
#include <chrono>
#include <utility>

#include "desktop/window_place.h"

namespace relucent::gui {
namespace {

/// Between two pictures of a display.
std::chrono::milliseconds refreshOf(const QScreen* screen) {
  const double rate = screen->refreshRate() > 1.0 ? screen->refreshRate() : 60.0;
  return std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(1.0 / rate));
}

/// A window that was seen for so many swaps stands where it will: desktops move it about at first.
constexpr int swapsUntilBelieved = 3;
/// And may take so long to get there, milliseconds.
constexpr qint64 longestWay = 1000;
/// Elsewhere, it tries again after so many seconds, then twice as many, up to the last of these.
constexpr int firstRetry = 2, lastRetry = 60;

/// Windows that are operated stand on that screen.
bool hidesWindows(const QScreen* screen) {
  const QWindowList windows = QGuiApplication::topLevelWindows();
  return std::any_of(windows.begin(), windows.end(), [screen](const QWindow* window) {
    return window->isVisible() && window->screen() == screen &&
           qobject_cast<const ProjectorWindow*>(window) == nullptr;
  });
}

}  // namespace

ProjectorWindow::ProjectorWindow(ScreenIdentity display, QWindow* parent)
    : QWindow(parent), display_(std::move(display)), onWayland_(*this), surface_(surfaceFor(*this)) {
  setFlags(Qt::Window | Qt::FramelessWindowHint | Qt::WindowStaysOnTopHint);
  setCursor(Qt::BlankCursor);
  setTitle(display_.connector);
  refreshing_.setTimerType(Qt::PreciseTimer);
  refreshing_.setSingleShot(true);
  connect(&refreshing_, &QTimer::timeout, this, &ProjectorWindow::drawn);
  returning_.setSingleShot(true);
  connect(&returning_, &QTimer::timeout, this, &ProjectorWindow::screenCame);
  connect(this, &QWindow::screenChanged, this, &ProjectorWindow::look);
  connect(qGuiApp, &QGuiApplication::screenRemoved, this, &ProjectorWindow::screenGone);
  connect(qGuiApp, &QGuiApplication::screenAdded, this, &ProjectorWindow::screenCame);
}

ProjectorWindow::~ProjectorWindow() {
  wanted_ = false;
  letOthersCome();
}

void ProjectorWindow::takeKeysOnlyIfAlone() {
  setFlag(Qt::WindowDoesNotAcceptFocus, !hidesWindows(findScreen(display_)));
}

bool ProjectorWindow::isTaken(const ScreenIdentity& display) {
  const QScreen* screen = findScreen(display);
  const QWindowList windows = QGuiApplication::topLevelWindows();
  return std::any_of(windows.begin(), windows.end(), [screen](const QWindow* window) {
    const auto* projector = qobject_cast<const ProjectorWindow*>(window);
    return projector != nullptr && projector->isShining() && projector->on_ == screen;
  });
}

void ProjectorWindow::shine() {
  wanted_ = true;
  QScreen* screen = findScreen(display_);
  if (screen != nullptr && !waitsFor(screen)) goTo(screen);
}

void ProjectorWindow::stop() {
  wanted_ = lost_ = false;
  returning_.stop();
  returns_ = 0;
  vanish();
  letOthersCome();
}

bool ProjectorWindow::waitsFor(const QScreen* screen) const {
  const QWindowList windows = QGuiApplication::topLevelWindows();
  return !isFirst_ && std::any_of(windows.begin(), windows.end(), [screen](const QWindow* window) {
    const auto* other = qobject_cast<const ProjectorWindow*>(window);
    return other != nullptr && other->isFirst_ && other->wanted_ && findScreen(other->display_) == screen;
  });
}

/// Whatever waited for this one, which is not wanted any more.
void ProjectorWindow::letOthersCome() {
  if (!isFirst_) return;
  for (QWindow* window : QGuiApplication::topLevelWindows())
    if (auto* other = qobject_cast<ProjectorWindow*>(window); other != nullptr && other != this)
      other->screenCame();
}

void ProjectorWindow::vanish() {
  on_ = nullptr;
  onWayland_.forget();
  hide();
}

bool ProjectorWindow::isShining() const {
  return on_ != nullptr && isVisible();
}

QSize ProjectorWindow::displaySize() const {
  const QScreen* screen = findScreen(display_);
  return screen ? nativeSize(*screen) : QSize();
}

void ProjectorWindow::present(const DrivePicture& drive, const QImage& overlay) {
  picture_ = drive;
  overlay_ = overlay;
  update();
}

void ProjectorWindow::blacken() {
  present({});
}

void ProjectorWindow::goTo(QScreen* screen) {
  on_ = screen;
  doubt();
  connect(screen, &QScreen::geometryChanged, this, &ProjectorWindow::follow, Qt::UniqueConnection);
  setScreen(screen);
  setGeometry(screen->geometry());
  // showFullScreen() would ask for the keys, too.
  setWindowStates(Qt::WindowFullScreen);
  setVisible(true);
  if (!flags().testFlag(Qt::WindowDoesNotAcceptFocus)) requestActivate();
  update();
}

void ProjectorWindow::follow() {
  if (on_ == nullptr || geometry() == on_->geometry()) return;
  setGeometry(on_->geometry());
  Q_EMIT displayChanged();
}

void ProjectorWindow::screenGone(QScreen* screen) {
  if (screen != on_) return;
  elsewhere_.clear();
  lost_ = true;
  vanish();
  Q_EMIT displayLost();
}

void ProjectorWindow::screenCame() {
  if (!wanted_ || on_ != nullptr) return;
  QScreen* screen = findScreen(display_);
  if (screen == nullptr || waitsFor(screen)) return;
  returning_.stop();
  goTo(screen);
}

bool ProjectorWindow::stands() const {
  return standsOn(*this, *on_, {on_->geometry().topLeft(), nativeSize(*on_)});
}

/// The desktop may have moved it.
void ProjectorWindow::look() {
  if (on_ == nullptr || !proven_ || stands()) return;
  doubt();
  update();
}

void ProjectorWindow::doubt() {
  proven_ = false;
  swaps_ = 0;
  doubted_.start();
}

/// After each swap of black.
void ProjectorWindow::prove() {
  if (on_ == nullptr) return;
  if (++swaps_ < swapsUntilBelieved) return update();
  if (!stands()) return doubted_.hasExpired(longestWay) ? leave() : update();
  proven_ = true;
  returns_ = 0;
  elsewhere_.clear();
  if (std::exchange(lost_, false)) Q_EMIT displayFound();
  update();
}

void ProjectorWindow::leave() {
  elsewhere_ = screen() != nullptr && screen() != on_ ? screen()->name() : QString("?");
  lost_ = true;
  vanish();
  returning_.start(std::chrono::seconds(std::min(lastRetry, firstRetry << std::min(returns_++, 10))));
  Q_EMIT displayLost();
}

void ProjectorWindow::update() {
  fresh_ = true;
  if (isExposed()) requestUpdate();
}

bool ProjectorWindow::event(QEvent* event) {
  if (event->type() != QEvent::UpdateRequest) return QWindow::event(event);
  draw();
  return true;
}

void ProjectorWindow::exposeEvent(QExposeEvent*) {
  draw();
}

void ProjectorWindow::draw() {
  fresh_ = true;
  if (!isExposed() || refreshing_.isActive()) return;
  fresh_ = false;
  onWayland_.prepare();
  if (proven_)
    surface_->draw(picture_, overlay_);
  else
    surface_->draw({}, {});
  if (!surface_->keepsStep()) return refreshing_.start(refreshOf(screen()));
  drawn();
}

/// The display has shown all of what was drawn last.
void ProjectorWindow::drawn() {
  if (!proven_) return prove();
  if (fresh_) return draw();
  Q_EMIT frameSwapped();
}

void ProjectorWindow::moveEvent(QMoveEvent*) {
  look();
}

void ProjectorWindow::resizeEvent(QResizeEvent*) {
  look();
}

void ProjectorWindow::keyPressEvent(QKeyEvent* event) {
  Q_EMIT keyPressed(event->key(), event->modifiers());
}

void ProjectorWindow::mousePressEvent(QMouseEvent* event) {
  mouse_ = event->position();
}

void ProjectorWindow::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  const QPointF by = event->position() - std::exchange(mouse_, event->position());
  Q_EMIT dragged(by.x() / width(), -by.y() / height());
}

}  // namespace relucent::gui
