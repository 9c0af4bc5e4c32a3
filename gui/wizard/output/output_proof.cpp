// SPDX-License-Identifier: MIT
#include "wizard/output/output_proof.h"

#include <QStandardPaths>

#include "handover/report_pdf.h"
#include "output/default_picture.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/pipeline/verify.h"
#include "relucent/report/report.h"
#include "text/written_times.h"
#include "wizard/output/proof_file.h"

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;

/// Of the show that this program installs.
std::vector<fs::path> showLogs() {
  fs::path folder = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation).toStdString();
  return {folder / "show.log", folder / "health.json"};
}

/// When the light transport was measured.
std::string measurementOf(const Session& session) {
  const auto& stored = session.result(calibration::Stage::acquisition);
  return stored ? stored->stored : std::string();
}

std::shared_ptr<Proof> proofOf(pipeline::ProveResult figures, const fs::path& folder) {
  auto proof = std::make_shared<Proof>();
  proof->views = proofViews(folder, figures.others.size() + 1);
  proof->taken = QDateTime::currentDateTime();
  proof->figures = std::move(figures);
  return proof;
}

QDateTime timeOf(const pipeline::DriftRecord& drift) {
  return timeWritten(drift.checked);
}

/// So that nobody asks for the former again because of the latter.
bool isShortlyBefore(const QDateTime& former, const QDateTime& latter) {
  constexpr qint64 shortly = 3600;  // seconds
  const qint64 between = former.secsTo(latter);
  return between >= 0 && between < shortly;
}

/// By a dozen patterns one after the other, where a photograph needs a few pictures that stand.
bool flashes(OutputProof::Work work) {
  return work == OutputProof::Work::drift || work == OutputProof::Work::repair;
}

}  // namespace

struct OutputProof::Found {
  std::shared_ptr<const Proof> proof;
  std::optional<pipeline::DriftRecord> drift;
  std::optional<pipeline::RepairResult> repair;
  QString report;
};

OutputProof::OutputProof(Session& session, const StepName& step, QObject* parent)
    : QObject(parent), session_(session), step_(step) {
  connect(&session_, &Session::opened, this, [this] {
    job_.cancel();
    recall();
    repair_.reset();
    found_ = nullptr;
    pushedBack_ = endedUnclear_ = false;
    leftElsewhere_.reset();
    Q_EMIT changed();
  });
  connect(&session_, &Session::stepsChanged, this, &OutputProof::look);
  connect(&job_, &Job::progressed, this, &OutputProof::progressed);
  connect(&job_, &Job::ended, this, &OutputProof::finished);
}

/// Somebody photographed it earlier.
void OutputProof::recall() {
  proof_ = session_.isOpen() ? loadProof(proofFolder(session_.path())) : nullptr;
  recallDrift();
}

/// Of the measurement that is used: what a check found of another one says nothing of it, and holds again
/// when that one is used again.
void OutputProof::recallDrift() {
  driftOf_ = measurementOf(session_);
  drift_ = session_.isOpen() ? loadDrift(proofFolder(session_.path())) : std::nullopt;
  if (drift_ && drift_->measurement != driftOf_) drift_.reset();
}

QString OutputProof::whyNot() const {
  if (!session_.isOpen()) return tr("No venue is open.");
  switch (work()) {
    case Work::photograph:
      return tr("A photograph is being taken.");
    case Work::drift:
      return tr("Drift is being checked.");
    case Work::repair:
      return tr("It is being repaired.");
    case Work::report:
      return tr("The report is being written.");
    case Work::none:
      break;
  }
  return session_.whyInUse();
}

bool OutputProof::holds(const Proof& proof) const {
  const bool isSame = proof.shownFrom.empty() || proof.shownFrom == session_.shownFrom();
  return isSame && proof.content == session_.settings().content && proof.measured == measurementOf(session_);
}

/// What was measured, chosen or decided has changed.
void OutputProof::look() {
  if (!session_.isOpen()) return;
  const bool isDriftOld = driftOf_ != measurementOf(session_);
  if (isDriftOld) recallDrift();
  const bool isRepairOld = repair_ && repairOf_ != measurementOf(session_);
  if (isRepairOld) repair_.reset();
  const bool wasOutOfDate = std::exchange(wasOutOfDate_, isOutOfDate());
  if (isDriftOld || isRepairOld || wasOutOfDate != wasOutOfDate_) Q_EMIT changed();
}

const pipeline::DriftRecord* OutputProof::newestDrift() const {
  const bool isAnswered = drift_ && proof_ && pipeline::answers(recordOf(*proof_), !isOutOfDate(), *drift_);
  return drift_ && !isAnswered ? &*drift_ : nullptr;
}

