// SPDX-License-Identifier: MIT
#pragma once

#include <QDialog>
#include <QListWidget>
#include <vector>

#include "relucent/pipeline/night_record.h"
#include "theme/controls.h"
#include "views/line_chart.h"
#include "wizard/output/nights_chart.h"

namespace relucent::gui {

/// Quality over weeks: a chart of what each night's proof came to, and below it a sentence for each night.
class NightsDialog : public QDialog {
  Q_OBJECT

 public:
  explicit NightsDialog(std::vector<pipeline::NightRecord> nights, QWidget* parent = nullptr);

 private:
  void draw(NightFigure figure);
  void list();

  std::vector<pipeline::NightRecord> nights_;
  Segmented* figure_;
  LineChart* chart_;
  QListWidget* list_;
};

}  // namespace relucent::gui
