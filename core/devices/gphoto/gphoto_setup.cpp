// SPDX-License-Identifier: MIT
#include "relucent/devices/gphoto/gphoto_setup.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "relucent/base/error.h"
#include "relucent/base/lowered.h"
#include "relucent/devices/gphoto/gphoto_failure.h"

namespace relucent::devices {
namespace {

/// Longer than anybody waits for a photograph.
constexpr double longestBulb = 120.0;
/// Below it photographs are darkened by calculation on many cameras, which costs highlights.
constexpr int leastIso = 100;
constexpr int weakBattery = 30;

bool holds(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::optional<int> wholeNumber(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number <= 0) return std::nullopt;
  return number;
}

/// The first choice that begins with one of `words`, in the order of the words, however it is written.
std::optional<std::string> choiceLike(const GphotoSetting& setting,
                                      std::initializer_list<std::string_view> words) {
  for (std::string_view word : words)
    for (const std::string& choice : setting.choices)
      if (lowered(choice).starts_with(word)) return choice;
  return std::nullopt;
}

class Setup {
 public:
  Setup(BorrowedSettings& settings, const std::string& name, std::optional<int> iso, CameraTraits& traits)
      : settings_(settings), name_(name), iso_(iso), traits_(traits) {}

  GphotoSetup run() {
    if (const auto model = settings_.get("cameramodel"); model && !model->value.empty())
      traits_.model = model->value;
    chooseManualExposure();
    chooseRaw();
    chooseIso();
    chooseOptionalSettings();
    chooseShutter();
    chooseBulb();
    remarkOnBattery();
    return setup_;
  }

 private:
  [[noreturn]] void refuse(const Message& what, const Message& advice) const {
    throw Error(ErrorKind::device, what, advice, name_);
  }

  void chooseManualExposure() {
    const auto mode = settings_.firstOf({"autoexposuremode", "expprogram", "exposuremetermode_program"});
    if (!mode) return;  // the shutter tells whether it can be set
    const auto& [setting, now] = *mode;
    auto isManual = [](const std::string& value) {
      return value == "M" || lowered(value).starts_with("manual");
    };
    if (isManual(now.value)) return;
    const auto manual = std::find_if(now.choices.begin(), now.choices.end(), isManual);
    if (manual != now.choices.end() && settings_.set(setting, *manual)) return;
    refuse(RELUCENT_MESSAGE("device.mode-dial-not-manual",
                            "the camera's mode dial is set to {}, where the camera chooses exposures itself")
               .with(now.value),
           RELUCENT_MESSAGE("device.turn-dial-to-m", "turn it to M"));
  }

  void chooseRaw() {
    bool isRaw = false;
    // Cameras with two cards have a setting for each.
    for (const char* setting :
         {"imageformat", "imagequality", "imageformatsd", "imageformatcf", "imagequality2"}) {
      const std::optional<GphotoSetting> now = settings_.get(setting);
      if (!now) continue;
      const std::optional<std::string> raw =
          rawChoice(now->choices.empty() ? std::vector{now->value} : now->choices);
      if (raw && settings_.set(setting, *raw)) isRaw = true;
      // Where one may not be changed it may be raw already, with a JPEG beside it.
      if (!isRaw && raw && rawChoice({now->value})) isRaw = true;
    }
    if (!isRaw)
      refuse(
          RELUCENT_MESSAGE("device.no-raw-files", "the camera does not deliver raw files"),
          RELUCENT_MESSAGE("device.switch-quality-to-raw",
                           "switch its picture quality to RAW by hand; a camera without RAW cannot be used"));
    if (const auto target = settings_.get("capturetarget"))
      if (const auto memory = choiceLike(*target, {"internal ram", "sdram", "ram"}))
        settings_.set("capturetarget", *memory);
  }

  void chooseIso() {
    for (const char* automatic : {"autoiso", "isoauto"})
      if (const auto setting = settings_.get(automatic)) {
        const auto off = choiceLike(*setting, {"off", "manual"});
        settings_.set(automatic, off ? *off : "0");
      }
    const std::optional<GphotoSetting> iso = settings_.get("iso");
    if (!iso) return;
    std::optional<std::string> best;
    for (const std::string& choice : iso->choices) {
      const std::optional<int> value = wholeNumber(choice);
      if (!value || (iso_ && *value != *iso_)) continue;
      auto worth = [](int number) {
        return std::pair(number < leastIso, number < leastIso ? -number : number);
      };
      if (!best || worth(*value) < worth(*wholeNumber(*best))) best = choice;
    }
    if (iso_ && !best)
      refuse(
          RELUCENT_MESSAGE("device.iso-wanted-not-there", "ISO {} is wanted and the camera does not have it")
              .with(as::label(*iso_)),
          RELUCENT_MESSAGE("device.choose-offered-iso", "choose one of those that it has: {}")
              .with(fmt::to_string(fmt::join(iso->choices, ", "))));
    if (best) settings_.set("iso", *best);
    const std::optional<GphotoSetting> held = settings_.get("iso");
    const std::optional<int> number = held ? wholeNumber(held->value) : std::nullopt;
    traits_.gain = number.value_or(0);
    if (!number)
      refuse(RELUCENT_MESSAGE("device.automatic-iso",
                              "the camera chooses its sensitivity itself (automatic ISO)"),
             RELUCENT_MESSAGE("device.set-iso-100", "set it to ISO 100 by hand"));
    if (best && held->value != *best)
      traits_.remarks.push_back(RELUCENT_MESSAGE("device.iso-refused", "was asked for ISO {} but uses ISO {}")
                                    .with(*best, held->value));
  }

