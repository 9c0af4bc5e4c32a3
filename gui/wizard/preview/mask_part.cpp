// SPDX-License-Identifier: MIT
#include "wizard/preview/mask_part.h"

#include <QListWidget>
#include <QSignalBlocker>
#include <QSlider>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/preview/preview_page.h"
#include "wizard/session/device_label.h"

namespace relucent::gui {
namespace {

constexpr int featherSteps = 200;  // of the slider, each a thousandth of the view's side
constexpr int mostRowsInSight = 5;

QString maskName(const PreviewPage& page, std::size_t mask) {
  const QString name = PreviewPage::tr("Mask %1").arg(mask + 1);
  const std::size_t camera = page.settings().masks[mask].camera;
  return page.cameras() > 1 ? PreviewPage::tr("%1, %2").arg(name, cameraLabel(page.session(), camera)) : name;
}

}  // namespace

QWidget* maskPart(PreviewPage& page) {
  MaskEditing& editing = page.masks();
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(labelOf(PreviewPage::tr("Masks"), "section"));
  column->addWidget(
      labelOf(PreviewPage::tr("No light falls on these parts: doors, windows, where visitors sit."), "note"));
  auto* list = new QListWidget;
  list->setObjectName("masks");
  list->setAccessibleName(PreviewPage::tr("Masks"));
  column->addWidget(list);
  auto* draw = new ActionButton(PreviewPage::tr("Draw a mask"));
  draw->setObjectName("draw-mask");
  draw->setCheckable(true);
  column->addWidget(draw);
  QLabel* how =
      labelOf(PreviewPage::tr("Click points in the picture, and the first one again to close. With the "
                              "keyboard: arrow keys, Space, Return; Escape leaves it."),
              "note");
  how->setObjectName("how-to-draw");
  column->addWidget(how);
  auto* problem = new Note(Note::Kind::amber);
  problem->setObjectName("mask-problem");
  column->addWidget(problem);
  auto* outline = new Segmented({PreviewPage::tr("Straight"), PreviewPage::tr("Curved")});
  outline->setObjectName("mask-outline");
  outline->setAccessibleName(PreviewPage::tr("How the points of the mask are joined"));
  column->addWidget(outline);
  auto* featherRow = new ValueRow(PreviewPage::tr("Feather"));
  auto* feather = new QSlider(Qt::Horizontal);
  feather->setObjectName("mask-feather");
  feather->setRange(0, featherSteps);
  feather->setAccessibleName(
      PreviewPage::tr("How far beyond the mask the light comes back, thousandths of the view"));
  column->addWidget(featherRow);
  column->addWidget(feather);
  QPushButton* remove = buttonOf(PreviewPage::tr("Remove the mask"));
  remove->setObjectName("remove-mask");
  column->addWidget(remove);
  column->addWidget(lineOf());

  QObject::connect(list, &QListWidget::currentRowChanged, &editing, [&page, &editing](int row) {
    if (row < 0) return;
    const auto mask = static_cast<std::size_t>(row);
    if (mask < editing.masks().size() && editing.masks()[mask].camera < page.cameras())
      page.showCamera(editing.masks()[mask].camera);
    editing.choose(mask);
  });
  QObject::connect(draw, &QPushButton::clicked, &editing,
                   [&editing](bool wanted) { wanted ? editing.draw() : editing.cancel(); });
  QObject::connect(outline, &Segmented::chosen, &editing, [&editing](int index) {
    editing.setOutline(index == 1 ? compensation::Outline::curve : compensation::Outline::lines);
  });
  QObject::connect(feather, &QSlider::valueChanged, &editing,
                   [&editing](int value) { editing.setFeather(value / 1000.0); });
  QObject::connect(remove, &QPushButton::clicked, &editing, &MaskEditing::removeChosen);

  auto refresh = [=, &page, &editing] {
    QSignalBlocker quietList(list), quietFeather(feather);
    const auto count = static_cast<int>(editing.masks().size());
    while (list->count() > count) delete list->takeItem(list->count() - 1);
    while (list->count() < count) list->addItem(QString());
    for (int row = 0; row < count; ++row)
      list->item(row)->setText(maskName(page, static_cast<std::size_t>(row)));
    list->setCurrentRow(editing.chosen() ? static_cast<int>(*editing.chosen()) : -1);
    list->setVisible(count > 0);
    if (count > 0)
      list->setFixedHeight(std::min(count, mostRowsInSight) * list->sizeHintForRow(0) +
                           2 * list->frameWidth());
    draw->setChecked(editing.isDrawing());
    draw->setWhyNot(page.preview() == nullptr ? PreviewPage::tr("There is no preview yet.") : QString());
    draw->setText(editing.isDrawing() ? PreviewPage::tr("Stop drawing") : PreviewPage::tr("Draw a mask"));
    const bool begins = editing.isDrawing() && how->isHidden();
    how->setVisible(editing.isDrawing());
    // Once all have their places.
    if (begins) QTimer::singleShot(0, how, [how] { bringIntoSight(how); });
    problem->setVisible(!editing.problem().isEmpty());
    problem->setText(editing.problem());
    const bool isShaped = editing.isDrawing() || editing.chosen().has_value();
    for (QWidget* widget : std::initializer_list<QWidget*>{outline, featherRow, feather})
      widget->setVisible(isShaped);
    remove->setVisible(editing.chosen().has_value());
    outline->setCurrent(editing.outline() == compensation::Outline::curve ? 1 : 0);
    feather->setValue(static_cast<int>(std::lround(1000.0 * editing.feather())));
    featherRow->setValue(percentText(editing.feather()));
  };
  QObject::connect(&editing, &MaskEditing::changed, part, refresh);
  refreshOn(page, part, refresh, &PreviewPage::settingsChanged, &PreviewPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
