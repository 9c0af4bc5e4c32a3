// SPDX-License-Identifier: MIT
#include "relucent/rehearsal/venue_days.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "relucent/base/error.h"
#include "relucent/base/file.h"
#include "relucent/base/stopwatch.h"
#include "relucent/pipeline/night_record.h"
#include "relucent/rehearsal/simulated_projector.h"
#include "relucent/rehearsal/simulated_stream.h"
#include "relucent/rehearsal/venue_folder.h"

namespace relucent::rehearsal {
namespace {

using namespace std::chrono;

constexpr ShowTime begins = sys_days(year(2026) / May / 4) + hours(8) + minutes(50);
constexpr double careful = 120.0;  // times as fast as the real one, while something is looked at: as fast as
                                   // a rehearsed show waits
constexpr milliseconds betweenLooks{25};
constexpr seconds patience{60};  // real ones, on a busy computer
constexpr seconds nightPatience{300};
constexpr seconds endsWithin{30};
constexpr int samples = 12;  // at 10:00
constexpr minutes dark{5};   // a power failure

/// The show has ended by itself: what was found so far is the result.
struct ShowEnded {};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class VenueDays {
 public:
  VenueDays(const DaysSettings& settings, const Progress& progress)
      : settings_(settings), progress_(progress), folder_(settings), stream_(picture()) {
    std::vector<pjlink::Address> addresses;
    for (std::size_t number = 0; number < folder_.projectors(); ++number) {
      projectors_.push_back(std::make_unique<SimulatedProjector>());
      addresses.push_back(projectors_.back()->address());
    }
    folder_.tellProjectors(addresses);
    folder_.writePlaylist(stream_.url());
  }

  RehearsedDay day(int number) {
    day_ = {};
    day_.number = number;
    midnight_ = floor<days>(begins) + days(number - 1);
    happenings_ = happeningsOf(number, settings_.days);
    // Of a computer without card, desktop and display.
    expected_ = {"there is no OpenGL", "the system may go to sleep", "a screen saver may appear",
                 "there is no X server to tell"};
    try {
      open();
      measure();
      if (isToday(Happening::inputLost)) loseInput();
      if (isToday(Happening::stillGone)) loseStill();
      if (isToday(Happening::powerFailure)) failPower();
      if (isToday(Happening::projectorGone)) loseProjector();
      close();
      night();
      goOn(days(1) + hours(8) + minutes(50));
    } catch (const ShowEnded&) {
      miss(endSentence());
    }
    day_.logBytes = bytesIn(folder_.log());
    day_.calibrationBytes = bytesIn(folder_.calibration());
    return std::move(day_);
  }
  bool goesOn() { return !show_->ended(); }

  /// How the show ended when it was asked to; none: it had before, or does not.
  std::optional<platform::ProcessEnd> end() {
    if (!goesOn()) return std::nullopt;
    show_->ask();
    for (const auto deadline = steady_clock::now() + endsWithin; steady_clock::now() < deadline;) {
      take(show_->newLines());
      if (const auto end = show_->ended()) return end;
      std::this_thread::sleep_for(betweenLooks);
    }
    return std::nullopt;
  }

 private:
  static image::Image picture() {
    image::Image encoded({64, 48}, 3);
    for (std::size_t i = 0; i < encoded.data().size(); ++i)
      encoded.data()[i] = static_cast<float>(i % 97) / 96.0f;
    return encoded;
  }

  // What happens.

  void open() {
    const bool disobeys = isToday(Happening::disobedientProjector);
    begin(disobeys ? Happening::disobedientProjector : Happening::opening);
    if (disobeys) projectors_.front()->setObeys(false);
    if (!show_) start(midnight_ + hours(8) + minutes(50));
    goOn(opens + minutes(10));
    if (disobeys) {
      expect("was told to switch on and does not");
      seeLine("was told to switch on and does not", "it did not tell that the projector stays off");
      projectors_.front()->setObeys(true);
      finish();
      begin(Happening::opening);
    }
    see([this] { return plays(); }, "it does not play with its projectors on");
    finish();
  }

