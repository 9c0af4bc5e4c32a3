// SPDX-License-Identifier: MIT
#include <QGuiApplication>

#include "theme/icons.h"
#include "theme/theme.h"

namespace relucent::gui {
namespace {

// Names in braces are colours by role; what follows a role's name in a selector is set by setRole().
constexpr const char* rules = R"(
* { outline: none; }
QWidget { color: {text}; font-size: 13px; }
QMainWindow, QWidget[role="window"], QDialog { background: {window}; }
QWidget[role="rail"] { background: {rail}; }
QFrame[role="card"] { background: {card}; border: 1px solid {line}; border-radius: 8px; }
QFrame[role="card"] QLabel { background: transparent; border: none; }
QFrame[role="line"] { background: {line}; border: none; max-height: 1px; min-height: 1px; }
QFrame[role="bar"] { background: {window}; border: none; border-top: 1px solid {line}; }
QFrame[role="strip"] { background: {rail}; border: none; border-top: 1px solid {line}; }
QFrame[role="note-information"] { background: {informationGround}; border: 1px solid {information}; border-radius: 6px; }
QFrame[role="note-amber"] { background: {amberGround}; border: 1px solid {amber}; border-radius: 6px; }
QFrame[role="note-error"] { background: {errorGround}; border: 1px solid {error}; border-radius: 6px; }
QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; border: none; }

QLabel[role="title"] { font-size: 20px; font-weight: 600; }
QLabel[role="readout"] { font-size: 24px; font-weight: 600; }
QLabel[role="section"] { font-size: 13px; font-weight: 600; }
QLabel[role="heading"] { font-size: 15px; font-weight: 600; }
QLabel[role="strong"] { font-weight: 600; }
QLabel[role="secondary"] { color: {secondary}; }
QLabel[role="note"] { color: {secondary}; font-size: 12px; }
QLabel[role="good"] { color: {good}; font-weight: 600; }
QLabel[role="amber"] { color: {amber}; font-weight: 600; }
QLabel[role="error"] { color: {error}; font-weight: 600; }
QLabel[role="information"] { color: {information}; }

QPushButton { background: {raised}; border: 1px solid {border}; border-radius: 6px; padding: 0 16px;
  min-height: 34px; font-weight: 600; }
QPushButton:hover { border-color: {text}; }
QPushButton:pressed { background: {input}; }
QPushButton:focus { border: 2px solid {text}; padding: 0 15px; min-height: 32px; }
QPushButton:disabled { color: {disabled}; border-color: {line}; background: {card}; }
QPushButton[role="primary"] { background: {accent}; color: {onAccent}; border: 1px solid {accent}; min-height: 38px;
  padding: 0 24px; }
QPushButton[role="primary"]:focus { border: 2px solid {text}; min-height: 36px; padding: 0 23px; }
QPushButton[role="primary"]:disabled { background: {raised}; color: {disabled}; border-color: {line}; }
QPushButton[role="flat"] { background: transparent; border: 1px solid transparent; padding: 0 12px; }
QPushButton[role="flat"]:hover { background: {raised}; }
QPushButton[role="flat"]:focus { border: 2px solid {text}; padding: 0 11px; }
QPushButton[role="reason"] { background: transparent; border: 1px solid transparent; padding: 0 4px; color: {secondary};
  font-weight: 400; text-align: left; }
QPushButton[role="reason"]:focus { border: 2px solid {text}; padding: 0 3px; }
QPushButton::menu-indicator { subcontrol-origin: border; subcontrol-position: center right; width: 8px; right: 4px; }
QToolButton { background: transparent; border: 1px solid transparent; border-radius: 6px; padding: 5px; }
QToolButton:hover { background: {raised}; }
QToolButton:checked { background: {accentGround}; border-color: {accent}; }
QToolButton:focus { border: 2px solid {text}; padding: 4px; }

QPushButton[role="segment"] { background: {input}; border: 1px solid {border}; border-radius: 6px; padding: 0 12px;
  min-height: 28px; color: {secondary}; }
QPushButton[role="segment"]:checked { background: {accentGround}; border-color: {accent}; color: {text}; }
QPushButton[role="segment"]:focus { border: 2px solid {text}; min-height: 26px; padding: 0 11px; }
QPushButton[role="choice"] { background: {input}; border: 1px solid {line}; border-radius: 6px; padding: 0 12px;
  text-align: left; font-weight: 400; min-height: 50px; }
QPushButton[role="choice"]:checked { background: {accentGround}; border-color: {accent}; }
QPushButton[role="choice"]:hover { border-color: {border}; }
QPushButton[role="choice"]:focus { border: 2px solid {text}; padding: 0 11px; min-height: 48px; }

QLineEdit, QComboBox, QSpinBox, QDoubleSpinBox { background: {input}; border: 1px solid {border}; border-radius: 6px;
  padding: 0 10px; min-height: 32px; selection-background-color: {accent}; selection-color: {onAccent}; }
QLineEdit:focus, QComboBox:focus, QSpinBox:focus, QDoubleSpinBox:focus { border: 2px solid {text}; padding: 0 9px;
  min-height: 30px; }
QComboBox:disabled, QLineEdit:disabled, QSpinBox:disabled { color: {disabled}; border-color: {line}; background: {card}; }
QComboBox QAbstractItemView { background: {raised}; border: 1px solid {border}; selection-background-color: {accentGround};
  selection-color: {text}; outline: none; }
QComboBox::drop-down { border: none; width: 30px; }
QComboBox::down-arrow { image: url("{arrow}"); width: 16px; height: 16px; }
QCheckBox { spacing: 10px; }
QCheckBox::indicator { width: 16px; height: 16px; border: 1px solid {border}; border-radius: 4px; background: {input}; }
QCheckBox::indicator:checked { background: {accent}; border-color: {accent}; image: url("{tick}"); }
QCheckBox:focus { text-decoration: underline; }
QCheckBox::indicator:focus { width: 14px; height: 14px; border: 2px solid {text}; }
QRadioButton::indicator { width: 14px; height: 14px; border: 1px solid {border}; border-radius: 8px; background: {input}; }
QRadioButton::indicator:checked { border: 5px solid {accent}; width: 6px; height: 6px; background: {onAccent}; }
QRadioButton:focus { text-decoration: underline; }
QRadioButton::indicator:focus { border-color: {text}; }
QSlider::groove:horizontal { height: 4px; background: {border}; border-radius: 2px; }
{filled} { background: {accent}; border-radius: 2px; }
QSlider::handle:horizontal { background: {accent}; border: 2px solid {card}; width: 14px; height: 14px; margin: -7px 0;
  border-radius: 9px; }
QSlider::handle:horizontal:focus { border: 2px solid {text}; }
QSlider::handle:horizontal:disabled, {filledDisabled} { background: {disabled}; }
QProgressBar { background: {line}; border: none; max-height: 3px; min-height: 3px; }
QProgressBar::chunk { background: {accent}; }
QListWidget { background: {input}; border: 1px solid {line}; border-radius: 6px; }
QListWidget:focus { border: 2px solid {text}; }
QListWidget::item { padding: 5px 8px; border-radius: 4px; }
QListWidget::item:selected { background: {accentGround}; color: {text}; }
QTextBrowser { background: {card}; border: 1px solid {line}; border-radius: 8px; padding: 12px; }
QTextBrowser:focus { border: 2px solid {text}; }
QTableWidget { background: transparent; border: none; gridline-color: transparent; selection-background-color: {accentGround};
  selection-color: {text}; }
QTableWidget::item { padding: 0 5px; }
QTableWidget:focus { border: 2px solid {text}; border-radius: 6px; }
QHeaderView { background: transparent; }
QHeaderView::section { background: transparent; border: none; color: {secondary}; font-size: 12px; padding: 2px 8px; }
QToolTip { background: {raised}; color: {text}; border: 1px solid {border}; padding: 4px 8px; }
QScrollBar:vertical { background: transparent; width: 10px; }
QScrollBar::handle:vertical { background: {border}; border-radius: 4px; min-height: 24px; margin: 1px; }
QScrollBar:horizontal { background: transparent; height: 10px; }
QScrollBar::handle:horizontal { background: {border}; border-radius: 4px; min-width: 24px; margin: 1px; }
QScrollBar::add-line, QScrollBar::sub-line { height: 0; width: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
)";

}  // namespace

