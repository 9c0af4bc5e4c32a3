// SPDX-License-Identifier: MIT
#include "output/show.h"

#include <QDateTime>
#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStandardPaths>
#include <algorithm>
#include <thread>
#include <utility>

#include "output/output_playlist.h"
#include "output/output_tap.h"
#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/calibration/calibration_folder.h"
#include "relucent/pipeline/perfected.h"
#include "relucent/pipeline/proof_record.h"
#include "relucent/platform/process.h"
#include "text/written_times.h"

namespace relucent::gui {
namespace {

constexpr std::chrono::seconds noticed{1};  // of sleep
constexpr std::chrono::milliseconds healthInterval{10'000};
constexpr int streamsInterval = 1'000;  // milliseconds
constexpr std::chrono::milliseconds shortestPause{
    1'000};  // before it is tried again, doubled with every failure ...
constexpr std::chrono::milliseconds longestPause{60'000};    // ... up to here
constexpr int aheadOfTime = 60'000;                          // milliseconds: a set is prepared
constexpr std::chrono::milliseconds forgivenAfter{600'000};  // of playing without one

/// Where core's command line keeps them, too.
std::filesystem::path simulatedVenues() {
  return (QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + "/relucent").toStdString();
}

/// Nobody takes the lines of a rehearsal for those of a show.
ShowLog::Mark markOf(const MachineClock& clock) {
  return [rehearsal = clock.rehearsal] {
    return rehearsal ? "rehearsal " + rehearsal->now().toString(Qt::ISODate) + ' ' : QString();
  };
}

pjlink::Waiting waitingOf(const MachineClock& clock) {
  if (!clock.rehearsal) return {};
  using Steady = std::chrono::steady_clock;
  return {[begin = Steady::now()] { return begin + RehearsalClock::haste * (Steady::now() - begin); },
          [](std::chrono::milliseconds usual) {
            std::this_thread::sleep_for(std::chrono::duration<double>(usual) / RehearsalClock::haste);
          }};
}

}  // namespace

Show::Show(ShowSettings settings, MakeRenderer make, MachineClock clock, QObject* parent,
           std::unique_ptr<ShowPhotography> photography, std::unique_ptr<WatchSource> watch)
    : QObject(parent),
      settings_(std::move(settings)),
      make_(std::move(make)),
      clock_(std::move(clock)),
      slept_(clock_.slept()),
      log_(settings_.folder, markOf(clock_)),
      awake_(tr("A show is playing.")),
      wishes_(settings_.powerOffAfter),
      photographs_(photography ? std::move(photography)
                               : photographyOf(settings_.calibration, simulatedVenues(), waitingOf(clock_))) {
  scheduledSet_ = setAt(settings_.content.sets, clock_.wall().time());
  wantedSet_ = scheduledSet_ && settings_.set.empty() ? scheduledSet_->toStdString() : settings_.set;
  if (settings_.night) nights_.emplace(settings_, clock_.wall());
  connect(&photographs_, &ShowPhotographs::progressed, this,
          [this](const QString& work, double fraction, const QString& stage) {
            if (control_) control_->announce('/' + work, "progress", {fraction, stage});
          });
  connect(&photographs_, &ShowPhotographs::ended, this, &Show::photographed);
  connect(&escape_, &HeldKey::held, this, &Show::endWanted);
  for (const QString& problem : awake_.problems()) log_.warn(problem);
  health_.setInterval(clock_.pause(healthInterval));
  connect(&health_, &QTimer::timeout, this, [this] { look(); });
  streamsLooked_.setInterval(streamsInterval);
  connect(&streamsLooked_, &QTimer::timeout, this, &Show::tellStreams);
  again_.setSingleShot(true);
  connect(&again_, &QTimer::timeout, this, [this] {
    // Displays of projectors that are to be off are not missed, and those that are photographed are not free.
    if ((!player_ && !wishes().on) || state_ == ShowState::photographing)
      return again_.start(clock_.pause(longestPause));
    try {
      open();
      start();
    } catch (const Error& error) {
      tryAgain(error.sentence());
    }
  });
  projectors_ = watchOf(settings_, wishes(), clock_);
  if (projectors_) {
    connect(projectors_.get(), &ProjectorWatch::told, this, [this](const Message& sentence) {
      log_.tell(QString::fromStdString(englishSentence(sentence)));
    });
    connect(projectors_.get(), &ProjectorWatch::warned, this, [this](const Message& sentence) {
      log_.warn(QString::fromStdString(englishSentence(sentence)));
    });
    connect(projectors_.get(), &ProjectorWatch::changed, this, [this] { writeHealth(state_); });
  }
  if (settings_.watch)
    beginWatch(watch ? std::move(watch) : watchSourceOf(settings_.calibration, *settings_.watch));
  noteUse();
  openOrWait();
  listen();
}

Show::~Show() {
  stop();
}

void Show::open() {
  std::unique_ptr<FrameRenderer> renderer =
      make_([this](const QString& sentence) { log_.warn(sentence); }, wantedSet_);
  if (played_)
    renderer = std::make_unique<TappedRenderer>(
        std::move(renderer),
        [played = played_](const std::vector<DrivePicture>& drives) { played->put(drives); });
  renderer_ = renderer->name();
  const RemoteState before = state();
  player_.reset();
  if (windows_.empty()) {
    for (const ScreenIdentity& display : displaysFor(renderer->projectors(), settings_.displays)) {
      auto window = std::make_unique<ProjectorWindow>(display);
      QString name = display.connector;
      connect(window.get(), &ProjectorWindow::displayLost, this, [this, name, window = window.get()] {
        log_.warn(window->elsewhere().isEmpty()
                      ? "display lost: " + name
                      : QString("the desktop put the picture for %1 on %2: it left at once, and tries again")
                            .arg(name, window->elsewhere()));
        writeHealth(state_);
      });
      connect(window.get(), &ProjectorWindow::displayFound, this, [this, name] {
        log_.tell("display back: " + name);
        writeHealth(state_);
      });
      escape_.watch(*window);
      windows_.push_back(std::move(window));
      if (auto screen = VenueUse::take(VenueUse::ofScreen(display.connector), VenueUse::Way::screen))
        screens_.push_back(*std::move(screen));
    }
    if (!windows_.empty() && !windows_.front()->surface().keepsStep())
      log_.warn("there is no OpenGL: pictures go through memory, not in step with the displays");
  }
  playing_ = playedBy(settings_.calibration, wantedSet_);
  playsPerfected_ = pipeline::perfectedState(settings_.calibration);
  content_ = std::make_shared<Playlist>(settings_.content, settings_.canvas, Attendance::unattended);
  toldSkipped_.clear();
  followedItem_ = -1;
  std::vector<ProjectorWindow*> windows;
  for (const auto& window : windows_) windows.push_back(window.get());
  player_ = std::make_unique<Player>(std::move(renderer), content_, std::move(windows));
  connect(player_.get(), &Player::failed, this, &Show::tryAgain, Qt::QueuedConnection);
  connect(player_.get(), &Player::setShown, this, &Show::setShown);
  connect(player_.get(), &Player::setFailed, this, &Show::setFailed);
  connect(player_.get(), &Player::shown, this, [this] {
    followItem();
    tellControl();
    tellProjectors();
    tellWatch();
  });
  // Whoever made it black wants it black after a failure, too.
  setBlack(before.black);
  setCompensated(before.compensated);
  setBrightness(before.brightness);
  setChart(before.chart);
  if (watch_) player_->setAvailable(watch_->status().available);
}

void Show::openOrWait() {
  try {
    open();
  } catch (const Error& error) {
    if (!projectors_ || !settings_.switchesPower) throw;
    tryAgain(error.sentence());
  }
}

pjlink::Wanted Show::wishes() {
  if (nights_ && nights_->isUnderWay()) return wishes_.at(clock_.wall(), true, false);
  return wishes_.at(clock_.wall(), isTime(), player_ && player_->isBlack());
}

void Show::beginWatch(std::unique_ptr<WatchSource> source) {
  played_ = std::make_shared<PlayedTap>();
  WatchPace pace;
  pace.fillsShadows = settings_.fillsShadows;
  watch_ = std::make_unique<ShowWatch>(std::move(source), played_, std::move(pace));
  photographs_.waitFor(watch_->camera());
  const auto textOfMessage = [](const Message& message) { return QString::fromStdString(english(message)); };
  connect(watch_.get(), &ShowWatch::found, this, [this, textOfMessage](const monitoring::Finding& finding) {
    const QString what = textOfMessage(sentenceOf(finding));
    log_.warn(what + ' ' + textOfMessage(adviceOf(finding)));
    if (control_)
      control_->announce("/watch", "found",
                         {QString::fromStdString(std::string(nameOf(finding.kind))), what});
    writeHealth(state_);
  });
  connect(watch_.get(), &ShowWatch::over, this, [this, textOfMessage](const monitoring::Finding& finding) {
    const QString what = textOfMessage(sentenceOf(finding));
    log_.tell("no longer: " + what);
    if (control_)
      control_->announce("/watch", "over", {QString::fromStdString(std::string(nameOf(finding.kind))), what});
    writeHealth(state_);
  });
  connect(watch_.get(), &ShowWatch::shadowsChanged, this, [this, textOfMessage] {
    const WatchStatus& now = watch_->status();
    if (player_) player_->setAvailable(now.available);
    if (!now.filled.empty() && !isFilling_) log_.tell(textOfMessage(sentenceOf(now.filled.front())));
    if (now.filled.empty() && isFilling_) log_.tell("no shadow is filled any more");
    if (std::exchange(isFilling_, !now.filled.empty()) != isFilling_) writeHealth(state_);
  });
  connect(watch_.get(), &ShowWatch::cannotFill, this,
          [this](const Message& sentence) { log_.warn(QString::fromStdString(englishSentence(sentence))); });
  connect(watch_.get(), &ShowWatch::failed, this, [this](const Message& sentence) {
    log_.warn("nobody watches the show: " + QString::fromStdString(englishSentence(sentence)));
    writeHealth(state_);
  });
}

void Show::tellWatch() {
  if (watch_)
    watch_->setPlaying(state_ == ShowState::playing && player_ && player_->isPlaying() &&
                       !player_->isBlack() && !player_->hasOverlay());
}

void Show::tellStreams() {
  if (!content_) return;
  const auto news = streams_.news(content_->status().live, std::chrono::steady_clock::now());
  for (const auto& [sentence, isWarning] : news) {
    const QString line = QString::fromStdString(english(sentence));
    isWarning ? log_.warn(line) : log_.tell(line);
  }
  if (!news.empty()) writeHealth(state_);
}

void Show::tellProjectors() {
  if (projectors_) projectors_->want(wishes());
}

void Show::wakeDisplays() {
  if (awake_.wakeDisplays()) log_.warn("the displays were asleep and have been woken");
}

void Show::start() {
  health_.start();
  streamsLooked_.start();
  if (!player_) return;  // it begins once it can be opened
  wakeDisplays();
  for (const auto& window : windows_) window->shine();
  isTime() ? play() : rest();
  QTimer::singleShot(clock_.pause(forgivenAfter), player_.get(), [this] { failures_ = 0; });
}

/// For wizards of this computer. Where another show of this venue plays, it is noted by that one.
void Show::noteUse() {
  if (!use_) use_ = VenueUse::take(settings_.calibration, VenueUse::Way::show);
}

bool Show::isTime() const {
  return !settings_.hours || settings_.hours->contain(clock_.wall().time());
}

void Show::play() {
  player_->start();
  log_.tell(QString("playing %1 items on %2").arg(settings_.content.items.size()).arg(renderer_));
  writeHealth(ShowState::playing);
}

void Show::rest() {
  player_->stop();
  log_.tell("black until " + settings_.hours->from.toString("HH:mm"));
  writeHealth(ShowState::resting);
}

void Show::look() {
  if (clock_.rehearsal) clock_.rehearsal->follow();
  std::chrono::nanoseconds slept = clock_.slept();
  if (slept - slept_ > noticed) {
    log_.tell(QString("the machine slept for %1 s")
                  .arg(std::chrono::duration<double>(slept - slept_).count(), 0, 'f', 0));
    // Displays and graphics memory may have gone meanwhile.
    if (state_ != ShowState::photographing)
      for (const auto& window : windows_) window->shine();
  }
  slept_ = slept;
  noteUse();
  wakeDisplays();
  listen();
  if (nights_) tend();
  tellProjectors();
  if (state_ == ShowState::photographing) return writeHealth(state_);
  followTime();
  takeUp(state_ == ShowState::resting);
  if (state_ == ShowState::playing && !isTime()) return rest();
  if (state_ == ShowState::resting && isTime()) return play();
  writeHealth(state_);
}

void Show::tryAgain(const Message& sentence) {
  log_.warn(QString::fromStdString(englishSentence(sentence)));
  const std::chrono::milliseconds pause =
      std::min(longestPause, shortestPause * (1 << std::min(failures_, 10)));
  ++failures_;
  log_.tell(QString("trying again in %1 s").arg(pause.count() / 1000));
  writeHealth(ShowState::failed);
  again_.start(clock_.pause(pause));
}

void Show::stop() {
  photographs_.cancel();
  again_.stop();
  health_.stop();
  streamsLooked_.stop();
  if (player_) player_->stop();
  for (const auto& window : windows_) window->stop();
  if (state_ == ShowState::stopped) return;
  log_.tell("stopped");
  writeHealth(ShowState::stopped);
}

void Show::photographed(const QString& work, const QString& verdict, const QString& sentence) {
  log_.tell(QString("%1: %2").arg(verdict, sentence));
  if (control_) control_->announce('/' + work, "done", {verdict, sentence});
  if (work == "night") nightEnded(verdict, sentence);
  state_ = ShowState::starting;
  takeUp(true);
  if (state_ == ShowState::starting) start();
}

void Show::tend() {
  const QDateTime now = clock_.wall();
  switch (nights_->stepAt(now)) {
    case ShowNights::Step::none:
      return;
    case ShowNights::Step::missed:
      return leaveOutNight(
          RELUCENT_MESSAGE("night.missed",
                           "it could not begin within two hours of its time: the show did not run, or the "
                           "computer slept"));
    case ShowNights::Step::end:
      if (!brokenOff_.empty()) return;  // it is about to end
      brokenOff_ = isTime() && settings_.hours
                       ? RELUCENT_MESSAGE("night.hours-began", "the show's hours began before it was done")
                       : RELUCENT_MESSAGE("night.too-long", "it was not done within six hours");
      return photographs_.breakOff();
    case ShowNights::Step::begin:
      break;
  }
  if (photographs_.isRunning()) return;  // after that
  if (const Message why = photographs_.whyNot(); !why.empty()) {
    log_.warn("night: " + QString::fromStdString(englishSentence(why)));
    try {
      nights_->raise(now, why);
    } catch (const Error& error) {
      log_.warn(error.what());
    }
    return;
  }
  log_.tell("tending the calibration by photographs");
  nights_->begin(now);
  nightUse_ = VenueUse::take(settings_.calibration, VenueUse::Way::night);
  makeWay();
  pipeline::NightSettings work = nights_->work();
  work.set = playing_.opened;
  work.when = written(now);
  photographs_.tend(work, settings_.switchesPower);
}

void Show::leaveOutNight(const Message& why) {
  log_.warn("night left out: " + QString::fromStdString(englishSentence(why)));
  try {
    nights_->leaveOut(clock_.wall(), why);
  } catch (const Error& error) {
    log_.warn(error.what());
  }
}

void Show::nightEnded(const QString& verdict, const QString& sentence) {
  nightUse_.reset();
  if (verdict != "failed") {
    nights_->ended(clock_.wall());
    if (!nights_->alarm().empty()) log_.warn("alarm: " + sentence);
    if (nights_->last() && !nights_->last()->untold.empty())
      log_.warn("nobody was told: " + QString::fromStdString(englishSentence(nights_->last()->untold)));
  } else if (const Message why = std::exchange(brokenOff_, {}); !why.empty()) {
    leaveOutNight(why);
  } else {
    nights_->ended(clock_.wall(), Message::plain(sentence.toStdString()));
    log_.warn("alarm: " + sentence);
  }
  brokenOff_ = {};
}

void Show::takeUp(bool whole) {
  if (!player_) return;
  const PlayedSet now = whole ? playedBy(settings_.calibration, playing_.opened) : PlayedSet();
  if (!now.shownFrom.empty() &&
      (now.shownFrom != playing_.shownFrom || now.correctedFrom != playing_.correctedFrom)) {
    log_.tell("the calibration has changed: it is played by from now on");
    if (watch_) watch_->readAgain();
    try {
      open();
      start();
    } catch (const Error& error) {
      tryAgain(error.sentence());
    }
    return;
  }
  if (const std::string perfected = pipeline::perfectedState(settings_.calibration);
      perfected != std::exchange(playsPerfected_, perfected))
    player_->renew();
}

void Show::wish(const std::string& set) {
  if (set == wantedSet_ || (wantedSet_.empty() && set == playing_.name)) return;
  wantedSet_ = set;
  if (!player_) return;  // it begins by it
  log_.tell("preparing set " + QString::fromStdString(set));
  player_->useSet(set);
}

void Show::followTime() {
  const std::optional<QString> now = setAt(settings_.content.sets, clock_.wall().time());
  if (now && now != std::exchange(scheduledSet_, now)) wish(now->toStdString());
  const std::optional<QString> soon =
      setAt(settings_.content.sets, clock_.wall().time().addMSecs(aheadOfTime));
  if (player_ && soon && soon != now) player_->prepareSet(soon->toStdString());
}

void Show::followItem() {
  const qsizetype item = content_->status().playing;
  if (item < 0 || item == std::exchange(followedItem_, item)) return;
  const QList<PlaylistItem>& items = settings_.content.items;
  if (!items[item].set.isEmpty()) wish(items[item].set.toStdString());
  if (const QString& next = items[(item + 1) % items.size()].set; !next.isEmpty())
    player_->prepareSet(next.toStdString());
}

void Show::setShown(const std::string& name, const std::string& shownFrom) {
  playing_.opened = playing_.name = name;
  playing_.shownFrom = shownFrom;
  log_.tell("playing set " + QString::fromStdString(name));
  tellSet("shown", QString::fromStdString(name));
  writeHealth(state_);
}

void Show::setFailed(const std::string& name, const Message& sentence) {
  if (wantedSet_ == name) wantedSet_ = playing_.opened;
  log_.warn(QString::fromStdString(englishSentence(sentence)));
  tellSet("failed", QString::fromStdString(englishSentence(sentence)));
}

void Show::tellSkipped(const std::vector<Message>& skipped) {
  const auto lacks = [](const std::vector<Message>& all, const Message& one) {
    return std::ranges::find(all, one) == all.end();
  };
  for (const Message& sentence : skipped)
    if (lacks(toldSkipped_, sentence))
      log_.warn(QString::fromStdString("skipped: " + englishSentence(sentence)));
  for (const Message& sentence : toldSkipped_)
    if (lacks(skipped, sentence))
      log_.tell(QString::fromStdString("no longer: " + englishSentence(sentence)));
  toldSkipped_ = skipped;
}

void Show::writeHealth(ShowState state) {
  state_ = state;
  tellWatch();
  const Playlist::Status content = content_ ? content_->status() : Playlist::Status{};
  std::vector<Message> skipped;
  std::ranges::transform(content.skipped, std::back_inserter(skipped), &Playlist::Skipped::why);
  tellSkipped(skipped);
  try {
    writeFileAtomically(QDir(settings_.folder).filePath("health.json").toStdString(),
                        QJsonDocument(health()).toJson().toStdString());
  } catch (const Error& error) {
    log_.warn(error.what());  // a full disk is no reason for a dark wall
  }
}

QJsonObject Show::health() const {
  const Playlist::Status content = content_ ? content_->status() : Playlist::Status{};
  QJsonArray displays;
  for (const auto& window : windows_)
    displays.append(QJsonObject{{"connector", window->display().connector},
                                {"shining", window->isShining()},
                                {"drawn_by", window->surface().name()}});
  PlayerStatistics statistics = player_ ? player_->statistics() : PlayerStatistics{};
  QJsonObject health{{"state", QString::fromStdString(std::string(relucent::nameOf(state_)))},
                     {"updated", clock_.wall().toString(Qt::ISODate)},
                     {"renderer", renderer_},
                     {"frames", static_cast<qint64>(statistics.frames)},
                     {"late", static_cast<qint64>(statistics.late)},
                     {"frames_per_second", statistics.framesPerSecond},
                     {"frame_milliseconds", 1e3 * statistics.frameSeconds},
                     {"viewer_milliseconds", 1e3 * statistics.viewerSeconds},
                     {"clipped", statistics.clipped},
                     {"steps", statistics.steps},
                     {"perfected", statistics.perfected},
                     {"set", QString::fromStdString(playing_.name)},
                     {"item", static_cast<qint64>(content.playing)},
                     {"skipped", static_cast<qint64>(content.skipped.size())},
                     {"failures", failures_},
                     {"peak_memory_bytes", static_cast<qint64>(platform::peakMemoryBytes())},
                     {"displays", displays}};
  const RemoteState wanted = state();
  health["black"] = wanted.black;
  health["paused"] = wanted.paused;
  health["compensated"] = wanted.compensated;
  health["brightness"] = wanted.brightness;
  if (wanted.chart) health["chart"] = testChartName(*wanted.chart);
  if (clock_.rehearsal) health["rehearsal"] = QJsonObject{{"speed", clock_.rehearsal->speed()}};
  if (nights_) health["night"] = nights_->health(clock_.wall());
  if (nights_ && !nights_->alarm().empty())
    health["alarm"] = QString::fromStdString(englishSentence(nights_->alarm()));
  if (watch_) health["watch"] = toJson(watch_->status());
  if (!content.live.empty()) {
    health["streams"] = toJson(content.live);
    health["live_milliseconds"] = 1e3 * statistics.liveSeconds;
  }
  if (projectors_) health["projectors"] = toJson(projectors_->states());
  return health;
}

}  // namespace relucent::gui
