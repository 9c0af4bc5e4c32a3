// SPDX-License-Identifier: MIT
#pragma once

#include <QString>
#include <functional>
#include <memory>
#include <string>

namespace spdlog {
class logger;
}

namespace relucent::gui {

/// The log of a show: `show.log` in a folder, at most five files of a megabyte, the oldest dropped; and the
/// same on standard error.
class ShowLog {
 public:
  /// What each line begins with.
  using Mark = std::function<QString()>;
  /// Creates the folder. Throws: Error{disk}.
  explicit ShowLog(const QString& folder, Mark mark = [] { return QString(); });
  ~ShowLog();

  void tell(const QString& sentence);
  void warn(const QString& sentence);

 private:
  std::string lineOf(const QString& sentence) const;

  std::shared_ptr<spdlog::logger> logger_;
  Mark mark_;
};

}  // namespace relucent::gui
