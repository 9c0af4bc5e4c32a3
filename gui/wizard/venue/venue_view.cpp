// SPDX-License-Identifier: MIT
#include "wizard/venue/venue_view.h"

#include <QFileDialog>
#include <QLineEdit>
#include <QStackedWidget>

#include "relucent/base/time_left.h"
#include "text/message_text.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/venue/tile.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

/// Name, folder, and what it will take: the same for every kind of new venue.
class KeepingPart : public QWidget {
 public:
  explicit KeepingPart(VenuePage& model) : model_(model) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(labelOf(VenuePage::tr("This venue"), "section"));
    column->addWidget(labelOf(VenuePage::tr("Name"), "note"));
    name_ = new QLineEdit;
    name_->setObjectName("venue-name");
    name_->setAccessibleName(VenuePage::tr("Name of the venue"));
    column->addWidget(name_);
    column->addWidget(labelOf(VenuePage::tr("Folder"), "note"));
    auto* row = new QHBoxLayout;
    folder_ = new QLineEdit;
    folder_->setObjectName("venue-folder");
    folder_->setAccessibleName(VenuePage::tr("Folder that holds the venue"));
    row->addWidget(folder_, 1);
    QToolButton* browse = toolOf(Icon::folder, VenuePage::tr("Choose a folder"));
    row->addWidget(browse);
    column->addLayout(row);
    column->addSpacing(8);
    column->addWidget(lineOf());
    column->addWidget(labelOf(VenuePage::tr("Expected"), "section"));
    column->addWidget(patterns_ = new ValueRow(VenuePage::tr("Patterns")));
    column->addWidget(time_ = new ValueRow(VenuePage::tr("Time, by camera")));
    time_->setToolTip(VenuePage::tr("Industrial cameras and video devices are fast, still cameras slow."));
    column->addWidget(disk_ = new ValueRow(VenuePage::tr("Disk")));
    connect(name_, &QLineEdit::textEdited, &model, &VenuePage::setVenueName);
    connect(folder_, &QLineEdit::editingFinished, &model, [this] { model_.setFolder(folder_->text()); });
    connect(browse, &QToolButton::clicked, this, [this] {
      QString chosen =
          QFileDialog::getExistingDirectory(this, VenuePage::tr("Choose a folder"), model_.folder());
      if (!chosen.isEmpty()) model_.setFolder(chosen);
    });
    refreshOn(model, this, [this] { refresh(); }, &VenuePage::settingsChanged);
    connect(&model, &VenuePage::remedyWanted, this, [this] {
      if (model_.remedy() == VenuePage::Remedy::name) pointOut(name_);
      if (model_.remedy() == VenuePage::Remedy::folder) pointOut(folder_);
    });
  }

 private:
  void refresh() {
    if (name_->text() != model_.venueName()) name_->setText(model_.venueName());
    if (!folder_->hasFocus()) folder_->setText(model_.folder());
    time_->setVisible(model_.isReal());
    if (!model_.isExpectedKnown()) {
      time_->setValue(QString::fromUtf8("–"));
      patterns_->setValue(QString::fromUtf8("–"));
      return disk_->setValue(VenuePage::tr("%1 free").arg(bytesText(model_.freeBytes())));
    }
    WorkLeft work = model_.expected();
    patterns_->setValue(VenuePage::tr("about %1").arg(countText(static_cast<std::uint64_t>(work.shots))));
    auto [fast, slow] = model_.expectedSeconds();
    time_->setValue(
        VenuePage::tr("%1 to %2").arg(text(expectedDuration(fast)), text(expectedDuration(slow))));
    const std::uint64_t free = model_.freeBytes();
    disk_->setValue(VenuePage::tr("%1 of %2").arg(bytesText(work.diskBytes), bytesText(free)),
                    free < work.diskBytes ? "error" : "strong");
  }

  VenuePage& model_;
  QLineEdit *name_, *folder_;
  ValueRow *patterns_, *time_, *disk_;
};

}  // namespace

QWidget* keepingPart(VenuePage& model) {
  return new KeepingPart(model);
}

PageView viewOf(VenuePage& model) {
  // No QStackedWidget, which needs as much room as the largest of them.
  auto* stages = new QWidget;
  auto* column = new QVBoxLayout(stages);
  column->setContentsMargins(0, 0, 0, 0);
  const QList<QWidget*> each{startStage(model),   rehearseStage(model), scriptStage(model),
                             devicesStage(model), screenStage(model),   programsStage(model)};
  for (QWidget* stage : each) column->addWidget(stage);
  auto* inspectors = new QStackedWidget;
  for (QWidget* inspector : {new QWidget, rehearseInspector(model), scriptInspector(model),
                             devicesInspector(model), screenInspector(model), programsInspector(model)})
    inspectors->addWidget(inspector);
  auto refresh = [&model, each, inspectors] {
    int mode = static_cast<int>(model.mode());
    for (QWidget* stage : each)
      if (stage != each[mode]) stage->hide();
    each[mode]->show();
    inspectors->setCurrentIndex(mode);
  };
  refreshOn(model, stages, refresh, &VenuePage::settingsChanged);
  return {stages, inspectors};
}

}  // namespace relucent::gui
