// SPDX-License-Identifier: MIT
#include "wizard/acquire/outlook_view.h"

#include <utility>

#include "theme/controls.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"

namespace relucent::gui {
namespace {

// Of linear light. The corner, which looks right, reaches 34 dB; the wine glass, whose caustics stay, 24.
constexpr double fair = 20.0, good = 26.0, veryGood = 32.0;

QString qualityWord(double decibels) {
  if (decibels < fair) return AcquirePage::tr("rough");
  if (decibels < good) return AcquirePage::tr("fair");
  return decibels < veryGood ? AcquirePage::tr("good") : AcquirePage::tr("very good");
}

/// "about 34 dB, very good".
QString wholeText(double decibels) {
  return AcquirePage::tr("about %1").arg(qualityText(decibels));
}

}  // namespace

QString qualityText(double decibels) {
  return AcquirePage::tr("%1, %2").arg(isolated(AcquirePage::tr("%1 dB").arg(decimalText(decibels, 0))),
                                       qualityWord(decibels));
}

QString qualityMeaning() {
  return AcquirePage::tr(
      "dB says how close the picture comes to the one wanted, where it can be reached at all: 20 dB looks "
      "rough, 30 dB good, and every 6 dB halve what is off.");
}

QWidget* outlookCard(AcquirePage& model) {
  auto* card = new Card(AcquirePage::tr("Compensated so far"));
  auto* picture = new ImageView;
  picture->setObjectName("outlook-view");
  picture->setMinimumHeight(leastPictureHeight);
  picture->setAccessibleName(AcquirePage::tr("A picture, compensated with what is measured so far"));
  picture->setEmptyText(AcquirePage::tr("Appears after the first patterns, and grows sharper."));
  card->setToolTip(qualityMeaning());
  card->setWhatsThis(qualityMeaning());
  card->body()->addWidget(picture, 1);
  auto refresh = [&model, card, picture, shown = AcquisitionTrace::SharedOutlook()]() mutable {
    const AcquisitionTrace::SharedOutlook outlook = model.outlook();
    if (std::exchange(shown, outlook) == outlook) return;
    picture->setPicture(outlook ? encodedPictureOf(outlook->picture) : QImage());
    card->setSubtitle(outlook ? AcquirePage::tr("%1 px").arg(outlook->blocks) : QString());
    picture->setAccessibleDescription(
        outlook
            ? AcquirePage::tr("Blocks of %1 px. Expected now: %2. In the end: %3.")
                  .arg(QString::number(outlook->blocks), qualityText(outlook->now), wholeText(outlook->whole))
            : QString());
  };
  refreshOn(model, card, refresh, &AcquirePage::progressChanged, &AcquirePage::resultChanged);
  return card;
}

QWidget* outlookPart(AcquirePage& model) {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  auto* now = new ValueRow(AcquirePage::tr("Expected now"));
  auto* whole = new ValueRow(AcquirePage::tr("In the end"));
  rows->addWidget(now);
  rows->addWidget(whole);
  part->setToolTip(qualityMeaning());
  part->setWhatsThis(qualityMeaning());
  auto refresh = [&model, part, now, whole] {
    const AcquisitionTrace::SharedOutlook outlook = model.outlook();
    part->setVisible(model.isMeasuring() && outlook);
    if (!outlook) return;
    now->setValue(qualityText(outlook->now));
    whole->setValue(wholeText(outlook->whole));
    whole->setVisible(!model.isStopping());  // it will not come to that
  };
  refreshOn(model, part, refresh, &AcquirePage::progressChanged, &AcquirePage::resultChanged);
  return part;
}

}  // namespace relucent::gui
