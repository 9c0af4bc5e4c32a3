// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "wizard/frame/page_model.h"
#include "wizard/session/session.h"

namespace relucent::gui {

/// The steps in order, which of them is looked at, and which can be. Knows no page but by its contract.
class Wizard : public QObject {
  Q_OBJECT

 public:
  explicit Wizard(Session& session, QObject* parent = nullptr);
  /// In the order of the rail; the first is always open.
  void add(PageModel& page);

  std::size_t count() const { return pages_.size(); }
  PageModel& page(std::size_t index) const { return *pages_[index]; }
  std::size_t current() const { return current_; }
  PageModel& currentPage() const { return *pages_[current_]; }
  /// Of a page, as the rail shows it: that it waits for a device comes before all else.
  StepStatus statusOf(std::size_t index) const;
  /// What stands above the stage: on every page that work waits for a device, else what the page says.
  std::optional<Banner> banner() const;

  /// A page opens when all before it have a result, perhaps an old one.
  bool isLocked(std::size_t index) const { return lockedBy(index).has_value(); }
  /// The step that has to be done before; none: it can be opened.
  std::optional<std::size_t> lockedBy(std::size_t index) const;
  /// What is changed on the page of before is kept. False, with nothing changed, if it is locked.
  bool go(std::size_t index);
  void next();
  void back();
  bool canGoBack() const;
  /// The first page that has no result, or was interrupted on the way to another: where the calibration
  /// stood.
  std::size_t standing() const;

 Q_SIGNALS:
  /// Another page is looked at.
  void moved();
  /// Of some page, or which of them are open.
  void statusChanged();
  /// Of some page.
  void progressChanged();

 private:
  void show(std::size_t index);

  Session& session_;
  std::vector<PageModel*> pages_;
  std::size_t current_ = 0;
};

}  // namespace relucent::gui
