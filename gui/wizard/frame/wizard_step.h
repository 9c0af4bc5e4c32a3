// SPDX-License-Identifier: MIT
#pragma once

#include <QSettings>
#include <functional>
#include <memory>

#include "wizard/frame/page_model.h"
#include "wizard/frame/page_view.h"
#include "wizard/frame/preferences.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// What a page is made with. All of it outlives the page.
struct PageContext {
  Session& session;
  Preferences& preferences;
  QSettings& settings;
};

/// A step of the wizard: its name, and how its page and the page's view are made. A folder of a page makes
/// one.
struct WizardStep {
  StepName name;
  std::function<std::unique_ptr<PageModel>(const PageContext&)> makePage;
  /// The view of a page that makePage made.
  std::function<PageView(PageModel&)> makeView;
};

/// Of a page that has `Page::stepName` and a `viewOf(Page&)`.  `make`: PageContext -> std::unique_ptr<Page>.
template <typename Page, typename Make>
WizardStep stepOf(Make make) {
  return {Page::stepName,
          [make](const PageContext& context) -> std::unique_ptr<PageModel> { return make(context); },
          [](PageModel& page) { return viewOf(static_cast<Page&>(page)); }};
}

/// The same of a page that needs nothing but the session.
template <typename Page>
WizardStep stepOf() {
  return stepOf<Page>([](const PageContext& context) { return std::make_unique<Page>(context.session); });
}

}  // namespace relucent::gui