OutputProof::Next OutputProof::next() const {
  using acquisition::Verdict;
  if (leftElsewhere()) return Next::pushBack;
  if (pushedBack_) return Next::photograph;
  const pipeline::DriftRecord* drift = newestDrift();
  if (drift != nullptr && drift->verdict == Verdict::startAgain) return Next::aimAgain;
  const Proof* proof = current();
  const bool isMoved = proof != nullptr && showsItMoved(*proof);
  if (drift != nullptr && drift->verdict == Verdict::remeasure)
    return isMoved ? Next::pushBack : isBeyondRepair() ? Next::measureAgain : Next::repair;
  if (proof == nullptr) return Next::photograph;
  if (proof->isAsPredicted()) return Next::install;
  // The patterns fit: perhaps something was in the way of that photograph.
  if (drift != nullptr) return Next::photograph;
  const bool wasRepairInVain = repair_ && repair_->end != pipeline::RepairEnd::repaired;
  if (wasRepairInVain && proof->taken <= repairTried_)
    return isBeyondRepair() ? Next::measureAgain : Next::photograph;
  if (isMoved) return Next::pushBack;
  if (wasRepairInVain && isShortlyBefore(repairTried_, proof->taken)) return Next::measureAgain;
  return isCheckContradicted() ? Next::repair : Next::checkDrift;
}

bool OutputProof::showsItMoved(const Proof& proof) {
  return proof.figures.moved.explains && pipeline::viewThatDiffers(proof.figures) == std::size_t{0};
}

bool OutputProof::isCheckContradicted() const {
  const Proof* proof = current();
  return drift_ && drift_->verdict == acquisition::Verdict::stillGood && newestDrift() == nullptr &&
         proof != nullptr && !proof->isAsPredicted() && isShortlyBefore(timeOf(*drift_), proof->taken);
}

bool OutputProof::isUnsettled() const {
  return current() != nullptr && !current()->isAsPredicted() && !pushedBack_ && next() == Next::photograph;
}

void OutputProof::cameraLeft(double pixels) {
  leftElsewhere_ = pixels;
  leftBy_ = measurementOf(session_);
  pushedBack_ = false;
  Q_EMIT changed();
}

std::optional<double> OutputProof::leftElsewhere() const {
  return leftBy_ == measurementOf(session_) ? leftElsewhere_ : std::nullopt;
}

void OutputProof::cameraAtItsPlace(bool wasSeenElsewhere) {
  const bool wasLeft = std::exchange(leftElsewhere_, std::nullopt).has_value();
  // One that never moved explains nothing of what was found.
  const bool wasElsewhere = wasSeenElsewhere || wasLeft || (current() != nullptr && showsItMoved(*current()));
  if (!wasElsewhere) return;
  pushedBack_ = (current() != nullptr && !current()->isAsPredicted()) ||
                (drift_ && drift_->verdict != acquisition::Verdict::stillGood);
  const bool wasInVain = isBeyondRepair();
  if (wasInVain) repair_.reset();  // of a view that is no more
  if (!pushedBack_) {
    if (wasLeft || wasInVain) Q_EMIT changed();
    return;
  }
  drift_.reset();
  forgetDrift(proofFolder(session_.path()));
  Q_EMIT changed();
}

void OutputProof::start(Work work, Job::Work job) {
  work_ = work;
  lease_ = session_.leaseDevices(step_, work == Work::report ? DeviceWork::brief : DeviceWork::light, [this] {
    if (!flashes(work_)) return;
    endedUnclear_ = true;
    cancel();
  });
  endedUnclear_ = false;
  job_.start(std::move(job));
  Q_EMIT changed();
}

void OutputProof::photograph(const QString& picture, const Canvas& canvas) {
  if (!isPossible()) return;
  found_ = std::make_shared<Found>();
  start(Work::photograph, [found = found_, work = workOf(session_), picture, canvas,
                           content = session_.settings().content, measured = measurementOf(session_),
                           shownFrom = session_.shownFrom()](Progress& progress) {
    pipeline::ProveSettings settings;
    settings.out = proofFolder(work.path);
    settings.image = pictureFile(picture, settings.out);
    settings.method = content.method;
    settings.target = targetOf(content);
    settings.canvas = {{canvas.size.width(), canvas.size.height()}, canvas.fit};
    Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    Progress proving = progress.part(
        0.8, RELUCENT_MESSAGE("stage.taking-verification-photograph", "Taking the verification photograph"));
    auto proof = proofOf(pipeline::proveCalibration(work.path, settings, rig, proving), settings.out);
    proof->content = content;
    proof->measured = measured;
    proof->shownFrom = shownFrom;
    proof->picture = picture;
    saveProof(*proof, settings.out);
    found->proof = proof;
  });
}

