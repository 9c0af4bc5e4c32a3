// SPDX-License-Identifier: MIT
#pragma once

#include <QPushButton>
#include <functional>
#include <string>

#include "theme/controls.h"
#include "wizard/devices/camera_finder.h"

namespace relucent::gui {

/// The cameras that are there, the most suitable first: what each can do, why it stands where it does or what
/// is wrong with it, and a button.
class CameraRows : public Card {
  Q_OBJECT

 public:
  /// What the button of a camera says, and whether it can be pressed.
  struct Offer {
    QString text, accessibleName;
    bool isPossible = true;
  };
  using Offering = std::function<Offer(const devices::ListedCamera& camera, const QString& model)>;
  using Chosen = std::function<void(const devices::ListedCamera& camera)>;
  CameraRows(CameraFinder& finder, const QString& subtitle, Offering offering, Chosen chosen,
             QWidget* parent = nullptr);
  /// Where none is found, a button of the name `way` leads to `another`.
  void offerAnother(const QString& way, std::function<void()> another);
  /// Offers anew.
  void refresh();

 private:
  void addWaysOn();
  QWidget* rowOf(std::size_t index);
  static QString traitsText(const devices::CameraTraits& traits);
  QString meritText(std::size_t index) const;

  CameraFinder& finder_;
  Offering offering_;
  Chosen chosen_;
  QString way_;
  std::function<void()> another_;
  QVBoxLayout* rows_;
  QPushButton* again_;
  std::vector<QPushButton*> chooses_;  // of the cameras, in their order
};

}  // namespace relucent::gui
