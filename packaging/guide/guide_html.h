// SPDX-License-Identifier: MIT
#pragma once

#include <QString>

namespace relucent::gui {

/// The user's guide of every language, `help`/LANGUAGE/*.md, as HTML with its pictures:
/// `folder`/LANGUAGE/*.html and an index in each, `folder`/pictures. A page that a language lacks is English,
/// and says so to browsers. Needs a QGuiApplication. Throws std::runtime_error.
void writeGuide(const QString& help, const QString& folder);

}  // namespace relucent::gui
