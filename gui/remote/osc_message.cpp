// SPDX-License-Identifier: MIT
#include "remote/osc_message.h"

#include <lo/lo.h>

#include <QtEndian>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

namespace relucent::gui {
namespace {

struct FreeMessage {
  void operator()(lo_message message) const { lo_message_free(message); }
};
using OwnedMessage = std::unique_ptr<std::remove_pointer_t<lo_message>, FreeMessage>;

constexpr int deepest = 4;                             // of bundles within bundles
constexpr qsizetype bundleHead = 16, lengthBytes = 4;  // "#bundle", its time; of an element's length

std::optional<OscArgument> argumentOf(char type, const lo_arg& value) {
  switch (type) {
    case LO_INT32:
      return static_cast<double>(value.i);
    case LO_INT64:
      return static_cast<double>(value.h);
    case LO_FLOAT:
      return static_cast<double>(value.f);
    case LO_DOUBLE:
      return value.d;
    case LO_TRUE:
      return 1.0;
    case LO_FALSE:
      return 0.0;
    case LO_STRING:
    case LO_SYMBOL:
      return QString::fromUtf8(&value.s);
    default:
      return std::nullopt;
  }
}

bool appendMessage(QByteArray part, std::vector<OscMessage>& to) {
  // liblo reads whole words.
  if (part.isEmpty() || part.size() % lengthBytes != 0) return false;
  int result = 0;
  const auto bytes = static_cast<std::size_t>(part.size());
  const OwnedMessage message(lo_message_deserialise(part.data(), bytes, &result));
  if (message == nullptr) return false;
  OscMessage read{QString::fromUtf8(part.constData()), {}};
  const char* types = lo_message_get_types(message.get());
  lo_arg** values = lo_message_get_argv(message.get());
  for (int i = 0; i < lo_message_get_argc(message.get()); ++i) {
    std::optional<OscArgument> argument = argumentOf(types[i], *values[i]);
    if (!argument) return false;
    read.arguments.push_back(std::move(*argument));
  }
  to.push_back(std::move(read));
  return true;
}

bool appendPacket(const QByteArray& packet, int depth, std::vector<OscMessage>& to) {
  if (!packet.startsWith('#')) return appendMessage(packet, to);
  if (depth == deepest || packet.size() < bundleHead || !packet.startsWith(QByteArray("#bundle", 8)))
    return false;
  for (qsizetype at = bundleHead; at < packet.size();) {
    if (packet.size() - at < lengthBytes) return false;
    const auto length = qsizetype{qFromBigEndian<quint32>(packet.constData() + at)};
    at += lengthBytes;
    if (length > packet.size() - at || !appendPacket(packet.mid(at, length), depth + 1, to)) return false;
    at += length;
  }
  return true;
}

bool isWhole(double value) {
  return value == std::trunc(value) && std::abs(value) < std::numeric_limits<std::int32_t>::max();
}

}  // namespace

std::optional<std::vector<OscMessage>> oscMessages(const QByteArray& datagram) {
  std::vector<OscMessage> messages;
  if (!appendPacket(datagram, 0, messages)) return std::nullopt;
  return messages;
}

QByteArray oscDatagram(const OscMessage& message) {
  const OwnedMessage made(lo_message_new());
  for (const OscArgument& argument : message.arguments) {
    if (const auto* text = std::get_if<QString>(&argument))
      lo_message_add_string(made.get(), text->toUtf8().constData());
    else if (const double number = std::get<double>(argument); isWhole(number))
      lo_message_add_int32(made.get(), static_cast<std::int32_t>(number));
    else
      lo_message_add_float(made.get(), static_cast<float>(number));
  }
  const QByteArray address = message.address.toUtf8();
  std::size_t bytes = lo_message_length(made.get(), address.constData());
  QByteArray datagram(static_cast<qsizetype>(bytes), Qt::Uninitialized);
  lo_message_serialise(made.get(), address.constData(), datagram.data(), &bytes);
  return datagram;
}

QString oscLibraryVersion() {
  char text[64] = "";
  lo_version(text, sizeof text, nullptr, nullptr, nullptr, 0, nullptr, nullptr, nullptr);
  return QString::fromUtf8(text);
}

}  // namespace relucent::gui
