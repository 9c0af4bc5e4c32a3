// SPDX-License-Identifier: MIT
#include "wizard/output/nights_part.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLocale>
#include <QVBoxLayout>

#include "jobs/failure.h"
#include "output/venue_use.h"
#include "relucent/base/error.h"
#include "theme/action_button.h"
#include "theme/theme.h"
#include "wizard/output/nights_chart.h"
#include "wizard/output/nights_dialog.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

NightsPart::NightsPart(OutputPage& page, QWidget* parent) : QWidget(parent), page_(page) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(tr("Every night"), "section"));
  auto* row = new QHBoxLayout;
  row->addWidget(what_ = labelOf(tr("Look after the picture"), "note"), 1);
  row->addWidget(when_ = new QComboBox);
  when_->setObjectName("night-time");
  when_->setAccessibleName(what_->text());
  when_->addItem(tr("never"), QTime());
  constexpr int darkHours = 8;
  for (int hour = 0; hour < darkHours; ++hour)
    when_->addItem(tr("at %1").arg(QLocale().toString(QTime(hour, 0), QLocale::ShortFormat)), QTime(hour, 0));
  column->addLayout(row);
  connect(when_, &QComboBox::activated, &page_,
          [this](int index) { page_.setNightAt(when_->itemData(index).toTime()); });
  for (auto signal : {&OutputPage::settingsChanged, &OutputPage::resultChanged})
    connect(&page_, signal, this, &NightsPart::showTime);
  last_ = new Remark;
  last_->setObjectName("nights-remark");
  column->addWidget(last_);
  open_ = buttonOf(tr("Quality over weeks"));
  open_->setObjectName("nights-open");
  open_->setToolTip(tr("A chart of all nights, and what came of each."));
  column->addWidget(open_);
  connect(open_, &QPushButton::clicked, this, &NightsPart::open);
  connect(&page_.session(), &Session::opened, this, &NightsPart::reload);
  // Nights pass in the installed show, another program, while this page is looked at.
  connect(&folder_, &QFileSystemWatcher::directoryChanged, this, [this] {
    if (writtenNow() == written_) return;
    reload();
    page_.nightHasPassed();
  });
  // Which time it is at, and whether anything is installed.
  for (auto signal : {&OutputPage::settingsChanged, &OutputPage::resultChanged})
    connect(&page_, signal, this, [this] {
      if (nights_.empty() && !isUnreadable_) showLast();
    });
  connect(&Theme::instance(), &Theme::changed, this, &NightsPart::reload);
  constexpr std::chrono::seconds between{2};
  looking_.setInterval(between);
  connect(&looking_, &QTimer::timeout, this, &NightsPart::lookWhetherOneRuns);
  showTime();
  reload();
}

void NightsPart::showTime() {
  const QTime at = page_.nightAt();
  // By hand a show can have been installed with any other.
  if (when_->findData(at) < 0)
    when_->addItem(tr("at %1").arg(QLocale().toString(at, QLocale::ShortFormat)), at);
  when_->setCurrentIndex(when_->findData(at));
  const QString why = page_.isInstallable() ? QString() : tr("No show of a rehearsal is looked after.");
  setPossible(when_, why);
  what_->setText(why.isEmpty() ? tr("Look after the picture") : why);
}

void NightsPart::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  looking_.start();
  lookWhetherOneRuns();
  reload();
}

void NightsPart::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  looking_.stop();
}

void NightsPart::lookWhetherOneRuns() {
  const bool isUnderWay =
      page_.session().isOpen() && VenueUse::isTaken(page_.session().path(), VenueUse::Way::night);
  if (std::exchange(isUnderWay_, isUnderWay) != isUnderWay && !isUnreadable_) showLast();
}

QDateTime NightsPart::writtenNow() const {
  return QFileInfo(QString::fromStdString((page_.session().path() / pipeline::nightsName).string()))
      .lastModified();
}

void NightsPart::reload() {
  if (!folder_.directories().isEmpty()) folder_.removePaths(folder_.directories());
  if (page_.session().isOpen()) folder_.addPath(QString::fromStdString(page_.session().path().string()));
  written_ = writtenNow();
  nights_.clear();
  isUnreadable_ = false;
  open_->setIcon(iconOf(Icon::moon, colours().text));
  if (page_.session().isOpen()) {
    try {
      nights_ = pipeline::nightsOf(page_.session().path());
    } catch (const Error&) {
      const Failure failure = failureOf(std::current_exception());
      setPossible(open_, failure.what);
      isUnreadable_ = true;
      return last_->show(Remark::Kind::warning, failure.what, failure.advice);
    }
  }
  showLast();
}

void NightsPart::showLast() {
  setPossible(open_, nights_.empty() ? tr("There was no night yet") : QString());
  if (isUnderWay_)
    return last_->show(
        Remark::Kind::watch, tr("A night is under way"),
        tr("The show makes way while its picture is looked after. What comes of it is told here."));
  if (nights_.empty() && page_.installedShow() == OutputPage::InstalledShow::thisVenues &&
      page_.nightAt().isValid())
    return last_->show(
        Remark::Kind::watch, tr("There was no night yet"),
        tr("The installed show has its first one at %1, if it plays by then. Its camera has to stay "
           "where it is.")
            .arg(QLocale().toString(page_.nightAt(), QLocale::ShortFormat)));
  if (nights_.empty())
    return last_->show(
        Remark::Kind::watch, tr("There was no night yet"),
        tr("A show can look after the picture by itself at night: it checks, repairs, perfects "
           "and proves, and tells here what came of it. Its camera has to stay where it is."));
  const pipeline::NightRecord& night = nights_.back();
  const bool isAlarm = !night.alarm.empty(), isLeftOut = !night.skipped.empty();
  last_->show(isAlarm     ? Remark::Kind::warning
              : isLeftOut ? Remark::Kind::watch
                          : Remark::Kind::good,
              isAlarm     ? tr("Somebody has to look, %1").arg(nightTime(night))
              : isLeftOut ? tr("Left out, %1").arg(nightTime(night))
                          : tr("All is well, %1").arg(nightTime(night)),
              nightSentence(night));
}

void NightsPart::open() {
  auto* dialog = new NightsDialog(nights_, window());
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowModality(Qt::WindowModal);
  dialog->show();
}

}  // namespace relucent::gui
