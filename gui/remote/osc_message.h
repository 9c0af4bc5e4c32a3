// SPDX-License-Identifier: MIT
#pragma once

#include <QByteArray>
#include <QString>
#include <optional>
#include <variant>
#include <vector>

namespace relucent::gui {

/// An argument: numbers of any of OSC's types are numbers here; true and false are 1 and 0.
using OscArgument = std::variant<double, QString>;

/// A message of Open Sound Control 1.0.
struct OscMessage {
  QString address;  // "/viewer"
  std::vector<OscArgument> arguments;

  bool operator==(const OscMessage&) const = default;
};

/// The messages of a datagram, those of bundles in their order, whatever time they name; none: it is not OSC,
/// or holds an argument that is neither a number nor text.
std::optional<std::vector<OscMessage>> oscMessages(const QByteArray& datagram);

/// As a datagram: whole numbers as 32-bit integers, others as floats.
QByteArray oscDatagram(const OscMessage& message);

/// Of the library that reads and writes them.
QString oscLibraryVersion();

}  // namespace relucent::gui
