// SPDX-License-Identifier: MIT
#include "wizard/frame/content_files.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

#include "content/image_sequence.h"
#include "content/video.h"

namespace relucent::gui {
namespace {

struct Translated {
  Q_DECLARE_TR_FUNCTIONS(ContentFiles)
};

constexpr const char* lastFolder = "content/folder";

/// The wizard's, by whatever name the program goes.
struct Settings : QSettings {
  Settings() : QSettings("relucent", "relucent") {}
};

/// Of a folder that is not there the dialog would take the name for a file's.
QString folderToBegin() {
  using Paths = QStandardPaths;
  for (const QString& folder :
       {Settings().value(lastFolder).toString(), Paths::writableLocation(Paths::PicturesLocation),
        Paths::writableLocation(Paths::MoviesLocation)})
    if (!folder.isEmpty() && QFileInfo(folder).isDir()) return folder;
  return QDir::homePath();
}

QString filters(ContentFiles kinds) {
  const bool hasFilms = kinds == ContentFiles::picturesAndFilms;
  QStringList patterns;
  for (const QString& ending : pictureEndings() + (hasFilms ? filmEndings() : QStringList()))
    patterns << "*." + ending;
  const QString name = hasFilms ? Translated::tr("Pictures and films") : Translated::tr("Pictures");
  return QString("%1 (%2);;%3 (*)").arg(name, patterns.join(' '), Translated::tr("All files"));
}

/// More than twenty endings are no name of a choice.
constexpr QFileDialog::Options options = QFileDialog::HideNameFilterDetails;

}  // namespace

QStringList askForFiles(QWidget* parent, const QString& title, ContentFiles kinds) {
  const QStringList files =
      QFileDialog::getOpenFileNames(parent, title, folderToBegin(), filters(kinds), nullptr, options);
  if (!files.isEmpty()) Settings().setValue(lastFolder, QFileInfo(files.first()).absolutePath());
  return files;
}

QString askForFile(QWidget* parent, const QString& title, ContentFiles kinds) {
  const QString file =
      QFileDialog::getOpenFileName(parent, title, folderToBegin(), filters(kinds), nullptr, options);
  if (!file.isEmpty()) Settings().setValue(lastFolder, QFileInfo(file).absolutePath());
  return file;
}

}  // namespace relucent::gui
