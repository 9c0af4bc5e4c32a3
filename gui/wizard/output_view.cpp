// SPDX-License-Identifier: MIT
#include <cmath>

#include "theme/controls.h"
#include "theme/theme.h"
#include "views/image_view.h"
#include "views/number_text.h"
#include "wizard/output_page.h"
#include "wizard/page_view.h"

namespace relucent {
namespace {

QWidget* stageOf(OutputPage& page) {
  auto* card = new Card(OutputPage::tr("On the projector now"));
  auto* compare = new Segmented({OutputPage::tr("Corrected"), OutputPage::tr("Original")});
  compare->setObjectName("compare");
  card->addAction(compare);
  auto* view = new ImageView;
  view->setObjectName("output-view");
  view->setAccessibleName(OutputPage::tr("What the projector shows"));
  view->setEmptyText(OutputPage::tr("The output is closed. Nothing is projected."));
  card->body()->addWidget(view, 1);
  QObject::connect(compare, &Segmented::chosen, &page,
                   [&page](int index) { page.setCompensated(index == 0); });
  auto refresh = [&page, card, view, compare] {
    compare->setEnabled(page.isOpen());
    compare->setCurrent(page.isCompensated() ? 0 : 1);
    QImage drive = page.onProjector();
    if (drive.cacheKey() != view->picture().cacheKey()) view->setPicture(drive);
    Size size = page.projectorSize();
    card->setSubtitle(QString::fromUtf8("%1 × %2").arg(size.width).arg(size.height));
  };
  QObject::connect(&page, &OutputPage::changed, card, refresh);
  refresh();
  return card;
}

/// A choice for each screen, made again when one is plugged in or out.
class ScreenChoices : public QWidget {
 public:
  explicit ScreenChoices(OutputPage& page) : page_(page) {
    column_ = new QVBoxLayout(this);
    column_->setContentsMargins(0, 0, 0, 0);
    connect(&page, &OutputPage::changed, this, [this] { refresh(); });
    refresh();
  }

 private:
  void refresh() {
    QStringList now;
    for (const OutputScreen& screen : page_.screens())
      now << QString("%1 %2").arg(screen.identity.connector).arg(screen.size.width());
    if (now != shown_) fill();
    shown_ = now;
    for (std::size_t i = 0; i < choices_.size(); ++i) choices_[i]->setChecked(page_.chosen() == i);
  }
  void fill() {
    for (Choice* choice : choices_) delete choice;
    choices_.clear();
    for (std::size_t i = 0; i < page_.screens().size(); ++i) {
      const OutputScreen& screen = page_.screens()[i];
      auto* choice =
          new Choice(screen.operators ? OutputPage::tr("This screen") : screen.identity.connector,
                     OutputPage::tr("%1 × %2 pixels").arg(screen.size.width()).arg(screen.size.height()));
      Size size = page_.projectorSize();
      if (screen.size == QSize(size.width, size.height)) choice->setRemark(OutputPage::tr("fits"));
      choice->setObjectName("screen-" + screen.identity.connector);
      connect(choice, &Choice::clicked, &page_, [this, i] { page_.choose(i); });
      column_->addWidget(choice);
      choices_.push_back(choice);
    }
  }
  OutputPage& page_;
  QVBoxLayout* column_;
  QStringList shown_;
  std::vector<Choice*> choices_;
};

QWidget* inspectorOf(OutputPage& page) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(OutputPage::tr("Projector's screen"), "section"));
  column->addWidget(new ScreenChoices(page));
  auto* note = new Note(Note::Kind::information);
  column->addWidget(note);
  column->addWidget(lineOf());
  column->addWidget(labelOf(OutputPage::tr("Playback"), "section"));
  auto* rate = new ValueRow(OutputPage::tr("Frames a second"));
  auto* time = new ValueRow(OutputPage::tr("Frame time"));
  auto* late = new ValueRow(OutputPage::tr("Late frames"));
  auto* clipped = new ValueRow(OutputPage::tr("Beyond the projector"));
  auto* engine = new ValueRow(OutputPage::tr("Computed on"));
  for (ValueRow* row : {rate, time, late, clipped, engine}) column->addWidget(row);
  column->addStretch(1);
  auto refresh = [=, &page] {
    PlayerStatistics s = page.statistics();
    bool open = page.isOpen();
    QString none = QString::fromUtf8("–");
    rate->setValue(!open                     ? none
                   : s.framesPerSecond > 0.0 ? numberText(s.framesPerSecond)
                                             : OutputPage::tr("still picture"));
    time->setValue(open && s.frames > 0 ? OutputPage::tr("%1 ms").arg(numberText(1000.0 * s.frameSeconds))
                                        : none);
    late->setValue(open ? countText(s.late) : none, s.late > 0 ? "amber" : "strong");
    clipped->setValue(open && s.frames > 0 ? percentText(s.clipped) : none);
    engine->setValue(open ? page.engineName() : none);
    bool differs = false;
    if (page.chosen()) {
      Size size = page.projectorSize();
      differs = page.screens()[*page.chosen()].size != QSize(size.width, size.height);
    }
    note->setVisible(differs);
    note->setText(OutputPage::tr("This screen has other pixels than the projector that was measured."),
                  OutputPage::tr("The picture stands in its middle, pixel for pixel."));
  };
  QObject::connect(&page, &OutputPage::changed, card, refresh);
  refresh();
  return card;
}

}  // namespace

PageView viewOf(OutputPage& page) {
  return {stageOf(page), inspectorOf(page)};
}

}  // namespace relucent
