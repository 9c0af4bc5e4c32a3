// SPDX-License-Identifier: MIT
#pragma once

#include <QCoreApplication>
#include <QString>
#include <string_view>

namespace relucent::gui {

/// A step of the wizard: a word for programs, the same in every language, and its name for people.
struct StepName {
  const char* id = "";
  const char* context = "";  // of the translation
  const char* english = "";

  /// In the language of the moment.
  QString text() const { return QCoreApplication::translate(context, english); }

  friend bool operator==(const StepName& one, const StepName& other) {
    return std::string_view(one.id) == other.id;
  }
};

}  // namespace relucent::gui
