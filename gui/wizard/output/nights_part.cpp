// SPDX-License-Identifier: MIT
#include "wizard/output/nights_part.h"

#include <QVBoxLayout>

#include "jobs/failure.h"
#include "relucent/base/error.h"
#include "theme/theme.h"
#include "wizard/output/nights_chart.h"
#include "wizard/output/nights_dialog.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {

NightsPart::NightsPart(OutputPage& page, QWidget* parent) : QWidget(parent), page_(page) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(tr("Every night"), "section"));
  last_ = new Remark;
  last_->setObjectName("nights-remark");
  column->addWidget(last_);
  open_ = buttonOf(tr("Quality over weeks"));
  open_->setObjectName("nights-open");
  open_->setToolTip(tr("A chart of all nights, and what came of each."));
  column->addWidget(open_);
  connect(open_, &QPushButton::clicked, this, &NightsPart::open);
  connect(&page_.session(), &Session::opened, this, &NightsPart::reload);
  connect(&Theme::instance(), &Theme::changed, this, &NightsPart::reload);
  reload();
}

void NightsPart::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  reload();
}

void NightsPart::reload() {
  nights_.clear();
  open_->setIcon(iconOf(Icon::moon, colours().text));
  if (page_.session().isOpen()) {
    try {
      nights_ = pipeline::nightsOf(page_.session().path());
    } catch (const Error&) {
      const Failure failure = failureOf(std::current_exception());
      open_->setEnabled(false);
      return last_->show(Remark::Kind::warning, failure.what, failure.advice);
    }
  }
  open_->setEnabled(!nights_.empty());
  if (nights_.empty())
    return last_->show(
        Remark::Kind::watch, tr("There was no night yet"),
        tr("A show can look after the picture by itself at night: it checks, repairs, perfects "
           "and proves, and tells here what came of it. Help (F1) says how it is started so."));
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