QString styleSheetOf(const Colours& colours) {
  QString sheet = QString::fromLatin1(rules);
  auto fill = [&](const char* name, const QColor& colour) {
    sheet.replace("{" + QString::fromLatin1(name) + "}", colour.name());
  };
  // Of a slider, the part from where its values begin; style sheets mirror the handle alone.
  const QString filled = R"(QSlider[layoutDirection="LeftToRight"]::sub-page:horizontal%1, )"
                         R"(QSlider[layoutDirection="RightToLeft"]::add-page:horizontal%1)";
  sheet.replace("{filled}", filled.arg(QString()));
  sheet.replace("{filledDisabled}", filled.arg(":disabled"));
  sheet.replace("{arrow}", iconFile(Icon::down, colours.secondary, 16));
  sheet.replace("{tick}", iconFile(Icon::tick, colours.onAccent, 16));
  fill("window", colours.window);
  fill("rail", colours.rail);
  fill("card", colours.card);
  fill("raised", colours.raised);
  fill("input", colours.input);
  fill("line", colours.line);
  fill("border", colours.border);
  fill("text", colours.text);
  fill("secondary", colours.secondary);
  fill("disabled", colours.disabled);
  fill("accent", colours.accent);
  fill("accentGround", colours.accentGround);
  fill("onAccent", colours.onAccent);
  fill("good", colours.good);
  fill("amber", colours.amber);
  fill("amberGround", colours.amberGround);
  fill("error", colours.error);
  fill("errorGround", colours.errorGround);
  fill("information", colours.information);
  fill("informationGround", colours.informationGround);
  return sheet;
}

}  // namespace relucent::gui
