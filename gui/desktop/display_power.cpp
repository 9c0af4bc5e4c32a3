// SPDX-License-Identifier: MIT
#include "desktop/display_power.h"

#include <xcb/dpms.h>
#include <xcb/screensaver.h>
#include <xcb/xcb.h>

#include <QGuiApplication>

#include "desktop/xcb_reply.h"

namespace relucent::gui {
namespace {

constexpr std::uint8_t fromServer = 0x7f;  // of an event's kind: without the mark of those that clients send

bool isHidden(std::uint8_t saver) {
  return saver == XCB_SCREENSAVER_STATE_ON || saver == XCB_SCREENSAVER_STATE_CYCLE;
}

}  // namespace

/// A connection of its own: its events are nobody else's.
struct DisplayPower::Server {
  xcb_connection_t* x = xcb_connect(nullptr, nullptr);
  xcb_window_t root = XCB_NONE;
  bool hasDpms = false, hasSaver = false;
  std::uint8_t saverEvent = 0;

  Server() {
    if (!answers()) return;
    root = xcb_setup_roots_iterator(xcb_get_setup(x)).data->root;
    // To ask for an extension that is not there ends the connection.
    hasDpms = xcb_get_extension_data(x, &xcb_dpms_id)->present != 0;
    const xcb_query_extension_reply_t* saver = xcb_get_extension_data(x, &xcb_screensaver_id);
    hasSaver = saver->present != 0;
    if (!hasSaver) return;
    saverEvent = saver->first_event + XCB_SCREENSAVER_NOTIFY;
    xcb_screensaver_select_input(x, root, XCB_SCREENSAVER_EVENT_NOTIFY_MASK);
    xcb_flush(x);
  }
  ~Server() { xcb_disconnect(x); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  bool answers() const { return xcb_connection_has_error(x) == 0; }
  /// DPMS can be there and switched off: then the displays have their signal, and may not be told to.
  bool isWithoutSignal() const {
    if (!hasDpms) return false;
    auto power = owned(xcb_dpms_info_reply(x, xcb_dpms_info(x), nullptr));
    return power && power->state != 0 && power->power_level != XCB_DPMS_DPMS_MODE_ON;
  }
  bool isBlanked() const {
    if (!hasSaver) return false;
    auto saver = owned(xcb_screensaver_query_info_reply(x, xcb_screensaver_query_info(x, root), nullptr));
    return saver && isHidden(saver->state);
  }
  /// DPMS tells of itself here too: with the signal the server takes the picture away.
  bool reportedSleep() {
    bool told = false;
    while (auto event = owned(xcb_poll_for_event(x)))
      if ((event->response_type & fromServer) == saverEvent && hasSaver)
        told |= isHidden(reinterpret_cast<xcb_screensaver_notify_event_t*>(event.get())->state);
    return told;
  }
};

DisplayPower::DisplayPower() {
  if (QGuiApplication::platformName() != "xcb") return;
  server_ = std::make_unique<Server>();
  if (!server_->answers()) server_.reset();
}

DisplayPower::~DisplayPower() = default;

DisplayPower::State DisplayPower::state() const {
  if (!server_ || !server_->answers()) return State::unknown;
  return server_->isWithoutSignal() || server_->isBlanked() ? State::asleep : State::awake;
}

QString DisplayPower::problem() const {
  return state() == State::unknown
             ? "there is no X server to tell whether the displays are awake: have them never sleep, in the "
               "desktop's settings"
             : QString();
}

bool DisplayPower::hasSlept() {
  const bool sleeps = state() == State::asleep;  // and all events of before have arrived
  return (server_ && server_->reportedSleep()) || sleeps;
}

void DisplayPower::wake() {
  if (!server_) return;
  if (server_->isWithoutSignal()) xcb_dpms_force_level(server_->x, XCB_DPMS_DPMS_MODE_ON);
  xcb_force_screen_saver(server_->x, XCB_SCREEN_SAVER_RESET);
  xcb_flush(server_->x);
}

void DisplayPower::keepAwake() {
  if (!server_ || !server_->hasSaver) return;
  xcb_screensaver_suspend(server_->x, 1);
  xcb_flush(server_->x);
}

}  // namespace relucent::gui
