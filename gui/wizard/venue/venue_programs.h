// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <string>
#include <vector>

#include "wizard/session/session.h"

namespace relucent::gui {

/// The programs that show and photograph for the open calibration, and what is typed to change them.
class VenuePrograms : public QObject {
  Q_OBJECT

 public:
  explicit VenuePrograms(Session& session, QObject* parent = nullptr);

  /// The calibration has some, and nothing uses them.
  bool isChangeable() const { return session_.areDevicesFree() && !used().empty(); }
  /// As they are used: of projectors, then of cameras.
  std::vector<std::string> used() const;
  /// So many of them are projectors'.
  std::size_t projectors() const;

  /// In their place; as they are used until something is typed.
  const std::vector<std::string>& typed() const { return typed_; }
  void type(std::size_t program, const std::string& command);
  void forget();
  bool isDifferent() const { return typed_ != used(); }
  /// The first sentence against what is typed; empty: nothing.
  QString problem() const;
  /// Uses what is typed from now on. Throws: as Session::changeCommands().
  void apply();

 Q_SIGNALS:
  void changed();

 private:
  Session& session_;
  std::vector<std::string> typed_;
};

}  // namespace relucent::gui
