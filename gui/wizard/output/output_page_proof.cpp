// SPDX-License-Identifier: MIT
// What Output does about what plays by photographs: proof, drift, repair, perfecting, the report.
#include <algorithm>
#include <utility>

#include "output/default_picture.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

QString OutputPage::whyNoPhotograph() const {
  if (perfecting_.isRunning()) return tr("The picture is being perfected.");
  if (projection_.isOpening()) return tr("The output is being opened.");
  return proof_.whyNot();
}

QString OutputPage::whyNotProve() const {
  if (const QString why = whyNoPhotograph(); !why.isEmpty()) return why;
  if (isScreenLost()) return tr("The projector's screen is unplugged.");
  return playsEarlier() ? tr("Another correction still plays.") : QString();
}

QString OutputPage::whyNoPatterns() const {
  if (const QString why = whyNoPhotograph(); !why.isEmpty()) return why;
  return session_.whyNoPatterns();
}

void OutputPage::whileClosed(const std::function<void()>& work) {
  if (!whyNoPhotograph().isEmpty()) return;
  // A real camera would photograph the show.
  if (isOpen() && !session_.isSimulated()) closeForNow();
  work();
}

void OutputPage::verify() {
  // What plays now: once the output is closed nothing does.
  if (!mayProve()) return;
  whileClosed(
      [this, picture = pictureToProve(), canvas = canvasOfPicture()] { proof_.photograph(picture, canvas); });
}

void OutputPage::repair() {
  if (!whyNoPatterns().isEmpty()) return;
  whileClosed([this, picture = pictureToProve()] { proof_.startRepair(picture); });
}

/// What was repaired is shown at once: it was photographed, and is better.
void OutputPage::repairEnded() {
  if (playsEarlier() && proof_.repair() && proof_.repair()->end == pipeline::RepairEnd::repaired) renew();
  reopen();
}

void OutputPage::askToUndoRepair() {
  if (!whyNoPhotograph().isEmpty() || !proof_.repairNote()) return;
  undoRepair_->show(tr("Use the measurement before"));
  keepRepair_->show(tr("Keep the repaired one"));
  undoing_ = std::make_unique<QObject>();
  FailureReport question;
  question.isQuestion = question.endsWork = true;
  question.failure.heading = tr("Use the measurement before?");
  question.failure.what = tr("What was repaired is measured again if you repair once more.");
  question.safe =
      tr("The measurement from before the repair is used as it was, with all that followed from it.");
  question.goOn = undoRepair_;
  question.resume = keepRepair_;
  question.reason = undoing_.get();
  Q_EMIT failed(question);
}

void OutputPage::undoRepair() {
  undoing_.reset();
  if (!whyNoPhotograph().isEmpty()) return;
  proof_.undoRepair();
  if (playsEarlier() && session_.areDevicesFree() && !projectorWithoutScreen()) renew();
}

void OutputPage::perfect() {
  if (!mayProve()) return;
  whileClosed([this, picture = pictureToProve(), canvas = canvasOfPicture()] {
    perfecting_.lookAt(picture, canvas);
    perfecting_.start();
  });
}

/// What plays now, on the canvas that it plays on.
void OutputPage::lookAtPicture() {
  if (!playlist_.isEmpty()) perfecting_.lookAt(pictureToProve(), canvasOfPicture());
}

Canvas OutputPage::canvasOfPicture() const {
  return isOpen() ? projection_.canvas()
                  : OutputProjection::canvasFor(playlist_.settings(), session_.settings().content.fit);
}

/// What stands on the projectors is looked for again.
void OutputPage::perfectingEnded(bool isOther) {
  if (isOther && isOpen()) closeForNow();
  reopen();
}

void OutputPage::pushBack() {
  whileClosed([this] { Q_EMIT nudgeWanted(); });
}

void OutputPage::pushedBack(const std::optional<NudgeSight>& last, bool wasElsewhere) {
  if (last && last->isAtItsPlace()) proof_.cameraAtItsPlace(wasElsewhere);
  if (last && last->isElsewhere()) proof_.cameraLeft(last->distance());
  reopen();
}

QString OutputPage::pictureToProve() const {
  const QList<PlaylistItem>& items = playlist_.settings().items;
  qsizetype now = projection_.playing();
  if (now >= 0 && now < items.size() && OutputPlaylist::isStill(items[now])) return items[now].path;
  auto still = std::find_if(items.begin(), items.end(), OutputPlaylist::isStill);
  return still != items.end() ? still->path : defaultPicture();
}

void OutputPage::report() {
  if (whyNoPhotograph().isEmpty()) proof_.report(pictureToProve());
}

}  // namespace relucent::gui
