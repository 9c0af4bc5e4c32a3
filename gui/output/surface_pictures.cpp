// SPDX-License-Identifier: MIT
#include "output/surface_pictures.h"

#include "relucent/base/require.h"

namespace relucent::gui {

SurfacePictures::~SurfacePictures() {
  disconnect();
  stop();
}

void SurfacePictures::shine(const std::vector<ScreenIdentity>& screens, const std::vector<QImage>& pictures) {
  require(!isShining() && screens.size() == pictures.size(), "{} pictures for {} screens", pictures.size(),
          screens.size());
  for (const ScreenIdentity& screen : screens) {
    ProjectorWindow& window = *windows_.emplace_back(std::make_unique<ProjectorWindow>(screen));
    window.takeKeysOnlyIfAlone();
    // What Esc leads to ends the window that tells it: later, when it is done telling.
    connect(&window, &ProjectorWindow::keyPressed, this, [this](int key) {
      if (key != Qt::Key_Escape) return;
      QMetaObject::invokeMethod(this, &SurfacePictures::stop, Qt::QueuedConnection);
    });
    connect(&window, &ProjectorWindow::displayLost, this, &SurfacePictures::changed);
    connect(&window, &ProjectorWindow::displayFound, this, &SurfacePictures::changed);
  }
  present(pictures);
  for (const auto& window : windows_) window->shine();
  Q_EMIT changed();
}

void SurfacePictures::present(const std::vector<QImage>& pictures) {
  for (std::size_t i = 0; i < windows_.size() && i < pictures.size(); ++i) windows_[i]->present(pictures[i]);
}

void SurfacePictures::stop() {
  if (!isShining()) return;
  for (const auto& window : windows_) window->stop();
  windows_.clear();
  Q_EMIT changed();
}

bool SurfacePictures::isScreenMissing() const {
  return std::any_of(windows_.begin(), windows_.end(),
                     [](const auto& window) { return !window->isShining(); });
}

}  // namespace relucent::gui
