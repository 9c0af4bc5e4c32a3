// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <QStringList>

namespace relucent {

/// How a show starts by itself at log-in.
enum class Start {
  service,    // a unit of the user's systemd: starts the show again when it fails
  autostart,  // an entry of the desktop (XDG), for desktops that systemd does not start
};

/// A systemd unit that runs a program. Quoted as systemd reads it: quotes, backslashes, control characters,
/// "%" and "$" mean themselves.
QString systemdUnit(const QString& program, const QStringList& arguments);

/// An autostart entry that runs a program, quoted as the desktop entry specification reads it.
/// Throws: Error{input} for control characters, which it has no way to write.
QString autostartEntry(const QString& program, const QStringList& arguments);

/// Writes the unit or the entry into the user's configuration and switches it on; an older one is replaced.
/// Atomic. `config`: the folder of the user's configuration, ~/.config.  Returns the file.
/// Throws: Error{input, disk}.
QString install(Start start, const QString& config, const QString& program, const QStringList& arguments);

/// Whether it is there, for any venue.
bool isInstalled(Start start, const QString& config);
/// Whether it is there with that argument among others: the folder of the venue that it plays.
bool isInstalled(Start start, const QString& config, const QString& argument);

/// Takes it away again. Returns the file, or nothing if there was none. Throws: Error{disk}.
QString uninstall(Start start, const QString& config);

}  // namespace relucent
