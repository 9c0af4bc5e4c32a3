// SPDX-License-Identifier: MIT
#pragma once

#include <QCheckBox>
#include <functional>
#include <optional>

#include "wizard/session.h"

namespace relucent {

class Note;

/// What is said of a projector that may flash. `changes`: patterns a second, where that is known.
QString flashWarning(std::optional<double> changes);
/// Patterns a second while the response was measured; none before.
std::optional<double> measuredChanges(const Session& session);

/// The warning with its tick, for a page's inspector; hidden where nobody has to agree.
class FlashConsent : public QWidget {
  Q_OBJECT

 public:
  explicit FlashConsent(QWidget* parent = nullptr);
  void show(bool needed, bool given, const QString& warning);

 Q_SIGNALS:
  void given(bool clear);

 private:
  Note* note_;
  QCheckBox* tick_;
};

/// That of the open venue.
QWidget* consentPart(Session& session);

}  // namespace relucent