  void measure() {
    goOn(hours(10));
    // A live picture that is just being connected to has another handle.
    std::optional<platform::ProcessUse> least;
    for (int sample = 0; sample < samples; ++sample) {
      look();
      const std::optional<platform::ProcessUse> use = show_->use();
      if (!use) throw ShowEnded();
      if (!least) least = use;
      least->residentBytes = std::min(least->residentBytes, use->residentBytes);
      least->ownBytes = std::min(least->ownBytes, use->ownBytes);
      least->handles = std::min(least->handles, use->handles);
      least->threads = std::min(least->threads, use->threads);
    }
    day_.use = *least;
    day_.process = starts_;
  }

  void loseInput() {
    goOn(hours(11));
    begin(Happening::inputLost);
    expect("is lost");
    expect("skipped: ");
    stream_.lose();
    seeLine("is lost", "it did not tell that the live picture is lost");
    stream_.comeBack();
    seeLine("is back", "it did not tell that the live picture is back");
    finish();
  }

  void loseStill() {
    goOn(hours(12));
    begin(Happening::stillGone);
    expect("skipped: ");
    folder_.removeStill();
    seeLine("skipped: ", "it did not tell that the still is gone");
    folder_.writeStill();
    seeLine("no longer: ", "it did not tell that the still is there again");
    finish();
  }

  void failPower() {
    goOn(hours(14));
    begin(Happening::powerFailure);
    cutPower();
    see([this] { return plays(); }, "it does not play again after a power failure");
    finish();
  }

  void loseProjector() {
    goOn(hours(16));
    begin(Happening::projectorGone);
    expect("does not answer");
    projectors_.front()->vanish();
    seeLine("does not answer", "it did not tell that the projector is gone");
    projectors_.front()->comeBack();
    seeLine("answers again", "it did not tell that the projector is there again");
    finish();
  }

  void close() {
    begin(Happening::closing);
    goOn(closes + minutes(10));
    see([this] { return rests(); }, "it does not rest with its projectors off");
    finish();
  }

  void night() {
    const bool isUnreadable = isToday(Happening::unreadableStill);
    const std::size_t calls = alarmCalls();
    begin(isUnreadable ? Happening::unreadableStill : Happening::night);
    if (isUnreadable) {
      folder_.spoilStill();
      expect("alarm: ");
      expect("skipped: ");
    }
    goOn(nightAt + minutes(5));
    if (isToday(Happening::powerFailureAtNight)) {
      see([this] { return health().state == "photographing"; }, "its night did not begin");
      finish();
      begin(Happening::powerFailureAtNight);
      cutPower();
    }
    let(nightAt + hours(2), careful);
    see([this] { return health().night && *health().night >= midnight_ + nightAt && rests(); },
        "its night did not end with its projectors off", nightPatience);
    judgeNight(isUnreadable, calls);
    if (isUnreadable) folder_.writeStill();
    finish();
  }

  void judgeNight(bool isUnreadable, std::size_t calls) {
    const std::vector<pipeline::NightRecord> nights = pipeline::nightsOf(folder_.calibration());
    if (nights.empty() || showTimeFrom(nights.back().when).value_or(begins) < midnight_ + nightAt)
      return miss("its night has no line in the history");
    const pipeline::NightRecord& night = nights.back();
    const bool isAlarmed = !night.alarm.empty();
    if (isAlarmed)
      day_.night = englishSentence(night.alarm);
    else if (!night.skipped.empty())
      day_.night = englishSentence(night.skipped);
    else if (night.measured && night.predicted)
      day_.night = fmt::format("{}, {} perfected, colour error {:.2f} where {:.2f} was predicted",
                               night.repair ? nameOf(*night.repair) : "failed", night.perfected,
                               night.measured->deltaE, night.predicted->deltaE);
    if (!night.skipped.empty()) miss("its night was left out");
    if (isAlarmed != isUnreadable)
      miss(isAlarmed ? "a false alarm: " + day_.night : "it raised no alarm of a still that cannot be read");
    if (health().alarm.empty() == isUnreadable) miss("its health file does not say what the night does");
    if (alarmCalls() != calls + (isUnreadable ? 1 : 0)) miss("the alarm's command was not run once");
  }

