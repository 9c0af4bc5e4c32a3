// SPDX-License-Identifier: MIT
#include "desktop/cast_failure.h"

namespace relucent::gui {
namespace {

double secondsOf(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

NotChosen castRefused() {
  return {ErrorKind::input, RELUCENT_MESSAGE("cast.refused", "it was refused in the desktop's dialog"),
          RELUCENT_MESSAGE("cast.choose-again", "play it again, and choose there what is shown")};
}

NotChosen castUnanswered(bool chosenBefore) {
  return {
      ErrorKind::input,
      chosenBefore
          ? RELUCENT_MESSAGE("cast.choice-refused", "the desktop no longer gives what was chosen for it")
          : RELUCENT_MESSAGE("cast.not-chosen", "nobody has chosen in the desktop's dialog what is shown"),
      RELUCENT_MESSAGE("cast.choose-in-wizard",
                       "play it once in the wizard, on Output, and choose there; a show then takes the "
                       "same")};
}

Error castWithoutPortal() {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("cast.no-portal", "this desktop has no portal that gives the picture of a screen"),
          RELUCENT_MESSAGE("cast.install-portal",
                           "install xdg-desktop-portal and its part for this desktop, and log in again")};
}

Error castWithoutWindows() {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("cast.no-windows", "this desktop gives pictures of screens, not of windows"),
          RELUCENT_MESSAGE("cast.play-screen", "play the screen on which the window is")};
}

Error castPortalFailed(const QString& reason) {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("cast.portal-failed", "the desktop's portal gives no picture ({})")
              .with(reason.toStdString()),
          RELUCENT_MESSAGE("cast.log-in-again", "log in again")};
}

Error castPortalSilent(std::chrono::milliseconds waited) {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("cast.portal-silent", "the desktop's portal has not answered for {} s")
              .with(as::seconds(secondsOf(waited), as::digits(2))),
          RELUCENT_MESSAGE("cast.log-in-again", "log in again")};
}

Error castWithoutPipeWire() {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("cast.no-pipewire", "PipeWire, which brings the picture, does not answer"),
          RELUCENT_MESSAGE("cast.install-pipewire", "install pipewire and wireplumber, and log in again")};
}

Error castSilent(std::chrono::milliseconds waited) {
  return {ErrorKind::device,
          RELUCENT_MESSAGE("stream.silent", "no picture came within {} s")
              .with(as::seconds(secondsOf(waited), as::digits(2))),
          RELUCENT_MESSAGE("cast.install-pipewire", "install pipewire and wireplumber, and log in again")};
}

Error castEnded() {
  return {ErrorKind::device, RELUCENT_MESSAGE("cast.ended", "the desktop has ended it"),
          RELUCENT_MESSAGE("cast.check-screen", "see whether the screen is on, or the window open")};
}

Error castUnusable() {
  return {ErrorKind::format,
          RELUCENT_MESSAGE("cast.unusable", "what the desktop sends is no picture that can be shown"),
          RELUCENT_MESSAGE("cast.update-desktop", "update the desktop's portal and PipeWire")};
}

}  // namespace relucent::gui
