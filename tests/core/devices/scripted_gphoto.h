// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <memory>

#include "relucent/base/error.h"
#include "relucent/devices/gphoto/gphoto_driver.h"
#include "relucent/devices/shutter_speed.h"

namespace relucent::test {

/// A still camera that follows a script. Its clock moves only when something is waited for.
struct StillScript {
  /// What the camera makes of being asked for a photograph.
  enum class Answer { good, nothing, late, jpeg, jpegAndRaw, damaged, small, noFocus, refused };
  /// What is wrong with it from now on, until a time.
  enum class Trouble { none, unplugged, asleep, claimed, full, flat };

  std::vector<devices::GphotoCamera> cameras{{"Canon EOS 80D", "usb:001,005"}};
  std::map<std::string, devices::GphotoSetting> settings{};
  std::vector<std::string> stubborn{}, refusing{};  // settings that do not change: silently, with an error
  std::deque<Answer> answers{};                     // to the next requests; then only good ones
  std::chrono::seconds lateBy{20};                  // of Answer::late
  Trouble trouble = Trouble::none;
  std::chrono::microseconds troubleUntil{};
  std::chrono::microseconds clock{1'000'000'000};
  int shown = 0;  // what the venue shows now: the value of photographs
  int opened = 0, closed = 0, triggered = 0, busyFor = 0;
  double exposed = 0.0;  // seconds, the last photograph
  /// The content of a photograph's file, by its exposure; none: what scriptedRaw() reads.
  std::function<std::vector<std::uint8_t>(double seconds)> file{};
  std::vector<std::string> changes{};
  std::optional<std::chrono::microseconds> bulbSince{};
  std::map<std::string, std::vector<std::uint8_t>> files{};  // in the camera
  struct Pending {
    std::chrono::microseconds at{};
    std::string name;
  };
  std::deque<Pending> pending{};
  int made = 0;

  Trouble now() const { return clock < troubleUntil ? trouble : Trouble::none; }
  void be(Trouble what, std::chrono::microseconds time) {
    trouble = what;
    troubleUntil = clock + time;
  }
  std::string value(const std::string& name) const { return settings.at(name).value; }
  std::map<std::string, std::string> values() const {
    std::map<std::string, std::string> all;
    for (const auto& [name, setting] : settings) all[name] = setting.value;
    return all;
  }
  void make(const std::string& ending, std::uint8_t kind, std::chrono::microseconds at, int value) {
    const std::string name = "capt" + std::to_string(made++) + ending;
    files[name] = file ? file(exposed) : std::vector<std::uint8_t>{static_cast<std::uint8_t>(value), kind};
    const auto isBefore = [](std::chrono::microseconds time, const Pending& other) {
      return time < other.at;
    };
    pending.insert(std::upper_bound(pending.begin(), pending.end(), at, isBefore), {at, name});
  }
};

inline StillScript canon() {
  StillScript script;
  script.settings = {
      {"cameramodel", {"Canon EOS 80D", {}, true}},
      {"autoexposuremode", {"AV", {"P", "TV", "AV", "Manual", "Bulb"}}},
      {"imageformat",
       {"Large Fine JPEG", {"Large Fine JPEG", "mRAW", "sRAW", "RAW + Large Fine JPEG", "cRAW", "RAW"}}},
      {"capturetarget", {"Memory card", {"Internal RAM", "Memory card"}}},
      {"iso", {"Auto", {"Auto", "50", "100", "200", "400"}}},
      {"drivemode", {"Continuous", {"Single", "Continuous", "Timer 10 sec"}}},
      {"focusmode", {"One Shot", {"One Shot", "AI Focus", "Manual"}}},
      {"autopoweroff", {"60", {}}},
      {"batterylevel", {"75%", {}, true}},
      {"availableshots", {"812", {}, true}},
      {"eosremoterelease",
       {"None", {"None", "Press Half", "Press Full", "Release Half", "Release Full", "Immediate"}}},
      {"shutterspeed",
       {"1/60",
        {"bulb", "4", "2", "1", "0.5", "1/4", "1/8", "1/15", "1/30", "1/60", "1/125", "1/250", "1/1000"}}}};
  return script;
}

inline StillScript nikon() {
  StillScript script;
  script.cameras = {{"Nikon D750", "usb:002,007"}};
  script.settings = {
      {"cameramodel", {"D750", {}, true}},
      {"expprogram", {"M", {"M", "P", "A", "S"}, true}},
      {"imagequality",
       {"JPEG Fine", {"JPEG Basic", "JPEG Normal", "JPEG Fine", "NEF (Raw)", "NEF+Basic", "NEF+Fine"}}},
      {"capturetarget", {"Memory card", {"Internal RAM", "Memory card"}}},
      {"autoiso", {"1", {}}},
      {"iso", {"800", {"100", "200", "800", "6400"}}},
      {"longexpnr", {"On", {"On", "Off"}}},
      {"flashmode", {"Automatic Flash", {"Flash off", "Automatic Flash"}}},
      {"capturemode", {"Burst", {"Single Shot", "Burst"}}},
      {"bulb", {"0", {}}},
      {"shutterspeed", {"0.0166s", {"0.0010s", "0.0166s", "1.0000s"}}},
      {"shutterspeed2",
       {"1/60", {"1/1000", "1/250", "1/60", "1/15", "1/8", "1/4", "1/2", "1", "Bulb", "Time"}}}};
  return script;
}

inline StillScript sony() {
  StillScript script;
  script.cameras = {{"Sony Alpha-A6300", "usb:001,009"}};
  script.settings = {
      {"expprogram", {"M", {}, true}},
      {"imagequality", {"RAW+JPEG", {"Standard", "Fine", "RAW", "RAW+JPEG"}}},
      {"iso", {"Auto ISO", {"Auto ISO", "100", "200"}}},
      {"bulb", {"2", {}}},
      {"shutterspeed", {"1/60", {"30", "8", "13/10", "1", "4/10", "1/10", "1/60", "1/4000", "Bulb"}}}};
  return script;
}

class ScriptedPort : public devices::GphotoPort {
 public:
  explicit ScriptedPort(std::shared_ptr<StillScript> script) : script_(std::move(script)) {}

