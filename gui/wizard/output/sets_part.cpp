// SPDX-License-Identifier: MIT
#include "wizard/output/sets_part.h"

#include <QComboBox>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/output/output_page.h"
#include "wizard/output/set_times_dialog.h"

namespace relucent::gui {
namespace {

QStringList namesOf(const OutputPage& page) {
  QStringList names;
  for (const std::string& name : page.sets().names()) names << QString::fromStdString(name);
  return names;
}

void askForTimes(OutputPage& page, QWidget* parent) {
  auto* dialog = new SetTimesDialog(namesOf(page), page.playlist().settings().sets, parent->window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  QObject::connect(dialog, &SetTimesDialog::chosen, &page,
                   [&page](const QList<SetTime>& times) { page.setTimes(times); });
  dialog->open();
}

}  // namespace

QWidget* setsPart(OutputPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  QLabel* title = labelOf(OutputPage::tr("Set"), "section");
  column->addWidget(title);
  auto* box = new QComboBox;
  box->setObjectName("output-set");
  box->setAccessibleName(OutputPage::tr("Set"));
  title->setBuddy(box);
  column->addWidget(box);
  QLabel* when = labelOf({}, "note");
  when->setObjectName("set-times");
  column->addWidget(when);
  QPushButton* times = buttonOf(OutputPage::tr("Times of the day…"));
  times->setObjectName("change-set-times");
  column->addWidget(times);

  QObject::connect(box, &QComboBox::activated, &page,
                   [&page, box](int index) { page.useSet(box->itemText(index).toStdString()); });
  QObject::connect(times, &QPushButton::clicked, &page, [&page, part] { askForTimes(page, part); });
  auto refresh = [=, &page] {
    const QStringList now = namesOf(page);
    QStringList shown;
    for (int i = 0; i < box->count(); ++i) shown << box->itemText(i);
    if (shown != now) {
      box->clear();
      box->addItems(now);
    }
    part->setVisible(!now.isEmpty());
    if (!now.isEmpty()) box->setCurrentIndex(static_cast<int>(page.sets().inUse));
    const QString why = page.whyNoSets();
    setPossible(box, why.isEmpty() && now.size() == 1 ? OutputPage::tr("There is no other set.") : why);
    QStringList lines;
    for (const SetTime& time : page.playlist().settings().sets)
      lines << OutputPage::tr("%1: %2").arg(QLocale().toString(time.from, QLocale::ShortFormat), time.set);
    when->setText(!why.isEmpty()    ? why
                  : lines.isEmpty() ? OutputPage::tr("The installed show plays this one all day.")
                                    : OutputPage::tr("The show changes by itself, here too: %1")
                                          .arg(QLocale().createSeparatedList(lines)));
  };
  refreshOn(page, part, refresh, &OutputPage::settingsChanged, &OutputPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
