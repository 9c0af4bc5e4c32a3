// SPDX-License-Identifier: MIT
#include "app/show_arguments.h"

#include <QCommandLineParser>
#include <QCoreApplication>
#include <QFileInfo>
#include <QStandardPaths>

#include "app/versions.h"
#include "content/content_address.h"
#include "output/night_schedule.h"
#include "relucent/compensation/content_identity.h"
#include "relucent/pipeline/sets.h"
#include "remote/controller_template.h"

namespace relucent::gui {
namespace {

/// Of "1920x1080"; none if it is no size that content can have.
std::optional<QSize> sizeFrom(const QString& text) {
  QStringList parts = text.toLower().split('x');
  if (parts.size() != 2) return std::nullopt;
  QSize size(parts[0].toInt(), parts[1].toInt());
  using compensation::leastCanvasSide, compensation::mostCanvasSide;
  if (size.width() < leastCanvasSide || size.height() < leastCanvasSide || size.width() > mostCanvasSide ||
      size.height() > mostCanvasSide)
    return std::nullopt;
  return size;
}

QString fromRoot(const QString& path) {
  return QFileInfo(path).absoluteFilePath();
}

QString contentFromRoot(const QString& path) {
  return addressOf(path).kind == ContentAddress::Kind::file ? fromRoot(path) : path;
}

const QCommandLineOption content(
    "content",
    "What to play: a picture, a film, a folder of numbered pictures, a playlist, "
    "chart:NAME, screen:CONNECTOR, window:TITLE, camera:NAME, or stream:URL of a live picture on the network "
    "(rtsp, srt, rtp, udp, http, rtmp), with #hold=black behind it where black is shown while it is lost "
    "instead of its last picture. A password in it is seen in the list of processes, not in a playlist.",
    "PATH");
const QCommandLineOption loop("loop", "Repeat the content.");
const QCommandLineOption schedule("schedule", "Play during these hours of the day only; black outside them.",
                                  "HH:MM-HH:MM");
const QCommandLineOption night("night",
                               "Tend the venue every night at this time, or after the hours of --schedule: "
                               "the camera looks for what has changed, the calibration is repaired, pictures "
                               "are perfected, and one is proved. The show makes way and then goes on.",
                               "HH:MM|after");
const QCommandLineOption alarm("alarm",
                               "Command that tells somebody when a night had an alarm, once for each: "
                               "{sentence} becomes why, {calibration} the folder.",
                               "COMMAND");
const QCommandLineOption display("screen",
                                 "Connector of a projector's display, one for each; default: chosen by size.",
                                 "NAME");
const QCommandLineOption canvas("canvas", "Size to which content is scaled.", "WxH", "1920x1080");
const QCommandLineOption adaptive("adaptive-range", "Adapt brightness and black level to the content.");
const QCommandLineOption brightness("brightness",
                                    "How bright white is where: even, picture or region. Default: as the "
                                    "calibration has it.",
                                    "NAME");
const QCommandLineOption backend("backend",
                                 "Device for computing: cpu, opengl (including software renderers), or "
                                 "automatic, a graphics card if there is one.",
                                 "NAME", "automatic");
const QCommandLineOption cameraPosition("camera-position",
                                        "Where a camera stands, in the units in which the viewer's position "
                                        "is told; once for each, for viewers who "
                                        "move. Default: as the calibration has it.",
                                        "X,Y,Z");
const QCommandLineOption osc("osc", "Listen to OSC remote controls on this UDP port.", "PORT");
const QCommandLineOption oscAddress(
    "osc-address",
    "The address of this computer on which to listen to them; 0.0.0.0: on all. "
    "Whoever reaches it controls the show.",
    "ADDRESS", "127.0.0.1");
const QCommandLineOption oscFeedback("osc-feedback", "Tell every change to this address by OSC.",
                                     "HOST:PORT");
const QCommandLineOption oscTemplate(
    "osc-template",
    "Write all OSC addresses for a controller and end: open-stage-control, a session of Open Stage Control "
    "that sends to the port of --osc, or csv, a table.",
    "FORMAT");
const QCommandLineOption statusPage("status",
                                    "Show the show's state to browsers on this TCP port, read only.", "PORT");
const QCommandLineOption statusAddress(
    "status-address",
    "The address of this computer on which to show it; 0.0.0.0: on all. Whoever reaches it reads it.",
    "ADDRESS", "127.0.0.1");
const QCommandLineOption switchProjectors("switch-projectors",
                                          "Switch the projectors on for the hours of play and off outside "
                                          "them, if the calibration knows where they are on "
                                          "the network: relucent-cli projectors.");
const QCommandLineOption powerOffAfter(
    "power-off-after", "Switch them off when the picture was black for so long, and on again after that.",
    "MINUTES");
const QCommandLineOption closeShutter("close-shutter", "Close their shutters while the picture is black.");
const QCommandLineOption watch("watch",
                               "Watch the show by a camera that stays: the number of one of the "
                               "calibration's cameras, or KIND:PLACE where "
                               "the first one is now. What has moved, faded or stands in the light is told "
                               "in log, health file, status page "
                               "and by OSC.",
                               "CAMERA");
const QCommandLineOption fillShadows("fill-shadows",
                                     "Where two projectors overlap, fill the shadow of whoever stands in the "
                                     "light of one by the others, as the "
                                     "watching camera sees it: with --watch.");
const QCommandLineOption rehearseTime("rehearse-time",
                                      "For rehearsals in a simulated venue: the time is as the line of this "
                                      "file says, \"FROM UNTIL SPEED\", as "
                                      "\"2026-05-04T08:50 2026-05-04T18:10 1000\", stands still at UNTIL, "
                                      "and follows the file when it changes. "
                                      "relucent-cli rehearse-day does all of it.",
                                      "FILE");
const QCommandLineOption installService(
    "install-service",
    "Start this show at every log-in and restart it after a failure: a systemd user unit.");
const QCommandLineOption installAutostart("install-autostart",
                                          "The same through the desktop's autostart, without systemd.");
const QCommandLineOption removeService("remove-service", "Remove the systemd unit.");
const QCommandLineOption removeAutostart("remove-autostart", "Remove the desktop's autostart entry.");

const QCommandLineOption set("set",
                             "As which set of the calibration content is shown at first: relucent-cli sets. "
                             "Default: as the playlist's times say, or the one in use.",
                             "NAME");
const QCommandLineOption setAtTime(
    "set-at",
    "From this time of the day on as that set, within some seconds and without "
    "a dark frame; once for each, in place of the playlist's.",
    "HH:MM=NAME");

/// Everything that was said, with paths from the root.
QStringList repeatedArguments(const QCommandLineParser& parser, const ShowSettings& settings) {
  QStringList again{"show",      fromRoot(parser.positionalArguments()[1]),
                    "--content", contentFromRoot(parser.value(content)),
                    "--log",     fromRoot(settings.folder)};
  for (const QString& connector : settings.displays) again << "--screen" << connector;
  for (const QString& position : parser.values(cameraPosition)) again << "--camera-position" << position;
  for (const QString& time : parser.values(setAtTime)) again << "--set-at" << time;
  for (const QCommandLineOption& option :
       {schedule, night, alarm, canvas, brightness, backend, osc, oscAddress, oscFeedback, statusPage,
        statusAddress, powerOffAfter, watch, set})
    if (parser.isSet(option)) again << "--" + option.names().first() << parser.value(option);
  for (const QCommandLineOption& option : {loop, adaptive, switchProjectors, closeShutter, fillShadows})
    if (parser.isSet(option)) again << "--" + option.names().first();
  return again;
}

/// Of "x,y" or "x,y,z".
compensation::Position positionFrom(const QString& text) {
  const QStringList parts = text.split(',');
  compensation::Position position{};
  bool isPosition = parts.size() == 2 || parts.size() == 3;
  for (qsizetype k = 0; k < parts.size() && isPosition; ++k)
    position[static_cast<std::size_t>(k)] = parts[k].toDouble(&isPosition);
  if (!isPosition || !compensation::isFinite(position))
    throw WrongArguments(QString("'%1' is no camera's position: write x,y or x,y,z, camera after camera")
                             .arg(text)
                             .toStdString());
  return position;
}

/// Where something is listened to. Throws: WrongArguments.
std::optional<NetworkPlace> placeOf(const QCommandLineParser& parser, const QCommandLineOption& port,
                                    const QCommandLineOption& address) {
  if (!parser.isSet(port)) return std::nullopt;
  NetworkPlace place{QHostAddress(parser.value(address)), parser.value(port).toUShort()};
  if (place.port == 0)
    throw WrongArguments(
        QString("the port of --%1 must be 1 to 65535").arg(port.names().first()).toStdString());
  if (place.host.isNull())
    throw WrongArguments("the address to listen on must be a number, as 127.0.0.1 or 0.0.0.0");
  return place;
}

std::optional<NetworkPlace> oscPlaceOf(const QCommandLineParser& parser) {
  if (!parser.isSet(osc) && (parser.isSet(oscAddress) || parser.isSet(oscFeedback)))
    throw WrongArguments("--osc-address and --osc-feedback need --osc PORT");
  return placeOf(parser, osc, oscAddress);
}

std::optional<NetworkPlace> statusPlaceOf(const QCommandLineParser& parser) {
  if (!parser.isSet(statusPage) && parser.isSet(statusAddress))
    throw WrongArguments("--status-address needs --status PORT");
  return placeOf(parser, statusPage, statusAddress);
}

/// Throws: WrongArguments.
std::optional<pipeline::WatchSettings> watchFrom(const QCommandLineParser& parser) {
  if (!parser.isSet(watch)) return std::nullopt;
  const QString camera = parser.value(watch);
  bool isNumber = false;
  const int number = camera.toInt(&isNumber);
  if (isNumber && number >= 1) return pipeline::WatchSettings{static_cast<std::size_t>(number) - 1};
  if (isNumber || !camera.contains(':'))
    throw WrongArguments(QString("'%1' is no camera: write its number in the calibration, as --watch 1, or "
                                 "where it is, as --watch v4l2:/dev/video0")
                             .arg(camera)
                             .toStdString());
  return pipeline::WatchSettings{0, camera.toStdString()};
}

/// Throws: WrongArguments.
QString templateOf(const QCommandLineParser& parser) {
  constexpr quint16 usualPort = 7700;
  const auto format = valueNamed<ControllerFormat>(parser.value(oscTemplate).toStdString());
  if (!format) throw WrongArguments("the format of --osc-template must be open-stage-control or csv");
  NetworkPlace place = oscPlaceOf(parser).value_or(NetworkPlace{QHostAddress::LocalHost, usualPort});
  // Nobody can send to all addresses.
  if (place.host == QHostAddress::AnyIPv4 || place.host == QHostAddress::AnyIPv6)
    place.host = QHostAddress::LocalHost;
  return QString::fromUtf8(controllerTemplate(*format, place));
}

void readProjectors(const QCommandLineParser& parser, ShowSettings& settings) {
  settings.switchesPower = parser.isSet(switchProjectors);
  settings.closesShutter = parser.isSet(closeShutter);
  if (!parser.isSet(powerOffAfter)) return;
  if (!settings.switchesPower) throw WrongArguments("--power-off-after needs --switch-projectors");
  constexpr int most = 24 * 60;
  const int minutes = parser.value(powerOffAfter).toInt();
  if (minutes < 1 || minutes > most) throw WrongArguments("--power-off-after takes 1 to 1440 minutes");
  settings.powerOffAfter = std::chrono::minutes(minutes);
}

void readNight(const QCommandLineParser& parser, ShowSettings& settings) {
  if (!parser.isSet(night)) {
    if (parser.isSet(alarm)) throw WrongArguments("--alarm needs --night");
    return;
  }
  settings.night = nightTimeFrom(parser.value(night), settings.hours);
  if (!settings.night)
    throw WrongArguments(
        "the night must be HH:MM outside the hours of --schedule, or after, which needs --schedule");
  settings.alarmCommand = parser.value(alarm).toStdString();
}

void readSets(const QCommandLineParser& parser, ShowSettings& settings) {
  if (parser.isSet(set)) {
    settings.set = parser.value(set).toStdString();
    if (const Message wrong = pipeline::problemOfSetName(settings.set); !wrong.empty())
      throw WrongArguments("--set: " + english(wrong));
  }
  if (!parser.isSet(setAtTime)) return;
  settings.content.sets.clear();
  for (const QString& text : parser.values(setAtTime)) {
    const std::optional<SetTime> time = setTimeFrom(text);
    if (!time)
      throw WrongArguments(
          QString("'%1' is no time of a set: write HH:MM=NAME, as 18:00=night").arg(text).toStdString());
    settings.content.sets.append(*time);
  }
  if (const std::vector<Message> wrong = problems(settings.content.sets); !wrong.empty())
    throw WrongArguments(english(wrong.front()));
}

ShowSettings settingsOf(const QCommandLineParser& parser, const QString& folder) {
  if (!parser.isSet(content)) throw WrongArguments("nothing to play; name it with --content");
  ShowSettings settings;
  std::optional<QSize> size = sizeFrom(parser.value(canvas));
  if (!size) throw WrongArguments("the canvas must be WIDTHxHEIGHT of 8 to 8192 pixels, as 1920x1080");
  settings.canvas.size = *size;
  if (parser.isSet(schedule)) {
    settings.hours = dailyHoursFrom(parser.value(schedule));
    if (!settings.hours)
      throw WrongArguments("the schedule must be HH:MM-HH:MM with two different times, as 09:30-18:00");
  }
  readNight(parser, settings);
  std::optional<engine::BackendChoice> chosen =
      valueNamed<engine::BackendChoice>(parser.value(backend).toStdString());
  if (!chosen) throw WrongArguments("the backend must be cpu, opengl or automatic");
  settings.backend = *chosen;
  settings.calibration = parser.positionalArguments()[1].toStdString();
  settings.content = contentOf(parser.value(content));
  settings.content.loop = settings.content.loop || parser.isSet(loop);
  readSets(parser, settings);
  settings.displays = parser.values(display);
  settings.adaptiveRange = parser.isSet(adaptive);
  if (parser.isSet(brightness)) {
    settings.brightness = valueNamed<compensation::Brightness>(parser.value(brightness).toStdString());
    if (!settings.brightness) throw WrongArguments("the brightness must be even, picture or region");
    if (settings.adaptiveRange)
      throw WrongArguments(
          "--adaptive-range and --brightness both say how bright white is: give one of them");
  }
  for (const QString& position : parser.values(cameraPosition))
    settings.cameras.push_back(positionFrom(position));
  settings.osc = oscPlaceOf(parser);
  settings.status = statusPlaceOf(parser);
  settings.watch = watchFrom(parser);
  settings.fillsShadows = parser.isSet(fillShadows);
  if (settings.fillsShadows && !settings.watch)
    throw WrongArguments("shadows are filled as a camera sees them: say which, as --watch 1");
  readProjectors(parser, settings);
  settings.rehearsal = parser.value(rehearseTime);
  if (parser.isSet(oscFeedback)) {
    settings.oscFeedback = networkPlaceFrom(parser.value(oscFeedback));
    if (!settings.oscFeedback)
      throw WrongArguments(
          "the feedback address must be HOST:PORT with a number as host, as 192.168.1.20:9000");
  }
  settings.folder = folder;
  return settings;
}

}  // namespace

ShowArguments parseShowArguments(const QStringList& arguments) {
  QCommandLineParser parser;
  parser.setApplicationDescription(
      "Plays content in a calibrated venue, with compensation, until it is terminated.\n"
      "Keys at the projector: C compensation on and off, space freeze, B black, T test charts,\n"
      "O overlay. Arrow keys, page up and down, and the mouse, dragged, move the viewer where\n"
      "the cameras' positions are known, Home ends that.");
  QCommandLineOption help = parser.addHelpOption(), version = parser.addVersionOption();
  parser.addPositionalArgument("show", "Play a calibrated venue.", "show");
  parser.addPositionalArgument("calibration", "Folder of the calibration.", "CALIBRATION");
  QCommandLineOption log("log", "Folder of the log and the health file.", "DIR",
                         QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation));
  parser.addOptions({content,
                     loop,
                     schedule,
                     night,
                     alarm,
                     display,
                     canvas,
                     adaptive,
                     brightness,
                     backend,
                     cameraPosition,
                     osc,
                     oscAddress,
                     oscFeedback,
                     oscTemplate,
                     statusPage,
                     statusAddress,
                     switchProjectors,
                     powerOffAfter,
                     closeShutter,
                     watch,
                     fillShadows,
                     set,
                     setAtTime,
                     rehearseTime,
                     log,
                     installService,
                     installAutostart,
                     removeService,
                     removeAutostart});
  if (!parser.parse(arguments)) throw WrongArguments(parser.errorText().toStdString());
  if (parser.isSet(help)) return TextToPrint{parser.helpText()};
  if (parser.isSet(version))
    return TextToPrint{QString::fromStdString(pipeline::versionText("relucent", allLibraries()))};

  QStringList words = parser.positionalArguments();
  if (words.value(0) == "show" && words.size() == 1) {
    if (parser.isSet(removeService)) return UninstallShow{Start::service};
    if (parser.isSet(removeAutostart)) return UninstallShow{Start::autostart};
  }
  // Of every show, whichever is named.
  if (words.value(0) == "show" && parser.isSet(oscTemplate)) return TextToPrint{templateOf(parser)};
  if (words.size() != 2 || words[0] != "show")
    throw WrongArguments("usage: relucent show CALIBRATION --content PATH");
  ShowSettings settings = settingsOf(parser, parser.value(log));
  const bool installs = parser.isSet(installService) || parser.isSet(installAutostart);
  if (installs && !settings.rehearsal.isEmpty())
    throw WrongArguments("--rehearse-time is for rehearsals: a show that starts by itself has the real time");
  if (parser.isSet(installService))
    return InstallShow{Start::service, repeatedArguments(parser, settings), settings};
  if (parser.isSet(installAutostart))
    return InstallShow{Start::autostart, repeatedArguments(parser, settings), settings};
  return PlayShow{settings};
}

}  // namespace relucent::gui
