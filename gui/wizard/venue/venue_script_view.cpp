// SPDX-License-Identifier: MIT
#include <QLineEdit>
#include <QSpinBox>

#include "theme/action_button.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "wizard/frame/page_view.h"
#include "wizard/venue/screen_list.h"
#include "wizard/venue/venue_page.h"
#include "wizard/venue/venue_parts.h"

namespace relucent::gui {
namespace {

QLineEdit* commandLine(VenuePage& model, QVBoxLayout* column, const QString& name, const QString& example,
                       std::string pipeline::CommandRigSettings::* part) {
  column->addWidget(labelOf(name, "note"));
  auto* line = new QLineEdit(QString::fromStdString(model.script().*part));
  line->setPlaceholderText(example);
  line->setAccessibleName(name);
  QObject::connect(line, &QLineEdit::textEdited, &model, [&model, part](const QString& text) {
    pipeline::CommandRigSettings script = model.script();
    script.*part = text.toStdString();
    model.setScript(script);
  });
  column->addWidget(line);
  return line;
}

QString whySizeIsFixed() {
  return VenuePage::tr("As many as the chosen screen has.");
}

}  // namespace

QWidget* scriptStage(VenuePage& model) {
  auto* stage = new QWidget;
  auto* column = new QVBoxLayout(stage);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(space::gap);
  auto* list = new ScreenList([&model](const ScreenChoice& choice) { model.chooseScriptScreen(choice); });
  Card* screens = screensCard(stage, list);
  pointOutScreens(model, list);
  screens->setSubtitle(VenuePage::tr("Relucent shows the pictures on it, unless a program of yours does."));
  column->addWidget(screens, 1);
  auto* programs = new Card(VenuePage::tr("Programs"));
  programs->setSubtitle(VenuePage::tr("Any projector and any camera that a command can drive"));
  commandLine(model, programs->body(), VenuePage::tr("Not needed with a screen. %1").arg(showingProgram()),
              "show-on-projector {image}", &pipeline::CommandRigSettings::projectorCommand);
  commandLine(model, programs->body(), photographingProgram(),
              "photograph --seconds {exposure} --to {output}", &pipeline::CommandRigSettings::cameraCommand);
  programs->body()->addStretch(1);
  column->addWidget(programs, 1);
  return stage;
}

QWidget* scriptInspector(VenuePage& model) {
  QVBoxLayout* column = nullptr;
  QWidget* card = inspectorCard(column);
  column->addWidget(consentToBegin(model));
  column->addWidget(labelOf(VenuePage::tr("Projector's pixels"), "section"));
  auto* row = new QHBoxLayout;
  for (int Size::* side : {&Size::width, &Size::height}) {
    auto* box = new QSpinBox;
    box->setRange(8, 8192);
    box->setButtonSymbols(QAbstractSpinBox::NoButtons);
    box->setValue(model.script().projector.*side);
    box->setAccessibleName(side == &Size::width ? VenuePage::tr("Width") : VenuePage::tr("Height"));
    QObject::connect(box, &QSpinBox::valueChanged, &model, [&model, side](int value) {
      pipeline::CommandRigSettings script = model.script();
      if (script.projector.*side == value) return;
      script.projector.*side = value;
      model.setScript(script);
    });
    QObject::connect(&model, &VenuePage::settingsChanged, box, [&model, box, side] {
      QSignalBlocker quiet(box);
      setPossible(box, !model.isScriptOnScreen(), whySizeIsFixed());
      box->setValue(model.script().projector.*side);
    });
    row->addWidget(box);
  }
  column->addLayout(row);
  QLabel* fixed = labelOf({}, "note");
  column->addWidget(fixed);
  QObject::connect(&model, &VenuePage::settingsChanged, fixed, [&model, fixed] {
    fixed->setText(model.isScriptOnScreen() ? whySizeIsFixed() : QString());
    fixed->setVisible(model.isScriptOnScreen());
  });
  fixed->hide();
  column->addWidget(lineOf());
  column->addWidget(keepingPart(model));
  column->addStretch(1);
  return card;
}

}  // namespace relucent::gui
