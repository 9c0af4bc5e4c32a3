// SPDX-License-Identifier: MIT
#pragma once

#include <QList>
#include <QString>

namespace relucent {

/// Whether the gaps "{}" of one of core's English sentences hold quantities, from left to right: what is
/// measured or counted, as opposed to names, sizes like 1024x768, codes and numbers by which things are told
/// apart, which stay as they are in every language.
QList<bool> quantitiesIn(const QString& sentence);

/// A sentence of any language with narrow spaces between its gaps and the units behind them.
QString withNarrowUnits(QString sentence);

}  // namespace relucent