  /// The mains fail: whatever was under way ends, and the service starts the show again.
  void cutPower() {
    show_->kill();
    take(show_->newLines());
    for (const auto& projector : projectors_) projector->cutPower();
    start(now_ + dark);
  }

  // The show.

  void start(ShowTime from) {
    folder_.writeTime(from, from, careful);
    show_ = std::make_unique<ShowProcess>(folder_.command(settings_));
    ++starts_;
    now_ = from;
    wait([&] { return show_->health().has_value(); }, patience);
    if (!show_->health()) miss("it did not write a health file");
  }

  const ShowHealth& health() const {
    static const ShowHealth none;
    return show_->health() ? *show_->health() : none;
  }
  bool powerIs(const char* wanted) const {
    return health().power.size() == projectors_.size() &&
           std::ranges::all_of(health().power, [&](const std::string& power) { return power == wanted; });
  }
  bool plays() const { return health().state == "playing" && powerIs("on"); }
  bool rests() const { return health().state == "resting" && powerIs("standby"); }

  /// Its time goes on to then, of this day, and stands still there.
  void goOn(seconds ofDay) {
    let(ofDay, 86400.0 / settings_.daySeconds);
    const ShowTime until = midnight_ + ofDay;
    if (!wait([&] { return now_ >= until; }, patience)) miss("its time stands still at " + textOf(now_));
  }
  void let(seconds ofDay, double speed) {
    folder_.writeTime(now_, std::max(now_, ShowTime(midnight_ + ofDay)), std::max(speed, careful));
  }

  void look() {
    progress_.checkpoint();
    std::this_thread::sleep_for(betweenLooks);
    take(show_->newLines());
    show_->look();
    if (show_->health()) now_ = std::max(now_, show_->health()->updated);
    countLampHours();
    if (show_->ended()) {
      take(show_->newLines());
      throw ShowEnded();
    }
  }

  void countLampHours() {
    const ShowTime before = std::exchange(looked_, now_);
    if (before == ShowTime() || projectors_.front()->power() != pjlink::Power::on) return;
    lampTime_ += now_ - before;
    for (const auto& projector : projectors_)
      projector->setLampHours(static_cast<int>(duration_cast<hours>(lampTime_).count()));
  }

  bool wait(const std::function<bool()>& isSo, seconds longest) {
    for (const auto deadline = steady_clock::now() + longest; steady_clock::now() < deadline;) {
      look();
      if (isSo()) return true;
    }
    return false;
  }

  void take(const std::vector<LogLine>& lines) {
    for (const LogLine& line : lines) {
      recent_.push_back(line.text);
      last_ = line.text;
      const bool isExpected =
          std::ranges::any_of(expected_, [&](const std::string& part) { return contains(line.text, part); });
      if (line.isWarning && !isExpected) day_.unexpected.push_back(line.text);
    }
  }

  // What is to be seen of it.

  bool isToday(Happening what) const { return std::ranges::find(happenings_, what) != happenings_.end(); }

  void begin(Happening what) {
    day_.happened.push_back({what, {}, 0.0});
    recent_.clear();
    watch_ = Stopwatch();
  }
  void finish() { day_.happened.back().seconds = watch_.seconds(); }
  /// A warning of this day.
  void expect(const std::string& part) { expected_.push_back(part); }
  void miss(const std::string& what) {
    std::string& missed = day_.happened.back().missed;
    missed += (missed.empty() ? "" : "; ") + what;
  }
  void see(const std::function<bool()>& isSo, const std::string& otherwise, seconds longest = patience) {
    if (!wait(isSo, longest)) miss(fmt::format("{} ({} at {})", otherwise, health().state, textOf(now_)));
  }
  void seeLine(const std::string& part, const std::string& otherwise) {
    see([&] { return std::ranges::any_of(recent_, [&](const auto& line) { return contains(line, part); }); },
        otherwise);
  }
  std::string endSentence() {
    const std::optional<platform::ProcessEnd> end = show_->ended();
    return fmt::format("it ended by itself, {} {}, after \"{}\"",
                       end && end->killed ? "by signal" : "with status", end ? end->status : 0, last_);
  }

