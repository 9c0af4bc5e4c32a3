// SPDX-License-Identifier: MIT
#pragma once

#include <QStringList>
#include <QWidget>

namespace relucent::gui {

/// What can be shown, of files.
enum class ContentFiles { pictures, picturesAndFilms };

/// Asks for files to show, in the desktop's own dialog where it has one. It opens where the last ones came
/// from, whatever they were for; the first time in the user's folder of pictures or films. Empty: none was
/// chosen.
QStringList askForFiles(QWidget* parent, const QString& title, ContentFiles kinds);
/// The same for one. Empty: none was chosen.
QString askForFile(QWidget* parent, const QString& title, ContentFiles kinds);

}  // namespace relucent::gui
