// SPDX-License-Identifier: MIT
#pragma once

#include <QDateTime>
#include <QString>
#include <QStringList>

namespace relucent::gui {

/// How a show starts automatically at log-in.
enum class Start {
  service,    // a unit of the user's systemd: starts the show again when it fails
  autostart,  // an autostart entry (XDG), for desktops without systemd
};

/// A systemd unit that runs a program. Quoted for systemd: quotes, backslashes, control characters, "%" and
/// "$" are literal.
QString systemdUnit(const QString& program, const QStringList& arguments);

/// An autostart entry that runs a program, quoted as the desktop entry specification reads it.
/// Throws: Error{input} for control characters, which it has no way to write.
QString autostartEntry(const QString& program, const QStringList& arguments);

/// Writes the unit or the entry into the user's configuration and enables it, replacing an older one. Atomic.
/// `config`: the folder of the user's configuration, ~/.config.  Returns the file.
/// Throws: Error{input, disk}.
QString install(Start start, const QString& config, const QString& program, const QStringList& arguments);

/// Whether one is installed, for any venue.
bool isInstalled(Start start, const QString& config);
/// When it was; invalid: it is not.
QDateTime installedAt(Start start, const QString& config);
/// Whether one is installed with this argument, the folder of a venue.
bool isInstalled(Start start, const QString& config, const QString& argument);

/// What follows an option of the one that is installed; nothing where it has none. Of values without signs
/// that are quoted, like a time.
QString installedValue(Start start, const QString& config, const QString& option);

/// Where the one that is installed names a folder, or what lies within, it names that of `to` from now on.
/// Nothing where there is none. Atomic. Throws: as install().
void moveInstalled(Start start, const QString& config, const QString& from, const QString& to);

/// Removes it. Returns the file, or nothing if there was none. Throws: Error{disk}.
QString uninstall(Start start, const QString& config);

}  // namespace relucent::gui
