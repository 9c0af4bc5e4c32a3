// SPDX-License-Identifier: MIT
#include "wizard/acquire/acquire_step.h"

#include <QApplication>

#include "wizard/acquire/acquire_view.h"

namespace relucent::gui {
namespace {

/// How it begins and what is heard of it is a preference that is chosen on the page as well.
void share(Preferences& preferences, AcquirePage& page) {
  auto follow = [&page, &preferences] {
    page.setSecondsToLeave(preferences.secondsToLeave());
    page.setSound(preferences.hasSound());
  };
  QObject::connect(&preferences, &Preferences::changed, &page, follow);
  follow();
  QObject::connect(&page, &AcquirePage::secondsToLeaveChosen, &preferences, &Preferences::setSecondsToLeave);
  QObject::connect(&page, &AcquirePage::soundChosen, &preferences, &Preferences::setSound);
}

}  // namespace

WizardStep acquireStep() {
  return stepOf<AcquirePage>([](const PageContext& context) {
    auto page = std::make_unique<AcquirePage>(context.session);
    share(context.preferences, *page);
    auto sound = [page = page.get()] {
      if (page->hasSound()) QApplication::beep();
    };
    QObject::connect(page.get(), &AcquirePage::measured, page.get(), sound);
    QObject::connect(page.get(), &AcquirePage::asks, page.get(), sound);
    return page;
  });
}

}  // namespace relucent::gui
