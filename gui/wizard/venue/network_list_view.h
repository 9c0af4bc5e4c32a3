// SPDX-License-Identifier: MIT
#pragma once

#include <QWidget>

namespace relucent::gui {

class VenuePage;

/// Where the projectors of a new venue are on the network: an address each, with its password, and a search.
QWidget* networkList(VenuePage& model);

}  // namespace relucent::gui
