// SPDX-License-Identifier: MIT
#include "wizard/session/other_screens.h"

#include <QGuiApplication>
#include <QScreen>
#include <QThread>
#include <QWindow>
#include <algorithm>
#include <chrono>
#include <future>

#include "output/projector_window.h"
#include "output/window_projector.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/screen_devices.h"

namespace relucent::gui {
namespace {

/// Looks at whether the waiting thread is asked to end.
constexpr std::chrono::milliseconds patience(20);

/// What must stay as it is: the projectors' screens, and where the operator works.
std::vector<QRect> takenPlaces(const pipeline::ScreenRigSettings& projector) {
  std::vector<QRect> places;
  std::vector<const QScreen*> taken{QGuiApplication::primaryScreen()};
  for (const pipeline::ScreenRigSettings::Screen& own : pipeline::screensOf(projector))
    taken.push_back(findScreen(identityOf(own.display)));
  for (const QScreen* screen : taken)
    if (screen != nullptr) places.push_back(screen->geometry());
  for (const QWindow* window : QGuiApplication::topLevelWindows())
    if (window->isVisible() && qobject_cast<const ProjectorWindow*>(window) == nullptr)
      places.push_back(window->geometry());
  return places;
}

}  // namespace

std::vector<pipeline::ScreenRigSettings> otherScreens(const pipeline::ScreenRigSettings& projector) {
  const std::vector<QRect> taken = takenPlaces(projector);
  std::vector<pipeline::ScreenRigSettings> others;
  for (const QScreen* screen : QGuiApplication::screens()) {
    if (std::any_of(taken.begin(), taken.end(),
                    [screen](const QRect& place) { return place.intersects(screen->geometry()); }))
      continue;
    pipeline::ScreenRigSettings& other = others.emplace_back(pipeline::withScreenAlone(projector, 0));
    const QSize size = nativeSize(*screen);
    other.display = displayOf(*screen);
    other.projector = {size.width(), size.height()};
  }
  return others;
}

std::vector<pipeline::ScreenRigSettings> askForOtherScreens(const pipeline::ScreenRigSettings& projector) {
  auto asked = std::make_shared<std::promise<std::vector<pipeline::ScreenRigSettings>>>();
  std::future<std::vector<pipeline::ScreenRigSettings>> answer = asked->get_future();
  QMetaObject::invokeMethod(
      qApp, [asked, projector] { asked->set_value(otherScreens(projector)); }, Qt::QueuedConnection);
  while (answer.wait_for(patience) != std::future_status::ready)
    if (QThread::currentThread()->isInterruptionRequested()) throw Cancelled();
  return answer.get();
}

}  // namespace relucent::gui
