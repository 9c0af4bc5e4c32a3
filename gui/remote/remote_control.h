// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "remote/osc_message.h"
#include "remote/osc_server.h"
#include "remote/remote_actions.h"

namespace relucent::gui {

/// What an address takes, for controllers that are made from the table.
struct RemoteInput {
  enum class Kind {
    none,
    onOff,  // 0 or 1
    range,  // a number from least to most
    whole,  // a whole number from least on
    chart,  // a test chart's name, or none
    name,   // one that the show knows
    place,  // x and y; least and most are those that a controller begins with, as places have no bounds
  };
  Kind kind = Kind::none;
  double least = 0.0, most = 1.0;
};

/// An address that is listened to.
struct RemoteCommand {
  const char* address;
  const char* arguments;    // for people: "0 or 1"
  const char* what;         // a sentence for the table
  std::size_t least, most;  // arguments
  /// Why it cannot be carried out; empty: done.
  Message (*run)(RemoteActions& actions, const std::vector<OscArgument>& arguments);
  /// The present value; nullptr: it has none.
  std::vector<OscArgument> (*value)(const RemoteState& state);
  RemoteInput input{};
  bool isLong = false;  // only begun by the message: what comes of it is announced
};
/// All of them: the one table, from which README and tests take theirs.
std::span<const RemoteCommand> remoteCommands();

/// Carries out OSC messages. An address without arguments, where it needs some, asks for its value. Whoever
/// sent it is answered with the value, or with /error ADDRESS SENTENCE. The position of the viewer comes many
/// times a second: it is answered by errors only, and by each once a minute. Where a feedback address is set,
/// every value goes there whenever it changes, and all of them at first.
class RemoteControl : public QObject {
  Q_OBJECT

 public:
  static constexpr std::size_t mostSentences = 10;

  /// `server` and `actions` must outlive it.
  RemoteControl(OscServer& server, RemoteActions& actions, std::optional<NetworkPlace> feedback,
                QObject* parent = nullptr);

  /// Sends what has changed since the last time to the feedback address. Whoever changes the state by other
  /// means calls it.
  void report();

  /// Tells how long work goes: ADDRESS/WHAT with arguments, to whoever began it last and to the feedback
  /// address.
  void announce(const QString& address, const QString& what, const std::vector<OscArgument>& arguments);

 Q_SIGNALS:
  /// A sentence for the log: why a message cannot be carried out; the same once a minute, and no more than
  /// `mostSentences` of all.
  void warned(const QString& sentence);

 private:
  void obey(const OscMessage& message, const NetworkPlace& from);
  /// `kind`: what else differs in the sentences of one kind is not told again.
  void refuse(const OscMessage& message, const NetworkPlace& from, const QString& kind,
              const QString& sentence);
  bool isNew(const QString& kind);

  OscServer& server_;
  RemoteActions& actions_;
  std::optional<NetworkPlace> feedback_;
  std::map<QString, NetworkPlace> askers_;          // of long work, by its address
  std::vector<std::vector<OscArgument>> reported_;  // of each command
  std::set<QString> told_;                          // kinds of sentences in the minute that began at
  OscServer::Time minute_;
};

}  // namespace relucent::gui
