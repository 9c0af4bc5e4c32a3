// SPDX-License-Identifier: MIT
#include <QGuiApplication>

#include "app/show_command.h"
#include "app/wizard_command.h"
#include "content/media_thread.h"

int main(int argc, char** argv) {
  relucent::chooseMediaBackend();
  if (relucent::asksForWizard(argc, argv)) return relucent::runWizardCommand(argc, argv);
  QGuiApplication application(argc, argv);
  QGuiApplication::setApplicationName("relucent");
  QGuiApplication::setQuitOnLastWindowClosed(false);
  return relucent::runShowCommand(QGuiApplication::arguments());
}
