// SPDX-License-Identifier: MIT
// Which screen Output shines on, and what that is to the calibration.
#include <QGuiApplication>
#include <QScreen>
#include <utility>

#include "output/window_projector.h"
#include "wizard/output_page.h"
#include "wizard/screen_choice.h"

namespace relucent {

void OutputPage::listScreens() {
  std::optional<ScreenIdentity> before;
  if (chosen_) before = screens_[*chosen_].identity;
  screens_.clear();
  chosen_.reset();
  for (QScreen* screen : QGuiApplication::screens())
    screens_.push_back(
        {identityOf(*screen), nativeSize(*screen), screen == QGuiApplication::primaryScreen()});
  for (std::size_t i = 0; i < screens_.size(); ++i)
    if (before && screens_[i].identity == *before) chosen_ = i;
  // What was chosen and went away may come back: no other shines in its place.
  if (!chosen_ && (!before || session_.screenRig() != nullptr)) chosen_ = usualScreen();
  Q_EMIT changed();
}

/// The one that was measured, and no other in its place; where none was, one that nobody works at.
std::optional<std::size_t> OutputPage::usualScreen() const {
  if (const ScreenRigSettings* measured = session_.screenRig()) {
    QList<ScreenIdentity> present;
    for (const OutputScreen& screen : screens_) present << screen.identity;
    return findScreen(identityOf(measured->display), present);
  }
  for (std::size_t i = 0; i < screens_.size(); ++i)
    if (!screens_[i].operators) return i;
  return std::nullopt;
}

void OutputPage::choose(std::size_t index) {
  if (isOpen()) close();
  chosen_ = index;
  keepScreen();
  Q_EMIT changed();
}

/// The calibration was given another screen, here or at Venue.
void OutputPage::followScreen() {
  const ScreenRigSettings* screen = session_.screenRig();
  const ScreenIdentity now = screen != nullptr ? identityOf(screen->display) : ScreenIdentity();
  if (std::exchange(screenBefore_, now) == now || screen == nullptr) return;
  if (chosen_ && screens_[*chosen_].identity == now) return;
  close();
  chosen_.reset();
  listScreens();
}

void OutputPage::keepScreen() {
  const ScreenRigSettings* before = session_.screenRig();
  if (before == nullptr || !session_.busy().isEmpty()) return;
  for (const ScreenChoice& choice : screenChoicesFor(before->projector)) {
    if (!choice.refusal.isEmpty() || identityOf(choice.display) != screens_[*chosen_].identity) continue;
    if (choice.display == before->display) return;
    try {
      session_.changeScreen(withScreen(*before, choice));
    } catch (...) {
      tell(failureOf(std::current_exception()));
    }
    return;
  }
}

QString OutputPage::meaningOfScreen() const {
  const ScreenRigSettings* now = session_.screenRig();
  return now != nullptr ? meaningOfMove(session_.measuredDisplay(), now->display) : QString();
}

QString OutputPage::screenHint() const {
  if (const ScreenRigSettings* measured = session_.screenRig(); measured != nullptr)
    return tr("The projector's screen %1 is not there. Plug it in, or choose another.")
        .arg(QString::fromStdString(measured->display.connector));
  if (screens_.size() > 1) return tr("Choose the projector's screen.");
  return tr(
      "There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.");
}

}  // namespace relucent
