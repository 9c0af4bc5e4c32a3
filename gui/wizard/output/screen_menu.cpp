// SPDX-License-Identifier: MIT
#include "wizard/output/screen_menu.h"

#include "content/cast_choices.h"
#include "desktop/screen_capture.h"
#include "desktop/screen_cast.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {
namespace {

constexpr int longestTitle = 60;  // characters

/// As a menu's entry: a "&" is one.
QString shownTitle(const QString& title) {
  QString shown = title.size() > longestTitle ? title.left(longestTitle) + QChar(0x2026) : title;
  return shown.replace('&', "&&");
}

}  // namespace

QList<ScreenOffer> screenOffers(const QStringList& taken, const QStringList& projectors) {
  if (isGivenByPortal())
    return {{OutputPage::tr("A screen, chosen in the desktop's dialog"), unusedCast("screen:", taken)},
            {OutputPage::tr("A window, chosen in the desktop's dialog"), unusedCast("window:", taken)}};
  QList<ScreenOffer> offers;
  const ScreenCapture desktop;
  for (const ScreenCapture::Screen& screen : desktop.screens()) {
    if (screen.place.isEmpty()) continue;
    const bool isProjectors = projectors.contains(screen.name);
    const QString text =
        isProjectors ? OutputPage::tr("Screen %1, which this plays on") : OutputPage::tr("Screen %1");
    offers.append({text.arg(shownTitle(screen.name)), "screen:" + screen.name, isProjectors});
  }
  QStringList titles;
  for (const ScreenCapture::Window& window : desktop.windows()) {
    if (window.isOwn || titles.contains(window.title)) continue;
    titles.append(window.title);
    offers.append({OutputPage::tr("Window %1").arg(shownTitle(window.title)), "window:" + window.title});
  }
  return offers;
}

QMenu* screenMenu(OutputPage& page, QWidget* parent) {
  auto* menu = new QMenu(parent);
  QObject::connect(menu, &QMenu::aboutToShow, menu, [menu, &page] {
    menu->clear();
    QStringList taken;
    for (const PlaylistItem& item : page.playlist().settings().items) taken.append(item.path);
    for (const ScreenOffer& offer : screenOffers(taken, page.connectors())) {
      QAction* add = menu->addAction(offer.text);
      add->setEnabled(!offer.isProjectors);
      QObject::connect(add, &QAction::triggered, &page,
                       [&page, path = offer.path] { page.addFiles({path}); });
    }
    if (menu->isEmpty())
      menu->addAction(OutputPage::tr("There is no desktop whose screens could be shown."))->setEnabled(false);
  });
  return menu;
}

}  // namespace relucent::gui