  std::vector<devices::GphotoCamera> list() override {
    return script_->now() == StillScript::Trouble::unplugged || script_->now() == StillScript::Trouble::flat
               ? std::vector<devices::GphotoCamera>{}
               : script_->cameras;
  }
  void open(const devices::GphotoCamera&) override {
    answer();
    ++script_->opened;
    isOpen_ = true;
    script_->pending.clear();
  }
  void close() noexcept override {
    if (isOpen_) ++script_->closed;
    isOpen_ = false;
  }
  std::optional<devices::GphotoSetting> get(const std::string& setting) override {
    answer();
    const auto place = script_->settings.find(setting);
    if (place == script_->settings.end()) return std::nullopt;
    return place->second;
  }
  void set(const std::string& setting, const std::string& value) override {
    answer();
    script_->changes.push_back(setting + "=" + value);
    auto& own = script_->settings.at(setting);
    auto isIn = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), setting) != list.end();
    };
    if (own.readOnly || isIn(script_->refusing))
      throw devices::GphotoFailure(devices::GphotoFault::refused, "not settable");
    if (isIn(script_->stubborn)) return;
    if (setting == "eosremoterelease" || setting == "bulb") bulb(value);
    own.value = value;
  }
  void trigger() override {
    answer();
    if (script_->busyFor > 0) {
      --script_->busyFor;
      throw devices::GphotoFailure(devices::GphotoFault::busy, "busy");
    }
    ++script_->triggered;
    if (script_->now() == StillScript::Trouble::full)
      throw devices::GphotoFailure(devices::GphotoFault::full, "no space");
    const auto it = script_->settings.contains("shutterspeed2") ? "shutterspeed2" : "shutterspeed";
    photograph(devices::secondsFromShutter(script_->value(it)).value_or(0.0));
  }
  Event waitEvent(std::chrono::microseconds time) override {
    answer();
    auto& pending = script_->pending;
    if (pending.empty() || pending.front().at > script_->clock + time) {
      script_->clock += time;
      return {{}, true};
    }
    script_->clock = std::max(script_->clock, pending.front().at);
    const std::string name = pending.front().name;
    pending.pop_front();
    if (name.empty()) return {};
    return {devices::GphotoFile{"/", name}, false};
  }
  std::vector<std::uint8_t> download(const devices::GphotoFile& file) override {
    answer();
    return script_->files.at(file.name);
  }
  void remove(const devices::GphotoFile& file) override {
    answer();
    script_->files.erase(file.name);
  }
  std::chrono::microseconds now() const override { return script_->clock; }
  void wait(std::chrono::microseconds time) override { script_->clock += time; }

 private:
  void answer() const {
    switch (script_->now()) {
      case StillScript::Trouble::unplugged:
      case StillScript::Trouble::flat:
      case StillScript::Trouble::asleep:
        throw devices::GphotoFailure(devices::GphotoFault::silent, "I/O problem");
      case StillScript::Trouble::claimed:
        throw devices::GphotoFailure(devices::GphotoFault::claimed, "Could not claim the USB device");
      default:
        return;
    }
  }
  void bulb(const std::string& value) {
    if (value == "Immediate" || value == "1") script_->bulbSince = script_->clock;
    if ((value != "Release Full" && value != "0") || !script_->bulbSince) return;
    const auto open = script_->clock - *script_->bulbSince;
    script_->bulbSince.reset();
    photograph(std::chrono::duration<double>(open).count(), false);
  }
  void photograph(double seconds, bool takesTime = true) {
    using Answer = StillScript::Answer;
    Answer answer = Answer::good;
    if (!script_->answers.empty()) {
      answer = script_->answers.front();
      script_->answers.pop_front();
    }
    script_->exposed = seconds;
    const auto end = script_->clock + std::chrono::microseconds(takesTime ? std::llround(seconds * 1e6) : 0) +
                     std::chrono::milliseconds(600);
    switch (answer) {
      case Answer::nothing:
        script_->pending.push_back({end, ""});
        return;
      case Answer::late:
        script_->make(".jpg", 0, end + script_->lateBy, 99);
        return script_->make(".CR2", 0, end + script_->lateBy + std::chrono::seconds(1), script_->shown);
      case Answer::jpeg:
        return script_->make(".jpg", 0, end, script_->shown);
      case Answer::jpegAndRaw:
        script_->make(".jpg", 0, end, 99);
        return script_->make(".cr2", 0, end, script_->shown);
      case Answer::damaged:
        return script_->make(".cr2", 1, end, script_->shown);
      case Answer::small:
        return script_->make(".cr2", 2, end, script_->shown);
      case Answer::noFocus:
        throw devices::GphotoFailure(devices::GphotoFault::refused, "Out of Focus");
      case Answer::refused:
        throw devices::GphotoFailure(devices::GphotoFault::refused, "General Error");
      case Answer::good:
        return script_->make(".CR2", 0, end, script_->shown);
    }
  }

  std::shared_ptr<StillScript> script_;
  bool isOpen_ = false;
};

/// What stands in for raw files: a value, and what is wrong with the file.
inline devices::RawPhotograph scriptedRaw(const std::vector<std::uint8_t>& bytes, const std::string& name) {
  if (bytes.at(1) == 1)
    throw Error(ErrorKind::format, Message::plain("the raw file cannot be read (cut short)"),
                Message::plain("take it again"), name);
  const Size size = bytes.at(1) == 2 ? Size{4, 4} : Size{12, 8};
  devices::RawPhotograph photograph;
  photograph.frame = {
      size, {devices::SensorLayout::bayerRG, 8}, {}, devices::SensorLevels{{10, 10, 10, 10}, 110.0f}};
  photograph.frame.bytes.assign(size.count(), static_cast<std::uint8_t>(10 + bytes.at(0)));
  return photograph;
}

}  // namespace relucent::test
