// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace relucent::gui {

/// A live picture on the network, as written behind "stream:": an address, and "#hold=black" or "#hold=last"
/// behind it if wanted, which no server is sent.
struct StreamAddress {
  enum class Hold { last, black };  // what is shown while it is lost
  QString url;                      // as typed, with user name and password: not for display
  QString host;                     // a name or a number, IPv6 without brackets; empty: any sender
  Hold hold = Hold::last;
};

/// Throws: Error{input} for a kind of address that is none of a stream, and for one without host or port
/// where it needs them. What it says holds no password.
StreamAddress streamAddressFrom(const QString& which);

/// The same for people: scheme, host, port and path. User name and password, and what follows a "?", which
/// may hold more of these, are left out; of an address that cannot be told apart all behind its scheme.
QString shownStream(const QString& which);

}  // namespace relucent::gui
