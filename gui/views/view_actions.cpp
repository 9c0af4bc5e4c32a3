// SPDX-License-Identifier: MIT
#include "views/view_actions.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QToolButton>

#include "relucent/base/error.h"
#include "relucent/image/exr.h"
#include "theme/controls.h"
#include "theme/theme.h"
#include "views/plane_view.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(ViewActions)
};

QToolButton* menuButton(Icon icon, const QString& name) {
  QToolButton* button = toolOf(icon, name);
  button->setMenu(new QMenu(button));
  button->setPopupMode(QToolButton::InstantPopup);
  return button;
}

/// Entries of a button's menu that save the visible picture, and the values where there are any then.
void addSaving(Card& card, QToolButton& button, const std::function<ShownView()>& shown,
               const std::function<void(const Failure&)>& failed) {
  auto add = [&](const QString& text, const QString& title, const QString& filter, const QString& ending) {
    QAction* action = button.menu()->addAction(text);
    QObject::connect(action, &QAction::triggered, &card, [=, &button] {
      QString path = QFileDialog::getSaveFileName(
          button.window(), title,
          suggestedFile(button.window()->windowFilePath(), shown().view.accessibleName(), ending), filter);
      if (path.isEmpty()) return;
      if (!path.endsWith(ending, Qt::CaseInsensitive)) path += ending;
      try {
        const ShownView now = shown();
        saveView(now.view, now.values, path);
      } catch (...) {
        failed(failureOf(std::current_exception()));
      }
    });
    return action;
  };
  add(Translated::tr("Picture as seen"), Translated::tr("Save the picture"),
      Translated::tr("Pictures (*.png)"), ".png");
  QAction* values = add(Translated::tr("Values"), Translated::tr("Save the values"),
                        Translated::tr("OpenEXR (*.exr)"), ".exr");
  QObject::connect(button.menu(), &QMenu::aboutToShow, &card,
                   [values, shown] { values->setVisible(static_cast<bool>(shown().values.values)); });
}

}  // namespace

QString suggestedFile(const QString& venue, const QString& shown, const QString& ending) {
  static const QRegularExpression refused(R"([/\\:*?"<>|\x00-\x1f])");
  static const QRegularExpression comma(QString::fromUtf8("[,\u060c\u3001\uff0c]"));
  // What is told beyond a comma is for those who do not see it.
  QStringList parts{QFileInfo(venue).fileName(), shown.section(comma, 0, 0).simplified()};
  parts.removeAll(QString());
  QString name = parts.join(", ");
  name.replace(refused, " ");
  if (name.simplified().isEmpty()) name = QCoreApplication::applicationName();
  // Where there is no folder for pictures, a dialog would take that in which the program was started.
  const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  return QDir(QFileInfo(pictures).isDir() ? pictures : QDir::homePath()).filePath(name.simplified() + ending);
}

void saveView(PlaneView& view, const ViewValues& values, const QString& path) {
  std::filesystem::path file(path.toStdString());
  if (path.endsWith(".exr", Qt::CaseInsensitive)) {
    image::Image numbers = values.values ? values.values() : image::Image();
    if (numbers.empty())
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("view.no-numbers-yet", "there are no numbers to save yet"),
                  RELUCENT_ENGLISH_MESSAGE("view.wait-until-complete", "wait until the view is complete"),
                  file.string());
    std::map<std::string, image::ExrAttribute> attributes{{image::exr_attribute::units, values.units}};
    return image::writeExr(file, numbers, image::ExrType::floatType, std::move(attributes));
  }
  if (!path.endsWith(".png", Qt::CaseInsensitive))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("view.format-unsupported", "a view is saved as .png or .exr"),
                RELUCENT_ENGLISH_MESSAGE("view.choose-supported-format", "choose one of these endings"),
                file.string());
  if (!view.asSeen().save(path, "PNG"))
    throw Error(ErrorKind::disk,
                RELUCENT_MESSAGE("view.cannot-write-picture", "the picture could not be written"),
                RELUCENT_MESSAGE("view.choose-writable-folder",
                                 "choose a folder that you may write to, with free space"),
                file.string());
}

void addViewActions(Card& card, PlaneView& view, ViewValues values,
                    const std::function<void(const Failure&)>& failed) {
  QToolButton* fit = toolOf(Icon::fit, Translated::tr("Show everything"));
  QObject::connect(fit, &QToolButton::clicked, &view, [&view] { view.link().look(1.0, {0.5, 0.5}); });
  card.addAction(fit);
  QToolButton* whole = toolOf(Icon::monitor, Translated::tr("Whole screen (F11 in the picture)"));
  QObject::connect(whole, &QToolButton::clicked, &view, [&view] { view.setWholeScreen(true); });
  card.addAction(whole);
  QToolButton* save = menuButton(Icon::save, Translated::tr("Save"));
  addSaving(card, *save, [&view, values = std::move(values)] { return ShownView{view, values}; }, failed);
  card.addAction(save);
}

void addViewMenu(Card& card, const std::function<ShownView()>& shown,
                 const std::function<void(const Failure&)>& failed) {
  QToolButton* button = menuButton(Icon::monitor, Translated::tr("Whole screen, save"));
  QAction* whole = button->menu()->addAction(Translated::tr("Whole screen (F11 in the picture)"));
  QObject::connect(whole, &QAction::triggered, &card, [shown] { shown().view.setWholeScreen(true); });
  addSaving(card, *button, shown, failed);
  card.addAction(button);
}

}  // namespace relucent::gui
