// SPDX-License-Identifier: MIT
#include "output/show_settings.h"

#include <QFileInfo>
#include <QGuiApplication>
#include <algorithm>

#include "content/content_address.h"
#include "content/stream_address.h"
#include "relucent/base/error.h"
#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/pipeline/stored_settings.h"

namespace relucent::gui {
namespace {

QString described(const QScreen& screen) {
  QSize size = nativeSize(screen);
  return QString("%1 (%2x%3%4)")
      .arg(screen.name())
      .arg(size.width())
      .arg(size.height())
      .arg(&screen == QGuiApplication::primaryScreen() ? ", the operator's" : "");
}

QString describedDisplays() {
  QStringList found;
  for (const QScreen* screen : QGuiApplication::screens()) found.append(described(*screen));
  return found.join(", ");
}

/// Pixels that each projector is sent; empty: nothing is.
struct Sizes {
  std::vector<Size> operator()(const pipeline::ScreenRigSettings& rig) const {
    std::vector<Size> sizes;
    for (const auto& screen : pipeline::screensOf(rig)) sizes.push_back(screen.projector);
    return sizes;
  }
  std::vector<Size> operator()(const pipeline::CommandRigSettings& rig) const {
    std::vector<Size> sizes;
    for (const auto& projector : pipeline::projectorsOf(rig)) sizes.push_back(projector.size);
    return sizes;
  }
  std::vector<Size> operator()(const auto&) const { return {}; }  // simulated: nothing is sent
};

}  // namespace

std::vector<ScreenIdentity> displaysFor(const std::vector<QSize>& projectors, const QStringList& named) {
  if (!named.isEmpty() && static_cast<std::size_t>(named.size()) != projectors.size())
    throw Error(
        ErrorKind::input,
        RELUCENT_ENGLISH_MESSAGE("show.display-count-differs", "{} displays are named for {} projectors")
            .with(named.size(), projectors.size()),
        RELUCENT_ENGLISH_MESSAGE("show.name-display-per-projector", "name one for each; there are: {}")
            .with(describedDisplays().toStdString()));

  QList<QScreen*> screens = QGuiApplication::screens();
  std::vector<ScreenIdentity> displays;
  for (const QString& connector : named) {
    auto found = std::find_if(screens.begin(), screens.end(),
                              [&](const QScreen* screen) { return screen->name() == connector; });
    displays.push_back(found != screens.end() ? identityOf(**found) : ScreenIdentity{connector, {}, {}, {}});
  }
  if (!named.isEmpty()) return displays;

  screens.removeOne(QGuiApplication::primaryScreen());
  std::sort(screens.begin(), screens.end(), [](const QScreen* a, const QScreen* b) {
    return std::pair(a->geometry().x(), a->geometry().y()) < std::pair(b->geometry().x(), b->geometry().y());
  });
  for (std::size_t i = 0; i < projectors.size(); ++i) {
    const QSize& projector = projectors[i];
    auto found = std::find_if(screens.begin(), screens.end(),
                              [&](const QScreen* screen) { return nativeSize(*screen) == projector; });
    if (found == screens.end())
      throw Error(
          ErrorKind::input,
          projectors.size() == 1
              ? RELUCENT_ENGLISH_MESSAGE(
                    "show.no-display-of-size",
                    "no display beside the operator's has the {} pixels of the projector")
                    .with(as::size(projector.width(), projector.height()))
              : RELUCENT_ENGLISH_MESSAGE("show.too-few-displays",
                                         "each of the {} projectors needs a display of its own beside the "
                                         "operator's, and there is none of {} pixels for projector {}")
                    .with(projectors.size(), as::size(projector.width(), projector.height()),
                          as::label(i + 1)),
          RELUCENT_ENGLISH_MESSAGE("show.connect-screen",
                                   "plug it in, set it to that size, or name it with --screen; there are: {}")
              .with(describedDisplays().toStdString()));
    displays.push_back(identityOf(**found));
    screens.erase(found);
  }
  return displays;
}

std::vector<ShowProjector> showProjectorsOf(const std::filesystem::path& calibration) {
  using calibration::CalibrationFolder;
  const pipeline::CalibrateSettings settings =
      pipeline::settingsOf(CalibrationFolder::open(calibration, CalibrationFolder::Access::read));
  const std::vector<std::string> labels = pipeline::projectorLabels(settings.rig);
  const std::vector<Size> sizes = std::visit(Sizes(), settings.rig);
  std::vector<ShowProjector> projectors;
  for (const auto& [number, address] : settings.network.addresses)
    projectors.push_back({number < labels.size() ? labels[number] : std::to_string(number + 1), address,
                          number < sizes.size() ? std::optional(sizes[number]) : std::nullopt});
  return projectors;
}

MachineClock clockOf(const ShowSettings& settings) {
  if (settings.rehearsal.isEmpty()) return {};
  // Nobody's lamps are switched on and off thirty times within minutes.
  using calibration::CalibrationFolder;
  const pipeline::RigSettings rig =
      pipeline::settingsOf(CalibrationFolder::open(settings.calibration, CalibrationFolder::Access::read))
          .rig;
  if (!std::holds_alternative<venue::VenueSettings>(rig))
    throw Error(ErrorKind::input,
                RELUCENT_ENGLISH_MESSAGE("show.rehearses-real-devices",
                                         "this calibration has real devices, and days within seconds are for "
                                         "simulated ones"),
                RELUCENT_ENGLISH_MESSAGE("show.rehearse-simulated",
                                         "calibrate a simulated venue for it: relucent-cli venues"),
                settings.calibration.string());
  return MachineClock::rehearsed(settings.rehearsal);
}

PlaylistSettings contentOf(const QString& path) {
  if (addressOf(path).kind != ContentAddress::Kind::file) {
    if (const ContentAddress address = addressOf(path); address.kind == ContentAddress::Kind::stream)
      streamAddressFrom(address.which);
    PlaylistSettings settings;
    settings.items.append({path});
    return settings;
  }
  QString ending = QFileInfo(path).suffix().toLower();
  if (ending == "playlist" || ending == "json") return readPlaylist(path);
  PlaylistSettings settings;
  settings.items.append({QFileInfo(path).absoluteFilePath()});
  return settings;
}

}  // namespace relucent::gui
