// SPDX-License-Identifier: MIT
#include "wizard/screen_choice.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QScreen>
#include <cmath>

#include "output/window_projector.h"
#include "wizard/identify_overlay.h"

namespace relucent {
namespace {

struct Words {
  Q_DECLARE_TR_FUNCTIONS(ScreenChoice)
};

ScreenChoice choiceOf(const QScreen& screen, bool isOnlyOne) {
  ScreenChoice choice;
  const QSize size = nativeSize(screen);
  choice.display = displayOf(screen);
  choice.size = {size.width(), size.height()};
  if (screen.refreshRate() > 1.0) choice.frameRate = screen.refreshRate();
  choice.primary = &screen == QGuiApplication::primaryScreen();
  choice.title = choice.primary ? Words::tr("This computer") : screenTitle(screen);
  choice.facts = Words::tr("%1, %2 × %3, %4 Hz")
                     .arg(screen.name())
                     .arg(size.width())
                     .arg(size.height())
                     .arg(std::lround(choice.frameRate));
  choice.refusal = whyNoProjector(screen);
  if (!choice.primary || !choice.refusal.isEmpty()) return choice;
  if (isOnlyOne)
    choice.warning = Words::tr(
        "There is no other screen: the patterns cover this window while they are shown. Plug the projector "
        "in, "
        "and switch the desktop to extended screens, to keep both apart.");
  else
    choice.refusal = Words::tr("This is the screen that you work on. Choose the projector's.");
  return choice;
}

}  // namespace

std::vector<ScreenChoice> screenChoices() {
  std::vector<ScreenChoice> choices;
  const QList<QScreen*> screens = QGuiApplication::screens();
  for (const QScreen* screen : screens) choices.push_back(choiceOf(*screen, screens.size() == 1));
  return choices;
}

}  // namespace relucent
