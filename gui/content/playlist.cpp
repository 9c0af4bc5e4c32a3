// SPDX-License-Identifier: MIT
#include "content/playlist.h"

#include <QFileInfo>
#include <algorithm>
#include <cmath>
#include <utility>

#include "content/content_address.h"
#include "content/image_sequence.h"
#include "content/live_camera.h"
#include "content/live_cast.h"
#include "content/live_screen.h"
#include "content/live_stream.h"
#include "content/still_image.h"
#include "content/test_chart.h"
#include "content/video.h"
#include "relucent/base/error.h"

namespace relucent::gui {
namespace {

constexpr std::size_t mostSentences = 100;
constexpr ContentTime betweenTries{1'000'000};
constexpr ContentTime livePatience{10'000'000};

std::unique_ptr<ContentSource> openChart(const QString& name, const Canvas& canvas) {
  if (std::optional<TestChart> chart = testChartFromName(name))
    return std::make_unique<TestChartContent>(*chart, canvas);
  QStringList known;
  for (TestChart chart : allTestCharts) known.append(testChartName(chart));
  throw Error(ErrorKind::input,
              RELUCENT_ENGLISH_MESSAGE("content.unknown-test-chart", "there is no test chart '{}'")
                  .with(name.toStdString()),
              RELUCENT_ENGLISH_MESSAGE("content.choose-one", "choose one of {}")
                  .with(known.join(", ").toStdString()));
}

std::unique_ptr<ContentSource> openScreen(const ContentAddress& address, const Canvas& canvas,
                                          Attendance attendance) {
  const bool isScreen = address.kind == ContentAddress::Kind::screen;
  if (isGivenByPortal())
    return std::make_unique<LiveCast>(isScreen ? ScreenCastWish::What::screen : ScreenCastWish::What::window,
                                      address.which, canvas, attendance);
  return std::make_unique<LiveScreen>(isScreen ? LiveScreen::What::screen : LiveScreen::What::window,
                                      address.which, canvas);
}

ContentTime fromSeconds(double seconds) {
  return ContentTime(std::llround(1e6 * seconds));
}

}  // namespace

std::unique_ptr<ContentSource> openContent(const PlaylistItem& item, const Canvas& canvas,
                                           Attendance attendance) {
  ContentAddress address = addressOf(item.path);
  switch (address.kind) {
    case ContentAddress::Kind::chart:
      return openChart(address.which, canvas);
    case ContentAddress::Kind::screen:
    case ContentAddress::Kind::window:
      return openScreen(address, canvas, attendance);
    case ContentAddress::Kind::camera:
      return std::make_unique<LiveCamera>(address.which, canvas);
    case ContentAddress::Kind::stream:
      return std::make_unique<LiveStream>(streamAddressFrom(address.which), canvas);
    case ContentAddress::Kind::file:
      break;
  }
  if (QFileInfo(item.path).isDir())
    return std::make_unique<ImageSequence>(picturesIn(item.path), item.picturesPerSecond, canvas);
  if (isVideo(item.path)) return std::make_unique<Video>(item.path, canvas);
  return std::make_unique<StillImage>(item.path, canvas);
}

Playlist::Playlist(PlaylistSettings settings, Canvas canvas, Attendance attendance, qsizetype first)
    : settings_(std::move(settings)), canvas_(canvas), attendance_(attendance) {
  if (std::vector<Message> wrong = problems(settings_); !wrong.empty())
    throw Error(ErrorKind::input, wrong.front(),
                RELUCENT_ENGLISH_MESSAGE("content.change-playlist", "change the playlist"));
  openNext(first > 0 && first < settings_.items.size() ? first - 1 : -1);
}

Playlist::~Playlist() {
  opening_.waitForFinished();
}

ContentTime Playlist::lengthOf(const Playing& item) const {
  return item.source->length().value_or(fromSeconds(settings_.items[item.index].seconds));
}

ContentTime Playlist::fadeBetween(const Playing& item, const Playing& next) const {
  return std::min({fromSeconds(settings_.fadeSeconds), lengthOf(item) / 2, lengthOf(next) / 2});
}

void Playlist::openNext(qsizetype after) {
  next_ = {};
  qsizetype index = after + 1;
  if (index >= settings_.items.size()) {
    // A list of one picture needs no next one: it would fade into itself.
    if (!settings_.loop || settings_.items.size() == 1) {
      ended_ = true;
      return;
    }
    index = 0;
  }
  open(index);
}

void Playlist::open(qsizetype index) {
  opened_ = {};
  openingIndex_ = index;
  opening_ = startedInBackground([item = settings_.items[index], canvas = canvas_, attendance = attendance_] {
    return std::shared_ptr<ContentSource>(openContent(item, canvas, attendance));
  });
}

void Playlist::skip(const Message& sentence) {
  const auto before = std::ranges::find(skipped_, openingIndex_, &Skipped::index);
  const bool isNew = before == skipped_.end() || before->why != sentence;
  if (isNew) {
    forgive(openingIndex_);
    if (skipped_.size() < mostSentences) skipped_.push_back({openingIndex_, sentence});
  }
  openNext(openingIndex_);
}

void Playlist::forgive(qsizetype index) {
  std::erase_if(skipped_, [index](const Skipped& one) { return one.index == index; });
}

bool Playlist::nextIsReady(ContentTime now) {
  if (next_.source) return true;
  if (!opened_.source) {
    if (ended_ || !opening_.isFinished()) return false;
    try {
      opened_ = {openingIndex_, resultOf(opening_), now};
    } catch (const Error& error) {
      skip(error.sentence());
      return false;
    }
  }
  // Where nothing plays, black is as good as anything until it comes.
  if (opened_.source->isReady() || !current_.source) {
    // A stream that shows nothing yet is not there again.
    if (opened_.source->isReady()) forgive(opened_.index);
    next_ = std::exchange(opened_, {});
    next_.begin = now;
    return true;
  }
  const std::optional<LiveState> live = opened_.source->live();
  if (live && live->phase == LiveState::Phase::asking) opened_.begin = now;
  if (now < opened_.begin + livePatience) return false;
  Message problem = RELUCENT_MESSAGE("stream.not-yet", "it has given no picture yet");
  if (live && !live->problem.empty()) problem = live->problem;
  skip(RELUCENT_MESSAGE("stream.not-ready", "{}: {}")
           .with(live ? live->address.toStdString() : std::string(), problem));
  return false;
}

void Playlist::begin(ContentTime now) {
  bool rewound = now < last_;
  if (!rewound && now < tryAgain_) return;
  opening_.waitForFinished();
  current_ = {};
  ended_ = false;
  // What the constructor opens, not once more: some cameras have one visitor at a time.
  if (!std::exchange(isFresh_, false)) openNext(-1);
  // The first picture is worth waiting for.
  for (qsizetype tried = 0; tried < settings_.items.size() && !ended_; ++tried) {
    opening_.waitForFinished();
    if (!nextIsReady({})) continue;
    current_ = std::exchange(next_, {});
    current_.begin = rewound ? ContentTime{0} : now;
    openNext(current_.index);
    return;
  }
  tryAgain_ = now + betweenTries;
}

ContentPicture Playlist::frameOf(const Playing& item, ContentTime time) {
  ContentTime own = time - item.begin;
  // A list of one film plays it again.
  if (settings_.loop && settings_.items.size() == 1 && item.source->length()) own %= lengthOf(item);
  return item.source->at(std::max(own, ContentTime{0}));
}

Playlist::Status Playlist::status() const {
  QMutexLocker lock(&statusGuard_);
  Status status = status_;
  for (const auto& source : live_)
    if (const std::optional<LiveState> live = source->live()) status.live.push_back(*live);
  return status;
}

void Playlist::playItem(qsizetype index) {
  require(index >= 0 && index < settings_.items.size(), "item {} of {}", index, settings_.items.size());
  QMutexLocker lock(&statusGuard_);
  wanted_ = index;
}

void Playlist::openWanted() {
  QMutexLocker lock(&statusGuard_);
  if (!wanted_) return;
  ended_ = false;
  jumps_ = true;
  next_ = {};
  open(*std::exchange(wanted_, std::nullopt));
}

ContentPicture Playlist::at(ContentTime time) {
  ContentPicture picture = pictureAt(time);
  std::vector<std::shared_ptr<ContentSource>> live;
  for (const auto& source : {current_.source, next_.source, opened_.source})
    if (source && source->live()) live.push_back(source);
  QMutexLocker lock(&statusGuard_);
  status_ = {current_.index, skipped_};
  live_.swap(live);  // those of before go after the lock
  return picture;
}

ContentPicture Playlist::pictureAt(ContentTime time) {
  if (!current_.source || time < last_) begin(time);
  last_ = time;
  if (!current_.source) return {};
  openWanted();

  while (nextIsReady(time)) {
    ContentTime fade = fadeBetween(current_, next_);
    ContentTime fadeBegin =
        jumps_ ? next_.begin : std::max(current_.begin + lengthOf(current_) - fade, next_.begin);
    if (time < fadeBegin) break;
    next_.begin = fadeBegin;
    ContentTime into = time - fadeBegin;
    if (into < fade)
      return {crossFaded(frameOf(current_, time).image, frameOf(next_, time).image,
                         static_cast<double>(into.count()) / static_cast<double>(fade.count())),
              nextFrameNumber()};
    current_ = std::exchange(next_, {});
    jumps_ = false;
    openNext(current_.index);
  }
  return frameOf(current_, time);
}

}  // namespace relucent::gui
