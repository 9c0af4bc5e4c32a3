// SPDX-License-Identifier: MIT
#include <utility>

#include "relucent/pipeline/sets.h"
#include "relucent/pipeline/stored_settings.h"
#include "wizard/preview/preview_page.h"

namespace relucent::gui {

QString PreviewPage::whyNoSets() const {
  if (session_.setsFailure()) return session_.setsFailure()->what + ' ' + session_.setsFailure()->advice;
  return session_.isOpen() ? whyLocked() : tr("No venue is open.");
}

void PreviewPage::changeSets(const std::function<void(calibration::CalibrationFolder&)>& how) {
  if (!whyNoSets().isEmpty()) return;
  try {
    session_.changeSets(how);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("The sets are as they were.")});
  }
  tellAll();
}

void PreviewPage::keepIn(calibration::CalibrationFolder& folder) const {
  if (!problem_.isEmpty() || placedSettings() == session_.settings().content) return;
  pipeline::CalibrateSettings settings = pipeline::settingsOf(folder);
  settings.content = placedSettings();
  pipeline::changeSettings(folder, settings);
}

void PreviewPage::useSet(const std::string& name) {
  if (name == sets().nameInUse()) return;
  changeSets([&](calibration::CalibrationFolder& folder) {
    keepIn(folder);
    pipeline::useSet(folder, name);
  });
}

void PreviewPage::saveSet(const std::string& name) {
  changeSets([&](calibration::CalibrationFolder& folder) {
    pipeline::saveSet(folder, name);
    keepIn(folder);
  });
}

void PreviewPage::renameSet(const std::string& to) {
  changeSets(
      [&](calibration::CalibrationFolder& folder) { pipeline::renameSet(folder, sets().nameInUse(), to); });
}

void PreviewPage::removeSet() {
  const pipeline::TargetSets before = sets();
  if (before.all.empty()) return;
  changeSets([&](calibration::CalibrationFolder& folder) {
    if (before.all.size() > 1) pipeline::useSet(folder, before.all[before.inUse == 0 ? 1 : 0].name);
    pipeline::removeSet(folder, before.nameInUse());
  });
}

/// Another one is in use, whoever chose it.
void PreviewPage::followSet() {
  const std::string now = session_.sets().nameInUse();
  if (std::exchange(set_, now) == now) return;
  isOtherSet_ = true;
  if (settings_ != session_.settings().content) takeOver();
  acceptSet();
}

/// What else changed it, like a repair, which moves it with the view: whoever looked at the page would keep
/// what it was.
void PreviewPage::followContent() {
  const pipeline::ContentSettings now = session_.settings().content;
  const bool isOwn = settings_ == now || placedSettings() == now;
  if (std::exchange(stored_, now) != now && !isOwn) takeOver();
}

void PreviewPage::takeOver() {
  masks_.cancel();
  masks_.choose(std::nullopt);
  undoStack().clear();  // of what is no more
  adopt(session_.settings().content);
}

/// Who places content in one set has placed it in those that are made of it: there is nothing to do again.
void PreviewPage::acceptSet() {
  if (!isOtherSet_ || !preview_ || isComputing()) return;
  isOtherSet_ = false;
  if (session_.progress(calibration::Stage::content) == calibration::StageProgress::stale && mayKeep())
    keepPlacement();
}

}  // namespace relucent::gui
