// SPDX-License-Identifier: MIT
#pragma once

#include <QJsonObject>
#include <QStringList>

namespace relucent::test {

/// What is wrong with what the windows in front show now, each a sentence: a text that is cut off or was not
/// filled in, a control without a name or reason, more than one primary button, one that is not all in sight.
QStringList windowFaults();
/// Of the work under way, as its bar shows it: {"shown", "permille"}.
QJsonObject progressInSight();

}  // namespace relucent::test
