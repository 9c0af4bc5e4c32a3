// SPDX-License-Identifier: MIT
#include "app/show_command.h"

#include <QCoreApplication>
#include <QGuiApplication>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>
#include <cstdio>
#include <string_view>

#include "app/language.h"
#include "app/show_arguments.h"
#include "desktop/termination.h"
#include "output/engine_renderer.h"
#include "output/shared_gl.h"
#include "output/show.h"
#include "relucent/base/error.h"
#include "relucent/base/terminal_text.h"
#include "relucent/devices/command/command_consent.h"
#include "relucent/pipeline/sets.h"

namespace relucent::gui {
namespace {

constexpr int done = 0, failed = 1, wrongUsage = 2;

int fail(const QString& sentence, int status) {
  std::fprintf(stderr, "relucent: %s\n", forTerminal(sentence.toStdString()).c_str());
  return status;
}

int say(const QString& text) {
  std::fputs(forTerminal(text.toStdString()).c_str(), stdout);
  return done;
}

QString config() {
  return QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation);
}

int run(const TextToPrint& print) {
  return say(print.text);
}

int run(const PlayShow& play) {
  // The overlay speaks as the wizard does.
  Language language(QSettings("relucent", "relucent").value("look/language").toString());
  ShowSettings settings = play.settings;
  settings.projectors = showProjectorsOf(settings.calibration);
  if (settings.projectors.empty() && (settings.switchesPower || settings.closesShutter))
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("show.no-projector-on-network",
                                 "this calibration does not know where its projectors are on the network"),
        RELUCENT_ENGLISH_MESSAGE("show.tell-projectors",
                                 "tell it: relucent-cli projectors --calibration {} --pjlink HOST")
            .with(settings.calibration.string()));
  const auto renderer = [settings](const std::function<void(const QString&)>& warn,
                                   const std::string& named) {
    Progress quiet;
    return std::make_unique<EngineRenderer>(
        RendererSettings{settings.calibration, settings.canvas, settings.adaptiveRange, settings.brightness,
                         settings.backend, settings.cameras, settings.fillsShadows, named},
        quiet, [warn](const Message& sentence) { warn(QString::fromStdString(englishSentence(sentence))); },
        [] {
          SharedGl* shared = SharedGl::instance();
          return shared != nullptr ? shared->host() : nullptr;
        });
  };
  Show show(settings, renderer, clockOf(settings));
  const auto end = [&show] {
    show.stop();
    QGuiApplication::quit();
  };
  Termination termination;
  QObject::connect(&termination, &Termination::requested, &show, end);
  QObject::connect(&show, &Show::endWanted, &show, end);
  show.start();
  return QGuiApplication::exec();
}

int run(const InstallShow& wanted) {
  // Now is when somebody is there to mend it.
  pipeline::openWithSet(wanted.settings.calibration, wanted.settings.set);
  QString file = install(wanted.start, config(), QCoreApplication::applicationFilePath(), wanted.arguments);
  return say(QString("Wrote %1: the show starts at the next log-in.\n").arg(file) +
             (wanted.start == Start::service
                  ? "Now: systemctl --user daemon-reload && systemctl --user start relucent-show\n"
                  : ""));
}

int run(const UninstallShow& unwanted) {
  QString file = uninstall(unwanted.start, config());
  return say(file.isEmpty() ? QString("There was none.\n")
                            : QString("Removed %1: the show starts no more by itself.\n").arg(file));
}

}  // namespace

bool asksForNoScreen(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc, [](std::string_view said) {
    return said == "-h" || said == "-v" || said.starts_with("--help") || said.starts_with("--version") ||
           said.starts_with("--install-") || said.starts_with("--osc-template") ||
           said.starts_with("--remove-");
  });
}

int runShowCommand(const QStringList& arguments) {
  std::vector<std::string> words;
  for (const QString& argument : arguments) words.push_back(argument.toStdString());
  devices::askForConsent(
      {devices::usualConsentFile(),
       [words](const std::string& command) { return devices::isNamedBy(words, command); },
       RELUCENT_MESSAGE("show.allow-commands",
                        "look at what it does, then open the venue in the wizard and allow its programs")});
  try {
    return std::visit([](const auto& command) { return run(command); }, parseShowArguments(arguments));
  } catch (const WrongArguments& error) {
    return fail(error.what(), wrongUsage);
  } catch (const Error& error) {
    return fail(error.what(), failed);
  }
}

}  // namespace relucent::gui
