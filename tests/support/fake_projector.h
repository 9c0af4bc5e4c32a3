// SPDX-License-Identifier: MIT
#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QThread>
#include <functional>
#include <memory>
#include <mutex>

#include "relucent/pjlink/address.h"

namespace relucent::test {

/// What a simulated projector says of itself: the values of PJLink's answers. An empty one is answered by
/// ERR1.
struct FakeProjectorState {
  QByteArray power = "0", shutter = "30", lamps = "1234 0", troubles = "000000", input = "31";
  QByteArray name = "Left", maker = "ACME", model = "P-1", protocolClass = "2";
  QByteArray serial = "SN1", inputName = "HDMI 1", signal = "1920x1080", own = "1920x1080", filter = "12",
             frozen = "0";
  int looksUntilWarm = 2;  // questions after its power before it is on, or off again
  QString password;        // empty: none
};

/// How it misbehaves.
enum class ProjectorFault {
  none,
  saysOnStaysOff,       // POWR 1 is answered OK and nothing happens
  shutterSaysOk,        // the same with its shutter
  noShutter,            // ERR1
  pictureWithSound,     // ERR2 for the shutter of the picture alone
  garbage,              // bytes that are no answer
  overlong,             // a line that never ends
  halfLine,             // and then silence
  slowBytes,            // one after the other, slower than anybody waits
  silent,               // connected, but not a word
  silentAfterGreeting,  //
  closesAtOnce,
  closesMidAnswer,
  lateAnswers,     // before each answer the one to the command before
  unavailable,     // ERR3 to everything but POWR ?
  failure,         // ERR4 to everything
  otherProtocol,   // a web server's greeting
  newerPassword,   // the authentication of class 2
  tooManyVisitors  // PJLINK ERRA at once
};

/// A projector with PJLink at the loopback network, on a thread of its own: whoever talks to it may block.
class FakeProjector {
 public:
  /// At any free port, or at the one given.
  explicit FakeProjector(FakeProjectorState state = {}, ProjectorFault fault = ProjectorFault::none,
                         quint16 port = 0);
  ~FakeProjector();

  /// With its password.
  pjlink::Address address() const;
  FakeProjectorState state() const;
  void change(const std::function<void(FakeProjectorState&)>& how);
  void setFault(ProjectorFault fault);
  /// Whatever it would answer is what this makes of it.
  void setMangle(std::function<QByteArray(const QByteArray&)> mangle);
  /// "POWR 1", in their order, without questions.
  QStringList orders() const;
  int connections() const;
  /// Also answers SRCH by UDP, at the same port.
  void beFound();

 private:
  class Machine;
  QThread thread_;
  std::unique_ptr<Machine> machine_;
};

}  // namespace relucent::test
