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

namespace {

/// Where it is plugged in now; none: nowhere.
std::optional<std::size_t> placeOf(const OutputScreen& wish, const std::vector<OutputScreen>& screens) {
  if (wish.isPageOnly) {
    const auto page = std::ranges::find_if(screens, &OutputScreen::isPageOnly);
    if (page == screens.end()) return std::nullopt;
    return static_cast<std::size_t>(page - screens.begin());
  }
  QList<ScreenIdentity> present;
  for (const OutputScreen& screen : screens) present << screen.identity;
  return findScreen(wish.identity, present);
}

}  // namespace

void OutputPage::listScreens() {
  screens_.clear();
  if (session_.isSimulated()) screens_.push_back({.isPageOnly = true});
  for (QScreen* screen : QGuiApplication::screens())
    screens_.push_back({identityOf(*screen), nativeSize(*screen), screen == QGuiApplication::primaryScreen(),
                        screen->refreshRate(), false});
  wished_.resize(session_.projectors());
  chosen_.assign(wished_.size(), std::nullopt);
  // What was chosen and went away may come back: no other shines in its place.
  for (std::size_t projector = 0; projector < wished_.size(); ++projector)
    if (wished_[projector]) chosen_[projector] = placeOf(*wished_[projector], screens_);
  for (std::size_t projector = 0; projector < wished_.size(); ++projector) {
    if (wished_[projector]) continue;
    chosen_[projector] = usualScreen(projector);
    if (chosen_[projector]) wished_[projector] = screens_[*chosen_[projector]];
  }
  tellSettings();
}

QStringList OutputPage::connectors() const {
  QStringList names;
  for (const std::optional<std::size_t>& screen : chosen_)
    if (screen && !screens_[*screen].isPageOnly) names << screens_[*screen].identity.connector;
  return names;
}

QString OutputPage::missingScreen() const {
  return missingScreenOf(projector());
}

QString OutputPage::missingScreenOf(std::size_t projector) const {
  if (projector >= wished_.size() || chosen_[projector]) return {};
  if (wished_[projector]) return wished_[projector]->identity.connector;
  const std::optional<pipeline::ScreenRigSettings> measured = session_.screenOf(projector);
  return measured ? QString::fromStdString(measured->display.connector) : QString();
}

/// The one that was measured, and no other in its place; where none was, one that nobody works at and no
/// projector has.
std::optional<std::size_t> OutputPage::usualScreen(std::size_t projector) const {
  if (const std::optional<pipeline::ScreenRigSettings> measured = session_.screenOf(projector)) {
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
  const std::optional<OutputScreen> mine = wished_[projector()];
  for (std::size_t other = 0; other < chosen_.size(); ++other)
    if (chosen_[other] == index && !screens_[index].isPageOnly) {
      wished_[other] = mine;
      chosen_[other] = chosen_[projector()];
    }
  wished_[projector()] = screens_[index];
  chosen_[projector()] = index;
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
  std::vector<ScreenIdentity> now;
  for (std::size_t projector = 0; projector < projectors(); ++projector)
    if (const auto screen = session_.screenOf(projector)) now.push_back(identityOf(screen->display));
  if (std::exchange(screensBefore_, now) == now || now.empty()) return;
  bool isFollowed = true;
  for (std::size_t projector = 0; projector < now.size(); ++projector)
    isFollowed =
        isFollowed && screenOf(projector) && screens_[*screenOf(projector)].identity == now[projector];
  if (isFollowed) return;
  close();
  wished_.clear();
  listScreens();
}

void OutputPage::keepScreen() {
  const std::optional<pipeline::ScreenRigSettings> before = session_.screenOf(projector());
  if (!before || !session_.areDevicesFree()) return;
  for (const ScreenChoice& choice : screenChoicesFor(before->projector)) {
    if (!choice.refusal.isEmpty() || identityOf(choice.display) != screens_[*chosen()].identity) continue;
    if (choice.display == before->display) return;
    try {
      session_.changeScreen(withScreen(*before, choice), projector());
    } catch (...) {
      tell(failureOf(std::current_exception()));
    }
    return;
  }
}

QString OutputPage::meaningOfScreen() const {
  const std::optional<pipeline::ScreenRigSettings> now = session_.screenOf(projector());
  return now ? meaningOfMove(session_.measuredDisplay(projector()), now->display) : QString();
}

QString OutputPage::screenHint(std::size_t projector) const {
  if (projectors() > 1 && session_.screenRig() == nullptr && screens_.size() < projectors())
    return tr("Each of the %n projector(s) needs a screen of its own. Plug in another one.", nullptr,
              static_cast<int>(projectors()));
  if (const QString missing = missingScreenOf(projector); !missing.isEmpty())
    return tr("The projector's screen %1 is not there. Plug it in, or choose another.").arg(missing);
  if (projectors() > 1) return tr("Choose a screen for projector %1.").arg(projector + 1);
  if (screens_.size() > 1) return tr("Choose the projector's screen.");
  return tr(
      "There is one screen only. Plug the projector in and extend the desktop to it, or choose this screen.");
}

}  // namespace relucent::gui
