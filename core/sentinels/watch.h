// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "relucent/base/message.h"
#include "relucent/photography/photographer.h"
#include "relucent/sentinels/inspection.h"
#include "relucent/sentinels/interruption.h"
#include "relucent/sentinels/observer.h"

namespace relucent::sentinels {

/// Who is asked about alarms and told what checks find, and what was decided. Outlives a measurement that
/// begins again.
struct Supervision {
  AlarmHandler handler;
  AcquisitionObserver& observer;
  // What accepted alarms said, by the shot that they came before.
  std::map<std::pair<int, AlarmKind>, Message> accepted{};
  /// What was photographed again after an alarm.
  struct Again {
    Message what;
    int first = 0, patterns = 0;
  };
  std::vector<Again> again{};
  /// Whether whoever measures wants it to end with what there is: then nobody is asked to put anything right
  /// for it. Empty: nobody does.
  std::function<bool()> isEnding{};
  /// The alarm that it ended with; none: it did not.
  std::optional<Alarm> endedBy{};
  /// Several times from the same pattern on for the same reason are one.
  void remember(const Alarm& alarm);
};

struct WatchSettings {
  int checkInterval = 40;      // shots between two checks of e, the lamp and the view
  bool mayBeMirrored = false;  // pictures are meant to appear mirrored: rear projection, a mirror
};

/// Photographs while watching. Every `checkInterval` shots, and whenever check() is called, black and the
/// reference picture are photographed:
/// - e becomes the mean of all blacks so far or, where it has changed, the new one;
/// - the lamp's power follows from the reference picture, continued as a straight line until the next check;
/// - sentinels compare the view with the first one, see inspection.h, or with what was accepted since. On
///   an alarm the handler is asked, or, where the measurement is to end anyway, it ends with what is safe;
///   unless it is accepted, an Interruption is returned in place of a result;
/// - the observer is told of both.
/// A device that is given up (rig/device_given_up.h) is an Interruption too: keepAndStop.
/// Frames come out as light: less e, in units of the lamp's power at the first check.
class Watch {
 public:
  /// Keeps references: all but the settings outlive it.
  Watch(photography::Photographer& photographer, const photography::References& references,
        const WatchSettings& settings, Supervision& supervision);

  /// As they were measured.
  const photography::References& references() const { return references_; }
  /// e as it is now. Changes in checks alone.
  const hdr::BlackLevel& black() const { return black_; }
  /// Power of the lamp now, relative to the first check.
  double power() const;

  /// The first look: whether the view is still that of the floods, which way round pictures appear, what the
  /// view is compared with later. Throws: as check().
  [[nodiscard]] std::optional<Interruption> begin(const Progress& progress);
  /// Nothing: the measurement goes on.  Throws: Error{device} if an alarm has nobody to handle it.
  [[nodiscard]] std::optional<Interruption> check(const Progress& progress);

  /// Light of a pattern, see Photographer::take. `meanwhile` goes on during that photograph, not during a
  /// check that is due before it: e does not change under its hands. Throws: as check().
  Interruptible<hdr::LampLight> light(const ProjectorStack& pattern,
                                      const std::vector<photography::Demand>& demands,
                                      const Progress& progress, const photography::Meanwhile& meanwhile = {});
  /// The same of a random pattern, about half of which shines wherever one looks. Where next to nothing is
  /// seen of it, see lightShare(), a check tells at once what lasts; if it finds nothing, the pattern is
  /// photographed again. A check every `checkInterval` shots would not see a lens that was covered for a
  /// moment between two.
  Interruptible<hdr::LampLight> lightOfRandom(const ProjectorStack& pattern,
                                              const std::vector<photography::Demand>& demands,
                                              const Progress& progress);
  /// The same at given exposures, see Photographer::takeAt.
  Interruptible<hdr::LampLight> lightOfRandomAt(const ProjectorStack& pattern,
                                                const std::vector<std::size_t>& exposures,
                                                const Progress& progress);
  Interruptible<hdr::LampLight> lightOfAll(const ProjectorStack& pattern, const Progress& progress,
                                           const photography::Meanwhile& meanwhile = {});

  /// The next one's number.
  int shots() const { return shots_.shots(); }
  /// Those before this one have been confirmed by a check.
  int confirmed() const { return trusted_; }
  /// Tells the observer that patterns from `shot` on, whose light does not add up, are photographed again.
  void contradicted(int shot, int patterns);

 private:
  struct Power {
    int shot = 0;
    double value = 1.0;
  };
  using Photograph = std::function<hdr::HdrFrame()>;
  /// A photograph whose exposures agree, or are accepted though they do not; or none, of a device that is
  /// given up.
  Interruptible<hdr::HdrFrame> photographed(const Photograph& photograph);
  Interruptible<hdr::LampLight> lightOf(const Photograph& photograph, const Progress& progress);
  using Take = std::function<Interruptible<hdr::LampLight>()>;
  Interruptible<hdr::LampLight> unlessDark(const ProjectorStack& pattern, const Take& take,
                                           const Progress& progress);
  Interruptible<Check> photographCheck(const Progress& progress);
  /// `check`: the first one.
  std::optional<Interruption> inspectProjectors(const Check& check, const Progress& progress);
  /// What the floods are worth. After the check, so that nothing goes unseen between the floods and what the
  /// view is compared with later.
  std::optional<Interruption> inspectReferences(const Check& check, const Progress& progress);
  std::optional<Interruption> inspectOrientation(const hdr::ProjectedLight& light, std::size_t projector);
  /// Looks at a check, tells the observer, and handles what it found wrong with the shots from `doubtful` on.
  std::optional<Interruption> inspectCheck(const Check& now, double expectedPower, int doubtful);
  /// Asks what to do about an alarm of the shots from `doubtful` on. Nothing: it is accepted.
  std::optional<Interruption> handle(const Alarm& alarm, int doubtful);
  /// Exposures of one pattern that contradict each other are an alarm of their own.
  std::optional<Interruption> inspectBracket();
  /// The last photograph was taken now and not read from the log.
  bool isNew() const { return shots_.times().shots > photographedBefore_; }
  void follow(const Check& check);

  photography::Photographer& photographer_;
  rig::ShotTaker& shots_;
  const photography::References& references_;
  WatchSettings settings_;
  Supervision& supervision_;
  hdr::BlackLevel black_;  // e as it is now
  FirstCheck first_;
  Power last_, beforeLast_;
  int trusted_ = 0;                // shots before this one have been confirmed by a check
  bool isFirstConfirmed_ = false;  // a later check says what the first one said
  int photographedBefore_ = 0;     // the last photograph, of those not read from the log
  double flicker_ = 0.0;           // the largest contradiction since the last check
};

}  // namespace relucent::sentinels
