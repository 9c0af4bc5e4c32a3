// SPDX-License-Identifier: MIT
#include "wizard/output/nights_dialog.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <ranges>

#include "theme/theme.h"

namespace relucent::gui {

NightsDialog::NightsDialog(std::vector<pipeline::NightRecord> nights, QWidget* parent)
    : QDialog(parent), nights_(std::move(nights)) {
  setObjectName("nights");
  setWindowTitle(tr("Quality over weeks"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 24, 24, 24);
  column->setSpacing(12);
  auto* head = new QHBoxLayout;
  head->addWidget(labelOf(windowTitle(), "title"), 1);
  figure_ = new Segmented({tr("Colour error"), tr("Quality")});
  figure_->setToolTip(
      tr("Colour error: CIEDE2000, less is better. Quality: peak signal-to-noise ratio, PSNR, in dB; "
         "more is better."));
  figure_->setObjectName("nights-figure");
  head->addWidget(figure_);
  column->addLayout(head);
  column->addWidget(
      labelOf(tr("What the photograph of each night's proof came to, beside what was predicted."), "note"));
  chart_ = new LineChart({}, {});
  chart_->setObjectName("nights-chart");
  chart_->setAccessibleName(tr("Quality of the picture, night by night"));
  chart_->setMinimumHeight(240);
  column->addWidget(chart_, 3);
  list_ = new QListWidget;
  list_->setObjectName("nights-list");
  list_->setAccessibleName(tr("What came of each night, the last one first"));
  list_->setWordWrap(true);
  list_->setResizeMode(QListView::Adjust);  // lines are broken for the width that it has
  list_->setTextElideMode(Qt::ElideNone);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setMinimumHeight(140);
  column->addWidget(list_, 2);
  auto* row = new QHBoxLayout;
  row->addStretch(1);
  QPushButton* close = buttonOf(tr("Close"), "primary");
  close->setObjectName("nights-close");
  close->setDefault(true);
  row->addWidget(close);
  column->addLayout(row);
  connect(close, &QPushButton::clicked, this, &QDialog::reject);
  connect(figure_, &Segmented::chosen, this,
          [this](int index) { draw(index == 0 ? NightFigure::colourError : NightFigure::psnr); });
  connect(&Theme::instance(), &Theme::changed, this, &NightsDialog::list);
  draw(NightFigure::colourError);
  list();
  resize(960, 640);
}

void NightsDialog::draw(NightFigure figure) {
  figure_->setCurrent(figure == NightFigure::colourError ? 0 : 1);
  NightsChart chart = chartOf(nights_, figure);
  chart_->setAxes(chart.x, chart.y);
  chart_->setCurves(std::move(chart.curves));
  chart_->setAccessibleDescription(chart.summary);
}

void NightsDialog::list() {
  list_->clear();
  for (const pipeline::NightRecord& night : nights_ | std::views::reverse) {
    auto* entry = new QListWidgetItem(nightTime(night) + '\n' + nightSentence(night), list_);
    entry->setData(Qt::AccessibleTextRole, nightTime(night) + ": " + nightSentence(night));
    if (!night.alarm.empty())
      entry->setIcon(iconOf(Icon::warning, colours().red));
    else if (night.repair == pipeline::RepairEnd::repaired)
      entry->setIcon(iconOf(Icon::retry, colours().green));
    else
      entry->setIcon(iconOf(night.skipped.empty() ? Icon::tick : Icon::clock, colours().secondary));
  }
  if (list_->count() > 0) list_->setCurrentRow(0);
}

}  // namespace relucent::gui
