// SPDX-License-Identifier: MIT
#include <QLineEdit>

#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

/// A line for each program of the calibration that is open.
class ProgramLines : public QWidget {
 public:
  explicit ProgramLines(VenuePage& model) : model_(model), column_(new QVBoxLayout(this)) {
    column_->setContentsMargins(0, 0, 0, 0);
    refreshOn(model, this, [this] { refresh(); }, &VenuePage::settingsChanged);
  }

 private:
  void refresh() {
    const std::vector<std::string>& typed = model_.openPrograms().typed();
    const auto layout = std::pair(typed.size(), model_.openPrograms().projectors());
    if (layout != shown_) build();
    shown_ = layout;
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (const QString text = QString::fromStdString(typed[i]); lines_[i]->text() != text)
        lines_[i]->setText(text);
  }
  void build() {
    while (QLayoutItem* item = column_->takeAt(0)) {
      item->widget()->hide();
      item->widget()->deleteLater();
      delete item;
    }
    lines_.clear();
    const std::size_t count = model_.openPrograms().typed().size();
    const std::size_t projectors = model_.openPrograms().projectors();
    for (std::size_t i = 0; i < count; ++i) {
      const bool shows = i < projectors;
      const std::size_t alike = shows ? projectors : count - projectors;
      const QString number = alike > 1 ? QString(" %1").arg(shows ? i + 1 : i - projectors + 1) : QString();
      column_->addWidget(
          labelOf((shows ? VenuePage::tr("Projector") : VenuePage::tr("Camera")) + number, "section"));
      const QString name = shows ? showingProgram() : photographingProgram();
      column_->addWidget(labelOf(name, "note"));
      auto* line = new QLineEdit;
      line->setObjectName(QString("program-%1").arg(i + 1));
      line->setAccessibleName(name);
      connect(line, &QLineEdit::textEdited, &model_,
              [this, i](const QString& text) { model_.openPrograms().type(i, text.toStdString()); });
      column_->addWidget(line);
      lines_.push_back(line);
    }
  }

  VenuePage& model_;
  QVBoxLayout* column_;
  std::vector<QLineEdit*> lines_;
  std::pair<std::size_t, std::size_t> shown_;
};

}  // namespace

QString showingProgram() {
  return VenuePage::tr("Shows the file {image} and ends as soon as the projector shines it");
}

QString photographingProgram() {
  return VenuePage::tr(
      "Photographs {exposure} seconds into the file {output}: float EXR, 16-bit PNG or TIFF");
}

QWidget* programsStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* card = new Card(VenuePage::tr("Programs"));
  card->body()->addWidget(new ProgramLines(model));
  card->body()->addStretch(1);
  column->addWidget(card, 1);
  return stage;
}

QWidget* programsInspector(VenuePage&) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(labelOf(VenuePage::tr("This venue"), "section"));
  column->addWidget(
      labelOf(VenuePage::tr("A program that fails ends with another status than 0. What it says "
                            "last is told with it. Try it in a terminal, with a file in place "
                            "of {image} or {output} and seconds in place of {exposure}."),
              "note"));
  column->addStretch(1);
  return card;
}

}  // namespace relucent::gui
