// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QString>
#include <optional>
#include <random>

namespace relucent::gui {

/// What is done next: a wish for the hand, in words for whoever wants to do it again.
struct Action {
  QJsonObject wish;
  QString words;
};

/// One of what can be used now (support/hand/usable_widgets.h), the likelier the more may go wrong by it:
/// what leads on, what pauses, resumes and stops. Nothing where nothing can be used.
std::optional<Action> useOf(const QJsonArray& usable, const QString& folder, std::mt19937& random);
/// A key that means something somewhere.
Action shortcut(std::mt19937& random);
/// The window gets another size, from 960x540 on.
Action resize(std::mt19937& random);

}  // namespace relucent::gui
