// SPDX-License-Identifier: MIT
#include <QGuiApplication>

#include "app/show_command.h"
#include "app/wizard_command.h"
#include "content/media_thread.h"
#include "desktop/platform_choice.h"

namespace {

template <typename Application>
int runShow(int argc, char** argv) {
  Application application(argc, argv);
  Application::setApplicationName("relucent");
  return relucent::gui::runShowCommand(Application::arguments());
}

}  // namespace

int main(int argc, char** argv) {
  if (relucent::gui::asksForNoScreen(argc, argv)) return runShow<QCoreApplication>(argc, argv);
  relucent::gui::choosePlatform();
  relucent::gui::chooseMediaBackend();
  if (relucent::gui::asksForWizard(argc, argv)) return relucent::gui::runWizardCommand(argc, argv);
  QGuiApplication::setQuitOnLastWindowClosed(false);
  return runShow<QGuiApplication>(argc, argv);
}
