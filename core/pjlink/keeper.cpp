// SPDX-License-Identifier: MIT
#include "relucent/pjlink/keeper.h"

#include <algorithm>
#include <utility>

#include "relucent/base/error.h"

namespace relucent::pjlink {
namespace {

/// Text that a projector chose may change with every look; what is told once is told by its kind.
std::string keyOf(const Message& sentence) {
  std::string key = sentence.id();
  for (const Argument& argument : sentence.arguments())
    if (const auto* inner = std::get_if<Argument::Sentence>(&argument.value()))
      key.append(" ").append(keyOf(*inner->message));
  return key;
}

}  // namespace

Keeper::Keeper(Address address, KeeperSettings settings)
    : address_(std::move(address)), settings_(std::move(settings)) {}

void Keeper::warnOnce(Kept& kept, Message sentence) {
  std::string key = keyOf(sentence);
  if (said_.insert(key).second && !standing_.contains(key)) kept.warned.push_back(std::move(sentence));
}

bool Keeper::keepPower(Session& session, const Wanted& wanted, Time now, Kept& kept) {
  const std::optional<Power> power = kept.report->power;
  if (!power) return true;
  const bool isAsWanted = *power == (wanted.on ? Power::on : Power::off);
  if (!settings_.switchesPower) {
    if (wanted.on && (power == Power::off || power == Power::cooling))
      warnOnce(
          kept,
          RELUCENT_ENGLISH_MESSAGE("pjlink.is-off", "projector {} is switched off").with(settings_.label));
    return true;
  }
  if (isAsWanted) {
    differsSince_.reset();
    toldPower_ = wanted.on;
    return true;
  }
  if (!differsSince_) differsSince_ = now;
  const bool isUnderWay = power == Power::warming || power == Power::cooling;
  if (!isUnderWay) {
    const Obedience obedience = switchPower(session, wanted.on);
    if (obedience == Obedience::cannot) {
      warnOnce(kept, RELUCENT_ENGLISH_MESSAGE("pjlink.cannot-switch",
                                              "projector {} cannot be switched on and off by the network")
                         .with(settings_.label));
      return true;
    }
    if (obedience == Obedience::done && toldPower_ != wanted.on) {
      kept.told.push_back(
          wanted.on ? RELUCENT_ENGLISH_MESSAGE("pjlink.switched-on", "projector {} was switched on")
                          .with(settings_.label)
                    : RELUCENT_ENGLISH_MESSAGE("pjlink.switched-off", "projector {} was switched off")
                          .with(settings_.label));
      toldPower_ = wanted.on;
    }
  }
  if (now - *differsSince_ >= settings_.obeys)
    warnOnce(
        kept,
        wanted.on
            ? RELUCENT_ENGLISH_MESSAGE(
                  "pjlink.stays-off",
                  "projector {} was told to switch on and does not: look at its lamps and its menu")
                  .with(settings_.label)
            : RELUCENT_ENGLISH_MESSAGE("pjlink.stays-on",
                                       "projector {} was told to switch off and does not: look at its menu")
                  .with(settings_.label));
  return false;
}

bool Keeper::keepShutter(Session& session, const Wanted& wanted, Kept& kept) {
  const std::optional<Shutter>& shutter = kept.report->shutter;
  // One that is to go off, goes off as it is: nothing of a desktop is seen meanwhile.
  if (kept.report->power != Power::on || !shutter || !wanted.on) return true;
  const bool wantsClosed = settings_.closesShutter && wanted.black;
  if (shutter->picture == wantsClosed) return true;
  if (!settings_.closesShutter) {
    if (!wanted.black)
      warnOnce(kept, RELUCENT_ENGLISH_MESSAGE("pjlink.shutter-closed",
                                              "the shutter of projector {} is closed: nothing can be seen")
                         .with(settings_.label));
    return true;
  }
  if (!hasShutter_) return true;
  switch (closeShutter(session, wantsClosed)) {
    case Obedience::done:
      // It may say so and leave the shutter; the next look tells.
      if (const std::optional<Answer> now = session.ask("AVMT", "?"); now && shutterFrom(now->value))
        kept.report->shutter = shutterFrom(now->value);
      return kept.report->shutter->picture == wantsClosed;
    case Obedience::notNow:
      return false;
    case Obedience::cannot:
      break;
  }
  hasShutter_ = false;
  kept.warned.push_back(RELUCENT_ENGLISH_MESSAGE(
                            "pjlink.no-shutter",
                            "projector {} has no shutter that the network closes: its black is what it shows")
                            .with(settings_.label));
  return true;
}

void Keeper::missed(Kept& kept, Message why) {
  kept.problem = std::move(why);
  // What it said before may still hold: it is not told again when the projector answers.
  if (failures_ == 0) kept.warned.push_back(kept.problem);
  kept.pause = std::min(settings_.longestPause, settings_.soon * (1 << std::min(failures_, 16)));
  ++failures_;
}

Kept Keeper::keep(const Wanted& wanted, Time now, const Progress& progress) {
  Kept kept;
  said_.clear();
  try {
    Session session(address_, settings_.patience, progress);
    kept.report = look(session);
    const bool isPowered = keepPower(session, wanted, now, kept);
    const bool isShut = keepShutter(session, wanted, kept);
    kept.pause = isPowered && isShut ? settings_.interval : settings_.soon;
  } catch (const Error& error) {
    kept.report.reset();
    missed(kept, error.sentence());
    return kept;
  }
  if (std::exchange(failures_, 0) > 0)
    kept.told.push_back(
        RELUCENT_ENGLISH_MESSAGE("pjlink.answers-again", "projector {} answers again").with(settings_.label));
  for (Message& sentence : troublesOf(*kept.report, settings_.label)) warnOnce(kept, std::move(sentence));
  for (Message& sentence : harmfulSettings(*kept.report, settings_.label, settings_.sent))
    warnOnce(kept, std::move(sentence));
  if (!kept.report->unclear.empty())
    warnOnce(kept, RELUCENT_ENGLISH_MESSAGE(
                       "pjlink.unclear",
                       "projector {} answers {} in a way that is no PJLink: what it means is ignored")
                       .with(settings_.label, kept.report->unclear.front()));
  standing_ = said_;
  return kept;
}

}  // namespace relucent::pjlink
