// SPDX-License-Identifier: MIT
#include "output/installation.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <filesystem>

#include "relucent/base/error.h"
#include "relucent/base/file.h"

namespace relucent::gui {
namespace {

namespace fs = std::filesystem;
constexpr const char* unitName = "relucent-show.service";

QString fileOf(Start start, const QString& config) {
  return config + (start == Start::service ? QString("/systemd/user/") + unitName
                                           : QString("/autostart/relucent-show.desktop"));
}

/// What `systemctl --user enable` makes.
QString switchOf(const QString& config) {
  return config + "/systemd/user/graphical-session.target.wants/" + unitName;
}

/// A word of ExecStart= [systemd.service(5), systemd.syntax(7)]. `isProgram`: "$" is a dollar there.
QString systemdWord(const QString& word, bool isProgram) {
  QString quoted = "\"";
  for (QChar c : word) {
    if (c == '"' || c == '\\')
      quoted += QString('\\') + c;
    else if (c == '%')
      quoted += "%%";
    else if (c == '$' && !isProgram)
      quoted += "$$";
    else if (c.unicode() < 0x20)
      quoted += QString("\\x%1").arg(c.unicode(), 2, 16, QChar('0'));
    else
      quoted += c;
  }
  return quoted + '"';
}

/// A word of Exec=: quoted by the rules of the Exec key, and then as a string value, where a backslash is
/// two.
QString desktopWord(const QString& word) {
  QString quoted = "\"";
  for (QChar c : word) {
    if (c.unicode() < 0x20)
      throw Error(ErrorKind::input,
                  RELUCENT_ENGLISH_MESSAGE("show.autostart-name-invalid",
                                           "an autostart entry cannot name files with control characters"),
                  RELUCENT_ENGLISH_MESSAGE("show.rename-or-install-service",
                                           "rename it, or install the service instead"),
                  word.toStdString());
    if (c == '\\')
      quoted += "\\\\\\\\";
    else if (c == '"' || c == '`' || c == '$')
      quoted += QString("\\\\") + c;
    else if (c == '%')
      quoted += "%%";
    else
      quoted += c;
  }
  return quoted + '"';
}

/// A symbolic link, in one step.
void link(const QString& target, const QString& name) {
  createFolder(QFileInfo(name).path().toStdString());
  fs::path temporary = (name + ".new").toStdString();
  std::error_code error;
  fs::remove(temporary, error);
  fs::create_symlink(target.toStdString(), temporary, error);
  if (!error) fs::rename(temporary, name.toStdString(), error);
  if (error)
    throw Error(ErrorKind::disk,
                RELUCENT_MESSAGE("show.cannot-enable-service", "the service cannot be switched on ({})")
                    .with(error.message()),
                RELUCENT_MESSAGE("show.check-folder-permissions", "check the folder's permissions"),
                name.toStdString());
}

bool removed(const QString& name) {
  std::error_code error;
  bool there = fs::remove(name.toStdString(), error);
  if (error)
    throw Error(
        ErrorKind::disk,
        RELUCENT_MESSAGE("show.cannot-remove-entry", "it cannot be removed ({})").with(error.message()),
        RELUCENT_MESSAGE("show.check-folder-permissions", "check the folder's permissions"),
        name.toStdString());
  return there;
}

}  // namespace

QString systemdUnit(const QString& program, const QStringList& arguments) {
  QStringList words{systemdWord(program, true)};
  for (const QString& argument : arguments) words.append(systemdWord(argument, false));
  return QString(
             "# Written by relucent show --install-service\n"
             "[Unit]\n"
             "Description=Relucent show\n"
             "PartOf=graphical-session.target\n"
             "After=graphical-session.target\n"
             "\n"
             "[Service]\n"
             "ExecStart=%1\n"
             "Restart=on-failure\n"
             "RestartSec=10\n"
             "\n"
             "[Install]\n"
             "WantedBy=graphical-session.target\n")
      .arg(words.join(' '));
}

QString autostartEntry(const QString& program, const QStringList& arguments) {
  QStringList words{desktopWord(program)};
  for (const QString& argument : arguments) words.append(desktopWord(argument));
  return QString(
             "[Desktop Entry]\n"
             "Type=Application\n"
             "Name=Relucent show\n"
             "Comment=Plays a calibrated venue\n"
             "Exec=%1\n"
             "Terminal=false\n")
      .arg(words.join(' '));
}

QString install(Start start, const QString& config, const QString& program, const QStringList& arguments) {
  QString file = fileOf(start, config);
  QString text =
      start == Start::service ? systemdUnit(program, arguments) : autostartEntry(program, arguments);
  createFolder(QFileInfo(file).path().toStdString());
  writeFileAtomically(file.toStdString(), text.toStdString());
  if (start == Start::service) link(file, switchOf(config));
  return file;
}

bool isInstalled(Start start, const QString& config) {
  return QFileInfo::exists(fileOf(start, config));
}

QDateTime installedAt(Start start, const QString& config) {
  return QFileInfo(fileOf(start, config)).lastModified();
}

bool isInstalled(Start start, const QString& config, const QString& argument) {
  QFile file(fileOf(start, config));
  if (!file.open(QIODevice::ReadOnly)) return false;
  const QString word = start == Start::service ? systemdWord(argument, false) : desktopWord(argument);
  return QString::fromUtf8(file.readAll()).contains(' ' + word);
}

QString installedValue(Start start, const QString& config, const QString& option) {
  QFile file(fileOf(start, config));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QString text = QString::fromUtf8(file.readAll());
  const QString before =
      ' ' + (start == Start::service ? systemdWord(option, false) : desktopWord(option)) + " \"";
  const qsizetype begin = text.indexOf(before);
  return begin < 0 ? QString() : text.mid(begin + before.size()).section('"', 0, 0);
}

void moveInstalled(Start start, const QString& config, const QString& from, const QString& to) {
  QFile file(fileOf(start, config));
  if (!file.open(QIODevice::ReadOnly)) return;
  const QString text = QString::fromUtf8(file.readAll());
  const auto word = [start](const QString& argument) {
    return ' ' + (start == Start::service ? systemdWord(argument, false) : desktopWord(argument));
  };
  // The folder itself, and the beginning of what lies within: a word without its last quote.
  QString moved = text;
  moved.replace(word(from), word(to));
  moved.replace(word(from + '/').chopped(1), word(to + '/').chopped(1));
  if (moved != text) writeFileAtomically(file.fileName().toStdString(), moved.toStdString());
}

QString uninstall(Start start, const QString& config) {
  if (start == Start::service) removed(switchOf(config));
  return removed(fileOf(start, config)) ? fileOf(start, config) : QString();
}

}  // namespace relucent::gui
