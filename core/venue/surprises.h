// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "relucent/base/enum_names.h"
#include "relucent/venue/device_faults.h"

namespace relucent::venue {

/// What happens once while a rehearsal measures the light transport, to practise what is to be done about it.
enum class Surprise {
  bump,       // somebody bumps the camera, which looks elsewhere until it is pushed back
  roomLight,  // somebody switches a light on, and off when asked to
  unplugged,  // the camera's cable comes out, and is soon pushed in again
};

inline constexpr std::array surpriseNames{EnumName<Surprise>{Surprise::bump, "bump"},
                                          EnumName<Surprise>{Surprise::roomLight, "room-light"},
                                          EnumName<Surprise>{Surprise::unplugged, "unplugged"}};
constexpr EnumNames<Surprise> namesOf(Surprise) {
  return {"surprise", surpriseNames};
}

struct SurpriseSettings {
  std::vector<Surprise> kinds;
  std::uint64_t seed = 1;   // of their moments
  int patterns = 200;       // that measuring is expected to take
  double shift = 2.0;       // of a bump, camera pixels to the right and down ...
  double degrees = 1.0;     // ... and turned
  double roomLight = 0.05;  // of the mean of what the camera sees at full light
  int failures = 20;        // photographs in vain until the cable is in again
  bool operator==(const SurpriseSettings&) const = default;
};

/// How far surprises have come: all else follows from their settings.
struct SurprisesSoFar {
  std::vector<Surprise> lasting, over;
  int failures = 0;  // photographs that were taken in vain
  int looks = 0;     // while a camera was pushed back
  bool operator==(const SurprisesSoFar&) const = default;
};

/// Surprises of one rehearsal, as faults of its devices (device_faults.h). Each comes at its own pattern,
/// random by the seed, between a sixth and half of those expected: when something is safe already, and before
/// an early end. Once it has happened it lasts, whatever is photographed, until what it asks for is done.
/// From any thread.
class Surprises {
 public:
  /// `soFar`: of before, where a rehearsal goes on; kinds that the settings do not have count for nothing.
  explicit Surprises(const SurpriseSettings& settings, const SurprisesSoFar& soFar = {});

  const SurpriseSettings& settings() const { return settings_; }
  SurprisesSoFar soFar() const;
  /// `changed` is called each time that what soFar() says is another, on the thread that made it so. To be
  /// set before anything is photographed.
  void tellChanges(std::function<void(const Surprises&)> changed) { changed_ = std::move(changed); }

  /// The pattern of the light transport before which it happens; contract: it is among them.
  int momentOf(Surprise kind) const;
  bool hasHappened(Surprise kind) const;
  /// It has happened, and nobody has put it right.
  bool lasts(Surprise kind) const;

  /// To be called for each photograph. Those of an unplugged camera are counted; while a camera is pushed
  /// back
  /// ("nudge") it comes nearer from look to look.
  std::vector<DeviceFault> during(const rig::ShotId& shot);
  /// Somebody has done what he was asked to before measuring again: the light is off. A camera that was
  /// bumped is not pushed back by it.
  void putRight();

 private:
  enum class State { toCome, lasts, over };
  struct Planned {
    Surprise kind = Surprise::bump;
    int moment = 0;
    State state = State::toCome;
  };
  Planned* find(Surprise kind);
  const Planned* find(Surprise kind) const;
  DeviceFault faultOf(Planned& planned, const rig::ShotId& shot);
  SurprisesSoFar countedSoFar() const;
  std::vector<DeviceFault> faultsDuring(const rig::ShotId& shot);

  SurpriseSettings settings_;
  std::function<void(const Surprises&)> changed_;
  mutable std::mutex guard_;
  std::vector<Planned> planned_;
  int failures_ = 0, looks_ = 0;
};

}  // namespace relucent::venue
