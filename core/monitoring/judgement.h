// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "relucent/base/raster.h"
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
  // Two visitors who stop at one place, one after the other, are there for forty seconds. What some pictures
  // show best must not count for most of that time: all photographs but one of ten have to agree as well.
  LastingSettings ofCell{50.0, 40.0, 8, 0.12, 0.03, 0.86, 0.7, 0.9};
  ReferenceSettings reference{};  // of gains
  LastingSettings ofRecognition{45.0, 25.0, 8, 10.0, 1.0, 0.85, 0.7};
  double lit = 0.003;  // mean light, of the flood image: below it nothing can be recognised, or be missing
  /// Deviation of a projector's gains if none of its light were as predicted: visitors darken what is beside
  /// them.
  double misled = 0.15;
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

/// What lasts over the looks of the last seconds is told. No memory grows.
class Judgement {
 public:
  /// `cells`: that the view is divided into.
  Judgement(std::size_t projectors, Size cells, const MonitorSettings& settings);

  /// What a photograph showed.
  void add(const Look& look, double seconds);
  /// See Monitor.
  std::vector<double> gains() const;
  const std::vector<Finding>& findings() const { return findings_; }
  double informed() const;
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

  Size cells_;
  MonitorSettings settings_;
  std::vector<Lasting> gain_, total_, cell_;  // less 1, the former two less their reference
  std::vector<Reference> gainReference_, totalReference_;
  Lasting x_, y_, turn_, unrecognised_;
  std::vector<Finding> findings_;
};

}  // namespace relucent::monitoring
