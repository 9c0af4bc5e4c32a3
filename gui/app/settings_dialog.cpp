// SPDX-License-Identifier: MIT
#include "app/settings_dialog.h"

#include <QComboBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QLocale>
#include <QScreen>
#include <algorithm>

#include "theme/controls.h"
#include "theme/theme.h"
#include "theme/tick.h"
#include "wizard/frame/stage_scroll.h"

namespace relucent::gui {
namespace {

constexpr int titleBar = 40;  // that a window manager may add, pixels

/// A name above the control that it is of.
void addNamed(QVBoxLayout* column, const QString& name, QWidget* control) {
  column->addWidget(labelOf(name, "note"));
  if (control->accessibleName().isEmpty()) control->setAccessibleName(name);
  column->addWidget(control);
}

/// As those call it who speak it. Qt names these two after a country.
QString nameOfLanguage(const QString& code) {
  if (code == "en") return "English";
  if (code == "es") return QString::fromUtf8("español");
  return QLocale(code).nativeLanguageName();
}

}  // namespace

SettingsDialog::SettingsDialog(Preferences& preferences, QStringList languages, QWidget* parent)
    : QDialog(parent), preferences_(preferences), languages_(std::move(languages)) {
  setWindowTitle(tr("Settings"));
  setObjectName("settings");
  setMinimumWidth(520);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(space::page, space::page, space::page, space::page);
  column->setSpacing(space::gap);
  column->addWidget(labelOf(tr("Settings"), "title"));
  auto* parts = new QWidget;
  auto* inside = new QVBoxLayout(parts);
  inside->setContentsMargins(0, 0, 0, 0);
  inside->setSpacing(space::gap);
  inside->addWidget(lookPart());
  inside->addWidget(measuringPart());
  inside->addWidget(folderPart());
  inside->addStretch(1);
  QScrollArea* scroll = scroll_ = stageScroll(parts);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column->addWidget(scroll, 1);
  auto* row = new QHBoxLayout;
  row->addStretch(1);
  QPushButton* close = buttonOf(tr("Close"), "primary");
  close->setObjectName("close-settings");
  close->setDefault(true);
  connect(close, &QPushButton::clicked, this, &QDialog::accept);
  row->addWidget(close);
  column->addLayout(row);
  // Wrapped lines make it higher, which a window does not ask its layout by itself.
  ensurePolished();
  const int around = column->sizeHint().height() - scroll->sizeHint().height();
  const int whole = around + inside->heightForWidth(minimumWidth() - 2 * space::page);
  resize(minimumWidth(), std::min(whole, screen()->availableSize().height() - titleBar));
}

/// A line more than was foreseen is seen only once all is laid out.
void SettingsDialog::showEvent(QShowEvent* event) {
  QDialog::showEvent(event);
  layout()->activate();
  const int lacking = scroll_->widget()->height() - scroll_->viewport()->height();
  if (lacking > 0)
    resize(width(), std::min(height() + lacking, screen()->availableSize().height() - titleBar));
}

QWidget* SettingsDialog::lookPart() {
  auto* card = new Card(tr("Look"));
  auto* look = new Segmented({tr("Dark"), tr("Light")});
  look->setObjectName("settings-look");
  look->setCurrent(preferences_.isLight() ? 1 : 0);
  connect(look, &Segmented::chosen, &preferences_, [this](int index) { preferences_.setLight(index == 1); });
  addNamed(card->body(), tr("Theme. The dark one is for the dark room."), look);
  auto* dim = new Tick(tr("Dim pictures: the laptop is room light"));
  dim->setObjectName("settings-dim");
  dim->setChecked(preferences_.isDimmed());
  connect(dim, &Tick::toggled, &preferences_, &Preferences::setDimmed);
  connect(&preferences_, &Preferences::changed, dim,
          [this, dim] { dim->setChecked(preferences_.isDimmed()); });
  card->body()->addWidget(dim);
  if (languages_.size() > 1) {
    auto* language = new QComboBox;
    language->setObjectName("settings-language");
    language->addItem(tr("As the computer"), QString());
    for (const QString& code : languages_) language->addItem(nameOfLanguage(code), code);
    language->setCurrentIndex(std::max(0, language->findData(preferences_.language())));
    connect(language, &QComboBox::activated, &preferences_,
            [this, language] { preferences_.setLanguage(language->currentData().toString()); });
    addNamed(card->body(), tr("Language"), language);
  }
  return card;
}

QWidget* SettingsDialog::measuringPart() {
  auto* card = new Card(tr("Measuring"));
  auto* limit = new QComboBox;
  limit->setObjectName("settings-flashes");
  limit->addItem(tr("As quickly as the devices can, after a consent"), 0);
  for (int changes : {3, 2, 1})
    limit->addItem(tr("At most %n change(s) a second", nullptr, changes), changes);
  limit->setCurrentIndex(limit->findData(preferences_.flashLimit()));
  connect(limit, &QComboBox::activated, &preferences_,
          [this, limit] { preferences_.setFlashLimit(limit->currentData().toInt()); });
  addNamed(card->body(), tr("Flashing light of the projector"), limit);
  card->body()->addWidget(labelOf(
      tr("More than three changes a second can cause seizures. Slower measuring needs no consent."), "note"));
  auto* sound = new Tick(tr("A sound when a measurement ends"));
  sound->setObjectName("settings-sound");
  sound->setChecked(preferences_.hasSound());
  connect(sound, &Tick::toggled, &preferences_, &Preferences::setSound);
  card->body()->addWidget(sound);
  return card;
}

QWidget* SettingsDialog::folderPart() {
  auto* card = new Card(tr("New venues"));
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  auto* folder = new QLineEdit(preferences_.folder());
  folder->setObjectName("settings-folder");
  folder->setAccessibleName(tr("Folder for new venues"));
  row->addWidget(folder, 1);
  QToolButton* browse = toolOf(Icon::folder, tr("Choose a folder"));
  row->addWidget(browse);
  addNamed(card->body(), tr("Folder"), line);
  connect(folder, &QLineEdit::editingFinished, &preferences_,
          [this, folder] { preferences_.setFolder(folder->text()); });
  connect(browse, &QToolButton::clicked, this, [this, folder] {
    QString chosen = QFileDialog::getExistingDirectory(this, tr("Choose a folder"), preferences_.folder());
    if (chosen.isEmpty()) return;
    preferences_.setFolder(chosen);
    folder->setText(chosen);
  });
  return card;
}

}  // namespace relucent::gui
