// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "relucent/monitoring/finding.h"
#include "relucent/monitoring/lasting.h"
#include "relucent/monitoring/light_fit.h"
#include "relucent/monitoring/view_shift.h"

namespace relucent::monitoring {

/// Beyond these, for as long as visitors do not stay, something is told.
struct MonitorSettings {
  double shift = 0.2;       // camera pixels
  double fade = 0.035;      // share of a projector's light
  double dark = 0.7;        // likewise: then it counts as dark
  double shadow = 0.3;      // share of a cell's light that is missing, of one cell alone half as much again
  double recognised = 0.5;  // share of the light that must be as predicted, or a photograph is no evidence
  LastingSettings ofGain{40.0, 15.0, 8, 0.04, 0.005, 0.75, 0.7};
  LastingSettings ofShift{40.0, 15.0, 8, 0.15, 0.03, 0.75, 0.7};
  // Two visitors who stop at one place, one after the other, are there for forty seconds.
  LastingSettings ofCell{50.0, 40.0, 8, 0.12, 0.03, 0.86, 0.7};
  ReferenceSettings reference{};  // of gains
  LastingSettings ofRecognition{45.0, 25.0, 8, 10.0, 1.0, 0.85, 0.7};
};
/// What is wrong with the settings; empty: nothing.
std::vector<Message> problems(const MonitorSettings& settings);

/// What became of one photograph.
struct Look {
  enum class Use {
    told,          // it is evidence
    saturated,     // it is too bright to be
    unrecognised,  // it shows something else, or too much stands in the way
  } use = Use::told;
  Moment moment;
  LightFit light;
  ViewShift shift;
};

/// Watches a venue by photographs of what plays, without patterns. Each photograph is compared with T p + e
/// of the frames lately projected (momentOf, fitLight, viewShift); what lasts is told. Photographs cost the
/// same whatever the camera's size, and no memory grows.
class Monitor {
 public:
  explicit Monitor(WatchedVenue venue, MonitorSettings settings = {});

  const WatchedVenue& venue() const { return venue_; }
  /// A photograph whose exposure began among these frames. `seconds`: when, of any clock that goes on.
  /// Contract: at least one frame; the frame has the camera's size.
  Look look(const rig::RawFrame& photograph, double seconds, std::span<const PlayedFrame> frames);
  /// Of the projectors' channels as far as photographs tell them, three a projector: 1 as they were measured.
  std::vector<double> gains() const;
  /// What lasts as of the last photograph, the gravest first.
  const std::vector<Finding>& findings() const { return findings_; }
  /// Share of all quantities that the photographs of the last seconds tell: 0 in the dark.
  double informed() const;
  /// Something else was shown, or nothing: what was seen before does not count.
  void forget();

 private:
  void decide(double seconds);
  void add(Finding finding, const std::vector<Finding>& before, double seconds);
  /// Whether any projector is dark: then the rest of the view is not judged.
  bool addLamps(bool isSteady, const std::vector<Finding>& before, double seconds);
  bool isAnyDark() const;
  /// Whether the view is steady: where it has moved, light is missing beside every edge.
  bool addMovement(const std::vector<Finding>& before, double seconds);
  void addShadows(const std::vector<Finding>& before, double seconds);
  bool was(FindingKind kind, std::optional<std::size_t> projector, std::optional<std::size_t> channel,
           const std::vector<Finding>& before) const;

  WatchedVenue venue_;
  MonitorSettings settings_;
  std::vector<Lasting> gain_, total_, cell_;  // less 1, the former two less their reference
  std::vector<Reference> gainReference_, totalReference_;
  Lasting x_, y_, turn_, unrecognised_;
  std::vector<Finding> findings_;
};

}  // namespace relucent::monitoring
