// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <functional>

namespace relucent::gui {

/// What comes to a port of this computer comes to one listener. Of all connections of this program to such an
/// address, this is the one that may listen, for as long as it lives: a show that is opened again comes
/// before the connection of the former one has found out that nobody waits for it. Any other address is
/// nobody's alone.
class StreamTurn {
 public:
  /// Waits for the one before to end. `check` is called meanwhile, many times a second. Throws: as that.
  StreamTurn(const QString& url, const std::function<void()>& check);
  ~StreamTurn();
  StreamTurn(const StreamTurn&) = delete;
  StreamTurn& operator=(const StreamTurn&) = delete;

 private:
  QString url_;  // empty: nobody has to wait for it
};

}  // namespace relucent::gui
