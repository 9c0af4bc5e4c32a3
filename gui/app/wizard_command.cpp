// SPDX-License-Identifier: MIT
#include "app/wizard_command.h"

#include <QApplication>
#include <QDir>
#include <QFontDatabase>
#include <QScreen>
#include <QSettings>
#include <QStandardPaths>
#include <cstring>

#include "app/wizard_window.h"
#include "desktop/termination.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/versions.h"

namespace relucent::gui {
namespace {

/// Where everything was packed into one folder, the type lies there too.
void addPackedFonts() {
  QDir fonts(QApplication::applicationDirPath() + "/../share/fonts");
  for (const QString& file : fonts.entryList({"Inter*.otf"}, QDir::Files))
    QFontDatabase::addApplicationFont(fonts.filePath(file));
}

}  // namespace

bool hasRoom(QSize window, QSize screen) {
  constexpr QSize frame(8, 40);  // what desktops put round a window, about
  window += frame;
  return window.width() <= screen.width() && window.height() <= screen.height();
}

bool asksForWizard(int argc, char** argv) {
  if (argc == 1) return true;
  return argc == 2 && argv[1][0] != '-' && std::strcmp(argv[1], "show") != 0;
}

int runWizardCommand(int argc, char** argv) {
  QApplication application(argc, argv);
  QApplication::setApplicationName("relucent");
  QApplication::setOrganizationName("relucent");
  QApplication::setApplicationDisplayName("Relucent");
  QApplication::setApplicationVersion(QString::fromStdString(pipeline::relucentVersion()));
  // The menu entry's: desktops find icon and name by it.
  QApplication::setDesktopFileName("org.relucent.relucent");
  addPackedFonts();
  devices::askForConsent(
      {devices::usualConsentFile(),
       {},
       RELUCENT_MESSAGE("wizard.allow-commands", "open the venue anew and allow its programs")});
  QSettings settings;
  QString cache = QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + "/venues";
  WizardWindow wizard(settings, cache.toStdString());
  const QSize size = settings.value("window/size", QSize(1366, 768)).toSize();
  const QSize screen = wizard.window().screen()->availableSize();
  // Where nobody manages windows, none is maximized by asking for it.
  wizard.window().resize(size.boundedTo(screen));
  if (settings.value("window/maximized").toBool() || !hasRoom(size, screen))
    wizard.window().showMaximized();
  else
    wizard.window().show();
  if (argc == 2) wizard.open(QDir().absoluteFilePath(QApplication::arguments().at(1)));
  Termination termination;
  QObject::connect(&termination, &Termination::requested, qApp,
                   [&wizard] { wizard.window().closeWithoutAsking(); });
  int status = QApplication::exec();
  // The next screen may have room for it again.
  settings.setValue("window/size",
                    wizard.window().isMaximized() ? size : wizard.window().normalGeometry().size());
  settings.setValue("window/maximized", wizard.window().isMaximized());
  return status;
}

}  // namespace relucent::gui
