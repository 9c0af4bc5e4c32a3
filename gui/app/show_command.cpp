// SPDX-License-Identifier: MIT
#include "app/show_command.h"

#include <QCommandLineParser>
#include <QDir>
#include <QFileInfo>
#include <QGuiApplication>
#include <QStandardPaths>
#include <cstdio>
#include <optional>

#include "app/termination.h"
#include "base/error.h"
#include "output/engine_renderer.h"
#include "output/show.h"

namespace relucent {
namespace {

constexpr int done = 0, failed = 1, wrongUsage = 2;

void say(const QString& sentence) {
  std::fprintf(stderr, "relucent: %s\n", qPrintable(sentence));
}

/// Of "1920x1080"; none if it is no size that content can have.
std::optional<QSize> sizeFrom(const QString& text) {
  QStringList parts = text.toLower().split('x');
  if (parts.size() != 2) return std::nullopt;
  QSize size(parts[0].toInt(), parts[1].toInt());
  if (size.width() < 8 || size.height() < 8 || size.width() > 8192 || size.height() > 8192)
    return std::nullopt;
  return size;
}

}  // namespace

int runShowCommand(const QStringList& arguments) {
  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Plays content in a calibrated venue, compensated, until it is asked to end.\n"
      "Keys at the projector: C compensation on and off, space freeze, B black, O overlay.");
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument("show", "Play a calibrated venue.", "show");
  parser.addPositionalArgument("calibration", "Folder of the calibration.", "CALIBRATION");
  QCommandLineOption content("content", "A picture, a folder of numbered pictures, or a playlist.", "PATH");
  QCommandLineOption loop("loop", "Begin again when it has ended.");
  QCommandLineOption display(
      "screen", "Connector of a projector's display, one for each; else chosen by size.", "NAME");
  QCommandLineOption canvas("canvas", "Size that content is brought to.", "WxH", "1920x1080");
  QCommandLineOption log("log", "Folder of the log and the health file.", "DIR",
                         QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation));
  for (const QCommandLineOption& option : {content, loop, display, canvas, log}) parser.addOption(option);
  if (!parser.parse(arguments)) {
    say(parser.errorText());
    return wrongUsage;
  }
  if (parser.isSet("help")) parser.showHelp(done);
  if (parser.isSet("version")) parser.showVersion();
  QStringList words = parser.positionalArguments();
  std::optional<QSize> canvasSize = sizeFrom(parser.value(canvas));
  if (words.size() != 2 || words[0] != "show" || !parser.isSet(content) || !canvasSize) {
    say(words.size() != 2 || words[0] != "show" ? "usage: relucent show CALIBRATION --content PATH"
        : !parser.isSet(content)                ? "nothing to play; name it with --content"
                                 : "the canvas must be WIDTHxHEIGHT of 8 to 8192 pixels, as 1920x1080");
    return wrongUsage;
  }

  try {
    ShowSettings settings;
    settings.calibration = words[1].toStdString();
    settings.content = contentOf(parser.value(content));
    settings.content.loop = settings.content.loop || parser.isSet(loop);
    settings.displays = parser.values(display);
    settings.canvas.size = *canvasSize;
    settings.folder = parser.value(log);
    Show show(settings, [settings] {
      Progress quiet;
      return std::make_unique<EngineRenderer>(settings.calibration, settings.canvas, quiet);
    });
    Termination termination;
    QObject::connect(&termination, &Termination::requested, &show, [&show] {
      show.stop();
      QGuiApplication::quit();
    });
    show.start();
    return QGuiApplication::exec();
  } catch (const Error& error) {
    say(error.what());
    return failed;
  }
}

}  // namespace relucent
