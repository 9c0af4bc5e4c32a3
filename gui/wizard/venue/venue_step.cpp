// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_step.h"

#include "wizard/venue/venue_view.h"

namespace relucent::gui {

WizardStep venueStep() {
  return stepOf<VenuePage>([](const PageContext& context) {
    auto page = std::make_unique<VenuePage>(context.session, RecentVenues(context.settings));
    auto follow = [page = page.get(), &preferences = context.preferences] {
      page->setUsualFolder(preferences.folder());
    };
    QObject::connect(&context.preferences, &Preferences::changed, page.get(), follow);
    follow();
    return page;
  });
}

}  // namespace relucent::gui
