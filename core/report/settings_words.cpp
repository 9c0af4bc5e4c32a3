// SPDX-License-Identifier: MIT
#include "relucent/report/settings_words.h"

#include <fmt/format.h>

#include <filesystem>
#include <type_traits>

#include "relucent/pipeline/command_devices.h"
#include "relucent/pipeline/screen_devices.h"
#include "relucent/report/number_text.h"

namespace relucent::report {
namespace {

std::string joined(std::initializer_list<std::string> parts) {
  std::string text;
  for (const std::string& part : parts)
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string yesOrNo(bool is) {
  return is ? "yes" : "no";
}

void addDevices(std::vector<NamedText>& list, const pipeline::RigSettings& rig) {
  auto camera = [&](const std::string& address) {
    if (!address.empty()) list.push_back({"Camera", address});
  };
  std::visit(
      [&](const auto& devices) {
        using Devices = std::decay_t<decltype(devices)>;
        if constexpr (std::is_same_v<Devices, pipeline::ScreenRigSettings>) {
          for (const pipeline::ScreenRigSettings::Screen& screen : screensOf(devices)) {
            const auto& [connector, manufacturer, model, serialNumber] = screen.display;
            list.push_back({"Projector", joined({manufacturer, model, serialNumber, connector})});
            list.push_back({"Pictures a second", fmt::format("{:.4g}", screen.frameRate)});
          }
          for (const pipeline::ScreenRigSettings::Camera& each : camerasOf(devices)) camera(each.address);
        } else if constexpr (std::is_same_v<Devices, pipeline::CommandRigSettings>) {
          for (std::size_t i = 0; i < projectorsOf(devices).size(); ++i)
            list.push_back({"Projector", "an external program"});
          for (const pipeline::CommandRigSettings::Camera& each : camerasOf(devices))
            camera(each.address.empty() ? "an external program" : each.address);
        }
      },
      rig);
}

std::string pixelWords(const reduction::PixelUse& use) {
  switch (use.kind) {
    case reduction::PixelUse::Kind::automatic:
      return "as many of those that are lit as the projection needs";
    case reduction::PixelUse::Kind::all:
      return "all";
    case reduction::PixelUse::Kind::binned:
      break;
  }
  return fmt::format("those that are lit, {0} × {0} taken as one", use.bin);
}

std::string schemeWords(acquisition::AcquisitionScheme scheme) {
  switch (scheme) {
    case acquisition::AcquisitionScheme::adaptive:
      return "blocks of the picture, finer where it matters";
    case acquisition::AcquisitionScheme::sen:
      return "blocks of the picture, finer down to a fixed brightness";
    case acquisition::AcquisitionScheme::multiplexed:
      break;
  }
  return "dense coloured patterns";
}

void addMeasurement(std::vector<NamedText>& list, const pipeline::CalibrateSettings& settings) {
  const acquisition::AcquisitionSettings& measured = settings.acquisition;
  list.push_back({"Camera pixels", pixelWords(settings.pixels)});
  list.push_back({"Brightness levels per colour", std::to_string(settings.linearization.levels)});
  list.push_back({"Patterns", schemeWords(measured.scheme)});
  if (measured.scheme != acquisition::AcquisitionScheme::multiplexed)
    list.push_back({"Colours of the patterns", measured.colours == acquisition::LitColours::rgb
                                                   ? "red, green and blue in turn"
                                                   : "white"});
  list.push_back({"Faintest light that was looked for",
                  percent(measured.relativeThreshold) + " of the brightest at its place"});
  list.push_back({"Checks of room light and view", fmt::format("every {} patterns", measured.checkInterval)});
  list.push_back({"Test patterns", std::to_string(measured.verificationPatterns)});
  list.push_back({"Pictures may appear mirrored", yesOrNo(measured.mayBeMirrored)});
}

std::string cutWords(const transport::ThresholdSettings& cut) {
  if (cut.absolute > 0.0f)
    return "brighter than " + smallPercent(static_cast<double>(cut.absolute)) +
           " of the camera's full signal a second";
  if (cut.shareOfRowMax > 0.0f)
    return percent(static_cast<double>(cut.shareOfRowMax)) + " of the brightest at its place and more";
  return "all that was measured";
}

/// As the wizard calls them.
std::string methodWords(compensation::Method method) {
  using compensation::Method;
  switch (method) {
    case Method::none:
      return "uncorrected";
    case Method::scalar:
      return "each pixel's brightness";
    case Method::mix:
      return "each pixel on its own";
    case Method::sharpen:
      return "each pixel, sharpened";
    case Method::clusters:
      return "clusters";
    case Method::windows:
      return "windows";
    case Method::refined:
      return "all bounces, for films";
    case Method::optimum:
      break;
  }
  return "all bounces, solved, for stills";
}

const char* brightnessWords(compensation::Brightness brightness) {
  switch (brightness) {
    case compensation::Brightness::even:
      return "one for all pictures";
    case compensation::Brightness::picture:
      return "one for each picture";
    case compensation::Brightness::region:
      break;
  }
  return "one for each part of a picture";
}

const char* clippingWords(compensation::Clipping clipping) {
  switch (clipping) {
    case compensation::Clipping::channels:
      return "as bright as can be";
    case compensation::Clipping::half:
      return "between bright and true";
    case compensation::Clipping::hue:
      break;
  }
  return "dimmed until their hue is right";
}

std::string viewWords(const compensation::ViewSettings& view) {
  return fmt::format("weight {:.3g}, {}", view.weight,
                     view.placement == compensation::ViewPlacement::own ? "a picture of its own"
                                                                        : "the picture on the surface");
}

std::string maskWords(const compensation::Mask& mask) {
  return fmt::format("not lit, in the view of camera {}; {} of {} points, feathered over {} of the view",
                     mask.camera + 1,
                     mask.outline == compensation::Outline::curve ? "a curve" : "straight lines",
                     mask.points.size(), percent(mask.feather));
}

void addContent(std::vector<NamedText>& list, const pipeline::CalibrateSettings& settings) {
  const pipeline::ContentSettings& content = settings.content;
  list.push_back({"Light that is used", cutWords(settings.threshold)});
  list.push_back({"Content", content.picture.empty()
                                 ? "Demonstration picture"
                                 : std::filesystem::path(content.picture).filename().string()});
  list.push_back({"Correction", methodWords(content.method)});
  list.push_back({"Brightness of white", brightnessWords(content.brightness)});
  list.push_back({"Colours out of reach", clippingWords(content.clipping)});
  list.push_back({"May stay too dark", percent(content.reachablePercentile / 100.0) + " of the picture"});
  list.push_back({"Blacks lifted by", content.blackLift ? percent(*content.blackLift)
                                                        : "as little as hides the edges of projectors"});
  for (std::size_t camera = 0; camera < content.views.size(); ++camera)
    list.push_back({fmt::format("View of camera {}", camera + 1), viewWords(content.views[camera])});
  for (std::size_t i = 0; i < content.masks.size(); ++i)
    list.push_back({fmt::format("Mask {}", i + 1), maskWords(content.masks[i])});
}

}  // namespace

std::vector<NamedText> settingsInWords(const pipeline::CalibrateSettings& settings) {
  std::vector<NamedText> list;
  addDevices(list, settings.rig);
  addMeasurement(list, settings);
  addContent(list, settings);
  return list;
}

}  // namespace relucent::report
