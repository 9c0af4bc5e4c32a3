// SPDX-License-Identifier: MIT
#include "wizard/devices/screen_choice.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QScreen>
#include <cmath>
#include <utility>

#include "output/window_projector.h"
#include "views/number_text.h"
#include "wizard/devices/identify_overlay.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(ScreenChoice)
};

ScreenChoice choiceOf(const QScreen& screen, bool isOnlyOne) {
  ScreenChoice choice;
  const QSize size = nativeSize(screen);
  choice.display = displayOf(screen);
  choice.size = {size.width(), size.height()};
  if (screen.refreshRate() > 1.0) choice.frameRate = screen.refreshRate();
  choice.primary = &screen == QGuiApplication::primaryScreen();
  choice.title = choice.primary ? Translated::tr("This computer") : screenTitle(screen);
  choice.facts = Translated::tr("%1, %2 × %3, %4 Hz")
                     .arg(screen.name())
                     .arg(size.width())
                     .arg(size.height())
                     .arg(std::lround(choice.frameRate));
  choice.refusal = unusableReason(screen);
  if (!choice.primary || !choice.refusal.isEmpty()) return choice;
  if (isOnlyOne)
    choice.warning = Translated::tr(
        "There is no other screen: the patterns cover this window while they are shown. Plug the projector "
        "in, "
        "and switch the desktop to extended screens, to keep both apart.");
  else
    choice.refusal = Translated::tr("This is the screen that you work on. Choose the projector's.");
  return choice;
}

}  // namespace

std::vector<ScreenChoice> screenChoices() {
  std::vector<ScreenChoice> choices;
  const QList<QScreen*> screens = QGuiApplication::screens();
  for (const QScreen* screen : screens) choices.push_back(choiceOf(*screen, screens.size() == 1));
  return choices;
}

std::vector<ScreenChoice> screenChoicesFor(Size projector) {
  std::vector<ScreenChoice> choices = screenChoices();
  for (ScreenChoice& choice : choices)
    if (choice.refusal.isEmpty() && choice.size != projector)
      choice.refusal =
          Translated::tr("The projector was measured with %1 pixels. Set this screen to that size.")
              .arg(sizeText(projector.width, projector.height));
  return choices;
}

pipeline::ScreenRigSettings withScreen(pipeline::ScreenRigSettings settings, const ScreenChoice& choice) {
  settings.display = choice.display;
  settings.projector = choice.size;
  settings.frameRate = choice.frameRate;
  return settings;
}

QString meaningOfMove(const pipeline::ScreenRigSettings::Display& measured,
                      const pipeline::ScreenRigSettings::Display& now) {
  const bool alike = measured.manufacturer == now.manufacturer && measured.model == now.model &&
                     measured.serialNumber == now.serialNumber;
  if (!alike)
    return Translated::tr(
        "This is another projector than the one that was measured. Its light and its place differ: take a "
        "verification photograph, and measure again where that does not look as predicted.");
  if (!measured.serialNumber.empty() || measured.connector == now.connector) return {};
  return Translated::tr(
             "Measured at %1, used at %2. If it is the same projector in the same place, everything that was "
             "measured holds; a verification photograph tells.")
      .arg(QString::fromStdString(measured.connector), QString::fromStdString(now.connector));
}

}  // namespace relucent::gui