void OutputProof::checkDrift() {
  if (!isPossible() || !mayFlash()) return;
  found_ = std::make_shared<Found>();
  start(Work::drift, [found = found_, work = workOf(session_),
                      measurement = measurementOf(session_)](Progress& progress) {
    Progress opening = progress.part(0.3, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    Progress verifying = progress.part(0.7, RELUCENT_MESSAGE("stage.checking-drift", "Checking for drift"));
    const pipeline::VerifyResult result = pipeline::verifyCalibration(work.path, {}, rig, verifying);
    found->drift = pipeline::DriftRecord{written(QDateTime::currentDateTime()),
                                         measurement,
                                         result.judgement.verdict,
                                         result.found.error,
                                         result.errorThen,
                                         result.found.changedShare,
                                         result.found.ambient,
                                         result.found.lamp};
    pipeline::saveDriftRecord(*found->drift, proofFolder(work.path));
  });
}

void OutputProof::startRepair(const QString& picture) {
  if (!isPossible() || !mayFlash()) return;
  found_ = std::make_shared<Found>();
  start(Work::repair, [found = found_, work = workOf(session_), picture](Progress& progress) {
    Progress opening = progress.part(0.1, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    pipeline::RepairSettings settings;
    settings.image = pictureFile(picture, proofFolder(work.path));
    Progress repairing =
        progress.part(0.9, RELUCENT_MESSAGE("stage.looking-for-changes", "Looking for what has changed"));
    found->repair = pipeline::repairCalibration(work.path, settings, rig, repairing);
  });
}

void OutputProof::undoRepair() {
  if (!isPossible() || !repairNote()) return;
  try {
    pipeline::undoRepair(session_.path());
    repair_.reset();
    session_.reload();
    // The repair found what that check had missed.
    if (drift_ && drift_->verdict == acquisition::Verdict::stillGood) {
      drift_.reset();
      forgetDrift(proofFolder(session_.path()));
    }
  } catch (...) {
    Q_EMIT failed(failureOf(std::current_exception()));
    return;
  }
  Q_EMIT changed();
}

std::optional<calibration::RepairNote> OutputProof::repairNote() const {
  const auto& measured = session_.figures<calibration::Stage::acquisition>();
  return measured ? measured->repair : std::nullopt;
}

std::string OutputProof::repairedAt() const {
  return measurementOf(session_);
}

void OutputProof::report(const QString& picture) {
  if (!isPossible()) return;
  found_ = std::make_shared<Found>();
  start(Work::report, [found = found_, path = session_.path(), cache = session_.cache(), picture,
                       logs = showLogs()](Progress& progress) {
    report::ReportSettings settings;
    settings.out = path / "report.html";
    settings.images = {pictureFile(picture, proofFolder(path))};
    settings.bundle = path / "support.zip";
    settings.attachments = logs;
    settings.evaluate = false;  // what was measured, not what a simulation knows
    Progress writing = progress.part(1.0, RELUCENT_MESSAGE("stage.writing-report", "Writing the report"));
    pipeline::WrittenFiles written = relucent::report::makeReport(path, settings, cache, writing);
    found->report = QString::fromStdString(written.files.front().string());
    writeReportPdf(QString::fromStdString(readFile(settings.out)),
                   QString::fromStdString((path / "report.pdf").string()));
  });
}

void OutputProof::finished() {
  std::shared_ptr<Found> found = std::exchange(found_, nullptr);
  lease_.release();
  bool done = job_.state() == Job::State::done && found;
  if (done) endedUnclear_ = false;  // it was ready by then
  if (done && found->proof) proof_ = found->proof;
  if (done && found->drift) {
    drift_ = std::move(found->drift);
    if (isBeyondRepair()) repair_.reset();  // what was tried in vain was before that
  }
  std::optional<Failure> unread;
  if (done && found->repair) {
    // What was found before of the former measurement goes with it.
    if (found->repair->end == pipeline::RepairEnd::repaired) unread = session_.readAgain();
    repair_ = std::move(found->repair);
    if (repair_->end == pipeline::RepairEnd::nothingToDo && drift_) {
      drift_.reset();  // what was found before is no more
      forgetDrift(proofFolder(session_.path()));
    }
    repairOf_ = measurementOf(session_);
    repairTried_ = QDateTime::currentDateTimeUtc();
  }
  const bool isSeen = done && (found->proof || found->drift);
  if (isSeen) pushedBack_ = false;
  const bool isAsMeasured = done && work_ == Work::repair && repair_->end == pipeline::RepairEnd::nothingToDo;
  if (isSeen || isAsMeasured) leftElsewhere_.reset();
  Q_EMIT changed();
  Q_EMIT ended(work_);
  if (done && !found->report.isEmpty()) Q_EMIT reported(found->report);
  if (unread) Q_EMIT failed(*unread);
  if (job_.state() == Job::State::failed) Q_EMIT failed(job_.failure());
}

}  // namespace relucent::gui
