// SPDX-License-Identifier: MIT
#include "wizard/devices/camera_rows.h"

#include <QScrollArea>
#include <utility>

#include "text/message_text.h"
#include "theme/action_button.h"
#include "theme/theme.h"
#include "views/number_text.h"
#include "wizard/devices/camera_ranking.h"

namespace relucent::gui {

CameraRows::CameraRows(CameraFinder& finder, const QString& subtitle, Offering offering, Chosen chosen,
                       QWidget* parent)
    : Card(tr("Cameras"), parent),
      finder_(finder),
      offering_(std::move(offering)),
      chosen_(std::move(chosen)) {
  setSubtitle(subtitle);
  again_ = buttonOf(tr("Look again"));
  again_->setObjectName("look-for-cameras");
  addAction(again_);
  auto* list = new QWidget;
  rows_ = new QVBoxLayout(list);
  rows_->setContentsMargins(0, 0, 0, 0);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFocusPolicy(Qt::NoFocus);  // its buttons are gone to one by one
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(list);
  body()->addWidget(scroll, 1);
  connect(again_, &QPushButton::clicked, &finder, &CameraFinder::look);
  connect(&finder, &CameraFinder::changed, this, &CameraRows::refresh);
  refresh();
}

void CameraRows::refresh() {
  again_->setText(finder_.isLooking() ? tr("Looking for cameras") : tr("Look again"));
  setPossible(again_, finder_.isLooking() ? tr("Looking for cameras") : QString());
  while (QLayoutItem* item = rows_->takeAt(0)) {
    if (QWidget* row = item->widget()) {
      row->hide();  // its own button may be what this follows from: it goes later
      row->deleteLater();
    }
    delete item;
  }
  const devices::CameraList& devices = finder_.cameras();
  chooses_.clear();
  for (std::size_t i = 0; i < devices.cameras.size(); ++i) rows_->addWidget(rowOf(i));
  // Made later than what stands behind the list: Tab comes to them in the order that is seen.
  QWidget* before = again_;
  for (QPushButton* choose : chooses_) setTabOrder(std::exchange(before, choose), choose);
  if (devices.cameras.empty() && finder_.isLooking())
    rows_->addWidget(labelOf(tr("Looking for cameras"), "secondary"));
  else if (devices.cameras.empty())
    addWaysOn();
  for (const devices::CameraSupport& kind : devices.support)
    if (!kind.available) rows_->addWidget(labelOf(fullSentence(kind.sentence), "note"));
  rows_->addStretch(1);
}

void CameraRows::offerAnother(const QString& way, std::function<void()> another) {
  way_ = way;
  another_ = std::move(another);
  refresh();
}

/// Where no camera is found: what could be one.
void CameraRows::addWaysOn() {
  rows_->addWidget(
      labelOf(tr("No camera answers. Check its cable and its power, and close other programs that use it."),
              "secondary"));
  rows_->addWidget(labelOf(tr("These are found here: webcams and other video devices, industrial cameras by "
                              "GigE Vision or USB3 Vision, and still cameras on USB."),
                           "note"));
  if (!another_) {
    rows_->addWidget(labelOf(tr("Any other is driven by a program of yours: go Back and choose “New venue by "
                                "script”. The guide (F1) tells how cameras are set up."),
                             "note"));
    return;
  }
  rows_->addWidget(labelOf(
      tr("Any other is driven by a program of yours. The guide (F1) tells how cameras are set up."), "note"));
  QPushButton* another = buttonOf(way_);
  another->setObjectName("another-camera");
  connect(another, &QPushButton::clicked, this, [this] { another_(); });
  rows_->addWidget(another, 0, Qt::AlignLeading);
}

QWidget* CameraRows::rowOf(std::size_t index) {
  const devices::ListedCamera& camera = finder_.cameras().cameras[index];
  auto* card = new QFrame;
  setRole(card, "card");
  auto* row = new QHBoxLayout(card);
  row->setContentsMargins(16, 10, 12, 10);
  row->addWidget(new IconLabel(camera.usable ? Icon::camera : Icon::warning, secondaryColour, 24));
  row->addSpacing(8);
  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  const QString name = text(camera.model);
  texts->addWidget(labelOf(name, "strong"));
  if (camera.usable) {
    if (const QString merit = meritText(index); !merit.isEmpty())
      texts->addWidget(labelOf(merit, index == 0 ? "good" : "note"));
    texts->addWidget(labelOf(traitsText(camera.traits), "note"));
    for (const Message& remark : camera.traits.remarks)
      texts->addWidget(labelOf(fullSentence(remark), "note"));
  } else {
    texts->addWidget(labelOf(tr("Cannot be used: %1").arg(fullSentence(camera.problem)), "note"));
  }
  texts->addWidget(labelOf(QString::fromStdString(camera.address), "note"));
  row->addLayout(texts, 1);
  const Offer offer = offering_(camera, name);
  QPushButton* choose = buttonOf(offer.text);
  choose->setObjectName("choose-camera");
  choose->setAccessibleName(offer.accessibleName);
  // The row says it.
  setPossible(choose, camera.usable && offer.isPossible,
              camera.usable ? QString() : tr("Cannot be used: %1").arg(fullSentence(camera.problem)));
  connect(choose, &QPushButton::clicked, this, [this, camera] { chosen_(camera); });
  row->addWidget(choose);
  chooses_.push_back(choose);
  return card;
}

QString CameraRows::traitsText(const devices::CameraTraits& traits) {
  return tr("%1 pixels, %n bit(s), exposures %2 to %3", nullptr, traits.format.bits)
      .arg(sizeText(traits.size.width, traits.size.height), exposureText(traits.exposures.shortest),
           exposureText(traits.exposures.longest));
}

/// The first is recommended, others lack something beside it.
QString CameraRows::meritText(std::size_t index) const {
  const bool isFirst = index == 0;
  switch (meritOf(finder_.cameras().cameras, index)) {
    case CameraMerit::alone:
      return {};
    case CameraMerit::bits:
      return isFirst ? tr("Recommended: it tells faint light apart best")
                     : tr("Fewer bits: faint light is told apart less well");
    case CameraMerit::exposures:
      return isFirst ? tr("Recommended: its exposures cover most, from bright to dark")
                     : tr("Fewer exposures: bright and dark are harder to cover");
    case CameraMerit::pixels:
      return isFirst ? tr("Recommended: it has most pixels") : tr("Fewer pixels than the first");
    case CameraMerit::none:
      return isFirst ? QString() : tr("As suitable as the first");
  }
  return {};
}

}  // namespace relucent::gui