  /// What is better so, but can do without.
  void chooseOptionalSettings() {
    requestSetting("longexpnr", {"off", "0"},
                   RELUCENT_MESSAGE("device.may-take-dark-frame",
                                    "may take a dark frame after long exposures, which doubles their time"));
    requestSetting("flashmode", {"flash off", "off"},
                   RELUCENT_MESSAGE("device.may-fire-flash", "may fire its flash: close it"));
    requestSetting(
        "focusmode", {"manual", "mf"},
        RELUCENT_MESSAGE("device.focuses-by-itself", "focuses by itself: switch its lens to manual focus"));
    requestSetting("drivemode", {"single"},
                   RELUCENT_MESSAGE("device.may-take-several-photographs",
                                    "may take several photographs at once: switch it to single shots"));
    requestSetting("capturemode", {"single"},
                   RELUCENT_MESSAGE("device.may-take-several-photographs",
                                    "may take several photographs at once: switch it to single shots"));
    requestSetting(
        "autopoweroff", {"0", "off", "never"},
        RELUCENT_MESSAGE("device.switches-itself-off", "switches itself off after a while: switch that off"));
  }

  void requestSetting(const char* setting, std::initializer_list<std::string_view> words,
                      const Message& remark) {
    const std::optional<GphotoSetting> now = settings_.get(setting);
    if (!now) return;
    auto isGood = [&](const std::string& value) {
      return std::any_of(words.begin(), words.end(),
                         [&](std::string_view word) { return lowered(value).starts_with(word); });
    };
    if (isGood(now->value)) return;
    // Without choices it is a switch or a number.
    const bool takesZero = std::find(words.begin(), words.end(), "0") != words.end();
    const std::optional<std::string> choice =
        now->choices.empty() ? std::string(takesZero ? "0" : *words.begin()) : choiceLike(*now, words);
    if (!choice || !settings_.set(setting, *choice)) traits_.remarks.push_back(remark);
  }

  void chooseShutter() {
    // Where a camera has both, the second has the exact words.
    for (const char* setting : {"shutterspeed2", "shutterspeed", "exptime"}) {
      const std::optional<GphotoSetting> now = settings_.get(setting);
      if (!now || now->readOnly) continue;
      setup_.speeds = ShutterList(now->choices);
      setup_.shutter = setting;
      if (!setup_.speeds.empty()) break;
    }
    if (setup_.speeds.empty())
      refuse(
          RELUCENT_MESSAGE("device.exposure-time-cannot-be-set", "the camera's exposure time cannot be set"),
          RELUCENT_MESSAGE("device.turn-dial-or-change-camera",
                           "turn its mode dial to M; a camera without manual exposure cannot be used"));
    traits_.exposures = {setup_.speeds.shortest(), setup_.speeds.longest()};
  }

  void chooseBulb() {
    if (!setup_.speeds.bulb()) return;
    if (const auto release = settings_.get("eosremoterelease")) {
      const auto open = choiceLike(*release, {"immediate", "press full"});
      const auto close = choiceLike(*release, {"release full"});
      if (open && close) setup_.bulb = GphotoSetup::Bulb{"eosremoterelease", *open, *close};
    }
    if (!setup_.bulb && settings_.get("bulb")) setup_.bulb = GphotoSetup::Bulb{"bulb", "1", "0"};
    if (setup_.bulb) traits_.exposures.longest = std::max(traits_.exposures.longest, longestBulb);
  }

  void remarkOnBattery() {
    const std::optional<GphotoSetting> battery = settings_.get("batterylevel");
    const std::optional<int> percent = battery ? batteryPercent(battery->value) : std::nullopt;
    if (percent && *percent <= weakBattery)
      traits_.remarks.push_back(
          RELUCENT_MESSAGE("device.battery-low",
                           "has {} % left in its battery: a measurement needs a full one or a mains adapter")
              .with(as::share(*percent / 100.0)));
  }

  BorrowedSettings& settings_;
  const std::string& name_;
  std::optional<int> iso_;
  CameraTraits& traits_;
  GphotoSetup setup_;
};

}  // namespace

GphotoSetup setUpGphoto(BorrowedSettings& settings, const std::string& name, std::optional<int> iso,
                        CameraTraits& traits) {
  return Setup(settings, name, iso, traits).run();
}

std::optional<std::string> rawChoice(const std::vector<std::string>& choices) {
  std::optional<std::string> best;
  int least = 0;
  for (const std::string& choice : choices) {
    const std::string word = lowered(choice);
    if (!holds(word, "raw") && !holds(word, "nef") && !holds(word, "rw2")) continue;
    // The camera makes these of several of its pixels each.
    if (holds(word, "sraw") || holds(word, "mraw") || holds(word, "raw s") || holds(word, "raw m")) continue;
    const bool isBeside = holds(word, "+") || holds(word, "jpeg") || holds(word, "jpg");
    const bool isLossy = holds(word, "craw") || holds(word, "compressed");
    const int cost = (isBeside ? 2 : 0) + (isLossy ? 1 : 0);
    if (best && cost >= least) continue;
    best = choice;
    least = cost;
  }
  return best;
}

}  // namespace relucent::devices
