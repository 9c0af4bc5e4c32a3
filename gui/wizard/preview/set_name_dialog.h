// SPDX-License-Identifier: MIT
#pragma once

#include "relucent/pipeline/sets.h"
#include "wizard/frame/name_dialog.h"

namespace relucent::gui {

/// Asks for the name of a set: of a new one, or another one of that in use.
class SetNameDialog : public NameDialog {
  Q_OBJECT

 public:
  enum class Kind { save, rename };
  SetNameDialog(Kind kind, const pipeline::TargetSets& sets, QWidget* parent = nullptr);
};

}  // namespace relucent::gui
