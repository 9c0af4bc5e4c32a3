// SPDX-License-Identifier: MIT
#include "wizard/preview/set_part.h"

#include <QComboBox>
#include <QMenu>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/preview/set_name_dialog.h"

namespace relucent::gui {
namespace {

void ask(PreviewPage& page, SetNameDialog::Kind kind, QWidget* parent) {
  auto* dialog = new SetNameDialog(kind, page.sets(), parent->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &SetNameDialog::chosen, &page, [&page, kind](const QString& name) {
    kind == SetNameDialog::Kind::save ? page.saveSet(name.toStdString()) : page.renameSet(name.toStdString());
  });
  dialog->open();
}

}  // namespace

QWidget* setPart(PreviewPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  QLabel* title = labelOf(PreviewPage::tr("Set"), "section");
  column->addWidget(title);
  auto* row = new QHBoxLayout;
  auto* box = new QComboBox;
  box->setObjectName("set");
  box->setAccessibleName(PreviewPage::tr("Set"));
  box->setPlaceholderText(PreviewPage::tr("Without a name"));
  title->setBuddy(box);
  row->addWidget(box, 1);
  QPushButton* more = buttonOf(PreviewPage::tr("More"), "flat");
  more->setObjectName("set-more");
  more->setAccessibleName(PreviewPage::tr("More for the set"));
  auto* menu = new QMenu(more);
  more->setMenu(menu);
  const auto action = [menu](const QString& text, const char* name) {
    QAction* added = menu->addAction(text);
    added->setObjectName(name);
    return added;
  };
  QAction* save = action(PreviewPage::tr("Save as…"), "save-set");
  QAction* rename = action(PreviewPage::tr("Rename…"), "rename-set");
  QAction* remove = action(PreviewPage::tr("Remove"), "remove-set");
  row->addWidget(more);
  column->addLayout(row);
  auto* problem = new Note(Note::Kind::amber);
  problem->setObjectName("set-problem");
  column->addWidget(problem);
  column->addWidget(lineOf());

  QObject::connect(box, &QComboBox::activated, &page,
                   [&page, box](int index) { page.useSet(box->itemText(index).toStdString()); });
  QObject::connect(save, &QAction::triggered, &page,
                   [&page, part] { ask(page, SetNameDialog::Kind::save, part); });
  QObject::connect(rename, &QAction::triggered, &page,
                   [&page, part] { ask(page, SetNameDialog::Kind::rename, part); });
  QObject::connect(remove, &QAction::triggered, &page, &PreviewPage::removeSet);
  auto refresh = [=, &page] {
    const pipeline::TargetSets& sets = page.sets();
    QStringList now, shown;
    for (const std::string& name : sets.names()) now << QString::fromStdString(name);
    for (int i = 0; i < box->count(); ++i) shown << box->itemText(i);
    if (shown != now) {
      box->clear();
      box->addItems(now);
    }
    box->setCurrentIndex(now.isEmpty() ? -1 : static_cast<int>(sets.inUse));
    box->setAccessibleDescription(now.isEmpty() ? box->placeholderText() : QString());
    const QString why = page.whyNoSets();
    const bool isBroken = page.session().setsFailure().has_value();
    // The action bar, or the note below, says it too.
    setPossible(box, why.isEmpty() && !now.isEmpty(), why);
    setPossible(more, why);
    for (QAction* one : {rename, remove}) {
      one->setVisible(!now.isEmpty());
      one->setEnabled(!now.isEmpty());
    }
    problem->setVisible(isBroken);
    problem->setText(isBroken ? why : QString());
  };
  refreshOn(page, part, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
