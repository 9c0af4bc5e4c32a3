// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <memory>

namespace spdlog {
class logger;
}

namespace relucent::gui {

/// The log of a show: `show.log` in a folder, at most five files of a megabyte, the oldest dropped; and the
/// same on standard error.
class ShowLog {
 public:
  /// Creates the folder. Throws: Error{disk}.
  explicit ShowLog(const QString& folder);
  ~ShowLog();

  void tell(const QString& sentence);
  void warn(const QString& sentence);

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace relucent::gui
