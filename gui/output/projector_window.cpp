// SPDX-License-Identifier: MIT
#include "output/projector_window.h"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QScreen>
#include <algorithm>
#include <chrono>
#include <utility>

namespace relucent::gui {
namespace {

/// Between two pictures of a display.
std::chrono::milliseconds refreshOf(const QScreen* screen) {
  const double rate = screen->refreshRate() > 1.0 ? screen->refreshRate() : 60.0;
  return std::chrono::ceil<std::chrono::milliseconds>(std::chrono::duration<double>(1.0 / rate));
}

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
    : QWindow(parent), display_(std::move(display)), surface_(surfaceFor(*this)) {
  setFlags(Qt::Window | Qt::FramelessWindowHint | Qt::WindowStaysOnTopHint);
  setCursor(Qt::BlankCursor);
  setTitle(display_.connector);
  refreshing_.setTimerType(Qt::PreciseTimer);
  refreshing_.setSingleShot(true);
  connect(&refreshing_, &QTimer::timeout, this, &ProjectorWindow::drawn);
  connect(qGuiApp, &QGuiApplication::screenRemoved, this, &ProjectorWindow::screenGone);
  connect(qGuiApp, &QGuiApplication::screenAdded, this, &ProjectorWindow::screenCame);
}

ProjectorWindow::~ProjectorWindow() = default;

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
  if (QScreen* screen = findScreen(display_)) goTo(screen);
}

void ProjectorWindow::stop() {
  wanted_ = false;
  on_ = nullptr;
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
  on_ = nullptr;
  hide();
  Q_EMIT displayLost();
}

void ProjectorWindow::screenCame() {
  if (!wanted_ || on_ != nullptr) return;
  QScreen* screen = findScreen(display_);
  if (screen == nullptr) return;
  goTo(screen);
  Q_EMIT displayFound();
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
  surface_->draw(picture_, overlay_);
  if (!surface_->keepsStep()) return refreshing_.start(refreshOf(screen()));
  Q_EMIT frameSwapped();
}

/// The display has shown all of what was drawn last.
void ProjectorWindow::drawn() {
  if (fresh_) return draw();
  Q_EMIT frameSwapped();
}

void ProjectorWindow::keyPressEvent(QKeyEvent* event) {
  Q_EMIT keyPressed(event->key(), event->modifiers());
}

}  // namespace relucent::gui
