// SPDX-License-Identifier: MIT
#include "wizard/venue/tidy_dialog.h"

#include <QEvent>
#include <QProgressBar>

#include "theme/action_button.h"
#include "theme/theme.h"
#include "views/number_text.h"

namespace relucent::gui {
namespace {

using Kept = pipeline::KeptPhotographs;
using State = VenueTidy::State;

QString titleOf(Kept kept) {
  switch (kept) {
    case Kept::everything:
      return TidyDialog::tr("All");
    case Kept::latest:
      return TidyDialog::tr("Of the latest measurement");
    case Kept::results:
      break;
  }
  return TidyDialog::tr("None: results only");
}

QString sentenceOf(Kept kept) {
  switch (kept) {
    case Kept::everything:
      return TidyDialog::tr("Only what nothing reads goes, and old files are compressed without loss.");
    case Kept::latest:
      return TidyDialog::tr("Those that were set aside by measuring again go too. Nothing reads them.");
    case Kept::results:
      break;
  }
  return TidyDialog::tr("All that was measured and computed stays. The photographs go.");
}

/// What is no longer possible without the photographs that go.
QString consequenceOf(Kept kept, int photographs) {
  if (photographs == 0) return TidyDialog::tr("No photograph goes: everything stays possible.");
  return kept == Kept::results
             ? TidyDialog::tr(
                   "Showing, checking and reports need results only. Other settings, and better "
                   "methods of later versions, then have to photograph everything again.")
             : TidyDialog::tr("The latest measurement keeps its photographs: everything stays possible.");
}

QString photographsText(int count) {
  return groupedText(TidyDialog::tr("%n photograph(s)", nullptr, count), count);
}

}  // namespace

TidyDialog::TidyDialog(std::unique_ptr<VenueTidy> tidy, QWidget* parent)
    : QDialog(parent), tidy_(std::move(tidy)) {
  setWindowTitle(tr("Free disk space"));
  setObjectName("tidy-dialog");
  setModal(true);
  setMinimumWidth(600);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(28, 28, 28, 24);
  column->setSpacing(12);
  column->addWidget(labelOf(tr("Disk space of %1").arg(tidy_->name()), "title"));
  column->addWidget(doing_ = labelOf({}, "secondary"));
  progress_ = new QProgressBar;
  progress_->setRange(0, 1000);
  progress_->setTextVisible(false);
  column->addWidget(progress_);
  column->addWidget(choicePart_ = choicePart());
  column->addWidget(question_ = new Note(Note::Kind::amber));
  column->addWidget(done_ = new Remark);
  column->addWidget(stopped_ = new Note(Note::Kind::information));
  column->addWidget(failure_ = new Note(Note::Kind::error));
  stopped_->setText(tr("Freeing space was stopped."),
                    tr("What was freed until then is free. Nothing that is needed is lost."));
  column->addStretch(1);
  column->addWidget(buttonRow());
  connect(tidy_.get(), &VenueTidy::changed, this, &TidyDialog::refresh);
  refresh();
}

QWidget* TidyDialog::choicePart() {
  auto* part = new QWidget;
  auto* rows = new QVBoxLayout(part);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(labelOf(tr("Photographs to keep"), "section"));
  auto* group = new QButtonGroup(part);
  for (Kept kept : allValues<Kept>()) {
    auto* choice = new Choice(titleOf(kept), sentenceOf(kept));
    choice->setObjectName("tidy-" + QLatin1StringView(nameOf(kept).data(), std::ssize(nameOf(kept))));
    group->addButton(choice);
    rows->addWidget(choice);
    choices_[kept] = choice;
    connect(choice, &QPushButton::clicked, this, [this, kept] { tidy_->choose(kept); });
  }
  rows->addWidget(incomplete_ = new Note(Note::Kind::information));
  incomplete_->setText(tr("This venue is not measured to the end."),
                       tr("All its photographs stay: going on needs them."));
  return part;
}

QWidget* TidyDialog::buttonRow() {
  auto* part = new QWidget;
  auto* row = new QHBoxLayout(part);
  row->setContentsMargins(0, 0, 0, 0);
  row->addStretch(1);
  row->addWidget(back_ = buttonOf(tr("Back"), "flat"));
  row->addWidget(close_ = buttonOf({}));
  row->addWidget(primary_ = buttonOf({}, "primary"));
  back_->setObjectName("tidy-back");
  close_->setObjectName("tidy-close");
  primary_->setObjectName("tidy-primary");
  connect(back_, &QPushButton::clicked, tidy_.get(), &VenueTidy::goBack);
  connect(close_, &QPushButton::clicked, this, &TidyDialog::reject);
  connect(primary_, &QPushButton::clicked, this,
          [this] { tidy_->state() == State::choosing ? tidy_->ask() : tidy_->free(); });
  return part;
}

void TidyDialog::reject() {
  const State state = tidy_->state();
  if (state != State::looking && state != State::freeing) return QDialog::reject();
  // It may be in the middle of a file: the window waits for it, and says what it came to.
  closes_ = state == State::looking;
  tidy_->cancel();
}

void TidyDialog::refresh() {
  const State state = tidy_->state();
  if (closes_ && state != State::looking) return QDialog::reject();
  const bool atWork = state == State::looking || state == State::freeing;
  doing_->setVisible(atWork);
  progress_->setVisible(atWork);
  doing_->setText(state == State::looking ? tr("Looking up what could be freed. Nothing is removed yet.")
                                          : tr("Freeing the disk"));
  progress_->setAccessibleName(doing_->text());
  progress_->setValue(static_cast<int>(1000.0 * tidy_->fraction()));
  choicePart_->setVisible(state == State::choosing);
  question_->setVisible(state == State::asking);
  done_->setVisible(state == State::done);
  stopped_->setVisible(state == State::stopped);
  failure_->setVisible(state == State::failed);
  if (state == State::choosing) refreshChoices();
  if (state == State::asking) {
    const pipeline::TidiedCalibration& would = tidy_->freedBy(tidy_->kept());
    question_->setText(would.photographs.files > 0
                           ? tr("%1 will be removed for good.").arg(photographsText(would.photographs.files))
                           : tr("%1 will be freed.").arg(bytesText(would.freed())),
                       consequenceOf(tidy_->kept(), would.photographs.files));
  }
  if (state == State::done)
    done_->show(
        Remark::Kind::good,
        tr("%1 freed, %2 removed")
            .arg(bytesText(tidy_->freed().freed()), photographsText(tidy_->freed().photographs.files)),
        consequenceOf(tidy_->kept(), tidy_->freed().photographs.files));
  if (state == State::failed)
    failure_->setText(tidy_->failure().what,
                      tr("%1 Nothing that is needed is lost.").arg(tidy_->failure().advice));
  refreshButtons();
}

void TidyDialog::refreshChoices() {
  incomplete_->setVisible(!tidy_->isComplete());
  for (const auto& [kept, choice] : choices_) {
    const std::uint64_t bytes = tidy_->freedBy(kept).freed();
    choice->setRemark(bytes > 0 ? tr("frees %1").arg(bytesText(bytes)) : tr("nothing to free"));
    choice->setChecked(kept == tidy_->kept());
  }
}

void TidyDialog::refreshButtons() {
  const State state = tidy_->state();
  const bool decides = state == State::choosing || state == State::asking;
  back_->setVisible(state == State::asking);
  primary_->setVisible(decides);
  close_->setText(state == State::looking || decides ? tr("Cancel")
                  : state == State::freeing          ? tr("Stop")
                                                     : tr("Close"));
  if (!decides) return;
  const std::uint64_t bytes = tidy_->freedBy(tidy_->kept()).freed();
  setPossible(primary_, bytes > 0 ? QString() : tr("nothing to free"));
  primary_->setText((state == State::choosing ? tr("Free %1…") : tr("Free %1")).arg(bytesText(bytes)));
}

bool TidyDialog::event(QEvent* event) {
  const bool done = QDialog::event(event);
  // Wrapped lines make it higher, which a window does not ask its layout by itself.
  if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Show)
    resize(std::max(width(), minimumWidth()),
           layout()->totalHeightForWidth(std::max(width(), minimumWidth())));
  return done;
}

}  // namespace relucent::gui
