// SPDX-License-Identifier: MIT
// How far a measurement is, and how it is held up, ended or taken back.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "wizard/acquire/acquire_page.h"

namespace relucent::gui {
namespace {

constexpr int photographsBeforeTime = 20;
constexpr double mostBeforeTheEnd = 0.99;
// Below so many patterns a forecast's time is of computing, not of patterns.
constexpr int enoughPatterns = 5;

LiveRig::Taken takenOf(const Session& session) {
  return session.live().taken(std::string(nameOf(calibration::Stage::acquisition)));
}

}  // namespace

std::optional<double> AcquirePage::progress() const {
  if (!isMeasuring()) return std::nullopt;
  const PatternCount count = patterns();
  const double photographed =
      pipeline::photographedShare * static_cast<double>(count.taken) / std::max(1, count.expected);
  // Before the finest blocks are worked out, photographs tell better.
  const bool isConcluding = isFinestDone_ && job_.fraction() > pipeline::photographedShare;
  return std::min(mostBeforeTheEnd, isConcluding ? job_.fraction() : photographed);
}

bool AcquirePage::isWorkingOut() const {
  return isMeasuring() && pipeline::isWorkingOut(job_.stageId());
}

int AcquirePage::photographs() const {
  return isMeasuring() ? takenOf(session_).photographs - begunAt_ : 0;
}

bool AcquirePage::isReading() const {
  const bool isOfThis = !isStale() || again_ > 0;
  // While the devices are opened, patterns of their checks are on the projector.
  return isMeasuring() && job_.fraction() >= openingShare && !anew_ && kept_ > 0 && isOfThis &&
         photographs() == 0;
}

AcquisitionTrace::SharedOutlook AcquirePage::outlook() const {
  const AcquisitionTrace::SharedOutlook& outlook = trace_.outlook();
  const bool isGoingOn = isMeasuring() && !anew_ && stoppedAt() > 0;
  return isGoingOn && outlook && outlook->blocks > stoppedAt() ? nullptr : outlook;
}

PatternCount AcquirePage::reading() const {
  return {std::min(kept_, patterns().taken), kept_};
}

PatternCount AcquirePage::patterns() const {
  const AcquisitionTrace::Growth growth = trace_.growth();
  // Of the tree alone, as far as it was read from the journal; with checks and references, once there is a
  // new photograph, whose number counts them all.
  int taken = growth.through;
  if (growth.levels.size() > 1)
    taken = std::accumulate(growth.levels.begin(), growth.levels.end() - 1, taken);
  if (photographs() > 0) taken = takenOf(session_).lastShot + 1;
  return {taken, std::max(taken, patternsExpected())};
}

/// In all, by the levels that have begun. The finest goes on while that makes predictions better: before it
/// has as many patterns as were expected of it, or is worked out, nobody takes it for complete.
int AcquirePage::patternsExpected() const {
  if (isDone()) return cost().value_or(calibration::StageCost()).patterns;
  const Rasters projectors = session_.projectorRasters();
  if (projectors.count() == 0) return 0;
  const Rasters cameras = camerasUsed();
  const acquisition::AcquisitionSettings& settings = session_.settings().acquisition;
  acquisition::AcquisitionState state{isTraceCurrent() ? trace_.growth().levels : std::vector<int>()};
  if (!state.levels.empty() && !(isMeasuring() && isFinestDone_)) {
    const std::span before(state.levels.begin(), state.levels.end() - 1);
    const auto expected = acquisition::levelPatterns(projectors, settings, before);
    if (expected.size() == state.levels.size())
      state.levels.back() =
          std::max(state.levels.back(), static_cast<int>(std::lround(expected.back().likely)));
  }
  return acquisition::forecast({cameras, projectors, 1, 1.0}, settings, {}, state).shots;
}

void AcquirePage::expect(const WorkLeft& left) {
  forecast_ = left;
  if (left.shots >= enoughPatterns) secondsAPattern_ = left.seconds / left.shots;
}

std::optional<double> AcquirePage::secondsLeft() const {
  if (isReading()) return readingTime_.seconds(std::chrono::steady_clock::now());
  // What is expected is of photographs.
  if (!isMeasuring() || isWorkingOut() || photographs() < photographsBeforeTime) return std::nullopt;
  const PatternCount count = patterns();
  if (count.taken >= count.expected || !(secondsAPattern_ > 0.0)) return std::nullopt;
  return secondsAPattern_ * (count.expected - count.taken);
}

void AcquirePage::tick() {
  if (isReading()) {
    const PatternCount read = reading();
    readingTime_.add(std::chrono::steady_clock::now(), static_cast<double>(read.taken) / read.expected);
  }
  if (isHeldUp())
    rate_.forget();
  else if (isMeasuring())
    rate_.add(std::chrono::steady_clock::now(), photographs());
  tellProgress();
}

AcquirePage::Traced AcquirePage::traced() const {
  return {session_.measurement(), session_.progress(calibration::Stage::acquisition),
          session_.settings().acquisition.relativeThreshold};
}

bool AcquirePage::isTraceCurrent() const {
  return isMeasuring() || traced() == traced_;
}

void AcquirePage::pause() {
  session_.live().pause();
  tellProgress();
  tellStatus();
}

void AcquirePage::resume() {
  session_.live().resume();
  tellProgress();
  tellStatus();
}

void AcquirePage::stopAndKeep() {
  // Nothing is new yet: what there was stands, and may be more than what has been read of it.
  if (isReading()) return finish();
  job_.stopAndKeep();
  if (isAsking()) answer(sentinels::Answer::keepAndStop);
  session_.giveUpCamera();
  // What it ends with are patterns, too.
  if (session_.mayMeasure()) return resume();
  tellProgress();
  tellStatus();
}

void AcquirePage::askToReturn() {
  // What has ended is a result, of which nothing is under way.
  const bool isResult = isDone() && !isMeasuring();
  returnNow_->show(isResult ? tr("Use the earlier one") : tr("Keep the earlier one"));
  stayWithNew_->show(isResult ? tr("Keep the new one") : tr("Keep the new ones"));
  returning_ = std::make_unique<QObject>();
  FailureReport question;
  question.failure.heading =
      isResult ? tr("Use the earlier measurement?") : tr("Keep the earlier measurement?");
  question.failure.what =
      tr("The new photographs are set aside and not used again: measuring again then takes every photograph "
         "again.");
  question.safe = tr("The earlier measurement, and all that followed from it.");
  question.resume = stayWithNew_;
  question.goOn = returnNow_;
  // Of what shows nothing better than uncorrected pictures nobody is advised to keep it.
  if (isResult && isUseless()) std::swap(question.resume, question.goOn);
  question.isQuestion = true;
  question.reason = returning_.get();
  Q_EMIT failed(question);
}

void AcquirePage::returnToEarlier() {
  returning_.reset();
  if (isMeasuring()) {
    returns_ = true;
    job_.cancel();
    asking_.reset();
    question_->setClosed(true);
    return resume();
  }
  try {
    session_.returnToEarlier(calibration::Stage::acquisition);
  } catch (...) {
    Q_EMIT failed({failureOf(std::current_exception()), tr("What is measured is safe.")});
  }
  countKept();
  tellAll();
}

}  // namespace relucent::gui
