// SPDX-License-Identifier: MIT
// Which screen Output shines on, and what that is to the calibration.
#include <QGuiApplication>
#include <QScreen>
#include <algorithm>
#include <utility>

#include "output/window_projector.h"
#include "wizard/devices/screen_choice.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

void OutputPage::listScreens() {
  std::vector<std::optional<ScreenIdentity>> before;
  for (const auto& screen : chosen_)
    before.push_back(screen ? std::optional(screens_[*screen].identity) : std::nullopt);
  screens_.clear();
  if (session_.isSimulated()) screens_.push_back({.isPageOnly = true});
  for (QScreen* screen : QGuiApplication::screens())
    screens_.push_back({identityOf(*screen), nativeSize(*screen), screen == QGuiApplication::primaryScreen(),
                        screen->refreshRate(), false});
  before.resize(session_.projectors());
  chosen_.assign(before.size(), std::nullopt);
  for (std::size_t projector = 0; projector < before.size(); ++projector)
    for (std::size_t i = 0; i < screens_.size(); ++i)
      if (before[projector] && screens_[i].identity == *before[projector]) chosen_[projector] = i;
  // What was chosen and went away may come back: no other shines in its place.
  for (std::size_t projector = 0; projector < before.size(); ++projector)
    if (!chosen_[projector] && (!before[projector] || session_.screenRig() != nullptr))
      chosen_[projector] = usualScreen();
  tellSettings();
}

/// The one that was measured, and no other in its place; where none was, one that nobody works at and no
/// projector has.
std::optional<std::size_t> OutputPage::usualScreen() const {
  if (const pipeline::ScreenRigSettings* measured = session_.screenRig()) {
    QList<ScreenIdentity> present;
    for (const OutputScreen& screen : screens_) present << screen.identity;
    return findScreen(identityOf(measured->display), present);
  }
  // Nothing that is simulated shines into a room unasked.
  if (session_.isSimulated()) return std::size_t{0};
  for (std::size_t i = 0; i < screens_.size(); ++i) {
    bool taken = std::find(chosen_.begin(), chosen_.end(), std::optional(i)) != chosen_.end();
    if (!taken && !screens_[i].operators) return i;
  }
  return std::nullopt;
}

void OutputPage::choose(std::size_t index) {
  if (isOpen()) close();
  std::optional<std::size_t>& mine = chosen_[projector()];
  auto other = std::find(chosen_.begin(), chosen_.end(), std::optional(index));
  if (other != chosen_.end() && !screens_[index].isPageOnly) *other = mine;
  mine = index;
  keepScreen();
  tellSettings();
}

std::optional<std::size_t> OutputPage::projectorWithoutScreen() const {
  auto missing = std::find(chosen_.begin(), chosen_.end(), std::nullopt);
  if (missing == chosen_.end()) return std::nullopt;
  return static_cast<std::size_t>(missing - chosen_.begin());
}

bool OutputPage::coversOperator() const {
  return std::any_of(chosen_.begin(), chosen_.end(),
                     [this](const auto& screen) { return screen && screens_[*screen].operators; });
}

bool OutputPage::isOnPageOnly() const {
  return std::ranges::all_of(chosen_,
                             [this](const auto& screen) { return screen && screens_[*screen].isPageOnly; });
}

/// The calibration was given another screen, here or at Venue.
void OutputPage::followScreen() {
  const pipeline::ScreenRigSettings* screen = session_.screenRig();
  const ScreenIdentity now = screen != nullptr ? identityOf(screen->display) : ScreenIdentity();
  if (std::exchange(screenBefore_, now) == now || screen == nullptr) return;
  if (chosen() && screens_[*chosen()].identity == now) return;
  close();
  chosen_.clear();
  listScreens();
}

void OutputPage::keepScreen() {
  const pipeline::ScreenRigSettings* before = session_.screenRig();
  if (before == nullptr || !session_.areDevicesFree()) return;
  for (const ScreenChoice& choice : screenChoicesFor(before->projector)) {
    if (!choice.refusal.isEmpty() || identityOf(choice.display) != screens_[*chosen()].identity) continue;
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
  const pipeline::ScreenRigSettings* now = session_.screenRig();
  return now != nullptr ? meaningOfMove(session_.measuredDisplay(), now->display) : QString();
}

QString OutputPage::screenHint(std::size_t projector) const {
  if (const pipeline::ScreenRigSettings* measured = session_.screenRig(); measured != nullptr)
    return tr("The projector's screen %1 is not there. Plug it in, or choose another.")
        .arg(QString::fromStdString(measured->display.connector));
  if (projectors() > 1) {
    if (screens_.size() >= projectors()) return tr("Choose a screen for projector %1.").arg(projector + 1);
    return tr("Each of the %n projector(s) needs a screen of its own. Plug in another one.", nullptr,
              static_cast<int>(projectors()));
  }
  if (screens_.size() > 1) return tr("Choose the projector's screen.");
  return tr(
      "There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.");
}

}  // namespace relucent::gui
