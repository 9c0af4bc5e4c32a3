// SPDX-License-Identifier: MIT
// What Output plays: the playlist, the set in use, and the output that shows them.
#include <algorithm>

#include "content/content_address.h"
#include "views/number_text.h"
#include "wizard/output/output_page.h"
#include "wizard/session/method_name.h"

namespace relucent::gui {

std::optional<LiveState> OutputPage::livePlaying() const {
  const qsizetype now = projection_.playing();
  const QList<PlaylistItem>& items = playlist_.settings().items;
  const std::vector<LiveState> live = projection_.live();
  if (now < 0 || now >= items.size() || live.empty()) return std::nullopt;
  // The next item of the list may be live, too.
  if (addressOf(items[now].path).kind == ContentAddress::Kind::file) return std::nullopt;
  return live.front();
}

QString OutputPage::figures() const {
  const PlayerStatistics s = projection_.statistics();
  if (!isOpen() || !missingScreen().isEmpty() || isCovered() || s.frames == 0) return {};
  if (isContested()) return tr("Perhaps under another program's picture");
  if (isBlack()) return tr("Black");
  if (playsEarlier()) return tr("Another correction");
  if (showsChart()) return tr("Test chart");
  if (s.perfected) return tr("still picture, perfected by photographs");
  if (const std::optional<LiveState> live = livePlaying(); live && live->phase != LiveState::Phase::playing)
    return live->size.isEmpty() ? tr("No picture has come yet: black")
           : live->turnsBlack   ? tr("The live picture is lost: black")
                                : tr("The live picture is lost: its last one stands");
  const QString clipped = percentText(s.clipped);
  if (!(s.framesPerSecond > 0.0)) return tr("still picture, %1 of the pixels at their limit").arg(clipped);
  return tr("%1 fps, %2 ms, %3 of the pixels at their limit")
      .arg(decimalText(s.framesPerSecond, 1), decimalText(1000.0 * s.frameSeconds, 1), clipped);
}

void OutputPage::setPlaylist(const PlaylistSettings& settings) {
  try {
    playlist_.set(settings);
  } catch (...) {
    tell(failureOf(std::current_exception()));
  }
  if (playlist_.isEmpty())
    close();
  else
    projection_.changeList(settings);
}

void OutputPage::edit(const QString& what, const PlaylistSettings& after) {
  if (after == playlist_.settings()) return;
  changeUndoably(what, playlist_.settings(), after,
                 [this](const PlaylistSettings& settings) { setPlaylist(settings); });
}

void OutputPage::addFiles(const QStringList& files) {
  edit(tr("Add to the playlist"), playlist_.withAdded(files));
}

void OutputPage::removeItem(qsizetype index) {
  edit(tr("Remove from the playlist"), playlist_.without(index));
}

void OutputPage::moveItem(qsizetype index, qsizetype by) {
  edit(tr("Order of the playlist"), playlist_.withMoved(index, by));
}

void OutputPage::setRepeat(bool repeat) {
  PlaylistSettings after = playlist_.settings();
  after.loop = repeat;
  edit(tr("Repeat"), after);
}

void OutputPage::setFade(double seconds) {
  PlaylistSettings after = playlist_.settings();
  after.fadeSeconds = seconds;
  edit(tr("Cross-fade"), after);
}

void OutputPage::setPictureSeconds(qsizetype index, double seconds) {
  PlaylistSettings after = playlist_.settings();
  if (index < 0 || index >= after.items.size() || !OutputPlaylist::standsForSeconds(after.items[index]))
    return;
  after.items[index].seconds = seconds;
  edit(tr("Time of a picture"), after);
}

QString OutputPage::whyNoSets() const {
  if (session_.setsFailure()) return session_.setsFailure()->what + ' ' + session_.setsFailure()->advice;
  if (playsEarlier()) return tr("Another correction plays. Show the current one first.");
  return session_.whyLocked(stepName);
}

void OutputPage::useSet(const std::string& name) {
  if (!whyNoSets().isEmpty() || name == sets().nameInUse()) return;
  overruled_ = setAt(playlist_.settings().sets, now_());
  changeSet(name);
}

/// Once somebody looks, and nothing is being photographed.
void OutputPage::followTimes() {
  const std::optional<QString> wanted = setAt(playlist_.settings().sets, now_());
  if (!isOpen() || !isLookedAt_ || !wanted || wanted == overruled_) return;
  overruled_.reset();
  const std::string name = wanted->toStdString();
  const std::vector<std::string> names = sets().names();
  const bool isThere = std::ranges::find(names, name) != names.end();
  if (isThere && name != sets().nameInUse() && whyNoPhotograph().isEmpty() && whyNoSets().isEmpty())
    changeSet(name);
}

void OutputPage::changeSet(const std::string& name) {
  const bool plays = isOpen() && !earlier_;
  try {
    session_.changeSets([&](calibration::CalibrationFolder& folder) { pipeline::useSet(folder, name); });
  } catch (...) {
    return tell(failureOf(std::current_exception()));
  }
  if (!plays) return;
  playsFrom_ = session_.shownFrom();
  projection_.useSet(name);
  tellAll();
}

void OutputPage::setTimes(const QList<SetTime>& times) {
  PlaylistSettings after = playlist_.settings();
  after.sets = times;
  overruled_.reset();
  edit(tr("Times of sets"), after);
}

QString OutputPage::stillMethod() const {
  const compensation::Method method = session_.settings().content.method;
  return method == compensation::Method::refined ? QString() : methodName(method);
}

void OutputPage::openWith(const OutputProjection::Wanted::Beginning& beginning) {
  if (isOpen() || projection_.isOpening() || projectorWithoutScreen() || playlist_.isEmpty() ||
      !session_.areDevicesFree())
    return;
  std::vector<std::optional<ScreenIdentity>> screens;
  for (const auto& screen : chosen_) {
    const OutputScreen& wanted = screens_[*screen];
    screens.push_back(wanted.isPageOnly ? std::nullopt : std::optional(wanted.identity));
  }
  std::filesystem::path results = session_.path();
  try {
    earlier_ = nullptr;
    if (ResultsBeside::areNeeded(session_)) earlier_ = std::make_unique<ResultsBeside>(results);
  } catch (...) {
    return tell(failureOf(std::current_exception()));
  }
  if (earlier_) results = earlier_->path();
  playsFrom_ = session_.shownFrom();
  projection_.open({results, playlist_.settings(), session_.settings().content.fit, screens, beginning});
}

void OutputPage::close() {
  projection_.close();
}

/// The show goes on as it is, black if it is, where it is in its list.
void OutputPage::closeForNow() {
  reopening_ = {projection_.playing(), isBlack(), projection_.hasOverlay()};
  close();
}

void OutputPage::reopen() {
  if (const auto beginning = std::exchange(reopening_, std::nullopt)) openWith(*beginning);
}

void OutputPage::renew() {
  if (!renew_->isEnabled()) return;
  closeForNow();
  reopen();
}

}  // namespace relucent::gui