  std::size_t alarmCalls() const {
    std::error_code code;
    if (!std::filesystem::exists(folder_.alarms(), code)) return 0;
    const std::string calls = readFile(folder_.alarms());
    return static_cast<std::size_t>(std::ranges::count(calls, '\n'));
  }

  const DaysSettings& settings_;
  const Progress& progress_;
  VenueFolder folder_;
  SimulatedStream stream_;
  std::vector<std::unique_ptr<SimulatedProjector>> projectors_;
  std::unique_ptr<ShowProcess> show_;
  int starts_ = 0;
  ShowTime midnight_{}, now_{}, looked_{};
  seconds lampTime_{0};
  RehearsedDay day_;
  std::vector<Happening> happenings_;
  Stopwatch watch_;
  std::vector<std::string> recent_;    // lines since the last happening began
  std::vector<std::string> expected_;  // parts of warnings that this day explains
  std::string last_;                   // line
};

}  // namespace

std::vector<Happening> happeningsOf(int day, int days) {
  std::vector<Happening> happenings{Happening::opening};
  const bool isShaken = day <= std::max(1, days / 3);
  if (day % 7 == 4) happenings.push_back(Happening::disobedientProjector);
  if (day % 2 == 1) happenings.push_back(Happening::inputLost);
  if (day % 3 == 2) happenings.push_back(Happening::stillGone);
  if (isShaken && day % 3 == 1) happenings.push_back(Happening::powerFailure);
  if (day % 4 == 2) happenings.push_back(Happening::projectorGone);
  happenings.push_back(Happening::closing);
  // Before the first night there is no history that would tell that one is missed.
  const bool failsAtNight = isShaken && day % 4 == 2;
  const bool isUnreadable = !failsAtNight && day % 10 == 5;
  if (!isUnreadable) happenings.push_back(Happening::night);
  if (failsAtNight) happenings.push_back(Happening::powerFailureAtNight);
  if (isUnreadable) happenings.push_back(Happening::unreadableStill);
  return happenings;
}

std::vector<Message> problems(const DaysSettings& settings) {
  std::vector<Message> found;
  if (settings.days < 1 || settings.days > 1000)
    found.push_back(
        RELUCENT_ENGLISH_MESSAGE("rehearsal.days-outside", "the days to rehearse must be 1 to 1000"));
  if (!(settings.daySeconds >= 1.0 && settings.daySeconds <= 720.0))
    found.push_back(RELUCENT_ENGLISH_MESSAGE("rehearsal.day-seconds-outside",
                                             "a rehearsed day must take 1 to 720 seconds"));
  return found;
}

bool allHeld(const DaysResult& result) {
  return std::ranges::all_of(result.bounds, &Bound::isHeld);
}

DaysResult rehearseDays(const DaysSettings& settings, Progress& progress) {
  const Stopwatch watch;
  DaysResult result;
  result.out = settings.out;
  VenueDays venue(settings, progress);
  for (int number = 1; number <= settings.days && (number == 1 || venue.goesOn()); ++number) {
    Progress part = progress.part(
        1.0 / settings.days,
        RELUCENT_ENGLISH_MESSAGE("stage.rehearsing-day", "Rehearsing day {}").with(as::label(number)));
    part.report(0.0);
    result.days.push_back(venue.day(number));
  }
  const std::optional<platform::ProcessEnd> end = venue.end();
  result.bounds = boundsOf(result.days, end);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace relucent::rehearsal
