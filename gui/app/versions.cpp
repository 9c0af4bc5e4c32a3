// SPDX-License-Identifier: MIT
#include "app/versions.h"

#include <spdlog/version.h>
#include <vtkVersion.h>

#include <QCoreApplication>
#include <QFile>

#include "content/stream_decoder.h"
#include "desktop/cast_frames.h"
#include "remote/osc_message.h"

namespace relucent::gui {
namespace {

struct About {
  Q_DECLARE_TR_FUNCTIONS(About)
};

QString read(const QString& resource) {
  QFile file(resource);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

std::vector<pipeline::LibraryVersion> allLibraries() {
  std::vector<pipeline::LibraryVersion> libraries = pipeline::coreLibraries();
  libraries.push_back({"Qt", qVersion()});
  libraries.push_back({"FFmpeg", "libavformat " + streamLibraryVersion().toStdString()});
  libraries.push_back({"PipeWire", castLibraryVersion().toStdString()});
  libraries.push_back({"liblo", oscLibraryVersion().toStdString()});
  libraries.push_back({"VTK", vtkVersion::GetVTKVersion()});
  libraries.push_back({"spdlog", std::to_string(SPDLOG_VER_MAJOR) + '.' + std::to_string(SPDLOG_VER_MINOR) +
                                     '.' + std::to_string(SPDLOG_VER_PATCH)});
  return libraries;
}

QString aboutText() {
  QStringList versions;
  for (const pipeline::LibraryVersion& library : allLibraries())
    versions << QString::fromStdString(library.name + ' ' + library.version);
  return "# " + About::tr("About Relucent") + "\n\n" +
         About::tr("Version %1, with these libraries: %2.")
             .arg(QString::fromStdString(pipeline::relucentVersion()), versions.join(", ")) +
         "\n\n" + read(":/LICENSE").replace("MIT License", "## MIT License") + '\n' +
         read(":/licences.md").replace("# Licences", "## Licences");
}

}  // namespace relucent::gui
