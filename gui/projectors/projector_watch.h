// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <QUdpSocket>
#include <memory>
#include <vector>

#include "relucent/pjlink/keeper.h"

namespace relucent::gui {

/// A projector of a show that is on the network.
struct WatchedProjector {
  pjlink::Address address;
  pjlink::KeeperSettings settings;
};

/// What is known of one.
struct ProjectorState {
  QString label, address;
  bool wasAsked = false;                 // else nothing is known yet
  std::optional<pjlink::Report> report;  // none: it does not answer
  Message problem;                       // why not
};

/// Looks after the projectors of a show, each on a thread of its own (pjlink::Keeper).
class ProjectorWatch : public QObject {
  Q_OBJECT

 public:
  /// `wanted`: at first. `blackFor`: how long black must be wanted before shutters close, milliseconds.
  /// `noticesAt`: the UDP port to which projectors say unasked that they changed; 0: any.
  ProjectorWatch(std::vector<WatchedProjector> projectors, const pjlink::Wanted& wanted, int blackFor = 2000,
                 quint16 noticesAt = pjlink::standardPort, QObject* parent = nullptr);
  /// Cancels what is under way.
  ~ProjectorWatch() override;

  /// From now on.
  void want(const pjlink::Wanted& wanted);
  /// In their order.
  const std::vector<ProjectorState>& states() const { return states_; }
  /// The port of notices; 0: a program that shares it with nobody has it, and changes are seen when they are
  /// looked for.
  quint16 listensAt() const { return notices_.localPort(); }

 Q_SIGNALS:
  /// Sentences for the log.
  void told(const relucent::Message& sentence);
  void warned(const relucent::Message& sentence);
  /// states() has.
  void changed();

 private:
  class Watcher;
  void take(std::size_t index, const pjlink::Kept& kept);
  void pass();
  void readNotices();

  std::vector<ProjectorState> states_;
  QUdpSocket notices_;
  std::vector<std::unique_ptr<Watcher>> watchers_;
  pjlink::Wanted wanted_;
  bool closes_;  // shutters, as black has lasted
  QTimer black_;
};

}  // namespace relucent::gui
