// SPDX-License-Identifier: MIT
#include "wizard/frame/wizard.h"

#include "wizard/frame/lost_device.h"

namespace relucent::gui {

Wizard::Wizard(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_, &Session::devicesChanged, this, &Wizard::statusChanged);
  connect(&session_, &Session::opened, this, [this] {
    for (PageModel* page : pages_) {
      page->undoStack().clear();
      page->stopKeeping();
    }
    // What was changed and not kept was of another calibration.
    if (session_.isOpen()) show(standing());
  });
}

void Wizard::add(PageModel& page) {
  pages_.push_back(&page);
  connect(&page, &PageModel::statusChanged, this, &Wizard::statusChanged);
  connect(&page, &PageModel::progressChanged, this, &Wizard::progressChanged);
  connect(&page, &PageModel::nextWanted, this, &Wizard::next);
  connect(&page, &PageModel::standingWanted, this, [this] { go(standing()); });
  connect(&page, &PageModel::stepWanted, this, [this](const QString& id) {
    for (std::size_t i = 0; i < pages_.size(); ++i)
      if (pages_[i]->step().id == id) go(i);
  });
}

StepStatus Wizard::statusOf(std::size_t index) const {
  StepStatus status = pages_[index]->status();
  if (isUsable(status) && pages_[index]->isChanged()) {
    status.state = StepState::outOfDate;
    status.result = tr("Not applied yet");
  }
  if (!session_.isDeviceLost() || session_.devicesUser() != pages_[index]->step()) return status;
  status.result = lostDeviceText(session_);
  status.isHeldUp = true;
  return status;
}

std::optional<Banner> Wizard::banner() const {
  PageCommand* instead = nullptr;
  for (const PageModel* page : pages_)
    if (session_.devicesUser() == page->step()) instead = page->insteadOfWaiting();
  if (auto lost = lostDeviceBanner(session_, instead)) return lost;
  return currentPage().banner();
}

std::optional<std::size_t> Wizard::lockedBy(std::size_t index) const {
  for (std::size_t before = 0; before < index; ++before)
    if (!isUsable(pages_[before]->status())) return before;
  return std::nullopt;
}

bool Wizard::go(std::size_t index) {
  if (index >= pages_.size() || isLocked(index)) return false;
  if (index != current_) currentPage().keepChanges();
  show(index);
  return true;
}

void Wizard::show(std::size_t index) {
  if (index != current_) {
    currentPage().leave();
    current_ = index;
    Q_EMIT moved();
  }
  currentPage().stopKeeping();
  currentPage().enter();
  currentPage().refresh();
}

void Wizard::next() {
  go(current_ + 1);
}

void Wizard::back() {
  if (!currentPage().goBack() && current_ > 0) go(current_ - 1);
}

bool Wizard::canGoBack() const {
  return current_ > 0 || currentPage().canGoBack();
}

std::size_t Wizard::standing() const {
  std::size_t last = 0;
  while (last + 1 < pages_.size() && !isLocked(last + 1) && !pages_[last]->wasInterrupted()) ++last;
  return last;
}

}  // namespace relucent::gui
