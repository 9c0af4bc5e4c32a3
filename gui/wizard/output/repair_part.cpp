// SPDX-License-Identifier: MIT
#include "wizard/output/repair_part.h"

#include <QDateTime>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include "text/message_text.h"
#include "text/written_times.h"
#include "theme/action_button.h"
#include "theme/controls.h"
#include "views/number_text.h"
#include "wizard/frame/page_view.h"
#include "wizard/output/output_page.h"

namespace relucent::gui {
namespace {

QString sentences(const std::vector<Message>& what) {
  QStringList lines;
  for (const Message& message : what) lines << fullSentence(message);
  return lines.join('\n');
}

/// With as many decimals as tell one from the other.
QString errorText(double deltaE, double other) {
  const int decimals = decimalText(deltaE, 1) == decimalText(other, 1) ? 2 : 1;
  return isolated(QString::fromUtf8("ΔE %1").arg(decimalText(deltaE, decimals)));
}

/// What the last try came to, where it changed nothing. Returns whether there was one.
bool showVain(Remark& remark, const OutputProof& proof) {
  if (proof.endedUnclear() == OutputProof::Work::repair) {
    remark.show(Remark::Kind::watch, OutputPage::tr("The repair was ended: the room is not said to be clear"),
                OutputPage::tr("The measurement is used as before. Repair again when the room is clear."));
    return true;
  }
  const auto& repair = proof.repair();
  if (!repair || repair->end == pipeline::RepairEnd::repaired) return false;
  if (repair->end == pipeline::RepairEnd::nothingToDo)
    remark.show(Remark::Kind::good, OutputPage::tr("Nothing to repair"),
                OutputPage::tr("The venue is as it was measured."));
  else
    remark.show(Remark::Kind::warning, OutputPage::tr("Not repaired"),
                sentences(repair->what) + '\n' +
                    OutputPage::tr("No better picture came of it: the measurement is used as before."));
  return true;
}

void showState(Remark& remark, const OutputProof& proof) {
  const std::optional<calibration::RepairNote> note = proof.repairNote();
  const bool isVain = showVain(remark, proof);
  remark.setVisible(isVain || note.has_value());
  if (isVain || !note) return;
  const QDateTime when = timeWritten(proof.repairedAt()).toLocalTime();
  remark.show(Remark::Kind::good,
              OutputPage::tr("Repaired, %1").arg(QLocale().toString(when, QLocale::ShortFormat)),
              sentences(note->what) + '\n' +
                  OutputPage::tr("Colour error of a photographed picture: %1 before, %2 now.")
                      .arg(errorText(note->deltaEBefore, note->deltaEAfter),
                           errorText(note->deltaEAfter, note->deltaEBefore)));
}

}  // namespace

QWidget* repairPart(OutputPage& page) {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  auto* state = new Remark;
  state->setObjectName("repair-remark");
  column->addWidget(state);
  auto* repair = new ActionButton(Icon::retry, OutputPage::tr("Repair the calibration"));
  repair->setObjectName("repair");
  repair->setToolTip(
      OutputPage::tr("Finds what has changed, measures only that again, and keeps it if a photograph of the "
                     "picture is better by it."));
  column->addWidget(repair);
  auto* undo = new ActionButton(Icon::back, OutputPage::tr("Use the measurement before"));
  undo->setObjectName("repair-undo");
  undo->setToolTip(OutputPage::tr("Takes the repair back."));
  column->addWidget(undo);
  QObject::connect(repair, &QPushButton::clicked, &page, &OutputPage::repair);
  QObject::connect(undo, &QPushButton::clicked, &page, &OutputPage::askToUndoRepair);
  const auto refresh = [=, &page] {
    const OutputProof& proof = page.proof();
    showState(*state, proof);
    repair->setWhyNot(page.whyNoPatterns());
    undo->setVisible(proof.repairNote().has_value());
    undo->setWhyNot(page.whyNoPhotograph());
  };
  refreshOn(page, part, refresh, &OutputPage::settingsChanged, &OutputPage::resultChanged);
  return part;
}

}  // namespace relucent::gui
