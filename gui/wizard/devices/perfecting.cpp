// SPDX-License-Identifier: MIT
#include "wizard/devices/perfecting.h"

#include <algorithm>
#include <utility>

#include "output/default_picture.h"
#include "output/output_playlist.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;

/// Which one is kept for a picture. Empty: the picture cannot be read.
std::string keyOf(const std::string& shownFrom, const QString& picture, const Canvas& canvas) {
  const std::string identity = identityOf(picture, readContent(picture).size(), canvas);
  return identity.empty() ? identity : pipeline::perfectedKey(shownFrom, identity);
}

/// Tells the page's thread how many photographs there are.
class Counter {
 public:
  Counter(QObject* on, std::function<void(int)> tell) : on_(on), tell_(std::move(tell)) {}
  void count() {
    QMetaObject::invokeMethod(on_, [tell = tell_, count = ++count_] { tell(count); });
  }

 private:
  QObject* on_;
  std::function<void(int)> tell_;
  int count_ = 0;
};

}  // namespace

struct Perfecting::Found {
  std::optional<pipeline::PerfectedImage> image;
};

Perfecting::Perfecting(Session& session, const StepName& step, QObject* parent)
    : QObject(parent),
      session_(session),
      step_(step),
      looking_(
          [this](Known known) {
            known_ = std::move(known);
            Q_EMIT changed();
          },
          [this](const Failure&) {  // the page tells of pictures that cannot be read
            known_ = {};
            Q_EMIT changed();
          }) {
  connect(&session_, &Session::opened, this, [this] {
    job_.cancel();
    found_ = nullptr;
    picture_.clear();
    outcome_.reset();
    known_ = {};
    Q_EMIT changed();
  });
  connect(&session_, &Session::stepsChanged, this, &Perfecting::look);
  connect(&job_, &Job::progressed, this, &Perfecting::progressed);
  connect(&job_, &Job::ended, this, &Perfecting::finished);
}

void Perfecting::lookAt(const QString& picture, const Canvas& canvas) {
  const bool isSame = picture == picture_ && canvas.size == canvas_.size && canvas.fit == canvas_.fit;
  if (isSame || isRunning()) return;
  picture_ = picture;
  canvas_ = canvas;
  look();
}

void Perfecting::look() {
  if (!session_.isOpen() || picture_.isEmpty()) return;
  looking_.ask([folder = session_.path(), shownFrom = session_.shownFrom(), picture = picture_,
                canvas = canvas_]() -> Known {
    const std::string key = keyOf(shownFrom, picture, canvas);
    if (key.empty()) return {};
    Known known{pipeline::findPerfected(folder, key)};
    if (known.picture) return known;
    const std::string file = pathOfPicture(picture, pipeline::perfectedFolder(folder)).string();
    known.wasBefore =
        std::ranges::any_of(pipeline::allPerfected(folder), [&](const pipeline::PerfectedPicture& kept) {
          // The program's own picture lies in several places.
          return kept.picture == file ||
                 (OutputPlaylist::isDemonstration(QString::fromStdString(kept.picture)) &&
                  OutputPlaylist::isDemonstration(picture));
        });
    return known;
  });
}

QString Perfecting::whyNot() const {
  if (!session_.isOpen()) return tr("No venue is open.");
  return isRunning() ? tr("The picture is being perfected.") : session_.whyInUse();
}

void Perfecting::start() {
  if (!whyNot().isEmpty() || picture_.isEmpty()) return;
  found_ = std::make_shared<Found>();
  photographs_ = 0;
  outcome_.reset();
  tried_ = picture_;
  lease_ = session_.leaseDevices(step_, DeviceWork::light);
  auto counter = std::make_shared<Counter>(this, [this](int count) {
    photographs_ = count;
    Q_EMIT progressed();
  });
  job_.start([found = found_, work = workOf(session_), picture = picture_, canvas = canvas_,
              counter](Progress& progress) {
    pipeline::PerfectSettings settings;
    settings.images = {pictureFile(picture, pipeline::perfectedFolder(work.path))};
    settings.canvas = {{canvas.size.width(), canvas.size.height()}, canvas.fit};
    Progress opening = progress.part(0.2, RELUCENT_MESSAGE("stage.opening-devices", "Opening the devices"));
    rig::Rig& rig = work.devices->open(opening);
    Progress perfecting = progress.part(
        0.8, RELUCENT_MESSAGE("stage.perfecting", "Correcting the picture by photographs of itself"));
    pipeline::PerfectResult result = perfectPictures(
        work.path, settings, rig, [&](std::size_t, const pipeline::PerfectingRound&) { counter->count(); },
        perfecting);
    found->image = std::move(result.images.front());
  });
  Q_EMIT changed();
}

void Perfecting::forget() {
  if (!known_.picture) return;
  try {
    removePerfected(*known_.picture);
  } catch (...) {
    Q_EMIT failed(failureOf(std::current_exception()));
    return;
  }
  known_ = {};
  outcome_.reset();
  Q_EMIT changed();
  Q_EMIT ended(true);
}

void Perfecting::finished() {
  const std::shared_ptr<Found> found = std::exchange(found_, nullptr);
  lease_.release();
  const bool done = job_.state() == Job::State::done && found && found->image;
  if (done) outcome_ = std::move(found->image);
  look();
  Q_EMIT changed();
  Q_EMIT ended(done && outcome_->kept);
  if (job_.state() == Job::State::failed) Q_EMIT failed(job_.failure());
}

}  // namespace relucent::gui
