// SPDX-License-Identifier: MIT
#include "wizard/preview/set_name_dialog.h"

#include <algorithm>

#include "text/message_text.h"

namespace relucent::gui {
namespace {

QString problemOf(const QString& typed, const pipeline::TargetSets& sets) {
  const std::string name = typed.trimmed().toStdString();
  if (const Message wrong = pipeline::problemOfSetName(name); !wrong.empty() && !name.empty())
    return fullSentence(wrong);
  if (std::ranges::count(sets.all, name, &pipeline::TargetSet::name) > 0 && name != sets.nameInUse())
    return SetNameDialog::tr("There is a set of this name already.");
  return {};
}

NameDialog::Question questionOf(SetNameDialog::Kind kind, const pipeline::TargetSets& sets) {
  const bool isNew = kind == SetNameDialog::Kind::save;
  const QString present = QString::fromStdString(sets.nameInUse());
  return {isNew ? SetNameDialog::tr("Save as a set") : SetNameDialog::tr("Rename a set"),
          isNew ? SetNameDialog::tr("What you see becomes this set, and is changed in it from now on.")
                : SetNameDialog::tr(
                      "Playlists and controllers that call it by its present name have to be changed, too."),
          isNew ? SetNameDialog::tr("Save") : SetNameDialog::tr("Rename"),
          isNew ? QString() : present,
          present,
          SetNameDialog::tr("Day, night, school class"),
          [sets](const QString& typed) { return problemOf(typed, sets); }};
}

}  // namespace

SetNameDialog::SetNameDialog(Kind kind, const pipeline::TargetSets& sets, QWidget* parent)
    : NameDialog("set", questionOf(kind, sets), parent) {}

}  // namespace relucent::gui
